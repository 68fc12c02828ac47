//! Where voxels are stored: bricks of 8³ voxels, eight words of 4³ a brick.
//!
//! An address is `brick · 512 + word · 64 + bit`. It is a sum of one term an
//! axis, so a walk looks its terms up instead of dividing.

use super::grid::{Grid, Voxel};

/// Words of 64 voxels a brick.
pub(super) const WORDS: usize = 8;
/// Voxels a brick.
pub(super) const VOXELS: usize = 64 * WORDS;
/// One bit a voxel of a brick.
pub(super) type Bits = [u64; WORDS];

/// The bits that each axis has in the index of a voxel in its brick.
pub(super) const AXES: [u32; 3] = [0b0_0100_0011, 0b0_1000_1100, 0b1_0011_0000];

/// Place of a voxel in the storage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Address(pub usize);

impl Address {
    /// Index of the brick.
    #[inline(always)]
    pub fn brick(self) -> usize {
        self.0 / VOXELS
    }
    /// Index of the voxel in its brick.
    #[inline(always)]
    pub fn local(self) -> usize {
        self.0 % VOXELS
    }
    /// Index of the word in the brick.
    #[inline(always)]
    pub fn word(self) -> usize {
        self.0 / 64 % WORDS
    }
    /// The voxel's bit in its word.
    #[inline(always)]
    pub fn bit(self) -> u64 {
        1 << (self.0 % 64)
    }
}

/// How a grid is cut into bricks.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    grid: Grid,
    /// Bricks along x, y and z; the last ones may reach beyond the grid.
    pub bricks: [usize; 3],
    /// Between the indices of neighbouring bricks.
    pub strides: [usize; 3],
    terms: [Vec<usize>; 3],
}

impl Layout {
    /// The bricks of a grid.
    pub fn new(grid: Grid) -> Self {
        let bricks = grid.size.map(|n| (n as usize).div_ceil(8));
        let strides = [1, bricks[0], bricks[0] * bricks[1]];
        let term = |k: usize, c: usize| (c / 8 * strides[k] * VOXELS) + ((c / 4 % 2) << (6 + k)) + ((c % 4) << (2 * k));
        let terms = [0, 1, 2].map(|k| (0..grid.size[k] as usize).map(|c| term(k, c)).collect());
        Self {
            grid,
            bricks,
            strides,
            terms,
        }
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Number of bricks.
    pub fn len(&self) -> usize {
        self.bricks.iter().product()
    }

    /// Address of a cell inside the grid.
    #[inline(always)]
    pub fn address(&self, cell: [usize; 3]) -> Address {
        Address(self.terms[0][cell[0]] + self.terms[1][cell[1]] + self.terms[2][cell[2]])
    }

    /// Address of a voxel; `None` for a number that is none of the grid's.
    pub fn address_of(&self, voxel: Voxel) -> Option<Address> {
        (voxel.0 < self.grid.len()).then(|| self.address(self.grid.cell(voxel).map(|c| c as usize)))
    }

    /// Integer coordinates of an address.
    pub fn cell(&self, address: Address) -> [usize; 3] {
        let (brick, local) = (address.brick(), address.local());
        let corner = self.corner(brick);
        [0, 1, 2].map(|k| corner[k] + (((local >> (6 + k)) & 1) * 4) + ((local >> (2 * k)) & 3))
    }

    /// Integer coordinates of the first voxel of a brick.
    pub fn corner(&self, brick: usize) -> [usize; 3] {
        let [x, y, _] = self.bricks;
        [brick % x, brick / x % y, brick / x / y].map(|c| c * 8)
    }

    /// The voxels of a brick that lie in the grid.
    pub fn inside(&self, brick: usize) -> Bits {
        let corner = self.corner(brick);
        let left = [0, 1, 2].map(|k| self.grid.size[k] as usize - corner[k]);
        if left.iter().all(|&n| n >= 8) {
            return [u64::MAX; WORDS];
        }
        let axis = |k: usize, upper: usize| AXIS[k][left[k].saturating_sub(4 * upper).min(4)];
        std::array::from_fn(|w| axis(0, w & 1) & axis(1, w >> 1 & 1) & axis(2, w >> 2 & 1))
    }

    /// The voxel at an address inside the grid.
    pub fn voxel(&self, address: Address) -> Voxel {
        let [x, y, z] = self.cell(address).map(|c| c as u32);
        Voxel((z * self.grid.size[1] + y) * self.grid.size[0] + x)
    }
}

/// Bits of a word whose coordinate along an axis is below 0, 1, … 4.
const AXIS: [[u64; 5]; 3] = [
    [
        0,
        0x1111_1111_1111_1111,
        0x3333_3333_3333_3333,
        0x7777_7777_7777_7777,
        u64::MAX,
    ],
    [
        0,
        0x000f_000f_000f_000f,
        0x00ff_00ff_00ff_00ff,
        0x0fff_0fff_0fff_0fff,
        u64::MAX,
    ],
    [0, 0xffff, 0xffff_ffff, 0xffff_ffff_ffff, u64::MAX],
];

/// Addresses of the set bits of a brick, ascending.
pub(super) fn addresses(brick: usize, bits: &Bits) -> impl Iterator<Item = Address> + '_ {
    bits.iter().enumerate().flat_map(move |(word, &set)| {
        let base = brick * VOXELS + word * 64;
        ones(set).map(move |bit| Address(base + bit))
    })
}

/// Positions of the set bits of a word, ascending.
pub(super) fn ones(word: u64) -> impl Iterator<Item = usize> {
    let rest = |w: &u64| Some(w & (w - 1)).filter(|&r| r != 0);
    std::iter::successors(Some(word).filter(|&w| w != 0), rest).map(|w| w.trailing_zeros() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn every_voxel_has_its_own_address_and_back() {
        let grid = Grid {
            origin: Point::origin(),
            voxel: 1.0,
            size: [9, 17, 5],
        };
        let layout = Layout::new(grid);
        let mut seen: Vec<_> = (0..grid.len()).map(|v| layout.address_of(Voxel(v)).unwrap()).collect();
        for (v, &a) in seen.iter().enumerate() {
            assert_eq!(layout.voxel(a), Voxel(v as u32));
            assert!(a.brick() < layout.len());
        }
        for brick in 0..layout.len() {
            let inside = layout.inside(brick);
            let listed = seen.iter().filter(|a| a.brick() == brick);
            assert!(listed.clone().all(|a| inside[a.word()] & a.bit() != 0));
            assert_eq!(
                listed.count() as u32,
                inside.iter().map(|w| w.count_ones()).sum::<u32>()
            );
        }
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), grid.len() as usize);
        assert_eq!(layout.address_of(Voxel(grid.len())), None);
    }

    #[test]
    fn ones_lists_the_bits_of_a_word() {
        assert_eq!(ones(0).count(), 0);
        assert_eq!(ones(1 << 63 | 0b101).collect::<Vec<_>>(), [0, 2, 63]);
        assert_eq!(ones(u64::MAX).count(), 64);
    }
}
