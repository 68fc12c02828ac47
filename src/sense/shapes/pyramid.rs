//! Pyramids: a base, an apex that may lean, deformations.

use super::builder::Builder;
use super::deform::Deformations;
use super::outline::{Base, SIZES};
use super::prism::{Colours, Side, build_bottom, build_sides, crossing, lean};
use super::range;
use super::simple;
use crate::geometry::Point;
use crate::rules::Call;
use crate::sense::{Mesh, SceneError};

/// The mesh of a `pyramid` call. Notches run up to the apex and narrow with it.
pub(super) fn build(call: &Call) -> Result<Mesh, SceneError> {
    let base = Base::of(call)?;
    let height = range::length(call, "height", SIZES)?;
    let apex = Point::new(height * lean(call)?.tan(), 0.0, height / 2.0);
    let deformed = Deformations::of(call, base.sides())?;
    let outline = base.outline(&deformed.notches, call)?;
    let bottom: Vec<Point> = outline
        .iter()
        .map(|p| Point::new(p.at[0], p.at[1], -height / 2.0))
        .collect();

    let mut builder = Builder::default();
    let colours = Colours::of(call)?;
    build_bottom(&bottom, &deformed, colours.bottom, call, &mut builder)?;
    let sides: Vec<Side> = (0..base.sides())
        .map(|k| {
            let (a, b) = base.side(k);
            let corner = |p: [f64; 2]| Point::new(p[0], p[1], -height / 2.0);
            Side::new(vec![corner(a), corner(b), apex])
        })
        .collect();
    let panels = (0..outline.len()).map(|i| {
        let j = (i + 1) % outline.len();
        (outline[i].side, vec![bottom[i], bottom[j], apex])
    });
    build_sides(&sides, panels, &deformed, colours.side, call, &mut builder)?;
    simple::checked(builder.finish()).ok_or_else(|| crossing(call))
}
