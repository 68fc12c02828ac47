//! A depth image by a ray to every reading: what OctoMap's `insertPointCloud`
//! does without `discretize`.

use rayon::prelude::*;

use super::layout::Layout;
use super::marks::{self, Marks};
use super::table::Table;
use crate::geometry::Point;
use crate::sense::Observation;

/// Marks as missed what the rays from the eye to all readings pass. The voxels
/// that they end in are marked too: where they lie inside, they are hit, which wins.
pub(super) fn miss(layout: &Layout, table: &Table, marks: &Marks, observation: &Observation) {
    let eye = observation.eye();
    (0..observation.depth.height).into_par_iter().for_each(|v| {
        let points = (0..observation.depth.width).filter_map(|u| observation.point(u, v));
        points.for_each(|point| miss_ray(layout, table, marks, &eye, &point));
    });
}

fn miss_ray(layout: &Layout, table: &Table, marks: &Marks, eye: &Point, point: &Point) {
    let voxels = layout.grid().along(eye, point);
    for at in voxels.filter_map(|voxel| layout.address_of(voxel)) {
        if let Some(words) = marks.misses(table, at.brick()) {
            marks::mark(words, at.local() as u32);
        }
    }
}
