//! Held to hand-worked libraries, and to a reference that tries everything.

use proptest::prelude::*;

use super::*;

/// Rows of `0` and `1`, every look coming to an end, uniform priors.
fn of_rows(rows: &[&str], confidence: f64) -> Recognition {
    let row = |r: &&str| r.chars().map(|c| (c == '1', true)).collect();
    let n = rows.len();
    let priors = vec![1.0 / n as f64; n];
    Recognition::new(rows[0].len(), rows.iter().map(row).collect(), priors, confidence)
}

const PLENTY: Budget = Budget(1 << 40);

fn tanks() -> Recognition {
    let rows = [
        "1010111", "1000011", "1011111", "0100100", "1110111", "1011011", "1000111", "1011010", "1100111", "1011101",
        "1001111", "1110101",
    ];
    of_rows(&rows, 0.99)
}

fn certificate(r: &Recognition, class: usize) -> Certificate {
    r.certificate(class, &mut PLENTY.clone()).unwrap()
}

#[test]
fn twelve_tanks_take_44_twelfths_of_a_test() {
    let Tests::Exact(tests) = tanks().tests(&mut PLENTY.clone()) else {
        panic!("twelve tanks are solved exactly");
    };
    assert!((tests - 44.0 / 12.0).abs() < 1e-12, "{tests}");
}

#[test]
fn the_fourth_tank_is_certain_without_its_first_code() {
    let alone = certificate(&tanks(), 3);
    assert_eq!(alone.outcomes, [(FeatureId(0), false)]);
    assert!(alone.is_shortest());
}

#[test]
fn twins_are_never_certain_unless_one_outweighs_the_other() {
    let twins = of_rows(&["10", "10", "01"], 0.9);
    assert!(!twins.can_be_certain(0) && !twins.can_be_certain(1) && twins.can_be_certain(2));
    assert_eq!(twins.tests(&mut PLENTY.clone()), Tests::Endless);
    assert_eq!(twins.certificate(0, &mut PLENTY.clone()), None);

    let row = |has| vec![(has, true)];
    let uneven = Recognition::new(1, vec![row(true), row(true), row(false)], vec![0.6, 0.05, 0.35], 0.9);
    assert!(uneven.can_be_certain(0) && !uneven.can_be_certain(1));
    assert_eq!(certificate(&uneven, 0).outcomes.len(), 1);
    assert_eq!(uneven.tests(&mut PLENTY.clone()), Tests::Exact(1.0));
}

#[test]
fn a_large_prior_needs_no_test() {
    let row = |has| vec![(has, true)];
    let sure = Recognition::new(1, vec![row(true), row(false)], vec![0.995, 0.005], 0.99);
    assert_eq!(sure.tests(&mut PLENTY.clone()), Tests::Exact(0.0));
    assert_eq!(certificate(&sure, 0).outcomes, []);
    assert!(certificate(&sure, 1).is_shortest());
}

#[test]
fn without_a_budget_there_are_bounds() {
    let tanks = tanks();
    let Tests::Between { least, most } = tanks.tests(&mut Budget(100)) else {
        panic!("a hundred steps do not solve twelve tanks");
    };
    let (exact, entropy) = (44.0 / 12.0, 12_f64.log2());
    assert!((least - entropy).abs() < 1e-9 && most.unwrap() > exact - 1e-9);

    let hurried = tanks.certificate(0, &mut Budget(400)).unwrap();
    assert!(hurried.at_least <= certificate(&tanks, 0).outcomes.len());
    assert!(hurried.outcomes.len() >= certificate(&tanks, 0).outcomes.len());
    assert_eq!(tanks.certificate(0, &mut Budget(10)), None);
}

/// A small random problem: rows, priors and a confidence.
#[derive(Clone, Debug)]
struct Problem {
    rows: Vec<Vec<(bool, bool)>>,
    priors: Vec<f64>,
    confidence: f64,
}

impl Problem {
    fn recognition(&self) -> Recognition {
        Recognition::new(
            self.rows[0].len(),
            self.rows.clone(),
            self.priors.clone(),
            self.confidence,
        )
    }

    fn is_certain(&self, class: usize, left: &[usize]) -> bool {
        let total: f64 = left.iter().map(|m| self.priors[*m]).sum();
        self.priors[class] / total >= self.confidence
    }

    /// Every tree, without bounds or memory.
    fn tests(&self, left: &[usize]) -> f64 {
        if left.iter().any(|m| self.is_certain(*m, left)) {
            return 0.0;
        }
        let mass: f64 = left.iter().map(|m| self.priors[*m]).sum();
        let features = 0..self.rows[0].len();
        let split = |f: usize| left.iter().copied().partition(|m| self.rows[*m][f].0);
        let ends = |f: &usize| left.iter().all(|m| self.rows[*m][*f].1);
        let cost = |f: usize| {
            let (with, without): (Vec<usize>, Vec<usize>) = split(f);
            let splits = !with.is_empty() && !without.is_empty();
            if splits {
                mass + self.tests(&with) + self.tests(&without)
            } else {
                f64::INFINITY
            }
        };
        features.filter(ends).map(cost).fold(f64::INFINITY, f64::min)
    }

    /// The size of the smallest set of outcomes, of all sets.
    fn shortest(&self, class: usize) -> Option<usize> {
        let row = &self.rows[class];
        let sets = 0_u32..1 << row.len();
        let chosen = |set: u32, f: usize| set & (1 << f) != 0;
        let ends = |set: &u32| (0..row.len()).all(|f| !chosen(*set, f) || row[f].1);
        let proves = |set: &u32| {
            let fits = |m: &usize| (0..row.len()).all(|f| !chosen(*set, f) || self.rows[*m][f].0 == row[f].0);
            let left: Vec<usize> = (0..self.rows.len()).filter(fits).collect();
            self.is_certain(class, &left)
        };
        sets.filter(ends)
            .filter(proves)
            .map(|set| set.count_ones() as usize)
            .min()
    }
}

fn problems() -> impl Strategy<Value = Problem> {
    (2..7_usize, 1..6_usize).prop_flat_map(|(classes, features)| {
        // Most looks come to an end.
        let cell = (
            any::<bool>(),
            prop::sample::select(vec![true, true, true, true, true, true, true, false]),
        );
        let rows = prop::collection::vec(prop::collection::vec(cell, features), classes);
        let weights = prop::collection::vec(prop::sample::select(vec![1_u32, 1, 1, 2, 7, 60]), classes);
        let confidence = prop::sample::select(vec![0.3, 0.6, 0.9, 0.99, 1.0]);
        (rows, weights, confidence).prop_map(|(rows, weights, confidence)| {
            let total: u32 = weights.iter().sum();
            let priors = weights.iter().map(|w| f64::from(*w) / f64::from(total)).collect();
            Problem {
                rows,
                priors,
                confidence,
            }
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn trees_are_as_good_as_the_best_of_all(problem in problems()) {
        let all: Vec<usize> = (0..problem.rows.len()).collect();
        let reference = problem.tests(&all);
        match problem.recognition().tests(&mut PLENTY.clone()) {
            Tests::Exact(tests) => prop_assert!((tests - reference).abs() < 1e-9, "{} of {}", tests, reference),
            Tests::Endless => prop_assert!(reference.is_infinite()),
            Tests::Between { .. } => prop_assert!(false, "the budget does not end"),
        }
    }

    #[test]
    fn bounds_hold(problem in problems()) {
        let all: Vec<usize> = (0..problem.rows.len()).collect();
        if let Tests::Between { least, most } = problem.recognition().tests(&mut Budget(0)) {
            let reference = problem.tests(&all);
            prop_assert!(least <= reference + 1e-9);
            prop_assert!(most.is_none_or(|most| most >= reference - 1e-9));
        }
    }

    #[test]
    fn certificates_are_as_short_as_any(problem in problems()) {
        let recognition = problem.recognition();
        for class in 0..problem.rows.len() {
            let shortest = problem.shortest(class);
            prop_assert_eq!(recognition.can_be_certain(class), shortest.is_some());
            let found = recognition.certificate(class, &mut PLENTY.clone());
            prop_assert_eq!(found.as_ref().map(|c| c.outcomes.len()), shortest);
            let Some(found) = found else { continue };
            prop_assert!(found.is_shortest());
            let fits = |m: &usize| found.outcomes.iter().all(|(f, has)| problem.rows[*m][f.index()].0 == *has);
            let left: Vec<usize> = (0..problem.rows.len()).filter(fits).collect();
            prop_assert!(problem.is_certain(class, &left), "{:?} proves nothing", found.outcomes);
        }
    }

    #[test]
    fn hurried_certificates_hold_and_their_bounds_too(problem in problems(), steps in 0..200_u64) {
        let recognition = problem.recognition();
        for class in 0..problem.rows.len() {
            let Some(found) = recognition.certificate(class, &mut Budget(steps)) else { continue };
            let shortest = problem.shortest(class).unwrap();
            prop_assert!(found.at_least <= shortest && shortest <= found.outcomes.len());
        }
    }
}
