//! The planner's counts once more, written for clarity: sets, straight loops,
//! and visibility by intersecting a segment with every occupied cube.

use std::collections::{BTreeMap, BTreeSet};

use vpl::geometry::{Camera, Point, Polygon, Pose, Vector};
use vpl::map::{Grid, Occupancy, Voxel};
use vpl::primitives::{Envelope, ImageKind};
use vpl::rules::{Inspected, Task};

/// All that the counts depend on.
pub struct Scene<'a> {
    pub grid: Grid,
    pub states: Vec<Occupancy>,
    pub points: Vec<Point>,
    pub rear_side: BTreeSet<Voxel>,
    pub task: &'a Task,
    pub visited: Vec<Pose>,
}

/// A predicted instance.
pub struct Instance {
    pub weight: f64,
    pub polygons: Vec<Polygon>,
    pub envelope: Envelope,
}

/// What a view would give.
#[derive(Debug)]
pub struct Value {
    pub view: usize,
    pub feature: f64,
    pub surface: usize,
    pub overlap: f64,
}

impl Scene<'_> {
    /// PV_ij with the normals of the polygons in each voxel.
    pub fn pv(&self, instance: &Instance) -> BTreeMap<Voxel, Vec<Vector>> {
        let mut pv: BTreeMap<Voxel, Vec<Vector>> = BTreeMap::new();
        for polygon in &instance.polygons {
            for sample in polygon.samples(self.grid.voxel / 2.0) {
                if let Some(voxel) = self.grid.containing(&sample) {
                    pv.entry(voxel).or_default().push(polygon.normal());
                }
            }
        }
        pv
    }

    /// Pre-occupied voxels of some instances: unknown, within ξ of a PV.
    pub fn preoccupied(&self, instances: &[Instance]) -> BTreeSet<Voxel> {
        let mut tagged = BTreeSet::new();
        for instance in instances {
            for predicted in self.pv(instance).keys() {
                for voxel in self.all(Occupancy::Unknown) {
                    if self.apart(voxel, *predicted) <= self.task.thresholds.near + 1e-9 {
                        tagged.insert(voxel);
                    }
                }
            }
        }
        tagged
    }

    /// The inspected voxels of PV_ij.
    pub fn inspected(&self, instance: &Instance) -> BTreeSet<Voxel> {
        let pv = self.pv(instance);
        let mut inspected = BTreeSet::new();
        for view in &self.visited {
            let mut seen = BTreeSet::new();
            for (voxel, normals) in &pv {
                if self.is_known(*voxel) && self.reachable(view, *voxel, normals, &instance.envelope) {
                    seen.insert(*voxel);
                }
            }
            let enough = seen.len() as f64 >= self.task.thresholds.absent * pv.len() as f64 - 1e-9;
            if !instance.envelope.whole || enough {
                inspected.extend(seen);
            }
        }
        inspected
    }

    /// n_ij(v) after the gain floor.
    pub fn n(&self, instance: &Instance, view: &Pose) -> usize {
        let pv = self.pv(instance);
        let inspected = self.inspected(instance);
        let mut all = 0;
        let mut open = 0;
        for (voxel, normals) in &pv {
            if self.reachable(view, *voxel, normals, &instance.envelope) {
                all += 1;
                if !inspected.contains(voxel) {
                    open += 1;
                }
            }
        }
        if instance.envelope.whole && (all as f64) < self.task.thresholds.absent * pv.len() as f64 - 1e-9 {
            return 0;
        }
        self.floored(open)
    }

    /// The values of unvisited views: G_fd, G_so and overlap share.
    pub fn values(&self, instances: &[Instance], views: &[(usize, Pose)]) -> Vec<Value> {
        let mut values = Vec::new();
        for (view, pose) in views {
            let mut feature = 0.0_f64;
            for instance in instances {
                let total = self.pv(instance).len() as f64;
                feature = feature.max(instance.weight * self.n(instance, pose) as f64 / total);
            }
            values.push(Value {
                view: *view,
                feature,
                surface: self.floored(self.count(pose, &self.rear_side, 0.0)),
                overlap: self.overlap(instances, pose),
            });
        }
        values
    }

    fn overlap(&self, instances: &[Instance], view: &Pose) -> f64 {
        let preoccupied = self.preoccupied(instances);
        let rear: BTreeSet<Voxel> = self.rear_side.difference(&preoccupied).copied().collect();
        let occupied: BTreeSet<Voxel> = self.all(Occupancy::Occupied).into_iter().collect();
        let old = self.count(view, &occupied, 0.0) as f64;
        let new = self.count(view, &preoccupied, self.task.thresholds.near) + self.count(view, &rear, 0.0);
        if old == 0.0 { 0.0 } else { old / (old + new as f64) }
    }

    fn count(&self, view: &Pose, voxels: &BTreeSet<Voxel>, tolerance: f64) -> usize {
        let mut count = 0;
        for voxel in voxels {
            let seen = in_depth_image(&self.task.camera, view, &self.grid.centre(*voxel)).is_some();
            if seen && !self.is_hidden(&eye(view), *voxel, tolerance) {
                count += 1;
            }
        }
        count
    }

    fn reachable(&self, view: &Pose, voxel: Voxel, normals: &[Vector], envelope: &Envelope) -> bool {
        let centre = self.grid.centre(voxel);
        let camera = &self.task.camera;
        let Some(depth) = in_depth_image(camera, view, &centre) else {
            return false;
        };
        let image = match envelope.image {
            ImageKind::Depth => &camera.depth,
            ImageKind::Colour => &camera.colour,
        };
        let sight = (eye(view) - centre).normalize();
        let upright = normals.iter().any(|n| n.dot(&sight).acos() <= envelope.max_incidence);
        let inside = image.project(&view.inverse_transform_point(&centre)).is_some();
        upright
            && inside
            && image.fx / depth >= envelope.min_pixels_per_metre
            && !self.is_hidden(&eye(view), voxel, self.tolerance(voxel))
    }

    /// How far in front a surface may lie without hiding a predicted voxel.
    fn tolerance(&self, voxel: Voxel) -> f64 {
        if self.is_near_a_point(voxel) {
            let touching = self.grid.voxel * 3.0_f64.sqrt();
            self.task.thresholds.near.max(touching)
        } else {
            0.0
        }
    }

    fn is_near_a_point(&self, voxel: Voxel) -> bool {
        let centre = self.grid.centre(voxel);
        let near = self.task.thresholds.near;
        self.points.iter().any(|p| (p - centre).norm() <= near)
    }

    fn is_known(&self, voxel: Voxel) -> bool {
        let near = self.is_near_a_point(voxel);
        let free = self.states[voxel.0 as usize] == Occupancy::Free;
        near || (self.task.inspected == Inspected::Observed && free)
    }

    fn is_hidden(&self, eye: &Point, voxel: Voxel, tolerance: f64) -> bool {
        let hides = |o: &Voxel| {
            self.apart(*o, voxel) > tolerance + 1e-9 && crosses(&self.grid, *o, &self.grid.centre(voxel), eye)
        };
        self.all(Occupancy::Occupied).iter().any(hides)
    }

    fn all(&self, state: Occupancy) -> Vec<Voxel> {
        (0..self.grid.len())
            .map(Voxel)
            .filter(|v| self.states[v.0 as usize] == state)
            .collect()
    }

    fn apart(&self, a: Voxel, b: Voxel) -> f64 {
        (self.grid.centre(a) - self.grid.centre(b)).norm()
    }

    fn floored(&self, n: usize) -> usize {
        if n < self.task.gain_floor as usize { 0 } else { n }
    }
}

/// The best view without (`least` = `None`) or with the overlap constraint;
/// whether it was relaxed. Ties go to the nearest, then to the lowest index.
pub fn best(values: &[Value], least: Option<f64>, distance: impl Fn(usize) -> f64) -> Option<(usize, bool)> {
    let w = values.iter().all(|v| v.feature == 0.0);
    let gain = |v: &&Value| v.feature + if w { v.surface as f64 } else { 0.0 };
    let gaining: Vec<&Value> = values.iter().filter(|v| gain(v) > 0.0).collect();
    let passing: Vec<&Value> = gaining
        .iter()
        .filter(|v| least.is_none_or(|l| v.overlap >= l - 1e-9))
        .copied()
        .collect();
    let relaxed = passing.is_empty();
    let (pool, value): (_, &dyn Fn(&&Value) -> f64) = if relaxed {
        (gaining, &|v| v.overlap)
    } else {
        (passing, &gain)
    };
    let top = pool.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
    let mut tied: Vec<usize> = pool.iter().filter(|v| value(v) == top).map(|v| v.view).collect();
    tied.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)).then(a.cmp(b)));
    tied.first().map(|v| (*v, relaxed))
}

/// Unknown voxels behind occupied ones, given which eyes measured which voxel.
pub fn rear_side(grid: &Grid, states: &[Occupancy], measured: &[(Point, Voxel)]) -> BTreeSet<Voxel> {
    let mut rear = BTreeSet::new();
    for (eye, voxel) in measured {
        if states[voxel.0 as usize] != Occupancy::Occupied {
            continue;
        }
        let away = grid.centre(*voxel) - eye;
        for axis in 0..3 {
            let mut cell = grid.cell(*voxel);
            cell[axis] += if away[axis] > 0.0 { 1 } else { -1 };
            if away[axis] != 0.0
                && let Some(behind) = grid.at(cell)
                && states[behind.0 as usize] == Occupancy::Unknown
            {
                rear.insert(behind);
            }
        }
    }
    rear
}

fn eye(view: &Pose) -> Point {
    Point::from(view.translation.vector)
}

/// z-depth of a point inside the depth image and range.
fn in_depth_image(camera: &Camera, view: &Pose, p: &Point) -> Option<f64> {
    let local = view.inverse_transform_point(p);
    let k = &camera.depth;
    let (u, v) = (k.fx * local.x / local.z + k.cx, k.fy * local.y / local.z + k.cy);
    let inside = 0.0 <= u && u < f64::from(k.width) && 0.0 <= v && v < f64::from(k.height);
    (inside && camera.range.min <= local.z && local.z <= camera.range.max).then_some(local.z)
}

/// Whether a segment passes through the inside of a voxel.
fn crosses(grid: &Grid, voxel: Voxel, from: &Point, to: &Point) -> bool {
    let centre = grid.centre(voxel);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for k in 0..3 {
        let along = to[k] - from[k];
        let (low, high) = (centre[k] - grid.voxel / 2.0, centre[k] + grid.voxel / 2.0);
        if along == 0.0 {
            if from[k] <= low || from[k] >= high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - from[k]) / along, (high - from[k]) / along);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    leave - enter > 1e-9
}
