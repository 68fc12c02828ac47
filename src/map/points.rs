//! Measured points of a brick (PC_t of eq. 3), in bounded memory: of each
//! voxel the first point of every octant.
//!
//! With ξ as small as a voxel, one point a voxel leaves up to 1 % of the voxels
//! of an oblique plane without a near point where all points leave none: as
//! much as ξ_ned = 0.99 allows. With one an octant none was left.

use super::layout::{Address, VOXELS, WORDS};
use crate::geometry::Point;

/// Points of a brick, by voxel and octant.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Points {
    /// Octants with a point, one bit each.
    octants: [u8; VOXELS],
    /// The octant that had a point first.
    first: [u8; VOXELS],
    /// Where each word's points start, and the last one's end.
    starts: [u16; WORDS + 1],
    points: Vec<Point>,
}

impl Default for Points {
    fn default() -> Self {
        Self {
            octants: [0; VOXELS],
            first: [0; VOXELS],
            starts: [0; WORDS + 1],
            points: Vec::new(),
        }
    }
}

impl Points {
    /// Keeps the point of an octant (0 to 7) that has none.
    pub fn keep(&mut self, address: Address, octant: u8, point: Point) {
        let (local, bit) = (address.local(), 1 << octant);
        if self.octants[local] & bit != 0 {
            return;
        }
        if self.octants[local] == 0 {
            self.first[local] = octant;
        }
        let place = self.place(local, octant);
        self.points.insert(place, point);
        self.octants[local] |= bit;
        self.starts[address.word() + 1..]
            .iter_mut()
            .for_each(|start| *start += 1);
    }

    /// All points kept in one word of the brick.
    pub fn of_word(&self, word: usize) -> &[Point] {
        &self.points[usize::from(self.starts[word])..usize::from(self.starts[word + 1])]
    }

    /// Bytes on the heap.
    pub fn bytes(&self) -> usize {
        self.points.capacity() * size_of::<Point>()
    }

    /// The first measured point of every voxel that has one, by place.
    pub fn firsts(&self) -> impl Iterator<Item = (usize, Point)> {
        let measured = (0..VOXELS).filter(|&local| self.octants[local] != 0);
        measured.map(|local| (local, self.points[self.place(local, self.first[local])]))
    }

    /// Where the point of an octant is kept or belongs.
    fn place(&self, local: usize, octant: u8) -> usize {
        let start = usize::from(self.starts[local / 64]);
        let voxels = self.octants[local / 64 * 64..local].iter();
        let before = voxels.map(|o| o.count_ones()).sum::<u32>();
        start + (before + (self.octants[local] & ((1 << octant) - 1)).count_ones()) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_point_of_every_octant_is_kept_in_order() {
        let mut points = Points::default();
        let p = |x: f64| Point::new(x, 0.0, 0.0);
        for (local, octant, x) in [(70, 5, 1.0), (70, 2, 2.0), (3, 7, 3.0), (70, 5, 4.0), (511, 0, 5.0)] {
            points.keep(Address(512 * 9 + local), octant, p(x));
        }
        assert_eq!(points.of_word(0), [p(3.0)]);
        assert_eq!(points.of_word(1), [p(2.0), p(1.0)]);
        assert_eq!(points.of_word(7), [p(5.0)]);
        assert!(points.of_word(4).is_empty());
        let firsts: Vec<_> = points.firsts().collect();
        assert_eq!(firsts, [(3, p(3.0)), (70, p(1.0)), (511, p(5.0))]);
    }
}
