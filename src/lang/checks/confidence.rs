//! Confidences that a class never reaches, and ones that it has from the start.

use std::collections::BTreeSet;

use super::{Analysed, names, twins};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::recognition::Recognition;
use crate::rules::{FeatureId, Library};

/// Most classes that are pointed at one by one.
const MOST_SHOWN: usize = 4;

pub(super) fn check(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let (Some(library), Some(recognition)) = (task.library, &task.recognition) else {
        return Vec::new();
    };
    if !library.rules.iter().any(|r| r.antecedents.is_empty()) {
        // Nothing can be found at all, which is said elsewhere.
        return Vec::new();
    }
    let mut found = Vec::new();
    found.extend(certain_at_once(task, library, recognition));
    found.extend(never_certain(task, library, recognition));
    found
}

fn certain_at_once(task: &Analysed<'_>, library: &Library, recognition: &Recognition) -> Option<Diagnostic> {
    let all = recognition.all();
    let reaches = |m: &usize| recognition.share(*m, &all) >= task.task.thresholds.confidence;
    let class = &library.classes[(0..recognition.classes()).find(reaches)?];
    let message = format!("`{}` is certain before anything is seen", class.name);
    let help = if library.classes.len() == 1 {
        "a task that tells classes apart needs two of them".to_owned()
    } else {
        format!("ask for a `confidence` above its prior of {}", percent(class.prior))
    };
    Some(
        Diagnostic::new(Code::W0410, class.place, message)
            .related(task.spans.confidence, "the confidence that its prior reaches alone")
            .help(help),
    )
}

/// Twins are reported as such.
fn never_certain(task: &Analysed<'_>, library: &Library, recognition: &Recognition) -> Option<Diagnostic> {
    let never: Vec<usize> = (0..recognition.classes())
        .filter(|m| !recognition.can_be_certain(*m))
        .collect();
    let twins: BTreeSet<usize> = twins::pairs(library).into_iter().flat_map(|(a, b)| [a, b]).collect();
    let told: Vec<usize> = never.iter().copied().filter(|m| !twins.contains(m)).collect();
    let first = *told.first()?;
    let confidence = percent(task.task.thresholds.confidence);
    let (code, message) = if told.len() == recognition.classes() {
        (
            Code::E0406,
            format!("no class can ever reach a confidence of {confidence}"),
        )
    } else {
        let all = names(told.iter().map(|m| library.classes[*m].name.as_str()));
        (
            Code::W0409,
            format!("{all} can never reach a confidence of {confidence}"),
        )
    };
    let mut out = Diagnostic::new(code, task.spans.confidence, message);
    for m in told.iter().take(MOST_SHOWN) {
        let left = recognition.left_at_best(*m);
        let rivals = left.iter().filter(|rival| rival != m);
        let rivals = names(rivals.map(|r| library.classes[r].name.as_str()));
        let share = percent(recognition.share(*m, &left));
        out = out.related(library.classes[*m].place, format!("at best {share}, beside {rivals}"));
    }
    Some(out.help(way_out(first, library, recognition)))
}

/// What would tell a class from the first of those that stay beside it.
fn way_out(class: usize, library: &Library, recognition: &Recognition) -> String {
    let left = recognition.left_at_best(class);
    let mine = &library.classes[class];
    let Some(rival) = left.iter().find(|m| *m != class).map(|m| &library.classes[m]) else {
        return "ask for less, or correct the priors".to_owned();
    };
    let name = |f: FeatureId| library.feature(f).name.as_str();
    let only = |has: &crate::rules::Class, lacks: &crate::rules::Class| {
        library
            .feature_ids()
            .find(|f| has.presence.has(*f) && !lacks.presence.has(*f))
    };
    match (only(rival, mine), only(mine, rival)) {
        (Some(feature), _) => format!(
            "only what is predicted can be found absent: add a rule that predicts `{}` from what `{}` has",
            name(feature),
            mine.name
        ),
        (None, Some(feature)) => format!("add a rule that finds `{}` on `{}`", name(feature), mine.name),
        (None, None) => format!("`{}` and `{}` have the same features", mine.name, rival.name),
    }
}

/// A share as a user writes it.
fn percent(share: f64) -> String {
    let text = format!("{:.2}", share * 100.0);
    format!("{} %", text.trim_end_matches('0').trim_end_matches('.'))
}

#[cfg(test)]
mod tests {
    use super::super::testing::{codes, codes_of};
    use crate::lang::Code;

    /// Without a layout nothing is predicted, so nothing is found absent.
    const LAYOUT: &str = "  layout flat {
    left at [-300 mm, 0 mm, 0 mm] facing +z
    right at [300 mm, 0 mm, 0 mm] facing +z
  }
";

    fn without_layout() -> Vec<(&'static str, &'static str)> {
        vec![(LAYOUT, ""), (" marked pair.flat as both", "")]
    }

    #[test]
    fn fires_on_classes_whose_lack_nothing_shows() {
        assert_eq!(codes(&without_layout()), [Code::W0409]);
        let mut none = without_layout();
        none.push(("class both { left, right }", ""));
        none.push(("class other { right }", "class other { right }\n class none { }"));
        // `one` and `other` show their only code, which the other class lacks.
        assert_eq!(codes(&none), [Code::W0409]);
    }

    #[test]
    fn fires_as_an_error_where_it_is_true_of_all() {
        let text = include_str!("../../../tests/ui/E0406_unreachable_confidence.vpl");
        assert!(codes_of(text).contains(&Code::E0406));
        let listed = text.replace("{ lid", "{ lid, tag");
        assert_eq!(codes_of(&listed), [Code::W0403, Code::W0403]);
    }

    #[test]
    fn keeps_quiet_where_a_low_confidence_is_reached_all_the_same() {
        let mut low = without_layout();
        low.push(("class both { left, right }", "class both { left, right } prior 10 %"));
        low.push(("class one { left }", "class one { left } prior 45 %"));
        low.push(("class other { right }", "class other { right } prior 45 %"));
        low.push(("confidence: 99 %", "confidence: 80 %"));
        assert_eq!(codes(&low), []);
    }

    #[test]
    fn fires_on_a_prior_that_is_enough() {
        let priors = |a: &'static str| {
            [
                ("class both { left, right }", a),
                ("class one { left }", "class one { left } prior 1 %"),
                ("class other { right }", "class other { right } prior 1 %"),
            ]
        };
        let at = ("confidence: 99 %", "confidence: 98 %");
        let both = priors("class both { left, right } prior 98 %");
        assert_eq!(codes(&[both[0], both[1], both[2], at]), [Code::W0410]);
        assert_eq!(codes(&both), []);
    }
}
