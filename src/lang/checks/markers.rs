//! Markers that no view can decode, and ones smaller than a voxel.

use std::collections::BTreeSet;

use super::Analysed;
use super::space::metres;
use super::views::nearest;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::primitives::{ImageKind, envelope};
use crate::rules::{FeatureId, FeatureKind, Rule};

pub(super) fn check(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let Some(library) = task.library else {
        return Vec::new();
    };
    let mut seen: BTreeSet<FeatureId> = BTreeSet::new();
    let mut found = Vec::new();
    for rule in &library.rules {
        let marker = library.feature(rule.consequent).kind == FeatureKind::Marker;
        if marker && seen.insert(rule.consequent) {
            let name = &library.feature(rule.consequent).name;
            found.extend(resolution(task, rule, name).or_else(|| voxel(task, rule, name)));
        }
    }
    found
}

/// The nearest view must give the decoder its pixels, wherever in the space the marker is.
fn resolution(task: &Analysed<'_>, rule: &Rule, name: &str) -> Option<Diagnostic> {
    let bounds = task.task.space.bounds();
    let distance = task.views.iter().map(|v| nearest(&bounds, v)).min_by(f64::total_cmp)?;
    let envelope = envelope(&rule.detect).ok()?;
    let camera = &task.task.camera;
    let focal = match envelope.image {
        ImageKind::Colour => camera.colour.fx.min(camera.colour.fy),
        ImageKind::Depth => camera.depth.fx.min(camera.depth.fy),
    };
    let (has, needs) = (focal / distance.max(1e-9), envelope.min_pixels_per_metre);
    if has >= needs {
        return None;
    }
    let size = rule.detect.length("size").ok()?;
    let message = format!(
        "`{name}` is too small to be decoded from any view: the nearest, at {}, sees {has:.0} pixels a metre of {needs:.0}",
        metres(distance)
    );
    Some(
        Diagnostic::new(Code::W0407, rule.place, message)
            .related(task.spans.views, "the views")
            .help(format!(
                "print it at least {} wide, or bring the views to within {}",
                metres(size * needs / has),
                metres(focal / needs)
            )),
    )
}

fn voxel(task: &Analysed<'_>, rule: &Rule, name: &str) -> Option<Diagnostic> {
    let (size, voxel) = (rule.detect.length("size").ok()?, task.task.space.voxel);
    (size < voxel).then(|| {
        let message = format!(
            "`{name}` is {} wide, less than a voxel of {}",
            metres(size),
            metres(voxel)
        );
        Diagnostic::new(Code::W0407, rule.place, message).related(task.spans.voxel, "the voxel")
    })
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
}
