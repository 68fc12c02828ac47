//! Measured instances: which detection is of which instance, and their merging.
//!
//! A detection joins the instance that it matches; evidence merges and the
//! attributes are measured anew from all of it. Otherwise, of a `many` feature
//! it is a new instance. Of another feature there is one instance: the
//! detection with more evidence stays, the other is dropped (a feature of one
//! instance has one place, and the larger patch of it is the likelier one).

use super::features::{FeatureStatus, Found, Pin};
use crate::detect::{self, Evidence, Measurement};
use crate::primitives::Arguments;

/// What a detector and a measure made of one measurement.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What later views' evidence is merged with; `None` where nothing can be.
    pub evidence: Option<Evidence>,
    /// The attributes.
    pub measurement: Measurement,
}

/// A finding and how it came about.
#[derive(Clone, Debug)]
pub struct Detection {
    /// What was found.
    pub finding: Finding,
    /// The measure call that gave the attributes.
    pub measure: (String, Arguments),
    /// Where a rule with antecedents found it.
    pub pin: Option<Pin>,
}

/// How instances are told apart.
#[derive(Clone, Copy, Debug)]
pub struct Matching {
    /// Whether the feature can have several instances.
    pub many: bool,
    /// ξ, metres.
    pub near: f64,
    /// How far a measurement moves before rules take notice, metres.
    pub moved: f64,
    /// How far from a marker other features can lie, metres.
    pub reach: f64,
}

/// Takes a detection into a feature's instances. `revision` hands out numbers
/// for anchors.
pub fn take(feature: &mut FeatureStatus, detection: Detection, matching: &Matching, revision: &mut u32) {
    let same: Vec<usize> = (0..feature.found.len())
        .filter(|k| is_same(&feature.found[*k], &detection, matching.near))
        .collect();
    match same.split_first() {
        Some((&first, others)) => {
            for other in others.iter().rev() {
                let absorbed = feature.found.remove(*other);
                absorbed
                    .evidence
                    .into_iter()
                    .for_each(|e| merge_evidence(&mut feature.found[first], e));
            }
            join(&mut feature.found[first], detection);
            settle(&mut feature.found[first], matching, revision);
        }
        None if matching.many || feature.found.is_empty() => {
            let number = feature.found.iter().map(|f| f.number).max().unwrap_or(0) + 1;
            feature.found.push(new(number, detection, revision));
        }
        None => {
            let held = support(feature.found[0].evidence.as_ref());
            if support(detection.finding.evidence.as_ref()) > held {
                feature.found[0] = new(feature.found[0].number, detection, revision);
            }
        }
    }
}

/// A detection of an instance that is known. The first rule with antecedents
/// that finds it says at which edge it is and how it is measured.
fn join(found: &mut Found, detection: Detection) {
    if detection.pin.is_some() && found.pin.is_none() {
        found.pin = detection.pin;
        found.measure = detection.measure;
    }
    merge(found, detection.finding);
}

fn is_same(found: &Found, detection: &Detection, near: f64) -> bool {
    let pinned = detection.pin.is_some() && found.pin == detection.pin;
    pinned || found.measurement.same_instance(&detection.finding.measurement, near)
}

fn new(number: u32, detection: Detection, revision: &mut u32) -> Found {
    *revision += 1;
    Found {
        number,
        evidence: detection.finding.evidence,
        anchor: detection.finding.measurement.clone(),
        measurement: detection.finding.measurement,
        revision: *revision,
        measure: detection.measure,
        pin: detection.pin,
        key: number.to_string(),
    }
}

/// Adds a finding. What comes without evidence (nothing to merge) counts as it is.
fn merge(found: &mut Found, finding: Finding) {
    match finding.evidence {
        Some(evidence) => merge_evidence(found, evidence),
        None if found.evidence.is_none() => found.measurement = finding.measurement,
        None => {}
    }
}

/// Adds evidence and measures anew from all of it, where that is possible.
fn merge_evidence(found: &mut Found, more: Evidence) {
    let merged = match found.evidence.take() {
        Some(mut held) => {
            held.merge(more);
            held
        }
        None => more,
    };
    let (primitive, arguments) = &found.measure;
    if let Ok(Some(measurement)) = detect::measure(primitive, arguments, &merged) {
        found.measurement = measurement;
    }
    found.evidence = Some(merged);
}

/// Lets the anchor follow a measurement that has moved far enough. A marker
/// that turned moves what is tied to it, though its centre stays.
fn settle(found: &mut Found, matching: &Matching, revision: &mut u32) {
    let turned = match (&found.measurement, &found.anchor) {
        (Measurement::Marker { pose, .. }, Measurement::Marker { pose: before, .. }) => {
            pose.rotation.angle_to(&before.rotation) * matching.reach > matching.moved
        }
        _ => false,
    };
    if turned || found.measurement.moved(&found.anchor, matching.moved) {
        *revision += 1;
        found.anchor = found.measurement.clone();
        found.revision = *revision;
    }
}

/// How much speaks for an instance: points of a face, looks at a marker.
fn support(evidence: Option<&Evidence>) -> usize {
    match evidence {
        Some(Evidence::Face(face)) => face.points.len(),
        Some(Evidence::Marker(marker)) => marker.looks.len(),
        None => 0,
    }
}
