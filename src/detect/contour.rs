//! From a staircase contour to straight edges: simplify, fit lines, intersect.

use nalgebra::{Matrix2, Point2, Vector2};

type Flat = Point2<f64>;

/// How coarse the contour is.
#[derive(Clone, Copy, Debug)]
pub struct Coarseness {
    /// Most distance of the contour from a straight edge, metres.
    pub tolerance: f64,
    /// Edges shorter than this are artefacts, metres.
    pub shortest: f64,
}

/// Neighbouring edges within this angle are one edge, radians.
const STRAIGHT: f64 = 0.2;
/// A joint nearer than this to the chord over its edges is no corner, in units of the tolerance.
const FLAT: f64 = 0.8;
/// Edges must differ by this angle to be extended to their intersection, radians.
const CROSSING: f64 = 0.26;

/// A run of the contour that is one edge: from `start` through `len` points.
#[derive(Clone, Copy, Debug)]
struct Run {
    start: usize,
    len: usize,
}

struct Line {
    point: Flat,
    direction: Vector2<f64>,
}

/// The corners of a closed contour, in its order; fewer than three where it has no shape.
pub fn corners(contour: &[Flat], coarseness: Coarseness) -> Vec<Flat> {
    if contour.len() < 8 {
        return Vec::new();
    }
    let mut runs = runs(contour.len(), &simplified(contour, coarseness.tolerance));
    while runs.len() > 3 && reduce(contour, &mut runs, coarseness) {}
    meetings(contour, &runs, &lines(contour, &runs, coarseness), coarseness)
}

fn lines(contour: &[Flat], runs: &[Run], c: Coarseness) -> Vec<Line> {
    runs.iter().map(|r| fitted(contour, *r, c)).collect()
}

/// The first corner of each edge.
fn meetings(contour: &[Flat], runs: &[Run], lines: &[Line], c: Coarseness) -> Vec<Flat> {
    let n = runs.len();
    (0..n)
        .map(|k| ((k + n - 1) % n, k))
        .map(|(a, b)| corner(contour, runs[a], runs[b], &lines[a], &lines[b], c))
        .collect()
}

/// Where two neighbouring edges meet.
fn corner(contour: &[Flat], before: Run, after: Run, a: &Line, b: &Line, c: Coarseness) -> Flat {
    let n = contour.len();
    let end = contour[(before.start + before.len) % n];
    let middle = nalgebra::center(&end, &contour[after.start % n]);
    let reach = 4.0 * c.shortest + (end - contour[after.start % n]).norm();
    crossing(a, b)
        .filter(|p| (p - middle).norm() <= reach)
        .unwrap_or(middle)
}

fn crossing(a: &Line, b: &Line) -> Option<Flat> {
    let cross = a.direction.perp(&b.direction);
    (cross.abs() > STRAIGHT.sin() * 0.5)
        .then(|| a.point + a.direction * ((b.point - a.point).perp(&b.direction) / cross))
}

/// Takes out one artefact: a bend that is none, or an edge that is too short.
fn reduce(contour: &[Flat], runs: &mut Vec<Run>, c: Coarseness) -> bool {
    let n = runs.len();
    let lines = lines(contour, runs, c);
    let corners = meetings(contour, runs, &lines, c);
    let bend = |k: usize, l: usize| {
        let (a, b) = (lines[k].direction, lines[l].direction);
        a.perp(&b).atan2(a.dot(&b)).abs()
    };
    let length = |k: usize| (corners[(k + 1) % n] - corners[k]).norm();
    let shortest = (0..n).min_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0);
    if length(shortest) < c.shortest {
        let (before, after) = ((shortest + n - 1) % n, (shortest + 1) % n);
        let turn = bend(before, after);
        if turn > CROSSING && turn < std::f64::consts::PI - CROSSING {
            runs.remove(shortest);
        } else if bend(before, shortest) < bend(shortest, after) {
            unite(contour.len(), runs, before);
        } else {
            unite(contour.len(), runs, shortest);
        }
        return true;
    }
    // A joint close to the chord over both its edges is no corner either.
    let bulge = |k: usize| off_segment(&corners[(k + 1) % n], &corners[k], &corners[(k + 2) % n]) / c.tolerance;
    let cornerness = |k: usize| (bend(k, (k + 1) % n) / STRAIGHT).min(bulge(k) / FLAT);
    let straightest = (0..n)
        .min_by(|&a, &b| cornerness(a).total_cmp(&cornerness(b)))
        .unwrap_or(0);
    let straight = cornerness(straightest) < 1.0;
    if straight {
        unite(contour.len(), runs, straightest);
    }
    straight
}

/// Makes run `k` and the one after it one run.
fn unite(points: usize, runs: &mut Vec<Run>, k: usize) {
    let next = (k + 1) % runs.len();
    let gap = (runs[next].start + points - runs[k].start) % points;
    runs[k].len = gap + runs[next].len;
    runs.remove(next);
}

/// The line through the inner points of a run (total least squares).
fn fitted(contour: &[Flat], run: Run, c: Coarseness) -> Line {
    let n = contour.len();
    let (start, end) = (contour[run.start % n], contour[(run.start + run.len) % n]);
    let chord = end - start;
    let length = chord.norm().max(1e-9);
    let margin = (0.5 * c.shortest).min(0.2 * length);
    let inner = (0..=run.len).map(|k| contour[(run.start + k) % n]).filter(|p| {
        let along = (p - start).dot(&chord) / length;
        along >= margin && along <= length - margin
    });
    let (mut count, mut sum, mut products) = (0.0, Vector2::zeros(), Matrix2::zeros());
    for p in inner {
        let d = p - start;
        count += 1.0;
        sum += d;
        products += d * d.transpose();
    }
    if count < 3.0 {
        return Line {
            point: start,
            direction: chord / length,
        };
    }
    let mean = sum / count;
    let eigen = (products / count - mean * mean.transpose()).symmetric_eigen();
    let axis = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    let direction = if axis.dot(&chord) < 0.0 { -axis } else { axis };
    Line {
        point: start + mean,
        direction,
    }
}

fn runs(points: usize, vertices: &[usize]) -> Vec<Run> {
    let n = vertices.len();
    (0..n)
        .map(|k| Run {
            start: vertices[k],
            len: (vertices[(k + 1) % n] + points - vertices[k]) % points,
        })
        .collect()
}

/// Indices of the vertices that Douglas and Peucker keep of a closed line.
fn simplified(contour: &[Flat], tolerance: f64) -> Vec<usize> {
    let n = contour.len();
    let centre = contour.iter().map(|p| p.coords).sum::<Vector2<f64>>() / n as f64;
    let farthest = |from: Vector2<f64>| {
        (0..n)
            .max_by(|&a, &b| {
                (contour[a].coords - from)
                    .norm()
                    .total_cmp(&(contour[b].coords - from).norm())
            })
            .unwrap_or(0)
    };
    let first = farthest(centre);
    let second = farthest(contour[first].coords);
    let offset = (second + n - first) % n;
    let mut kept = vec![first, second];
    let mut open = vec![(0, offset), (offset, n)];
    while let Some((a, b)) = open.pop() {
        let (start, end) = (contour[(first + a) % n], contour[(first + b) % n]);
        let worst = (a + 1..b)
            .map(|k| (off_segment(&contour[(first + k) % n], &start, &end), k))
            .max_by(|x, y| x.0.total_cmp(&y.0));
        if let Some((distance, k)) = worst
            && distance > tolerance
        {
            kept.push((first + k) % n);
            open.extend([(a, k), (k, b)]);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

fn off_segment(p: &Flat, a: &Flat, b: &Flat) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(&along) / along.norm_squared().max(1e-18)).clamp(0.0, 1.0);
    (p - (a + along * t)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stair_cased_hexagon_gives_its_six_corners() {
        let hexagon: Vec<Flat> = (0..6)
            .map(|k| f64::from(k) * std::f64::consts::FRAC_PI_3 + 0.2)
            .map(|a| Flat::new(0.15 * a.cos(), 0.15 * a.sin()))
            .collect();
        let step = 0.005;
        let contour: Vec<Flat> = (0..6)
            .flat_map(|k| {
                let (a, b) = (hexagon[k], hexagon[(k + 1) % 6]);
                (0..60).map(move |t| a + (b - a) * (f64::from(t) / 60.0))
            })
            .map(|p| Flat::new((p.x / step).round() * step, (p.y / step).round() * step))
            .collect();
        let found = corners(
            &contour,
            Coarseness {
                tolerance: 0.008,
                shortest: 0.012,
            },
        );
        assert_eq!(found.len(), 6);
        for want in &hexagon {
            assert!(
                found.iter().any(|p| (p - want).norm() < 0.004),
                "{want} not in {found:?}"
            );
        }
    }
}
