//! Why a measurement was made from a view, and what came of it.

use std::fmt::Write as _;

use serde::Serialize;

use super::history::Past;
use super::words::{self, mark, plural, quantity, share};
use crate::detect::{Condition, Test, Unit};
use crate::show::lines::{aim, found_since, remaining};
use crate::show::log::{Contradiction, Next, Standing, Stop, View};

/// Why a measurement was made from a view, and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewAnswer {
    /// Number of the measurement.
    pub n: u32,
    /// Index of its candidate view.
    pub view: usize,
    /// The decision that led to it; `None` for the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen: Option<Chosen>,
    /// What it changed, as in the line of the run.
    pub found: Vec<String>,
    /// The classes left.
    pub classes: String,
    /// Where the camera went from there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<Standing>,
    /// Why the run stopped there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stop>,

    /// What contradicted the library.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contradiction: Option<Contradiction>,
}

/// A decision for a view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chosen {
    /// The method that decided.
    pub method: String,
    /// The chosen view and those it was preferred to.
    #[serde(flatten)]
    pub next: Next,
    /// Weight of the feature that it went for, bits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
    /// Least share of the overlap constraint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<f64>,
}

/// The answer about a measurement, which is the last of the past.
pub(super) fn answer(past: &Past<'_>, n: u32) -> ViewAnswer {
    let mut back = past.views[..past.views.len().min(n as usize)].iter().rev();
    let (view, before) = (back.next(), back.next());

    let stop = view.and_then(|v| v.stop.clone());
    ViewAnswer {
        n,
        view: view.map_or(0, |v| v.view),
        chosen: before.and_then(|b| chosen(past, b)),
        found: view
            .map(|v| found_since(before.map(|b| &b.features), &v.features))
            .unwrap_or_default(),
        classes: view.map(|v| remaining(&v.classes)).unwrap_or_default(),
        next: view.and_then(|v| v.next.as_ref()).map(|next| next.chosen.clone()),
        stop: stop.or_else(|| {
            past.run
                .end
                .as_ref()
                .filter(|_| view.is_some_and(|v| v.next.is_none()))
                .map(bare_stop)
        }),

        contradiction: past.contradiction().cloned(),
    }
}

/// What an older log tells of the end.
fn bare_stop(end: &crate::show::log::End) -> Stop {
    Stop {
        outcome: end.outcome.clone(),
        confident: false,
        exhausted: false,
        because: Vec::new(),
    }
}

fn chosen(past: &Past<'_>, before: &View) -> Option<Chosen> {
    let next = before.next.clone()?;
    let target = next.chosen.target.as_ref();
    Some(Chosen {
        method: past.run.start.method.clone(),
        weight: target.and_then(|t| before.features.get(&t.feature)).map(|f| f.weight),
        overlap: past.run.start.criteria.as_ref().map(|c| c.overlap),
        next,
    })
}

/// Why a run stops, in a few words.
pub(super) fn stop_reason(stop: &Stop) -> String {
    let holding = |name: &str| stop.because.iter().find(|c| c.name == name && c.holds);
    match stop.outcome.as_str() {
        "goal" if stop.because.is_empty() => "the goal was reached".to_owned(),
        "goal" if stop.confident => match holding("confident").map(|c| (&c.of, &c.test)) {
            Some((Some(class), Test::Quantity { found: Some(p), .. })) => format!("certain of {class}, p = {p:.3}"),
            _ => "the class is certain".to_owned(),
        },
        "goal" => "no view can show more".to_owned(),
        "exhausted" => "no view can gain anything".to_owned(),
        "contradiction" => match holding("contradiction").and_then(|c| c.of.as_ref()) {
            Some(feature) => format!("{feature} contradicts the library"),
            None => "the library is contradicted".to_owned(),
        },
        "view_limit" => "the limit of views".to_owned(),
        other => other.to_owned(),
    }
}

impl ViewAnswer {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let mut text = format!("view {}, from #{}\n\n", self.n, self.view);
        match &self.chosen {
            Some(chosen) => text += &chosen.to_text(self.n - 1),
            None => text += "the first view: drawn from the seed, or given with `--start`\n",
        }
        let found = if self.found.is_empty() {
            "nothing new".to_owned()
        } else {
            self.found.join(", ")
        };
        let _ = writeln!(text, "\nit showed   {found}; left: {}", self.classes);
        match (&self.next, &self.stop) {
            (Some(next), _) => {
                let _ = writeln!(text, "then        #{} {}", next.view, aim(next));
            }
            (None, Some(stop)) => self.stop_to(stop, &mut text),
            (None, None) => text += "then        the log does not tell\n",
        }
        text
    }

    fn stop_to(&self, stop: &Stop, text: &mut String) {
        let _ = writeln!(text, "then        the run stopped: {}", stop_reason(stop));
        if let Some(c) = &self.contradiction {
            let _ = writeln!(text, "  {}: {}", c.feature, c.evidence);
        }
        for condition in &stop.because {
            let _ = writeln!(text, "  {}", ending(condition, stop));
        }
    }
}

/// A condition that a run can end by, in words.
fn ending(condition: &Condition, goal: &Stop) -> String {
    let asked = match condition.name.as_ref() {
        "confident" | "verified" => goal.confident,
        "feature gain" | "feature seen whole" | "surface gain" => goal.exhausted,
        _ => false,
    };
    let asked = if asked { "  ← asked for by the goal" } else { "" };
    let said = match condition.name.as_ref() {
        "contradiction" if !condition.holds => "✗ no contradiction".to_owned(),
        "feature gain" | "feature seen whole" => gain(condition, "of a feature that matters"),
        "surface gain" => gain(condition, "behind the measured surface"),
        "view limit" => limit(condition),
        "verified" if condition.holds => "✓ every predicted feature of the class was inspected".to_owned(),
        "verified" => format!(
            "✗ `{}` of the class was not inspected",
            condition.of.as_deref().unwrap_or("a feature")
        ),
        _ => words::condition(condition),
    };
    said + asked
}

/// `✗ not at the limit of views: 10 of 20`.
fn limit(condition: &Condition) -> String {
    let Test::Quantity { least, found, .. } = &condition.test else {
        return words::condition(condition);
    };
    let (found, limit) = (found.unwrap_or(0.0), least.unwrap_or(0.0));
    match condition.holds {
        true => format!("✓ at the limit of {limit} views"),
        false => format!("✗ not at the limit of views: {found} of {limit}"),
    }
}

/// `✓ nothing to gain behind the measured surface: no unvisited view shows more than 8 voxels, …`.
fn gain(condition: &Condition, what: &str) -> String {
    let verdict = format!(
        "{} {} to gain {what}",
        mark(condition.holds),
        if condition.holds { "nothing" } else { "something" }
    );
    let Test::Quantity { unit, most, found, .. } = &condition.test else {
        return verdict;
    };
    let found = quantity(*unit, found.unwrap_or(0.0));
    let of = condition.of.as_ref().map_or(String::new(), |of| format!(" of `{of}`"));
    let enough = match (unit, most) {
        (Unit::Voxels, Some(most)) => format!(", and {} would count", quantity(*unit, most + 1.0)),
        (_, Some(most)) => format!(" in one view, and {} would count", quantity(*unit, *most)),
        _ => String::new(),
    };
    format!("{verdict}: no unvisited view shows more than {found}{of}{enough}")
}

impl Chosen {
    fn to_text(&self, after: u32) -> String {
        let best = &self.next.chosen;
        let mut text = format!(
            "{} chose #{} after view {after}: {}\n",
            self.method,
            best.view,
            aim(best)
        );
        if let (Some(target), Some(weight)) = (&best.target, self.weight)
            && best.terms.feature > 0.0
        {
            let _ = writeln!(
                text,
                "  {:.2} bits = weight of {} {weight:.2} · {} of its {} voxels",
                best.terms.feature, target.feature, target.reached, target.voxels
            );
        } else if best.terms.w == 1 {
            text += "  no unvisited view shows anything of a feature that matters, so the surface counts (W = 1)\n";
        }
        if self.next.relaxed {
            text += "  ✗ no view with a gain meets the overlap; of those the one of largest overlap was taken\n";
        } else if let (Some(share), Some(least)) = (best.share, self.overlap) {
            text += &format!("  {}\n", overlap(share, least));
        }
        for other in self
            .next
            .runners_up
            .iter()
            .filter(|s| s.terms.overlap == 0 && !self.next.relaxed)
        {
            let share = other.share.map_or(String::new(), |s| format!(" of {}", share(s)));
            let _ = writeln!(
                text,
                "  ✗ #{} would gain more, but its overlap{share} is too small",
                other.view
            );
        }
        if let Some(tie) = self.tie() {
            let _ = writeln!(text, "  {tie}");
        }
        text += &self.table();
        text
    }

    /// How the best view was told from its equals.
    fn tie(&self) -> Option<String> {
        let (best, second) = (&self.next.chosen, self.next.runners_up.first()?);
        let value = |s: &Standing| {
            if self.next.relaxed {
                s.share.unwrap_or(0.0)
            } else {
                s.score
            }
        };
        let same = value(best).total_cmp(&value(second)).is_eq();
        let (near, far) = (best.distance?, second.distance?);
        same.then(|| {
            let (near, far) = (quantity(Unit::Length, near), quantity(Unit::Length, far));
            if near == far {
                return format!("tie with #{}: as near, {far}; the lower index wins", second.view);
            }
            format!(
                "tie with #{}: #{} is nearer, {near} from the view before instead of {far}",
                second.view, best.view
            )
        })
    }

    fn table(&self) -> String {
        let mut text = String::from("\n         score  overlap  feature  surface  W  distance\n");
        text += &row('✓', &self.next.chosen);
        for other in &self.next.runners_up {
            text += &row(' ', other);
        }
        if self.next.runners_up.is_empty() {
            let why = if self.method == "random" {
                "this method does not rank"
            } else {
                "the log tells of no other view"
            };
            let _ = writeln!(text, "  {why}");
        }
        text
    }
}

fn overlap(share_of: f64, least: f64) -> String {
    format!(
        "{} overlap {} (at least {})",
        mark(share_of >= least - 1e-9),
        share(share_of),
        share(least)
    )
}

/// A row of the table of views.
pub(super) fn row(mark: char, standing: &Standing) -> String {
    let terms = &standing.terms;
    let overlap = standing.share.map_or_else(
        || terms.overlap.to_string(),
        |s| format!("{} {}", terms.overlap, share(s)),
    );
    let distance = standing.distance.map_or(String::new(), |d| format!("{d:.2} m"));
    let target = standing.target.as_ref().map_or(String::new(), |t| {
        format!(
            "  {} {}: {} of {}",
            t.feature,
            t.key,
            t.reached,
            plural(t.voxels, "voxel")
        )
    });
    let line = format!(
        "  {mark} #{:<4} {:<6} {overlap:<8} {:<8} {:<8} {}  {distance}{target}",
        standing.view,
        decimals(standing.score),
        decimals(terms.feature),
        terms.surface,
        terms.w
    );
    line.trim_end().to_owned() + "\n"
}

/// Four decimals as far as they say something: `1490`, `0.8571`.
fn decimals(x: f64) -> String {
    format!("{}", (x * 1e4).round() / 1e4)
}
