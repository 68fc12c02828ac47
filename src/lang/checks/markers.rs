//! Markers that no view can decode, ones smaller than a voxel, and layouts that are
//! larger than the space.

use std::collections::BTreeMap;

use super::space::metres;
use super::views::nearest;
use super::{Analysed, names};
use crate::geometry::{Point, Pose};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::primitives::{ImageKind, envelope};
use crate::rules::{FeatureId, FeatureKind, Library, Rule, Value};

pub(super) fn check(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let Some(library) = task.library else {
        return Vec::new();
    };
    let mut first: BTreeMap<FeatureId, &Rule> = BTreeMap::new();
    for rule in &library.rules {
        if library.feature(rule.consequent).kind == FeatureKind::Marker {
            first.entry(rule.consequent).or_insert(rule);
        }
    }
    let rules: Vec<&Rule> = first.into_values().collect();
    let mut found = Vec::new();
    found.extend(resolution(task, &rules, library));
    found.extend(voxel(task, &rules, library));
    found.extend(span(task, library));
    found
}

/// What the nearest view gives a decoder, wherever in the space the marker is.
struct Sight {
    focal: f64,
    has: f64,
    needs: f64,
    size: f64,
}

impl Sight {
    fn of(task: &Analysed<'_>, rule: &Rule, distance: f64) -> Option<Self> {
        let envelope = envelope(&rule.detect).ok()?;
        let camera = &task.task.camera;
        let focal = match envelope.image {
            ImageKind::Colour => camera.colour.fx.min(camera.colour.fy),
            ImageKind::Depth => camera.depth.fx.min(camera.depth.fy),
        };
        Some(Self {
            focal,
            has: focal / distance.max(1e-9),
            needs: envelope.min_pixels_per_metre,
            size: rule.detect.length("size").ok()?,
        })
    }

    /// The size that could be decoded.
    fn least_size(&self) -> f64 {
        self.size * self.needs / self.has
    }
}

fn resolution(task: &Analysed<'_>, rules: &[&Rule], library: &Library) -> Option<Diagnostic> {
    let bounds = task.task.space.bounds();
    let distance = task.views.iter().map(|v| nearest(&bounds, v)).min_by(f64::total_cmp)?;
    let sights = rules.iter().filter_map(|r| Some((*r, Sight::of(task, r, distance)?)));
    let small: Vec<(&Rule, Sight)> = sights.filter(|(_, s)| s.has < s.needs).collect();
    let (rule, worst) = small
        .iter()
        .max_by(|a, b| a.1.least_size().total_cmp(&b.1.least_size()))?;
    let message = format!("{} too small to be decoded from any view", are(&small, library));
    Some(
        Diagnostic::new(Code::W0407, rule.place, message)
            .label(format!("{:.0} pixels a metre are needed", worst.needs))
            .related(
                task.spans.views,
                format!("the nearest, at {}, sees {:.0}", metres(distance), worst.has),
            )
            .help(format!(
                "print at least {} wide, or bring the views to within {}",
                metres(worst.least_size()),
                metres(worst.focal / worst.needs)
            )),
    )
}

fn voxel(task: &Analysed<'_>, rules: &[&Rule], library: &Library) -> Option<Diagnostic> {
    let voxel = task.task.space.voxel;
    let sizes = rules.iter().filter_map(|r| Some((*r, r.detect.length("size").ok()?)));
    let small: Vec<(&Rule, f64)> = sizes.filter(|(_, size)| *size < voxel).collect();
    let (rule, _) = small.first()?;
    let message = format!("{} smaller than a voxel", are(&small, library));
    Some(
        Diagnostic::new(Code::W0407, rule.place, message)
            .related(task.spans.voxel, format!("the voxel of {}", metres(voxel)))
            .help("make the voxel smaller, or print larger"),
    )
}

/// `` `a` is`` or `` `a` and `b` are``.
fn are<T>(of: &[(&Rule, T)], library: &Library) -> String {
    let all = names(of.iter().map(|(r, _)| library.feature(r.consequent).name.as_str()));
    format!("{all} {}", if of.len() == 1 { "is" } else { "are" })
}

/// Prints that the space cannot hold together, whichever way the object is turned.
fn span(task: &Analysed<'_>, library: &Library) -> Option<Diagnostic> {
    let diagonal = task.task.space.size.norm();
    let wide = library.rules.iter().filter_map(|r| Some((r, reach(r)?)));
    let (rule, wide) = wide.filter(|(_, w)| *w > diagonal).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let message = "this layout is larger than the space";
    Some(
        Diagnostic::new(Code::W0417, rule.place, message)
            .label(format!("{} from end to end", metres(wide)))
            .related(task.spans.space, format!("{} from corner to corner", metres(diagonal)))
            .help("correct the places, or make the space larger"),
    )
}

/// The largest distance between corners of the prints that a rule ties together.
fn reach(rule: &Rule) -> Option<f64> {
    let predict = rule.predict.as_ref()?;
    let half = predict.length("size").ok()? / 2.0;
    let Some(Value::Pose(pose)) = predict.constant("antecedent_from_consequent") else {
        return None;
    };
    let corners = |pose: &Pose| {
        [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| pose * Point::new(x, y, 0.0))
    };
    let (here, there) = (corners(&Pose::identity()), corners(pose));
    let pairs = here.iter().flat_map(|a| there.iter().map(move |b| (a - b).norm()));
    pairs.max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    #[test]
    fn fires_on_a_code_that_no_view_resolves() {
        // 1064 pixels of focal length at 0.78 m or more: 1364 pixels a metre at most;
        // 4 pixels for each of 21 modules of 50 mm are 1680.
        assert_eq!(codes(&[("\"l\", size: 200 mm", "\"l\", size: 50 mm")]), [Code::W0407]);
        assert_eq!(codes(&[("\"l\", size: 200 mm", "\"l\", size: 110 mm")]), []);
    }

    #[test]
    fn says_it_once_for_all_markers() {
        assert_eq!(codes(&[("size: 200 mm", "size: 50 mm")]), [Code::W0407]);
    }

    #[test]
    fn fires_on_a_pattern_smaller_than_a_voxel() {
        let coarse = [("voxel 20 mm", "voxel 250 mm"), ("near: 30 mm", "near: 250 mm")];
        assert_eq!(codes(&coarse), [Code::W0407]);
    }

    #[test]
    fn fires_on_a_layout_larger_than_the_space() {
        assert_eq!(codes(&[("right at [300 mm,", "right at [3 m,")]), [Code::W0417]);
        assert_eq!(codes(&[("right at [300 mm,", "right at [900 mm,")]), []);
    }
}
