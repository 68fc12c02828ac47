//! The point behind the centre of a face.

use super::positive;
use crate::geometry::Point;
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn point(arguments: &Arguments) -> Result<Option<Point>, BadArgument> {
    let (face, depth) = (arguments.polygon("face")?, arguments.length("depth")?);
    Ok(positive(depth).then(|| face.centre() - face.normal() * depth))
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{arguments, bottom, length};
    use super::*;
    use crate::primitives::Datum;

    #[test]
    fn behind_a_bottom_is_above_its_middle() {
        let of = |depth| {
            point(&arguments([
                ("face", Datum::Polygon(bottom())),
                ("depth", length(depth)),
            ]))
            .unwrap()
        };
        assert!((of(2.0).unwrap() - Point::new(0.5, 0.5, 2.0)).norm() < 1e-12);
        assert_eq!(of(f64::NAN), None);
    }
}
