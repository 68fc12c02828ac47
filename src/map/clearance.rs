//! How far the nearest occupied voxel is, by blocks of 4³ voxels: what lets a
//! sight line leap over empty space without missing a voxel.
//!
//! Frozen at one state of the map; covers the box of occupied blocks only.

use super::bricks::{Bricks, States};
use super::layout::{Address, Layout, VOXELS};
use super::log_odds::LogOdds;

/// Entries below this are distances; from here on they index words.
const FIRST_WORD: u32 = 256;

/// What is known of a block.
pub(super) enum Block {
    /// No block within fewer blocks than this, along every axis, has an
    /// occupied voxel; at least 1.
    Clear(i32),
    /// Occupied voxels, one bit each, x fastest.
    Occupied(u64),
}

/// Clearance of all blocks in the box of occupied ones.
#[derive(Clone, Debug, Default)]
pub(super) struct Clearance {
    /// First cell of the box.
    low: [i32; 3],
    /// First cell beyond the box; equal to `low` where nothing is occupied.
    high: [i32; 3],
    /// Distance between neighbours in `entries`, which have a border of one.
    strides: [usize; 3],
    entries: Vec<u32>,
    words: Vec<u64>,
    /// Of each word, the first cell of its block.
    corners: Vec<[i32; 3]>,
}

/// One axis of the box of occupied blocks; reversed, cell c is −1 − c.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    /// First cell of the box.
    pub low: i32,
    /// First cell beyond it.
    pub high: i32,
    /// Between the places of neighbouring blocks.
    pub stride: i64,
    base: i64,
}

impl Axis {
    /// What a cell adds to the place of its block.
    #[inline(always)]
    pub fn place(&self, cell: i32) -> i64 {
        self.base + i64::from(cell >> 2) * self.stride
    }
}

impl Clearance {
    /// The clearance of a map's bricks.
    pub fn of(layout: &Layout, bricks: &Bricks, model: &LogOdds) -> Self {
        let words = occupied_words(layout, bricks, model);
        let Some((low, size)) = block_box(&words) else {
            return Self::default();
        };
        let padded = size.map(|n| n + 2);
        let mut clearance = Self {
            low: low.map(|b| b * 4),
            high: [0, 1, 2].map(|k| (low[k] + size[k] as i32) * 4),
            strides: [1, padded[0], padded[0] * padded[1]],
            entries: vec![FIRST_WORD - 1; padded.iter().product()],
            words: words.iter().map(|w| w.1).collect(),
            corners: words.iter().map(|w| w.0.map(|b| b * 4)).collect(),
        };
        let places: Vec<_> = words.iter().map(|w| clearance.place(w.0.map(|b| b * 4))).collect();
        clearance.spread_from(&places, size);
        for (i, place) in places.into_iter().enumerate() {
            clearance.entries[place] = FIRST_WORD + i as u32;
        }
        clearance
    }

    /// Whether nothing is occupied.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// First cell and extents, in cells, of the box of occupied blocks.
    pub fn extent(&self) -> ([i32; 3], [i32; 3]) {
        (self.low, [0, 1, 2].map(|k| self.high[k] - self.low[k]))
    }

    /// The blocks with occupied voxels: first cell and bits.
    pub fn occupied(&self) -> impl Iterator<Item = ([i32; 3], u64)> {
        self.corners.iter().copied().zip(self.words.iter().copied())
    }

    /// The block at a place: the sum of its places along the axes.
    #[inline(always)]
    pub fn block(&self, place: usize) -> Block {
        match self.entries[place] {
            d if d < FIRST_WORD => Block::Clear(d as i32),
            i => Block::Occupied(self.words[(i - FIRST_WORD) as usize]),
        }
    }

    /// An axis of the box, reversed where a line descends along it.
    #[inline(always)]
    pub fn axis(&self, k: usize, reversed: bool) -> Axis {
        let (low, high, stride) = (self.low[k], self.high[k], self.strides[k] as i64);
        let base = i64::from(low >> 2) * -stride;
        if reversed {
            Axis {
                low: -high,
                high: -low,
                stride: -stride,
                base,
            }
        } else {
            Axis {
                low,
                high,
                stride,
                base: base + stride,
            }
        }
    }

    fn place(&self, cell: [i32; 3]) -> usize {
        (0..3).map(|k| self.axis(k, false).place(cell[k])).sum::<i64>() as usize
    }

    /// Largest-norm distances from the given places, by two sweeps (Rosenfeld
    /// and Pfaltz 1968; exact for this norm).
    fn spread_from(&mut self, places: &[usize], size: [usize; 3]) {
        for &place in places {
            self.entries[place] = 0;
        }
        let before = self.neighbours_before();
        let rows = (1..=size[2]).flat_map(|z| (1..=size[1]).map(move |y| (z, y)));
        let starts: Vec<_> = rows
            .map(|(z, y)| z * self.strides[2] + y * self.strides[1] + 1)
            .collect();
        for &start in &starts {
            (start..start + size[0]).for_each(|i| self.relax(i, before.map(|b| i - b)));
        }
        for &start in starts.iter().rev() {
            (start..start + size[0])
                .rev()
                .for_each(|i| self.relax(i, before.map(|b| i + b)));
        }
    }

    fn relax(&mut self, at: usize, neighbours: [usize; 13]) {
        let nearest = neighbours.iter().fold(FIRST_WORD, |d, &n| d.min(self.entries[n]));
        self.entries[at] = self.entries[at].min(nearest + 1);
    }

    /// How far back the 13 neighbours lie that a sweep has passed.
    fn neighbours_before(&self) -> [usize; 13] {
        let [x, y, z] = self.strides;
        [
            x,
            y - x,
            y,
            y + x,
            z - y - x,
            z - y,
            z - y + x,
            z - x,
            z,
            z + x,
            z + y - x,
            z + y,
            z + y + x,
        ]
    }
}

/// Blocks with occupied voxels and their bits.
fn occupied_words(layout: &Layout, bricks: &Bricks, model: &LogOdds) -> Vec<([i32; 3], u64)> {
    let of_brick = |brick: States| {
        let words = brick.occupied.into_iter().enumerate().filter(|w| w.1 != 0);
        let base = brick.index * VOXELS;
        words
            .map(move |(i, word)| (Address(base + i * 64), word))
            .collect::<Vec<_>>()
    };
    let words = bricks.states(model).flat_map(of_brick);
    words
        .map(|(at, word)| (layout.cell(at).map(|c| c as i32 / 4), word))
        .collect()
}

/// First block and extents of the box around blocks.
fn block_box(words: &[([i32; 3], u64)]) -> Option<([i32; 3], [usize; 3])> {
    let first = words.first()?.0;
    let (low, high) = words.iter().fold((first, first), |(low, high), (b, _)| {
        (
            [0, 1, 2].map(|k| low[k].min(b[k])),
            [0, 1, 2].map(|k| high[k].max(b[k])),
        )
    });
    Some((low, [0, 1, 2].map(|k| (high[k] - low[k] + 1) as usize)))
}
