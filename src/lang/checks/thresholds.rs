//! Thresholds, shares and limits: in range, and not against the map.

use super::Analysed;
use super::space::metres;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;

pub(super) fn check(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    near(task, &mut found);
    shares(task, &mut found);
    sensor_model(task, &mut found);
    if task.task.limit == 0 {
        let message = "a run takes at least one view";
        found.push(Diagnostic::new(Code::E0309, task.spans.limit, message).help("write it like `limit 20 views`"));
    }
    found
}

fn near(task: &Analysed<'_>, found: &mut Vec<Diagnostic>) {
    let (near, voxel) = (task.task.thresholds.near, task.task.space.voxel);
    if near.is_nan() || near <= 0.0 {
        let message = "`near` is a distance above zero";
        found.push(Diagnostic::new(Code::E0402, task.spans.near, message).help("write it like `near: 10 mm`"));
    } else if near < voxel / 2.0 {
        let message = format!(
            "`near` is {}, less than half a voxel of {}",
            metres(near),
            metres(voxel)
        );
        found.push(
            Diagnostic::new(Code::E0402, task.spans.near, message)
                .related(task.spans.voxel, "the voxel")
                .help("points in a voxel would count as far from its centre: make `near` larger or the voxel smaller"),
        );
    } else {
        found.extend(wide(task));
    }
}

/// A `near` that makes one point of the space count for most of it.
fn wide(task: &Analysed<'_>) -> Option<Diagnostic> {
    let (near, across) = (task.task.thresholds.near, task.task.space.size.min());
    let (code, message) = if near >= across {
        (
            Code::E0402,
            format!("`near` is {}, as large as the space", metres(near)),
        )
    } else if near > across / 2.0 {
        (
            Code::W0414,
            format!("`near` is {}, more than half of the space", metres(near)),
        )
    } else {
        return None;
    };
    Some(
        Diagnostic::new(code, task.spans.near, message)
            .related(task.spans.space, format!("{} across", metres(across)))
            .help("a point then counts for what is far from it: one or two voxels are usual"),
    )
}

fn shares(task: &Analysed<'_>, found: &mut Vec<Diagnostic>) {
    let t = &task.task.thresholds;
    for (name, value, span) in [
        ("absent", t.absent, task.spans.absent),
        ("confidence", t.confidence, task.spans.confidence),
    ] {
        if !(0.0 < value && value <= 1.0) {
            found.push(out_of_range(Code::E0402, name, span, "above 0 % and at most 100 %"));
        }
    }
    if !(0.0..=1.0).contains(&task.task.overlap) {
        found.push(out_of_range(
            Code::E0309,
            "overlap",
            task.spans.overlap,
            "between 0 % and 100 %",
        ));
    }
}

fn sensor_model(task: &Analysed<'_>, found: &mut Vec<Diagnostic>) {
    let m = &task.task.sensor_model;
    let inside = |x: f64, low: f64, high: f64| low < x && x < high;
    for (name, right, expected) in [
        ("hit", inside(m.hit, 0.5, 1.0), "between 50 % and 100 %, both excluded"),
        ("miss", inside(m.miss, 0.0, 0.5), "between 0 % and 50 %, both excluded"),
        (
            "clamp_min",
            inside(m.clamp_min, 0.0, m.occupied),
            "above 0 % and below `occupied`",
        ),
        (
            "clamp_max",
            inside(m.clamp_max, m.occupied, 1.0),
            "above `occupied` and below 100 %",
        ),
        (
            "occupied",
            inside(m.occupied, 0.0, 1.0),
            "between 0 % and 100 %, both excluded",
        ),
    ] {
        if !right {
            let span = task.spans.sensor_model.get(name).copied().unwrap_or(task.spans.head);
            found.push(out_of_range(Code::E0309, name, span, expected));
        }
    }
}

fn out_of_range(code: Code, name: &str, span: Span, expected: &str) -> Diagnostic {
    Diagnostic::new(code, span, format!("`{name}` is out of range")).help(format!("it is {expected}"))
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    #[test]
    fn fires_on_near_below_half_a_voxel() {
        assert_eq!(codes(&[("near: 30 mm", "near: 9 mm")]), [Code::E0402]);
        assert_eq!(codes(&[("near: 30 mm", "near: 0 mm")]), [Code::E0402]);
        assert_eq!(codes(&[("near: 30 mm", "near: 10 mm")]), []);
    }

    #[test]
    fn fires_on_near_as_wide_as_the_space() {
        assert_eq!(codes(&[("near: 30 mm", "near: 1 m")]), [Code::E0402]);
        assert_eq!(codes(&[("near: 30 mm", "near: 501 mm")]), [Code::W0414]);
        assert_eq!(codes(&[("near: 30 mm", "near: 500 mm")]), []);
    }

    #[test]
    fn fires_on_shares_out_of_range() {
        assert_eq!(codes(&[("absent: 95 %", "absent: 0 %")]), [Code::E0402]);
        assert_eq!(codes(&[("confidence: 99 %", "confidence: 101 %")]), [Code::E0402]);
        assert_eq!(codes(&[("confidence: 99 %", "confidence: 100 %")]), []);
        assert_eq!(
            codes(&[("limit 20 views", "limit 20 views\n overlap 101 %")]),
            [Code::E0309]
        );
        assert_eq!(codes(&[("limit 20 views", "limit 0 views")]), [Code::E0309]);
    }

    #[test]
    fn fires_on_a_sensor_model_upside_down() {
        let model = |fields: &str| format!("limit 20 views\n sensor_model {{ {fields} }}");
        assert_eq!(codes(&[("limit 20 views", &model("hit: 40 %"))]), [Code::E0309]);
        assert_eq!(codes(&[("limit 20 views", &model("clamp_min: 60 %"))]), [Code::E0309]);
        assert_eq!(codes(&[("limit 20 views", &model("hit: 85 %, miss: 45 %"))]), []);
    }
}
