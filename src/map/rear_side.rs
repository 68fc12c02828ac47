//! Rear-side voxels (G_so of eq. 8): unknown space right behind a seen surface.

use super::Map;
use super::brick::{Brick, is_known};
use super::grid::Voxel;
use super::layout::addresses;
use crate::geometry::{Point, Vector};

/// The faces of a voxel that an eye cannot see from the front: those whose
/// outward axis points away from it. Bits −x, +x, −y, +y, −z, +z.
pub(super) fn far_faces(eye: &Point, centre: &Point) -> u8 {
    let away: Vector = centre - eye;
    (0..3).fold(0, |faces, k| {
        faces | u8::from(away[k] < 0.0) << (2 * k) | u8::from(away[k] > 0.0) << (2 * k + 1)
    })
}

/// Rear-side voxels of a map, ascending.
pub(super) fn rear_side(map: &Map) -> Vec<Voxel> {
    let mut voxels: Vec<_> = map.bricks.iter().flat_map(|b| behind(map, b)).collect();
    voxels.sort_unstable();
    voxels.dedup();
    voxels
}

/// Unknown voxels beyond a far face of an occupied voxel of a brick.
fn behind<'a>(map: &'a Map, brick: &'a Brick) -> impl Iterator<Item = Voxel> + 'a {
    let surface = brick.surface.as_deref().into_iter();
    surface.flat_map(move |s| {
        let occupied = brick.at_least(map.model.occupied_from());
        let occupied = addresses(brick.index, &occupied).collect::<Vec<_>>();
        occupied.into_iter().flat_map(move |at| {
            let (cell, far) = (map.layout.cell(at), s.far(at));
            let faces = (0..6).filter(move |face| far >> face & 1 == 1);
            faces.filter_map(move |face| unknown_beyond(map, cell, face))
        })
    })
}

fn unknown_beyond(map: &Map, mut cell: [usize; 3], face: usize) -> Option<Voxel> {
    let axis = face / 2;
    cell[axis] = if face % 2 == 1 {
        cell[axis] + 1
    } else {
        cell[axis].checked_sub(1)?
    };
    if cell[axis] >= map.grid.size[axis] as usize {
        return None;
    }
    let at = map.layout.address(cell);
    (!is_known(map.bricks.value(at))).then(|| map.layout.voxel(at))
}
