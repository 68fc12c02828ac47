//! Predicted instances: who predicts what, which prediction counts, and which
//! of them measured instances already fulfil.
//!
//! Every rule with a predictor whose antecedents are measured makes an *offer*
//! for one instance. If several offer the same one, the one of least propagated
//! uncertainty counts: strong before weak, then the shortest lever (distance
//! from antecedent to predicted centre over the antecedent's size), then the
//! library's order. Offers are made from anchors, so a prediction is replaced
//! only when an antecedent has moved by more than half a voxel, or when an
//! attribute of measured instances that it uses has.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use rayon::prelude::*;

use super::error::PlanError;
use super::expansion::{Expansion, expansions};
use super::features::{Existence, FeatureStatus, Found, Pin, Predicted};
use super::inspection::{self, evidence, inspected, predicted_voxels, reachable, tagged, touched};
use super::knowledge::Knowledge;
use super::look::Look;
use super::status::Status;
use super::trace::{Nothing, Trace};
use super::world::World;
use crate::detect::Measurement;
use crate::geometry::{Edge, Point, Polygon, Vector};
use crate::predict;
use crate::primitives::{Strength, strength};
use crate::rules::{BadArgument, FeatureId, FeatureKind};

/// One rule's prediction of one instance.
struct Offer {
    expansion: Expansion,
    polygons: Vec<Polygon>,
    uncertainty: (Strength, f64),
}

/// Makes the predictions anew where they changed, and says of every predicted
/// voxel whether it is inspected by now.
///
/// # Errors
/// A rule's arguments do not fit together.
pub fn refresh<W: World + ?Sized>(
    status: &mut Status,
    knowledge: &Knowledge,
    world: &W,
    trace: &mut Trace,
) -> Result<(), PlanError> {
    let visited = status.visited.clone();
    let visibility = knowledge.criteria.visibility;
    let visited: Vec<_> = visited.iter().map(|view| Look::of(world, view, visibility)).collect();
    for id in knowledge.library.feature_ids() {
        let offers = offers(id, status, knowledge, trace)?;
        name_found(id, &offers, status, knowledge);
        let open = unfulfilled(id, offers, status, knowledge);
        replace(id, open, status, knowledge, world, trace);
        inspect(&mut status.features[id.index()], knowledge, &visited, world);
    }
    Ok(())
}

/// The offers for a feature that may still have instances to find: in state −1
/// or 2, or detected and `many`.
fn offers(id: FeatureId, status: &Status, knowledge: &Knowledge, trace: &mut Trace) -> Result<Vec<Offer>, PlanError> {
    let state = status.feature(id).state;
    let further = state == Existence::Detected && knowledge.library.feature(id).many;
    let mut offers = Vec::new();
    if !(state.is_open() || further) {
        return Ok(offers);
    }
    for (k, rule) in knowledge.library.rules.iter().enumerate() {
        if rule.consequent == id && !rule.antecedents.is_empty() {
            let made = offers_of(k, status, knowledge, trace).map_err(|source| PlanError::Rule {
                rule: rule.id.clone(),
                source,
            })?;
            offers.extend(made);
        }
    }
    Ok(offers)
}

fn offers_of(
    rule: usize,
    status: &Status,
    knowledge: &Knowledge,
    trace: &mut Trace,
) -> Result<Vec<Offer>, BadArgument> {
    let declared = &knowledge.library.rules[rule];
    let detected = |id: &FeatureId| status.feature(*id).state == Existence::Detected;
    let (true, Some(call)) = (declared.antecedents.iter().all(detected), &declared.predict) else {
        return Ok(Vec::new());
    };
    let mut offers = Vec::new();
    trace.predicts_anew(rule);
    for expansion in expansions(rule, knowledge, &status.features)? {
        let Some(arguments) = expansion.arguments(call, &status.features)? else {
            trace.waits(rule, "predict");
            continue;
        };
        let Some(prediction) = predict::predict(&call.primitive, &arguments)? else {
            trace.blank(rule, &expansion.key, Nothing::NoFace);
            continue;
        };
        offers.push(Offer {
            uncertainty: (
                strength(&call.primitive),
                lever(&expansion, &prediction.polygons, &status.features),
            ),
            polygons: prediction.polygons,
            expansion,
        });
    }
    Ok(offers)
}

/// The longest lever arm over the antecedents.
fn lever(expansion: &Expansion, polygons: &[Polygon], features: &[FeatureStatus]) -> f64 {
    let (there, _) = extent(polygons);
    let arms = expansion.antecedents.iter().map(|(id, k)| {
        let (here, size) = match &features[id.index()].found[*k].anchor {
            Measurement::Face(face) => extent(std::slice::from_ref(face)),
            Measurement::Marker { pose, size } => (Point::from(pose.translation.vector), *size),
            Measurement::Shell(faces) => extent(faces),
        };
        (there - here).norm() / size.max(1e-9)
    });
    arms.fold(0.0, f64::max)
}

/// Centre, and the square root of the area: metres.
fn extent(faces: &[Polygon]) -> (Point, f64) {
    let area: f64 = faces.iter().map(Polygon::area).sum();
    let weighted: Vector = faces.iter().map(|f| f.centre().coords * f.area()).sum();
    (Point::from(weighted / area.max(1e-18)), area.sqrt())
}

/// Gives measured instances of a `many` feature the key of the edge they are at.
fn name_found(id: FeatureId, offers: &[Offer], status: &mut Status, knowledge: &Knowledge) {
    let near = knowledge.criteria.near;
    let many = knowledge.library.feature(id).many;
    let mut taken: Vec<String> = Vec::new();
    for k in 0..status.feature(id).found.len() {
        let found = &status.feature(id).found[k];
        let fulfilled = offers
            .iter()
            .filter(|o| fulfils(id, k, found, o, near) && !taken.contains(&o.expansion.key));
        let key = match (many, fulfilled.map(|o| o.expansion.key.clone()).next()) {
            (false, _) => knowledge.key(id).to_owned(),
            (true, Some(key)) => key,
            (true, None) => found.number.to_string(),
        };
        taken.push(key.clone());
        let found = &mut status.features[id.index()].found[k];
        found.key = key;
        let stale = |pin: &Pin| !offers.iter().any(|o| is_pin(pin, &o.expansion));
        if many && found.pin.as_ref().is_some_and(stale) {
            found.pin = None;
        }
    }
}

/// Whether a measured instance is the one that an offer predicts: found there
/// by a rule, of the same place, or along the offer's edge.
fn fulfils(id: FeatureId, position: usize, found: &Found, offer: &Offer, near: f64) -> bool {
    if offer.expansion.antecedents.contains(&(id, position)) {
        return false;
    }
    let pinned = found.pin.as_ref().is_some_and(|pin| is_pin(pin, &offer.expansion));
    let Measurement::Face(face) = &found.anchor else {
        return pinned;
    };
    let placed = |p: &Polygon| found.anchor.same_instance(&Measurement::Face(p.clone()), near);
    let edges = offer.expansion.variables.values();
    pinned || offer.polygons.iter().any(placed) || edges.into_iter().any(|e| shares_edge(face, e, 2.0 * near))
}

fn is_pin(pin: &Pin, expansion: &Expansion) -> bool {
    pin.key == expansion.key && pin.revisions == expansion.revisions
}

/// Whether an edge of a face lies along another face's edge: the shorter one
/// within `tolerance` of the longer, and at least half as long.
fn shares_edge(face: &Polygon, edge: &Edge, tolerance: f64) -> bool {
    let along = |own: Edge| {
        let (short, long) = if own.length() < edge.length() {
            (&own, edge)
        } else {
            (edge, &own)
        };
        let near = long.distance(&short.start) <= tolerance && long.distance(&short.end) <= tolerance;
        near && short.length() >= long.length() / 2.0
    };
    face.edges().into_iter().any(along)
}

/// The offers of instances that are not measured, by key, best first.
fn unfulfilled(
    id: FeatureId,
    offers: Vec<Offer>,
    status: &Status,
    knowledge: &Knowledge,
) -> BTreeMap<String, Vec<Offer>> {
    let found = &status.feature(id).found;
    let mut open: BTreeMap<String, Vec<Offer>> = BTreeMap::new();
    for offer in offers {
        let fulfilled = |(k, f): (usize, &Found)| fulfils(id, k, f, &offer, knowledge.criteria.near);
        if !found.iter().enumerate().any(fulfilled) {
            open.entry(offer.expansion.key.clone()).or_default().push(offer);
        }
    }
    for offers in open.values_mut() {
        offers.sort_by(less_uncertain);
    }
    open
}

/// The sort is stable: among equals the library's order holds.
fn less_uncertain(a: &Offer, b: &Offer) -> Ordering {
    let (strong, lever) = a.uncertainty;
    strong.cmp(&b.uncertainty.0).then(lever.total_cmp(&b.uncertainty.1))
}

/// Puts the best offers in the place of the predictions, keeping those that
/// did not change.
fn replace<W: World + ?Sized>(
    id: FeatureId,
    open: BTreeMap<String, Vec<Offer>>,
    status: &mut Status,
    knowledge: &Knowledge,
    world: &W,
    trace: &mut Trace,
) {
    let mut before = std::mem::take(&mut status.features[id.index()].predicted);
    for (key, offers) in open {
        let by = rule_ids(&offers, knowledge);
        let Some(best) = offers.into_iter().next() else {
            continue;
        };
        let before = before.remove(&key);
        let blind = before
            .as_ref()
            .map_or_else(|| blind(id, status, knowledge), |p| p.blind);
        let kept = before.filter(|p| p.polygons == best.polygons);
        let predicted = match kept {
            Some(kept) => Some(Predicted {
                by,
                rule: best.expansion.rule,
                envelope: knowledge.envelope(id, best.expansion.rule),
                ..kept
            }),
            None => {
                let rule = best.expansion.rule;
                let placed = place(id, best, by, status, knowledge, world);
                if placed.is_none() {
                    trace.blank(rule, &key, Nothing::Outside);
                }
                placed.map(|placed| Predicted { blind, ..placed })
            }
        };
        if let Some(predicted) = predicted {
            status.features[id.index()].predicted.insert(key, predicted);
        }
    }
}

fn rule_ids(offers: &[Offer], knowledge: &Knowledge) -> Vec<String> {
    let mut rules: Vec<usize> = offers.iter().map(|o| o.expansion.rule).collect();
    rules.sort_unstable();
    rules.dedup();
    rules
        .into_iter()
        .map(|r| knowledge.library.rules[r].id.clone())
        .collect()
}

/// How many of the visited views cannot have been a look at a feature that is
/// predicted for the first time. A detector that starts from antecedents was not
/// run before they were measured, and their measurement is the last view. A
/// definite rule was run on all views; a shell is proven from the map of all.
fn blind(id: FeatureId, status: &Status, knowledge: &Knowledge) -> usize {
    let whenever = knowledge.has_definite_rule(id) || knowledge.library.feature(id).kind == FeatureKind::Shell;
    if whenever {
        0
    } else {
        status.visited.len().saturating_sub(1)
    }
}

/// A new prediction; `None` where PV_ij is empty.
fn place<W: World + ?Sized>(
    id: FeatureId,
    offer: Offer,
    by: Vec<String>,
    status: &mut Status,
    knowledge: &Knowledge,
    world: &W,
) -> Option<Predicted> {
    let voxels = predicted_voxels(&offer.polygons, world.grid());
    if voxels.is_empty() {
        return None;
    }
    status.next_tag += 1;
    Some(Predicted {
        tagged: tagged(world, &voxels, knowledge.criteria.near),
        touched: vec![false; voxels.len()],
        inspected: vec![false; voxels.len()],
        envelope: knowledge.envelope(id, offer.expansion.rule),
        polygons: offer.polygons,
        voxels,
        tag: status.next_tag,
        rule: offer.expansion.rule,
        by,
        blind: 0,
        looks: Vec::new(),
    })
}

/// Counts the views that a prediction has not been held against yet: the new
/// one, or all where the prediction is new.
fn inspect<W: World + ?Sized>(feature: &mut FeatureStatus, knowledge: &Knowledge, visited: &[Look<'_, W>], world: &W) {
    let criteria = &knowledge.criteria;
    for predicted in feature.predicted.values_mut() {
        let (voxels, envelope) = (&predicted.voxels, &predicted.envelope);
        let blind = predicted.blind;
        let touched = touched(world, voxels, criteria.near);
        let missing = predicted.looks.len().min(visited.len())..visited.len();
        let look = |k: usize| {
            if k < blind {
                return vec![false; voxels.len()];
            }
            reachable(&visited[k], voxels, &touched, envelope, criteria.near, |_| true)
        };
        let looks: Vec<Vec<bool>> = missing.into_par_iter().map(look).collect();
        predicted.looks.extend(looks);
        let known = evidence(world, voxels, &touched, criteria);
        predicted.inspected = inspected(&predicted.looks, &known, envelope.whole, criteria.absent);
        predicted.touched = touched;
    }
}

/// Whether ξ_ned of the union of a feature's predicted places is inspected.
pub fn is_inspected(feature: &FeatureStatus, absent: f64) -> bool {
    let (done, all) = feature.inspected_union();
    inspection::reaches(done, all, absent)
}
