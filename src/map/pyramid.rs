//! The nearest and the farthest reading of any rectangle of a depth image.

use rayon::prelude::*;

/// Edge of a tile of the finest level, pixels.
const TILE: usize = 4;
/// Tiles along an axis that a question looks at, most.
const SPAN: usize = 4;

/// Least and greatest depth; a pixel without a reading counts as 0.
pub(super) type Range = [f32; 2];

/// Ranges of square tiles, each level's tiles twice as wide as the one's before.
pub(super) struct Pyramid {
    levels: Vec<Level>,
}

struct Level {
    width: usize,
    tiles: Vec<Range>,
}

/// Pixels, first and last of each axis, in the image.
#[derive(Clone, Copy)]
pub(super) struct Rectangle {
    pub u: [usize; 2],
    pub v: [usize; 2],
}

impl Pyramid {
    /// Of an image of rows of `width` pixels.
    pub fn of(depth: &[f32], width: usize) -> Self {
        let width = width.max(1);
        let (columns, rows) = (width.div_ceil(TILE), depth.par_chunks(width * TILE));
        let mut tiles = vec![NOTHING; columns * rows.len()];
        let pairs = tiles.par_chunks_mut(columns).zip(rows);
        pairs.for_each(|(tiles, rows)| tile_row(tiles, rows, width));
        let mut levels = vec![Level { width: columns, tiles }];
        while let Some(level) = levels.last().filter(|level| level.tiles.len() > 1) {
            levels.push(level.halved());
        }
        Self { levels }
    }

    /// The range of a rectangle or of one around it.
    #[inline]
    pub fn range(&self, pixels: &Rectangle) -> Range {
        let [mut u, mut v] = [pixels.u, pixels.v].map(|ends| ends.map(|end| end / TILE));
        let mut level = 0;
        while u[1] - u[0] >= SPAN || v[1] - v[0] >= SPAN {
            (u, v) = (u.map(|end| end / 2), v.map(|end| end / 2));
            level += 1;
        }
        let Some(level) = self.levels.get(level) else {
            return [0.0, f32::INFINITY];
        };
        let rows = (v[0]..=v[1]).filter_map(|row| level.tiles.get(row * level.width..)?.get(u[0]..=u[1]));
        rows.flatten().fold(NOTHING, |all, tile| both(all, *tile))
    }
}

impl Level {
    fn halved(&self) -> Self {
        let (width, rows) = (self.width.div_ceil(2), self.tiles.chunks(self.width * 2));
        let halved = |rows: &[Range]| {
            let (upper, lower) = rows.split_at(self.width);
            let pairs = move |row: &[Range]| {
                row.chunks(2)
                    .map(|pair| pair.iter().fold(NOTHING, |a, b| both(a, *b)))
                    .collect::<Vec<_>>()
            };
            let mut row = pairs(upper);
            row.iter_mut()
                .zip(pairs(lower))
                .for_each(|(above, below)| *above = both(*above, below));
            row
        };
        Self {
            width,
            tiles: rows.flat_map(halved).collect(),
        }
    }
}

const NOTHING: Range = [f32::INFINITY, 0.0];

#[inline(always)]
fn both(a: Range, b: Range) -> Range {
    [
        if b[0] < a[0] { b[0] } else { a[0] },
        if b[1] > a[1] { b[1] } else { a[1] },
    ]
}

/// Fills the tiles of up to [`TILE`] image rows.
fn tile_row(tiles: &mut [Range], rows: &[f32], width: usize) {
    let (mut least, mut most) = (vec![f32::INFINITY; width], vec![0.0_f32; width]);
    for row in rows.chunks(width) {
        for ((least, most), &z) in least.iter_mut().zip(&mut most).zip(row) {
            *least = if z < *least { z } else { *least };
            *most = if z > *most { z } else { *most };
        }
    }
    let columns = least.chunks(TILE).zip(most.chunks(TILE));
    for (tile, (least, most)) in tiles.iter_mut().zip(columns) {
        let ranges = least.iter().zip(most);
        *tile = ranges.fold(NOTHING, |all, (&least, &most)| both(all, [least, most]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every rectangle of an image whose sides no tile divides.
    #[test]
    fn a_range_holds_every_reading_of_its_rectangle() {
        let (width, height) = (23, 14);
        let depth: Vec<f32> = (0..width * height).map(|i| ((i * 7919) % 101) as f32).collect();
        let pyramid = Pyramid::of(&depth, width);
        let ends = |n: usize| (0..n).flat_map(move |a| (a..n).map(move |b| [a, b]));
        for u in ends(width) {
            for v in ends(height) {
                let [least, most] = pyramid.range(&Rectangle { u, v });
                let rows = (v[0]..=v[1]).map(|y| &depth[y * width + u[0]..=y * width + u[1]]);
                assert!(rows.flatten().all(|z| (least..=most).contains(z)));
            }
        }
        assert_eq!(pyramid.range(&Rectangle { u: [0, 22], v: [0, 13] }), [0.0, 100.0]);
        assert_eq!(
            pyramid.range(&Rectangle { u: [4, 7], v: [8, 8] })[1],
            (8..12)
                .map(|y| (4..8).map(|x| depth[y * 23 + x]).fold(0.0, f32::max))
                .fold(0.0, f32::max)
        );
    }
}
