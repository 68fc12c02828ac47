//! Triangulation of a simple polygon with holes, by ear clipping.
//!
//! Holes are first joined to the outline by bridges, so no point is added and
//! neighbouring faces fit edge to edge. Meant for tens of corners, not thousands.

/// A point of the plane.
pub(super) type Flat = [f64; 2];

/// Triangles (as indices into `points`, counter-clockwise) of the polygon
/// whose `outline` runs counter-clockwise and whose `holes` run clockwise.
/// `None` where the outline crosses itself or a hole is not inside.
pub(super) fn triangulate(points: &[Flat], outline: &[usize], holes: &[Vec<usize>]) -> Option<Vec<[usize; 3]>> {
    let mut ring = outline.to_vec();
    let mut left: Vec<&Vec<usize>> = holes.iter().collect();
    while !left.is_empty() {
        let (k, at, from) = shortest_bridge(points, &ring, &left)?;
        let hole = left.remove(k);
        let mut joined = ring[..=at].to_vec();
        joined.extend((0..=hole.len()).map(|j| hole[(from + j) % hole.len()]));
        joined.extend_from_slice(&ring[at..]);
        ring = joined;
    }
    clip_ears(points, ring)
}

/// Twice the signed area of a triangle: positive where it turns left.
pub(super) fn turn(a: Flat, b: Flat, c: Flat) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether two segments share a point other than a common end.
pub(super) fn cross(a: Flat, b: Flat, c: Flat, d: Flat) -> bool {
    if [c, d].contains(&a) || [c, d].contains(&b) {
        return false;
    }
    let opposite = |x: f64, y: f64| (x >= 0.0) != (y >= 0.0) || x == 0.0 || y == 0.0;
    opposite(turn(a, b, c), turn(a, b, d)) && opposite(turn(c, d, a), turn(c, d, b))
}

/// The shortest segment from the ring to a hole that crosses nothing:
/// (hole, position in the ring, position in the hole).
fn shortest_bridge(points: &[Flat], ring: &[usize], holes: &[&Vec<usize>]) -> Option<(usize, usize, usize)> {
    let mut all = Vec::new();
    for (k, hole) in holes.iter().enumerate() {
        for (at, &i) in ring.iter().enumerate() {
            for (from, &j) in hole.iter().enumerate() {
                let (dx, dy) = (points[i][0] - points[j][0], points[i][1] - points[j][1]);
                all.push((dx * dx + dy * dy, k, at, from));
            }
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let free = |&(_, k, at, from): &(f64, usize, usize, usize)| {
        let (a, b) = (points[ring[at]], points[holes[k][from]]);
        edges(ring)
            .chain(holes.iter().flat_map(|h| edges(h)))
            .all(|(i, j)| !cross(a, b, points[i], points[j]))
            && opens_inwards(points, ring, at, b)
    };
    all.into_iter().find(free).map(|(_, k, at, from)| (k, at, from))
}

/// Whether the segment from corner `at` of the ring to `b` starts inside the polygon.
fn opens_inwards(points: &[Flat], ring: &[usize], at: usize, b: Flat) -> bool {
    let n = ring.len();
    let (before, here, after) = (
        points[ring[(at + n - 1) % n]],
        points[ring[at]],
        points[ring[(at + 1) % n]],
    );
    let (from_after, to_before) = (turn(here, after, b) > 0.0, turn(here, b, before) > 0.0);
    if turn(before, here, after) >= 0.0 {
        from_after && to_before
    } else {
        from_after || to_before
    }
}

fn edges(ring: &[usize]) -> impl Iterator<Item = (usize, usize)> + '_ {
    (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]))
}

fn clip_ears(points: &[Flat], mut ring: Vec<usize>) -> Option<Vec<[usize; 3]>> {
    let mut triangles = Vec::with_capacity(ring.len());
    while ring.len() > 3 {
        let n = ring.len();
        let corner = |k: usize| [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]];
        let best = (0..n)
            .filter(|&k| is_ear(points, &ring, corner(k)))
            .max_by(|&j, &k| fatness(points, corner(j)).total_cmp(&fatness(points, corner(k))))?;
        triangles.push(corner(best));
        ring.remove(best);
    }
    triangles.push([ring[0], ring[1], ring[2]]);
    Some(triangles)
}

/// Twice the area over the longest edge squared: slivers come last.
fn fatness(points: &[Flat], [i, j, k]: [usize; 3]) -> f64 {
    let (a, b, c) = (points[i], points[j], points[k]);
    let squared = |p: Flat, q: Flat| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    turn(a, b, c) / squared(a, b).max(squared(b, c)).max(squared(c, a))
}

fn is_ear(points: &[Flat], ring: &[usize], [i, j, k]: [usize; 3]) -> bool {
    let (a, b, c) = (points[i], points[j], points[k]);
    if turn(a, b, c) <= 0.0 {
        return false;
    }
    let within = |p: Flat| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    ring.iter()
        .map(|&m| points[m])
        .filter(|p| ![a, b, c].contains(p))
        .all(|p| !within(p))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[Flat], triangles: &[[usize; 3]]) -> f64 {
        triangles
            .iter()
            .map(|t| {
                let a = turn(points[t[0]], points[t[1]], points[t[2]]);
                assert!(a > 0.0, "{t:?} is not counter-clockwise");
                a / 2.0
            })
            .sum()
    }

    #[test]
    fn a_square_with_three_holes_keeps_its_area() {
        let mut points = vec![[0., 0.], [10., 0.], [10., 10.], [0., 10.]];
        let mut holes = Vec::new();
        for (x, y) in [(1., 1.), (6., 1.), (3., 6.)] {
            let first = points.len();
            points.extend([[x, y], [x + 3., y], [x + 3., y + 3.], [x, y + 3.]]);
            holes.push(vec![first, first + 3, first + 2, first + 1]);
        }
        let triangles = triangulate(&points, &[0, 1, 2, 3], &holes).unwrap();
        assert!((area(&points, &triangles) - 73.0).abs() < 1e-9);
        assert_eq!(triangles.len(), points.len() + 2 * holes.len() - 2);
    }

    #[test]
    fn a_concave_outline_keeps_its_area() {
        let points = [
            [0., 0.],
            [4., 0.],
            [4., 3.],
            [5., 3.],
            [5., 0.],
            [9., 0.],
            [9., 6.],
            [0., 6.],
        ];
        let triangles = triangulate(&points, &[0, 1, 2, 3, 4, 5, 6, 7], &[]).unwrap();
        assert!((area(&points, &triangles) - 51.0).abs() < 1e-9);
    }
}
