//! Prospect: what new surface a view is expected to show.
//!
//! Unknown space is not all alike. Every class that is left predicts where its
//! surfaces lie: on the polygons of predicted features and of proven rough shapes,
//! with the probability that the class posterior gives the feature, times
//! [`ACCURACY`]. Elsewhere a surface is expected once across the width of the space.
//! And since objects are solid, a ray that reaches a measured surface out of unknown
//! space, from behind, must have met another surface first.
//!
//! A view's rays are followed until a measured surface ends them; on the way each
//! loses to every unknown voxel the probability that it ends there. A predicted
//! surface counts with the area that a ray sees of it, more where it is oblique; one of
//! unknown direction with twice the ray's cross-section, for that is what a convex body
//! shows of itself on average (Cauchy). Unknown voxels with a point within ξ of them are
//! gaps of a measured surface: what can be seen there is known.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::Situation;
use super::rays::RAYS_A_ROW;
use crate::detect::Measurement;
use crate::geometry::{Polygon, Vector};
use crate::map::{Grid, Occupancy, Voxel};
use crate::plan::candidates::presence;
use crate::plan::features::Existence;
use crate::plan::inspection::predicted_voxels;
use crate::plan::viewpoint::Viewpoint;

/// How likely a predicted surface is where it was predicted.
const ACCURACY: f64 = 0.8;
/// Obliquer surfaces count as if they were seen at this cosine, 75°: readings on them
/// lie too far apart.
const LEAST_COSINE: f64 = 0.26;
/// A ray of which no more is left has ended.
const SPENT: f64 = 0.01;

/// Area of a surface of unknown direction over the cross-section of a ray that meets it.
const UNKNOWN_DIRECTION: f64 = 2.0;

/// What rays meet in a voxel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cell {
    Free,
    /// Unknown, and nothing is predicted there.
    Unknown,
    /// On a predicted surface: an index of `Prospect::faces`.
    Predicted(u32),
    /// Unknown beside a measured surface, right behind it or not.
    Beside {
        rear: bool,
    },
    Occupied,
}

/// A voxel of predicted surfaces.
struct Face {
    probability: f64,
    normals: Vec<Vector>,
}

/// What is expected where.
pub(super) struct Prospect {
    grid: Grid,
    cells: Vec<Cell>,
    faces: Vec<Face>,
    /// P(surface) of an unknown voxel that nothing is predicted for.
    elsewhere: f64,
}

/// Surface that a view is expected to show and that was not seen yet, in voxel faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Expected {
    /// All of it.
    pub all: f64,
    /// Without what is expected just because space is unknown.
    pub firm: f64,
}

/// What of a voxel's surface is still to be seen, by voxel number: 1 where absent.
type Left = BTreeMap<u32, f64>;

impl Prospect {
    /// What is expected after the last measurement.
    pub fn of(situation: &Situation<'_>) -> Self {
        let world = situation.world;
        let grid = *world.grid();
        let near = situation.knowledge.criteria.near;
        let cell = |v: u32| match world.occupancy(Voxel(v)) {
            Occupancy::Free => Cell::Free,
            Occupancy::Occupied => Cell::Occupied,
            Occupancy::Unknown => Cell::Unknown,
        };
        let mut cells: Vec<Cell> = (0..grid.len()).into_par_iter().map(cell).collect();
        let reach = near + grid.voxel * 3_f64.sqrt() / 2.0;
        for voxel in around(&grid, &world.occupied(), reach) {
            let cell = &mut cells[voxel.0 as usize];
            if *cell == Cell::Unknown && world.measured_within(&grid.centre(voxel), reach) {
                *cell = Cell::Beside { rear: false };
            }
        }
        for voxel in world.rear_side() {
            cells[voxel.0 as usize] = Cell::Beside { rear: true };
        }
        let mut faces = Vec::new();
        for (voxel, face) in predicted(situation, &grid) {
            let cell = &mut cells[voxel.0 as usize];
            if *cell == Cell::Unknown {
                *cell = Cell::Predicted(faces.len() as u32);
                faces.push(face);
            }
        }
        let across = grid.size.iter().copied().max().unwrap_or(1);
        Self {
            grid,
            cells,
            faces,
            elsewhere: 1.0 / f64::from(across),
        }
    }

    /// What each unvisited view is expected to show.
    pub fn of_views(&self, situation: &Situation<'_>) -> Vec<Expected> {
        let views = situation.gains.views.par_iter();
        views
            .map(|v| self.of_view(&situation.candidates[*v], &Left::new(), |_, _| {}))
            .collect()
    }

    /// What is left of every surface once a view has been taken.
    pub fn after(&self, view: &Viewpoint) -> Left {
        let mut seen = BTreeMap::new();
        self.of_view(view, &Left::new(), |voxel, share| {
            let most: &mut f64 = seen.entry(voxel.0).or_default();
            *most = most.max(share);
        });
        seen.into_iter().map(|(voxel, share)| (voxel, 1.0 - share)).collect()
    }

    /// What a view is expected to show of what is `left`; `saw` hears of every voxel
    /// and the share of a ray that ends there.
    pub fn of_view(&self, view: &Viewpoint, left: &Left, mut saw: impl FnMut(Voxel, f64)) -> Expected {
        let mut expected = Expected::default();
        for (from, to) in view.rays(RAYS_A_ROW) {
            let sight = (to - from).normalize();
            let (mut all, mut firm) = (1.0, 1.0);
            // Whether it is in unknown space, and right behind a surface.
            let (mut inside, mut behind) = (false, false);
            for voxel in self.grid.along(&from, &to) {
                let (chance, sure, area) = match self.cells[voxel.0 as usize] {
                    Cell::Free => {
                        (inside, behind) = (false, false);
                        continue;
                    }
                    Cell::Beside { rear } if inside => {
                        behind = rear;
                        continue;
                    }
                    Cell::Occupied if inside && behind => (1.0, 1.0, UNKNOWN_DIRECTION),
                    Cell::Beside { .. } | Cell::Occupied => break,
                    Cell::Unknown => (self.elsewhere, 0.0, UNKNOWN_DIRECTION),
                    Cell::Predicted(k) => self.faces[k as usize].met_along(&sight),
                };
                (inside, behind) = (true, false);
                let there = left.get(&voxel.0).copied().unwrap_or(1.0);
                let area = there * area * view.ray_area(&self.grid.centre(voxel), RAYS_A_ROW);
                expected.all += all * chance * area;
                expected.firm += firm * sure * area;
                saw(voxel, all * chance);
                all *= 1.0 - chance;
                firm *= 1.0 - sure;
                if firm < SPENT {
                    break;
                }
            }
        }
        let face = self.grid.voxel * self.grid.voxel;
        Expected {
            all: expected.all / face,
            firm: expected.firm / face,
        }
    }
}

impl Face {
    /// Chance that a ray ends here, twice, and the area that it sees over its own
    /// cross-section. A face that is turned away is no surface to the ray.
    fn met_along(&self, sight: &Vector) -> (f64, f64, f64) {
        let cosine = self.normals.iter().map(|n| -n.dot(sight)).fold(0.0, f64::max);
        if cosine <= 0.0 {
            return (0.0, 0.0, 0.0);
        }
        (self.probability, self.probability, 1.0 / cosine.max(LEAST_COSINE))
    }
}

/// The voxels within `reach` metres of some others along each axis.
fn around(grid: &Grid, voxels: &[Voxel], reach: f64) -> Vec<Voxel> {
    let reach = ((reach / grid.voxel).ceil() as i64).clamp(1, 8);
    let near = |v: &Voxel| {
        let [x, y, z] = grid.cell(*v);
        let span = || -reach..=reach;
        let offsets = span().flat_map(move |dz| span().flat_map(move |dy| span().map(move |dx| [dx, dy, dz])));
        let voxels = offsets.filter_map(|[dx, dy, dz]| grid.at([x + dx, y + dy, z + dz]));
        voxels.collect::<Vec<_>>()
    };
    let mut all: Vec<Voxel> = voxels.par_iter().flat_map_iter(near).collect();
    all.par_sort_unstable();
    all.dedup();
    all
}

/// The voxels of all surfaces that the classes left predict.
fn predicted(situation: &Situation<'_>, grid: &Grid) -> BTreeMap<Voxel, Face> {
    let (status, library) = (situation.status, &situation.knowledge.library);
    let mut faces: BTreeMap<Voxel, Face> = BTreeMap::new();
    let mut add = |polygons: &[Polygon], exists: f64| {
        for voxel in predicted_voxels(polygons, grid) {
            let face = faces.entry(voxel.voxel).or_insert(Face {
                probability: 0.0,
                normals: Vec::new(),
            });
            face.probability = 1.0 - (1.0 - face.probability) * (1.0 - exists * ACCURACY);
            face.normals.extend(voxel.normals);
        }
    };
    for id in library.feature_ids() {
        let feature = status.feature(id);
        let exists = match feature.state {
            Existence::Unknown => presence(library, &status.posterior, id),
            Existence::Present | Existence::Detected => 1.0,
            Existence::Absent | Existence::Excluded => 0.0,
        };
        for predicted in feature.predicted.values() {
            add(&predicted.polygons, exists);
        }
        for found in &feature.found {
            if let Measurement::Shell(polygons) = &found.measurement {
                add(polygons, 1.0);
            }
        }
    }
    faces
}
