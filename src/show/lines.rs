//! Lines for people: one a view, and the closing summary.

use std::fmt::Write as _;

use super::log::{End, Feature, Ordered, Record, Standing, View};
use super::why;

/// Most names that a line lists.
const LISTED: usize = 4;

/// What a view showed and what comes next: what was found since `before`,
/// which classes remain, where the camera goes and why.
pub fn view_line(before: Option<&View>, view: &View) -> String {
    let mut line = format!("view {:>2}  #{:<4}", view.n, view.view);
    let found = found_since(before.map(|b| &b.features), &view.features);
    let _ = write!(
        line,
        "{:<34}",
        if found.is_empty() {
            "nothing new".to_owned()
        } else {
            found.join(", ")
        }
    );
    let _ = write!(line, "  {:<26}", remaining(&view.classes));
    match &view.next {
        None => match &view.stop {
            Some(stop) => {
                let _ = write!(line, "  stop: {}", why::stop_reason(stop));
            }
            None => line.push_str("  stop"),
        },
        Some(next) => {
            let _ = write!(line, "  next #{} {}", next.chosen.view, aim(&next.chosen));
            if next.relaxed {
                line.push_str(" (overlap relaxed)");
            }
        }
    }
    line
}

/// What a view is taken for.
pub(super) fn aim(view: &Standing) -> String {
    let terms = &view.terms;
    match &view.target {
        Some(target) if terms.feature > 0.0 => {
            let feature = match target.key.as_str() {
                key if key.contains('/') => format!("{} at {key}", target.feature),
                _ => target.feature.clone(),
            };
            format!("for {feature}, {:.2} bits", terms.feature)
        }
        None if terms.feature > 0.0 => format!("for {:.2} bits", terms.feature),
        _ if terms.w == 1 => format!("for {} unseen voxels behind the surface", terms.surface),
        _ => "by the method's own measure".to_owned(),
    }
}

/// `+code[3]` detected, `-code[2]` absent, and `bottom ×4` for several instances.
pub(super) fn found_since(before: Option<&Ordered<Feature>>, now: &Ordered<Feature>) -> Vec<String> {
    let measured = |f: &Feature| f.instances.iter().filter(|i| i.state == 1).count();
    let mut found = Vec::new();
    for (k, (name, feature)) in now.0.iter().enumerate() {
        let old = before.and_then(|b| b.0.get(k)).map(|(_, f)| f);
        let (old_state, old_count) = old.map_or((-1, 0), |f| (f.state, measured(f)));
        match feature.state {
            1 if measured(feature) > old_count => {
                let n = measured(feature);
                found.push(if n > 1 {
                    format!("+{name} ×{n}")
                } else {
                    format!("+{name}")
                });
            }
            0 if old_state != 0 => found.push(format!("-{name}")),
            _ => {}
        }
    }
    shortened(found)
}

/// The classes that remain: names where few, a count where many.
pub(super) fn remaining(classes: &Ordered<f64>) -> String {
    let left: Vec<&str> = classes
        .0
        .iter()
        .filter(|(_, p)| *p > 0.0)
        .map(|(name, _)| name.as_str())
        .collect();
    match left.as_slice() {
        [] => "no class fits".to_owned(),
        [only] => (*only).to_owned(),
        few if few.len() <= LISTED => few.join(" "),
        many => format!("{} of {} classes", many.len(), classes.0.len()),
    }
}

fn shortened(mut names: Vec<String>) -> Vec<String> {
    if names.len() > LISTED {
        let more = names.len() - (LISTED - 1);
        names.truncate(LISTED - 1);
        names.push(format!("{more} more"));
    }
    names
}

/// The closing summary.
pub fn summary(records: &[Record], object: &str) -> String {
    let mut text = String::new();
    let Some(Record::End(end)) = records.last() else {
        return text;
    };
    let one_class = views(records).last().is_some_and(|v| v.classes.0.len() == 1);
    let _ = writeln!(text, "{}", verdict(end, object, one_class));
    let views: Vec<String> = views(records).map(|v| v.view.to_string()).collect();
    let _ = writeln!(text, "views       {}: {}", end.views, views.join(" → "));
    if let Some(coverage) = end.coverage {
        let _ = writeln!(text, "coverage    {:.1} % of the observable surface", coverage * 100.0);
    }
    let total = |of: fn(&View) -> f64| self::views(records).map(of).sum::<f64>() / 1000.0;
    let split = [
        total(|v| v.ms.sense),
        total(|v| v.ms.detect),
        total(|v| v.ms.map),
        total(|v| v.ms.score),
    ];
    let [sense, detect, map, score] = split;
    let sum: f64 = split.iter().sum();
    let _ = writeln!(
        text,
        "time        {sum:.2} s: sense {sense:.2}, detect {detect:.2}, map {map:.2}, score {score:.2}"
    );
    text
}

fn views(records: &[Record]) -> impl Iterator<Item = &View> {
    records.iter().filter_map(|r| match r {
        Record::View(view) => Some(view.as_ref()),
        _ => None,
    })
}

/// `one_class`: the library has no other, so that naming it would say nothing.
fn verdict(end: &End, object: &str, one_class: bool) -> String {
    let class = end.class.as_deref().filter(|_| !one_class);
    match (end.outcome.as_str(), class) {
        ("goal", Some(class)) => format!("goal        {object} is of class {class} (p = {:.3})", end.confidence),
        ("goal", None) => format!("goal        no view can show more of {object}"),
        ("contradiction", _) => {
            let (feature, evidence) = end
                .contradiction
                .as_ref()
                .map_or(("?", ""), |c| (c.feature.as_str(), c.evidence.as_str()));
            format!("contradiction  {object} fits no class of the library\n  {feature}: {evidence}")
        }
        ("exhausted", _) => format!(
            "exhausted   no view can gain anything, and the goal is not reached ({})",
            likeliest(end)
        ),
        (outcome, _) => format!("{outcome}  the limit of views is used up ({})", likeliest(end)),
    }
}

fn likeliest(end: &End) -> String {
    match &end.class {
        Some(class) => format!("class {class}, p = {:.3}", end.confidence),
        None => format!("no class is certain, the likeliest has p = {:.3}", end.confidence),
    }
}
