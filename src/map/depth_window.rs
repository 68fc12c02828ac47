//! A depth image that is kept where something is drawn, with the extremes of its tiles.

/// Edge of a tile of pixels.
const TILE: usize = 4;

/// Pixels from (left, top) to (right, bottom), all of them included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixels {
    pub left: usize,
    pub top: usize,
    pub right: usize,
    pub bottom: usize,
}

/// The nearest depths in a window of an image; infinite where nothing was drawn,
/// so everywhere outside.
#[derive(Clone, Debug, Default)]
pub(super) struct DepthWindow {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
    depth: Vec<f32>,
    tiles_across: usize,
    /// Nearest and farthest depth of every tile.
    tiles: Vec<(f32, f32)>,
}

impl DepthWindow {
    /// A window in which nothing was drawn yet.
    pub fn over(pixels: Pixels) -> Self {
        let (width, height) = (pixels.right + 1 - pixels.left, pixels.bottom + 1 - pixels.top);
        Self {
            left: pixels.left,
            top: pixels.top,
            width,
            height,
            depth: vec![f32::INFINITY; width * height],
            tiles_across: width.div_ceil(TILE),
            tiles: vec![(f32::INFINITY, 0.0); width.div_ceil(TILE) * height.div_ceil(TILE)],
        }
    }

    /// Draws a depth in some pixels, where nothing nearer is.
    #[inline(always)]
    pub fn draw(&mut self, pixels: Pixels, depth: f32) {
        let Some(pixels) = self.inside(pixels) else {
            return;
        };
        for row in pixels.top..=pixels.bottom {
            for nearest in &mut self.depth[row * self.width..][pixels.left..=pixels.right] {
                *nearest = nearest.min(depth);
            }
        }
    }

    /// Ends the drawing: gathers the extremes of the tiles.
    pub fn finish(&mut self) {
        for (v, row) in self.depth.chunks_exact(self.width.max(1)).enumerate() {
            let tiles = &mut self.tiles[v / TILE * self.tiles_across..][..self.tiles_across];
            for ((near, far), pixels) in tiles.iter_mut().zip(row.chunks(TILE)) {
                for depth in pixels {
                    (*near, *far) = (near.min(*depth), far.max(*depth));
                }
            }
        }
    }

    /// The nearest depth at a pixel of the image.
    #[inline(always)]
    pub fn at(&self, u: usize, v: usize) -> f32 {
        let (u, v) = (u.wrapping_sub(self.left), v.wrapping_sub(self.top));
        if u < self.width && v < self.height {
            self.depth[v * self.width + u]
        } else {
            f32::INFINITY
        }
    }

    /// Bounds of the depths in some pixels of the image.
    pub fn extremes(&self, pixels: Pixels) -> (f32, f32) {
        let Some(inside) = self.inside(pixels) else {
            return (f32::INFINITY, f32::INFINITY);
        };
        let whole = inside.right - inside.left == pixels.right - pixels.left
            && inside.bottom - inside.top == pixels.bottom - pixels.top;
        let (mut nearest, mut farthest) = (f32::INFINITY, if whole { 0.0 } else { f32::INFINITY });
        for row in inside.top / TILE..=inside.bottom / TILE {
            let columns = inside.left / TILE..=inside.right / TILE;
            for (near, far) in &self.tiles[row * self.tiles_across..][columns] {
                (nearest, farthest) = (near.min(nearest), far.max(farthest));
            }
        }
        (nearest, farthest)
    }

    /// The part of some pixels that lies in the window, from its corner.
    #[inline(always)]
    fn inside(&self, pixels: Pixels) -> Option<Pixels> {
        let meets = pixels.right >= self.left
            && pixels.bottom >= self.top
            && pixels.left < self.left + self.width
            && pixels.top < self.top + self.height;
        meets.then(|| Pixels {
            left: pixels.left.max(self.left) - self.left,
            top: pixels.top.max(self.top) - self.top,
            right: (pixels.right - self.left).min(self.width - 1),
            bottom: (pixels.bottom - self.top).min(self.height - 1),
        })
    }
}
