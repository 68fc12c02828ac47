//! What a detector looked at, and which condition what failed did not meet.
//!
//! A detector decides by [`Condition`]s: each says what it asked for and what it
//! found, and whether it holds. A [`Judgement`] collects them for one candidate
//! up to the first that fails; an [`Account`] keeps the candidate that came
//! furthest. Nobody judges a second time to explain.

use std::borrow::Cow;

use serde::{Deserialize, Serialize, Serializer};

/// One condition on one candidate, as it was decided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Condition {
    /// What it is about, in a word or two.
    pub name: Cow<'static, str>,
    /// Which colour, code or the like it is about.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// What was asked for and what was found.
    #[serde(flatten)]
    pub test: Test,
    /// Whether it holds.
    pub holds: bool,
}

/// What a condition asks for and what it found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Test {
    /// A quantity between bounds.
    Quantity {
        /// What the numbers count.
        unit: Unit,
        /// Lower bound.
        #[serde(default, skip_serializing_if = "Option::is_none", serialize_with = "rounded")]
        least: Option<f64>,
        /// Upper bound.
        #[serde(default, skip_serializing_if = "Option::is_none", serialize_with = "rounded")]
        most: Option<f64>,
        /// What was found; `None` where it has no value.
        #[serde(default, serialize_with = "rounded")]
        found: Option<f64>,
    },
    /// One of a few names.
    Name {
        /// The name asked for.
        expected: String,
        /// The names found.
        found: Vec<String>,
    },
    /// Nothing that could be counted.
    Plain {},
}

/// What a quantity counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Radians.
    Angle,
    /// Metres.
    Length,
    /// Square metres.
    Area,
    /// 0 to 1.
    Share,
    /// Bits.
    Bits,
    /// Pixels.
    Pixels,
    /// Levels of brightness, 0 to 255.
    Levels,
    /// Voxels.
    Voxels,
    /// Things of another kind.
    Count,
}

/// Millionths are enough for an explanation, and keep a log short.
fn rounded<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    value
        .map(|x| (x * 1e6).round() / 1e6)
        .filter(|x| x.is_finite())
        .serialize(serializer)
}

impl Condition {
    /// Holds where `found` is at least `least`.
    pub fn at_least(name: &'static str, unit: Unit, found: f64, least: f64) -> Self {
        Self::quantity(name, unit, found, (Some(least), None), found >= least)
    }

    /// Holds where `found` is off `middle` by at most `tolerance`.
    pub fn about(name: &'static str, unit: Unit, found: f64, middle: f64, tolerance: f64) -> Self {
        let bounds = (Some(middle - tolerance), Some(middle + tolerance));
        Self::quantity(name, unit, found, bounds, (found - middle).abs() <= tolerance)
    }

    /// A quantity of which the caller has decided whether it is within bounds.
    pub fn quantity(
        name: &'static str,
        unit: Unit,
        found: f64,
        (least, most): (Option<f64>, Option<f64>),
        holds: bool,
    ) -> Self {
        let found = Some(found).filter(|x| x.is_finite());
        let test = Test::Quantity {
            unit,
            least,
            most,
            found,
        };
        Self::new(name, test, holds)
    }

    /// Holds where `one` is the name expected; `found` lists all that there were.
    pub fn named(name: &'static str, expected: &str, one: &str, found: Vec<String>) -> Self {
        let test = Test::Name {
            expected: expected.to_owned(),
            found,
        };
        Self::new(name, test, one == expected)
    }

    /// A condition without a value.
    pub fn plain(name: &'static str, holds: bool) -> Self {
        Self::new(name, Test::Plain {}, holds)
    }

    /// With the colour, the code or the like that it is about.
    pub fn of(mut self, what: Option<String>) -> Self {
        self.of = what;
        self
    }

    fn new(name: &'static str, test: Test, holds: bool) -> Self {
        Self {
            name: Cow::Borrowed(name),
            of: None,
            test,
            holds,
        }
    }

    /// How far off a failed quantity is, as a share of the bound that it misses.
    fn miss(&self) -> f64 {
        let Test::Quantity {
            least,
            most,
            found: Some(found),
            ..
        } = &self.test
        else {
            return f64::INFINITY;
        };
        let bounds = least.iter().chain(most);
        let off = bounds.map(|b| (found - b).abs() / b.abs().max(1e-9));
        off.fold(f64::INFINITY, f64::min)
    }
}

/// The conditions on one candidate, up to the first that fails.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judgement(Vec<Condition>);

impl Judgement {
    /// Adds a condition and says whether it holds.
    pub fn holds(&mut self, condition: Condition) -> bool {
        let holds = condition.holds;
        self.0.push(condition);
        holds
    }
}

/// What a detector looked at in one measurement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    /// How many candidates it looked at.
    pub looked: usize,
    /// The conditions that the surest finding met; empty where nothing was found.
    pub met: Vec<Condition>,
    /// The conditions of the candidate that failed last, the failed one at the
    /// end; empty where none failed.
    pub failed: Vec<Condition>,
}

impl Account {
    /// Nothing judged yet of a number of candidates.
    pub fn of(looked: usize) -> Self {
        Self {
            looked,
            ..Self::default()
        }
    }

    /// Takes in the surest finding, where there is one.
    pub fn accept(mut self, surest: Option<&Judgement>) -> Self {
        self.met = surest.map(|j| j.0.clone()).unwrap_or_default();
        self
    }

    /// Whether a finding could be measured; where none could, that is what failed.
    pub fn measured(&mut self, succeeded: bool) {
        if !succeeded {
            let mut conditions = self.met.clone();
            conditions.push(Condition::plain("measured", false));
            self.reject(Judgement(conditions));
        }
    }

    /// Of one candidate with one condition.
    pub fn single(looked: usize, condition: Condition) -> Self {
        let (met, failed) = if condition.holds {
            (vec![condition], Vec::new())
        } else {
            (Vec::new(), vec![condition])
        };
        Self { looked, met, failed }
    }

    /// Takes in a candidate that failed: the one that met most conditions is
    /// kept, of equals the one that missed by less, then the earlier one.
    pub fn reject(&mut self, judgement: Judgement) {
        let miss = |conditions: &[Condition]| conditions.last().map_or(f64::INFINITY, Condition::miss);
        let (new, held) = (&judgement.0, &self.failed);
        let further = new.len() > held.len() || new.len() == held.len() && miss(new) < miss(held);
        if further {
            self.failed = judgement.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(conditions: Vec<Condition>) -> Judgement {
        let mut judgement = Judgement::default();
        let all = conditions.into_iter().all(|c| judgement.holds(c));
        assert!(!all);
        judgement
    }

    fn angle(found: f64) -> Condition {
        Condition::about("dihedral", Unit::Angle, found, 1.5, 0.1)
    }

    #[test]
    fn the_candidate_that_came_furthest_is_kept() {
        let colour = |n: f64| Condition::at_least("colour", Unit::Pixels, n, 4.0);
        let mut account = Account::of(4);
        account.reject(judged(vec![colour(3.0)]));
        account.reject(judged(vec![colour(9.0), angle(1.0)]));
        account.reject(judged(vec![colour(9.0), angle(1.3)]));
        account.reject(judged(vec![colour(9.0), angle(1.8)]));
        assert_eq!(account.failed, [colour(9.0), angle(1.3)]);
        assert!(account.failed[0].holds && !account.failed[1].holds);
    }

    #[test]
    fn a_condition_survives_the_log_to_a_millionth() {
        let conditions = [
            Condition::at_least("colour", Unit::Pixels, 41.0, 4.0).of(Some("#1ea032".into())),
            Condition::named("text", "f3", "f1", vec!["f1".into(), "f6".into()]),
            Condition::plain("another face", false),
        ];
        for condition in conditions {
            let line = serde_json::to_string(&condition).unwrap();
            assert_eq!(serde_json::from_str::<Condition>(&line).unwrap(), condition, "{line}");
        }
        let line = serde_json::to_string(&angle(1.0 / 3.0)).unwrap();
        assert!(line.contains("\"found\":0.333333,\"holds\":false"), "{line}");
        let nothing = serde_json::to_string(&angle(f64::NAN)).unwrap();
        assert!(nothing.contains("\"found\":null"), "{nothing}");
    }
}
