//! A set of voxels by bricks, for counting many of them at once.

use super::grid::{Grid, Voxel};
use super::layout::{Bits, Layout, WORDS};

/// Some voxels of a grid.
#[derive(Clone, Debug, Default)]
pub struct VoxelSet(Vec<([i32; 3], Bits)>);

/// Voxels of a set inside a cube of 8³ or 4³.
pub(super) struct Cube<'a> {
    /// First cell.
    pub corner: [i32; 3],
    /// Voxels along an edge.
    pub size: i32,
    words: &'a [u64],
}

impl VoxelSet {
    /// The set of some voxels; numbers outside the grid are passed over.
    pub fn of(grid: &Grid, voxels: &[Voxel]) -> Self {
        let layout = Layout::new(*grid);
        let mut addresses: Vec<_> = voxels.iter().filter_map(|v| layout.address_of(*v)).collect();
        addresses.sort_unstable();
        let mut bricks: Vec<(usize, Bits)> = Vec::new();
        for at in addresses {
            if bricks.last().is_none_or(|b| b.0 != at.brick()) {
                bricks.push((at.brick(), [0; WORDS]));
            }
            if let Some((_, bits)) = bricks.last_mut() {
                bits[at.word()] |= at.bit();
            }
        }
        Self::of_bricks(&layout, bricks.into_iter())
    }

    /// The set of the voxels that bricks' bits name.
    pub(super) fn of_bricks(layout: &Layout, bricks: impl Iterator<Item = (usize, Bits)>) -> Self {
        let held = bricks.filter(|(_, bits)| *bits != [0; WORDS]);
        Self(
            held.map(|(brick, bits)| (layout.corner(brick).map(|c| c as i32), bits))
                .collect(),
        )
    }

    /// Number of voxels.
    pub fn len(&self) -> u64 {
        self.bricks().map(|brick| brick.len()).sum()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn bricks(&self) -> impl Iterator<Item = Cube<'_>> {
        self.0.iter().map(|(corner, bits)| Cube {
            corner: *corner,
            size: 8,
            words: bits,
        })
    }
}

impl<'a> Cube<'a> {
    /// Number of voxels.
    pub fn len(&self) -> u64 {
        self.words.iter().map(|w| u64::from(w.count_ones())).sum()
    }

    /// Its parts of 4³ that hold voxels, or its bits where it has none.
    pub fn parts(&self) -> Result<impl Iterator<Item = Cube<'a>> + use<'a>, u64> {
        if let [word] = self.words {
            return Err(*word);
        }
        let corner = self.corner;
        let parts = self.words.chunks_exact(1).enumerate().filter(|(_, word)| word[0] != 0);
        Ok(parts.map(move |(part, words)| Cube {
            corner: [0, 1, 2].map(|k| corner[k] + 4 * (part >> k & 1) as i32),
            size: 4,
            words,
        }))
    }
}
