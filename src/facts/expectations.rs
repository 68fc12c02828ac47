//! Expectations, held against what follows from a fact's evidence.

use std::collections::{BTreeMap, BTreeSet};

use super::words::{bits, features, listed, metres, percent};
use super::{Concluded, Failure, compare, values};
use crate::geometry::Polygon;
use crate::plan::completion;
use crate::plan::features::{Existence, FeatureStatus, Predicted};
use crate::rules::{Expected, Fact, FeatureId, FeatureKind, Flag, State};

/// Features whose weights differ by less are equal, bits.
const SAME_WEIGHT: f64 = 1e-9;

/// Why an expectation does not hold: what was found instead, and advice.
struct Miss(String, Option<String>);

/// The expectations of a fact that do not hold, in its order.
pub(super) fn failures(fact: &Fact, concluded: Option<&Concluded>) -> Vec<Failure> {
    let failed = fact.expected.iter().filter_map(|expectation| {
        let Miss(message, help) = judge(&expectation.what, concluded)?;
        Some(Failure {
            place: expectation.place,
            message,
            help,
        })
    });
    failed.collect()
}

fn judge(expected: &Expected, concluded: Option<&Concluded>) -> Option<Miss> {
    match (expected, concluded) {
        (
            Expected::Equal {
                found,
                expected,
                within,
            },
            _,
        ) => equal(found, expected, *within),
        (Expected::Count(of, count), _) => counted(of, *count),
        (expected, Some(concluded)) => concluded.judge(expected),
        // The language gives every other expectation a library.
        (_, None) => Some(Miss("this expectation needs a library".into(), None)),
    }
}

fn equal(found: &crate::rules::Expr, expected: &crate::rules::Expr, within: f64) -> Option<Miss> {
    let (found, expected) = match (values::known(found), values::known(expected)) {
        (Ok(found), Ok(expected)) => (found, expected),
        (Err(why), _) | (_, Err(why)) => return Some(Miss(why, None)),
    };
    let apart = compare::apart(&found, &expected);
    if apart.is_some_and(|d| d <= within) {
        return None;
    }
    let message = format!(
        "expected {}, found {}",
        values::describe(&expected),
        values::describe(&found)
    );
    Some(Miss(message, apart.and_then(|d| compare::distance(&found, d))))
}

fn counted(of: &crate::rules::Expr, count: u64) -> Option<Miss> {
    match values::known(of).map(|known| values::count(&known)) {
        Err(why) => Some(Miss(why, None)),
        Ok(found) => differ("a count of ", count, found),
    }
}

fn differ(what: &str, expected: u64, found: u64) -> Option<Miss> {
    (expected != found).then(|| Miss(format!("expected {what}{expected}, found {found}"), None))
}

impl Concluded {
    fn judge(&self, expected: &Expected) -> Option<Miss> {
        match expected {
            Expected::Classes(classes) => self.classes(classes),
            Expected::Class { class, share, within } => {
                let found = self.status.posterior.get(*class).copied().unwrap_or(0.0);
                let name = &self.knowledge.library.classes[*class].name;
                let miss = || {
                    format!(
                        "expected class `{name}` at {}, found {}",
                        percent(*share),
                        percent(found)
                    )
                };
                off(found, *share, *within).then(|| Miss(miss(), None))
            }
            Expected::Flag(flag, holds) => self.flag(*flag, *holds),
            Expected::Next(wanted) => self.next(wanted),
            Expected::Rules(count) => differ("rules: ", *count, self.knowledge.library.rules.len() as u64),
            Expected::Predicts { head, rules, count } => self.predicts(head, rules, *count),
            Expected::State(feature, state) => self.state(*feature, *state),
            Expected::Weight {
                feature,
                bits: expected,
                within,
            } => {
                let found = self.status.weights.get(feature.index()).copied().unwrap_or(0.0);
                let miss = || format!("expected a weight of {}, found {}", bits(*expected), bits(found));
                off(found, *expected, *within).then(|| Miss(miss(), None))
            }
            Expected::Predicted(feature, count) => {
                let found = self.status.feature(*feature).predicted.len() as u64;
                differ("predicted instances: ", *count, found).map(|m| self.with_reason(m, *feature))
            }
            Expected::Placed { feature, face, within } => self.placed(*feature, face, *within),
            Expected::Equal { .. } | Expected::Count(..) => None,
        }
    }

    fn classes(&self, expected: &[usize]) -> Option<Miss> {
        let possible: Vec<usize> = (0..self.status.posterior.len())
            .filter(|m| self.status.posterior[*m] > 0.0)
            .collect();
        let name = |m: &usize| self.knowledge.library.classes[*m].name.as_str();
        (possible != expected).then(|| {
            let message = format!(
                "expected {} to remain, found {}",
                listed(expected.iter().map(name)),
                listed(possible.iter().map(name))
            );
            Miss(message, None)
        })
    }

    fn flag(&self, flag: Flag, expected: bool) -> Option<Miss> {
        let contradiction = self.status.contradiction.as_ref();
        let found = match flag {
            Flag::Confident => completion::confident(&self.status, &self.knowledge),
            Flag::Contradicted => contradiction.is_some(),
        };
        if found == expected {
            return None;
        }
        let why = contradiction.map(|c| {
            let name = &self.knowledge.library.feature(c.feature).name;
            format!("`{name}` was {}", c.evidence)
        });
        Some(match flag {
            Flag::Confident => {
                let (winner, share) = completion::likeliest(&self.status.posterior);
                let likeliest = self.knowledge.library.classes.get(winner).map_or("none", |c| &c.name);
                let reached = if expected {
                    "confident, and it is not"
                } else {
                    "not confident, and it is"
                };
                let asked = percent(self.knowledge.task.thresholds.confidence);
                let help = format!(
                    "the likeliest class is `{likeliest}` at {}, asked is {asked}",
                    percent(share)
                );
                Miss(
                    format!("expected the status to be {reached}"),
                    Some(why.unwrap_or(help)),
                )
            }
            Flag::Contradicted if expected => {
                let left = (0..self.status.posterior.len()).filter(|m| self.status.posterior[*m] > 0.0);
                let names = listed(left.map(|m| self.knowledge.library.classes[m].name.as_str()));
                let help = format!("still possible: {names}");
                Miss(
                    "expected a contradiction, and a class explains the evidence".into(),
                    Some(help),
                )
            }
            Flag::Contradicted => Miss("expected no contradiction, found one".into(), why),
        })
    }

    fn next(&self, expected: &[FeatureId]) -> Option<Miss> {
        let most = self.status.weights.iter().copied().fold(0.0, f64::max);
        let heaviest = |id: &FeatureId| most > 0.0 && self.status.weights[id.index()] >= most - SAME_WEIGHT;
        let library = &self.knowledge.library;
        let found: Vec<FeatureId> = library.feature_ids().filter(heaviest).collect();
        (found != expected).then(|| {
            let message = format!(
                "expected {} next, found {}",
                features(expected, library),
                features(&found, library)
            );
            let mut weights: Vec<FeatureId> = library.feature_ids().collect();
            weights.sort_by(|a, b| self.status.weights[b.index()].total_cmp(&self.status.weights[a.index()]));
            let weighed = weights.iter().take(4).map(|id| {
                let weight = self.status.weights[id.index()];
                format!("`{}` {}", library.feature(*id).name, bits(weight))
            });
            Miss(
                message,
                Some(format!("heaviest: {}", weighed.collect::<Vec<_>>().join(", "))),
            )
        })
    }

    fn predicts(&self, head: &str, rules: &[usize], expected: u64) -> Option<Miss> {
        let library = &self.knowledge.library;
        let ids: Vec<&str> = rules.iter().map(|k| library.rules[*k].id.as_str()).collect();
        let by_them = |feature: &FeatureStatus| {
            let named = |by: &Vec<String>| by.iter().any(|id| ids.contains(&id.as_str()));
            feature.predicted.values().filter(|p| named(&p.by)).count() as u64
        };
        let consequent = rules.first().map(|k| library.rules[*k].consequent);
        let found = consequent.map_or(0, |id| by_them(self.status.feature(id)));
        let miss = differ(&format!("instances predicted by `{head}`: "), expected, found)?;
        Some(match consequent {
            Some(id) => self.with_reason(miss, id),
            None => miss,
        })
    }

    fn state(&self, feature: FeatureId, expected: State) -> Option<Miss> {
        let found = state(self.status.feature(feature).state);
        let name = &self.knowledge.library.feature(feature).name;
        let message = || format!("expected `{name}` to be {}, found {}", expected.word(), found.word());
        (found != expected).then(|| Miss(message(), None))
    }

    fn placed(&self, feature: FeatureId, expected: &Polygon, within: f64) -> Option<Miss> {
        let predicted = &self.status.feature(feature).predicted;
        let apart = |p| Some((compare::faces_apart(p, expected)?, p));
        let near = predicted.values().flat_map(|p| &p.polygons).filter_map(apart);
        let best = near.min_by(|a, b| a.0.total_cmp(&b.0));
        let name = &self.knowledge.library.feature(feature).name;
        match best {
            Some((distance, _)) if distance <= within => None,
            Some((distance, face)) => {
                let message = format!(
                    "expected a predicted `{name}` within {} of this place, found the nearest {} away",
                    metres(within),
                    metres(distance)
                );
                let place = match self.knowledge.library.feature(feature).kind {
                    FeatureKind::Marker => values::print(face),
                    _ => values::face(face),
                };
                Some(Miss(message, Some(format!("the nearest is `{place}`"))))
            }
            None => {
                let found = match predicted.len() {
                    0 => "none".to_owned(),
                    n => format!(
                        "{n} of {}, and this has {}",
                        corners(predicted),
                        expected.vertices().len()
                    ),
                };
                let message = format!("expected a predicted `{name}` at this place, found {found}");
                Some(self.with_reason(Miss(message, None), feature))
            }
        }
    }

    /// Says why a feature is not predicted, where that is plain.
    fn with_reason(&self, Miss(message, help): Miss, feature: FeatureId) -> Miss {
        let status = self.status.feature(feature);
        let library = &self.knowledge.library;
        let name = &library.feature(feature).name;
        let unmeasured = library
            .rules
            .iter()
            .filter(|r| r.consequent == feature && r.predict.is_some());
        let lacking = unmeasured
            .flat_map(|r| &r.antecedents)
            .find(|id| self.status.feature(**id).found.is_empty());
        let why = match status.state {
            _ if !status.predicted.is_empty() => None,
            Existence::Absent | Existence::Excluded => Some(format!("`{name}` is {}", state(status.state).word())),
            Existence::Detected if !library.feature(feature).many => Some(format!("`{name}` is detected")),
            _ => lacking.map(|id| {
                let antecedent = &library.feature(*id).name;
                format!("`{antecedent}` predicts it, and no place is given for `{antecedent}`")
            }),
        };
        Miss(message, why.or(help))
    }
}

/// How many corners the predicted faces have: `4 corners`, `3 or 4 corners`.
fn corners(predicted: &BTreeMap<String, Predicted>) -> String {
    let faces = predicted.values().flat_map(|p| &p.polygons);
    let counts: BTreeSet<usize> = faces.map(|face| face.vertices().len()).collect();
    let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
    format!("{} corners", counts.join(" or "))
}

fn off(found: f64, expected: f64, within: f64) -> bool {
    (found - expected).abs() > within
}

fn state(of: Existence) -> State {
    match of {
        Existence::Unknown => State::Unknown,
        Existence::Absent => State::Absent,
        Existence::Detected => State::Detected,
        Existence::Present => State::Present,
        Existence::Excluded => State::Excluded,
    }
}
