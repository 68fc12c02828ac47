//! What recognition costs, as a note: the best expected number of feature tests, and
//! for each class the shortest certificate.

use super::{Analysed, names};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::recognition::{Budget, Certificate, Recognition, Tests};
use crate::rules::Library;

/// Steps that the best tree may take.
const TREE: Budget = Budget(3_000_000);
/// Steps that all certificates together may take.
const CERTIFICATES: Budget = Budget(10_000_000);
/// Most classes whose certificates are shown one by one.
const MOST_SHOWN: usize = 16;

pub(super) fn check(task: &Analysed<'_>) -> Option<Diagnostic> {
    let library = task
        .library
        .filter(|l| task.task.goal.confident && l.classes.len() > 1)?;
    let n = library.classes.len();
    let Some(recognition) = &task.recognition else {
        let message = format!("what telling {n} classes apart takes is not worked out: the library is too large");
        return Some(Diagnostic::new(Code::N0401, task.spans.goal, message));
    };
    let part = CERTIFICATES.part(n);
    let certificates: Vec<Option<Certificate>> =
        (0..n).map(|m| recognition.certificate(m, &mut part.clone())).collect();
    let mut out = Diagnostic::new(Code::N0401, task.spans.goal, message(n, recognition));
    if n > MOST_SHOWN {
        return Some(out.maybe_help(extremes(&certificates, library)));
    }
    for (class, certificate) in library.classes.iter().zip(&certificates) {
        if let Some(certificate) = certificate {
            out = out.related(class.place, proof(certificate, library));
        }
    }
    Some(out)
}

fn message(n: usize, recognition: &Recognition) -> String {
    match recognition.tests(&mut TREE.clone()) {
        Tests::Exact(tests) => {
            format!("telling {n} classes apart takes {tests:.3} feature tests on average, in the best order")
        }
        Tests::Between { least, most } => {
            let most = most.map_or(String::new(), |most| format!(" and at most {most:.2}"));
            format!(
                "telling {n} classes apart takes at least {least:.2}{most} feature tests on average, in the best order; \
                 there are too many for an exact figure"
            )
        }
        Tests::Endless => format!(
            "telling {n} classes apart has no average number of feature tests: on some objects some come to no end"
        ),
    }
}

/// `certain after 2: with `a`, without `b``.
fn proof(certificate: &Certificate, library: &Library) -> String {
    let of = |present: bool, word: &str| {
        let all = certificate.outcomes.iter().filter(|(_, has)| *has == present);
        let all: Vec<&str> = all.map(|(f, _)| library.feature(*f).name.as_str()).collect();
        (!all.is_empty()).then(|| format!("{word} {}", names(all)))
    };
    let parts: Vec<String> = [of(true, "with"), of(false, "without")].into_iter().flatten().collect();
    let n = certificate.outcomes.len();
    let count = match (n, certificate.is_shortest()) {
        (0, _) => return "certain at once".to_owned(),
        (_, true) => format!("{n}"),
        (_, false) => format!("{n} (no fewer than {})", certificate.at_least),
    };
    format!("certain after {count}: {}", parts.join(", "))
}

/// The easiest class and the hardest.
fn extremes(certificates: &[Option<Certificate>], library: &Library) -> Option<String> {
    let known = certificates.iter().zip(&library.classes);
    let known: Vec<(usize, &str)> = known
        .filter_map(|(c, class)| Some((c.as_ref()?.outcomes.len(), class.name.as_str())))
        .collect();
    let (least, most) = (known.iter().map(|k| k.0).min()?, known.iter().map(|k| k.0).max()?);
    let of = |n: usize| names(known.iter().filter(|k| k.0 == n).map(|k| k.1));
    let tests = |n: usize| format!("{n} test{}", if n == 1 { "" } else { "s" });
    Some(format!(
        "certain after {} at the earliest: {}; after {} at the earliest: {}",
        tests(least),
        of(least),
        tests(most),
        of(most)
    ))
}

#[cfg(test)]
mod tests {
    use super::super::testing::{notes_of, program};
    use crate::lang::{Code, Diagnostic};

    fn cost(text: &str) -> Option<Diagnostic> {
        notes_of(text).into_iter().find(|d| d.code == Code::N0401)
    }

    #[test]
    fn twelve_tanks() {
        let note = cost(include_str!("../../../examples/tanks/tanks.vpl")).unwrap();
        assert_eq!(
            note.message,
            "telling 12 classes apart takes 3.667 feature tests on average, in the best order"
        );
        assert_eq!(note.related.len(), 12);
        assert_eq!(note.related[3].text, "certain after 1: without `code[1]`");
    }

    #[test]
    fn priors_are_weights_and_a_confidence_saves_tests() {
        // `both` takes both codes, `one` and `other` take the one that they lack.
        let note = cost(&program(&[])).unwrap();
        assert!(note.message.contains("1.667 feature tests"), "{}", note.message);
        let uneven = program(&[
            ("class both { left, right }", "class both { left, right } prior 98 %"),
            ("class one { left }", "class one { left } prior 1 %"),
            ("class other { right }", "class other { right } prior 1 %"),
        ]);
        // After the first code is found, 98 : 1 is 98.99 %.
        let note = cost(&uneven).unwrap();
        assert!(note.message.contains("1.990 feature tests"), "{}", note.message);
        let note = cost(&uneven.replace("confidence: 99 %", "confidence: 98.5 %")).unwrap();
        assert!(note.message.contains("1.000 feature tests"), "{}", note.message);
    }

    #[test]
    fn keeps_quiet_where_classes_need_not_be_told_apart() {
        assert_eq!(cost(include_str!("../../../examples/solids/solids.vpl")), None);
        assert_eq!(cost(&program(&[("near: 30 mm", "near: 1 mm")])), None);
    }

    /// The tanks' task about other classes, told apart by `columns` codes.
    fn large(classes: u64, columns: usize) -> String {
        let row = |k: u64| {
            let bits = (k + 7).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let cells = (0..columns).map(|b| if bits >> b & 1 == 1 { " 1" } else { " 0" });
            format!("c{k}{}\n", cells.collect::<String>())
        };
        let rows: String = (0..classes).map(row).collect();
        let place = |k: usize| format!("code[{k}] at [{k} m, 0 mm, 0 mm] facing +z\n");
        let places: String = (1..=columns).map(place).collect();
        let tanks = include_str!("../../../examples/tanks/tanks.vpl");
        let at = |word: &str| tanks.find(word).unwrap();
        let text = format!(
            "{}{rows}}}\n{}layout hull {{\n{places}}}\n}}\n{}",
            &tanks[..at("    tk1")],
            &tanks[at("  rule")..at("  layout")],
            &tanks[at("task ")..at("/// The origin")]
        );
        text.replace("code[1..7]", &format!("code[1..{columns}]"))
    }

    #[test]
    fn a_large_library_gets_bounds_and_ends() {
        let note = cost(&large(120, 40)).unwrap();
        assert!(note.message.contains("at least"), "{}", note.message);
        let note = cost(&large(1_100, 20)).unwrap();
        assert!(note.message.contains("not worked out"), "{}", note.message);
    }
}
