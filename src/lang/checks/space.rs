//! The space and its map: sizes that make sense, and fit in memory.

use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::lower::TaskSpans;
use crate::rules::{Space, Task};

/// Most voxels of a map, whose indices are 32 bits wide.
const MOST_VOXELS: f64 = 4_294_967_295.0;
/// Memory of a map that is worth a warning, bytes.
const MUCH: f64 = 2e9;

/// Checks the space; whether views about it can be looked at.
pub(super) fn check(task: &Task, spans: &TaskSpans, found: &mut Vec<Diagnostic>) -> bool {
    let space = &task.space;
    if space.voxel.is_nan() || space.voxel <= 0.0 {
        let message = "a voxel has an edge above zero";
        found.push(Diagnostic::new(Code::E0309, spans.voxel, message).help("write it like `voxel 10 mm`"));
        return false;
    }
    let smallest = space.size.min();
    if space.voxel > smallest {
        let message = format!("a voxel of {} is larger than the space", metres(space.voxel));
        found.push(
            Diagnostic::new(Code::E0309, spans.voxel, message)
                .related(spans.space, format!("{} across", metres(smallest)))
                .help("make the voxel smaller"),
        );
        return true;
    }
    let voxels: f64 = space.size.iter().map(|side| (side / space.voxel).ceil()).product();
    if voxels >= MOST_VOXELS {
        let needed = (space.size.product() / MOST_VOXELS).cbrt();
        let message = format!("a map of {voxels:.1e} voxels does not fit in memory");
        found.push(
            Diagnostic::new(Code::E0404, spans.voxel, message)
                .label(format!("at most {MOST_VOXELS:.1e} voxels"))
                .related(spans.space, format!("{} of memory for this space", gigabytes(space)))
                .help(format!(
                    "make the voxel at least {}, or the space smaller",
                    metres(needed * 1.01)
                )),
        );
    } else if space.map_bytes() > MUCH {
        let message = format!("a map of this space can grow to {} of memory", gigabytes(space));
        found.push(
            Diagnostic::new(Code::W0418, spans.voxel, message)
                .related(spans.space, format!("{voxels:.1e} voxels"))
                .help("make the voxel larger, or the space smaller"),
        );
    }
    true
}

fn gigabytes(space: &Space) -> String {
    format!("{} GB", round(space.map_bytes() / 1e9))
}

/// A length as a user writes it.
pub(super) fn metres(x: f64) -> String {
    if x.abs() < 0.9995 {
        format!("{} mm", round(x * 1000.0))
    } else {
        format!("{} m", round(x))
    }
}

/// Three significant digits or so, without a tail of zeros.
fn round(x: f64) -> String {
    let digits = (2.0 - x.abs().max(1e-9).log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{x:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use super::metres;
    use crate::lang::Code;

    #[test]
    fn lengths_are_written_as_users_do() {
        assert_eq!(metres(0.01), "10 mm");
        assert_eq!(metres(1.4), "1.4 m");
        assert_eq!(metres(0.1234567), "123 mm");
        assert_eq!(metres(120.0), "120 m");
    }

    #[test]
    fn fires_on_voxels_of_no_size_and_too_large_ones() {
        assert_eq!(codes(&[("voxel 20 mm", "voxel 0 mm")]), [Code::E0309]);
        assert_eq!(codes(&[("voxel 20 mm", "voxel -20 mm")]), [Code::E0309]);
        let large = [("voxel 20 mm", "voxel 2 m"), ("near: 30 mm", "near: 3 m")];
        assert!(codes(&large).contains(&Code::E0309));
        assert_eq!(codes(&[("voxel 20 mm", "voxel 25 mm")]), []);
    }

    #[test]
    fn fires_on_a_map_that_does_not_fit() {
        assert_eq!(codes(&[("voxel 20 mm", "voxel 0.5 mm")]), [Code::E0404]);
        assert_eq!(codes(&[("voxel 20 mm", "voxel 0.7 mm")]), [Code::W0418]);
        assert_eq!(codes(&[("voxel 20 mm", "voxel 1 mm")]), []);
    }
}
