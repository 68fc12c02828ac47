//! Joins parts of one plane that a groove, a shadow or noise has separated.

use super::cloud::Cloud;
use super::segment::Part;

/// Widest gap across which parts of one plane count as one face, metres.
pub const WIDEST_GAP: f64 = 0.06;
/// Least cosine between normals of joined parts, of which the smaller is well fitted.
const SAME_NORMAL: f64 = 0.9903; // 8°
/// The same where the smaller part has few pixels.
const SAME_NORMAL_SMALL: f64 = 0.9659; // 15°
/// Fewer pixels than this leave a normal uncertain.
const FEW: usize = 60;

/// Groups of pixels, each the union of coplanar parts that lie close together.
pub fn coplanar(cloud: &Cloud, parts: Vec<Part>, tolerance: f64) -> Vec<Vec<usize>> {
    let borders: Vec<Vec<usize>> = parts.iter().map(|p| border(cloud, &p.pixels)).collect();
    let mut sets = Sets::new(parts.len());
    for a in 0..parts.len() {
        for b in a + 1..parts.len() {
            if one_plane(cloud, &parts[a], &parts[b], tolerance) && near(cloud, &borders[a], &borders[b]) {
                sets.join(a, b);
            }
        }
    }
    sets.merged(parts.into_iter().map(|p| p.pixels).collect())
}

/// Unites sets of pixels that lie within [`WIDEST_GAP`] of each other.
pub fn close_together(cloud: &Cloud, pieces: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let borders: Vec<Vec<usize>> = pieces.iter().map(|p| border(cloud, p)).collect();
    let mut sets = Sets::new(pieces.len());
    for a in 0..pieces.len() {
        for b in a + 1..pieces.len() {
            if sets.root(a) != sets.root(b) && near(cloud, &borders[a], &borders[b]) {
                sets.join(a, b);
            }
        }
    }
    sets.merged(pieces)
}

/// The 4-connected pieces of a set of pixels (ascending), each ascending.
pub fn pieces(cloud: &Cloud, pixels: &[usize]) -> Vec<Vec<usize>> {
    let mut open = vec![false; cloud.points.len()];
    pixels.iter().for_each(|&p| open[p] = true);
    let mut found = Vec::new();
    for &seed in pixels {
        if !std::mem::take(&mut open[seed]) {
            continue;
        }
        let (mut piece, mut next) = (vec![seed], 0);
        while let Some(&pixel) = piece.get(next) {
            next += 1;
            for other in cloud.neighbours(pixel) {
                if std::mem::take(&mut open[other]) {
                    piece.push(other);
                }
            }
        }
        piece.sort_unstable();
        found.push(piece);
    }
    found
}

fn one_plane(cloud: &Cloud, a: &Part, b: &Part, tolerance: f64) -> bool {
    let (large, small) = if a.pixels.len() >= b.pixels.len() {
        (a, b)
    } else {
        (b, a)
    };
    let least = if small.pixels.len() < FEW {
        SAME_NORMAL_SMALL
    } else {
        SAME_NORMAL
    };
    if large.plane.normal.dot(&small.plane.normal) < least {
        return false;
    }
    let distances = small.pixels.iter().map(|&p| large.plane.distance(&cloud.points[p]));
    let (mut sum, mut squares) = (0.0, 0.0);
    for d in distances {
        sum += d;
        squares += d * d;
    }
    let n = small.pixels.len() as f64;
    f64::abs(sum / n) <= tolerance * 0.7 && f64::sqrt(squares / n) <= tolerance
}

/// Pixels of a set that have a neighbour outside it.
fn border(cloud: &Cloud, pixels: &[usize]) -> Vec<usize> {
    let inside = |p: usize| pixels.binary_search(&p).is_ok();
    let whole = |p: usize| cloud.neighbours(p).filter(|&q| inside(q)).count() == 4;
    pixels.iter().copied().filter(|&p| !whole(p)).collect()
}

fn near(cloud: &Cloud, a: &[usize], b: &[usize]) -> bool {
    a.iter().any(|&p| {
        let here = &cloud.points[p];
        b.iter()
            .any(|&q| (cloud.points[q] - here).norm_squared() < WIDEST_GAP * WIDEST_GAP)
    })
}

/// Disjoint sets of indices; the root of a set is its least index.
struct Sets(Vec<usize>);

impl Sets {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn root(&self, mut k: usize) -> usize {
        while self.0[k] != k {
            k = self.0[k];
        }
        k
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// The union of each set, in the order of roots, pixels ascending.
    fn merged(&self, mut pixels: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
        for k in 0..pixels.len() {
            let root = self.root(k);
            if root != k {
                let moved = std::mem::take(&mut pixels[k]);
                pixels[root].extend(moved);
            }
        }
        pixels.retain(|p| !p.is_empty());
        pixels.iter_mut().for_each(|p| p.sort_unstable());
        pixels
    }
}
