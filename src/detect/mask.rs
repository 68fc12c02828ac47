//! Binary images of a face in its own plane: closing, components, contour.

/// A binary image; everything outside is empty.
#[derive(Clone)]
pub struct Mask {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    cells: Vec<bool>,
}

impl Mask {
    /// An empty mask.
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            cells: vec![false; width * height],
        }
    }

    /// Fills a cell.
    pub fn set(&mut self, x: usize, y: usize) {
        self.cells[y * self.width + x] = true;
    }

    /// Whether a cell is filled; `false` outside.
    pub fn at(&self, x: i64, y: i64) -> bool {
        let inside = x >= 0 && y >= 0 && (x as usize) < self.width && (y as usize) < self.height;
        inside && self.cells[y as usize * self.width + x as usize]
    }

    /// Morphological closing with a disc of `radius` cells.
    pub fn closed(&self, radius: f64) -> Self {
        let grown = self.within(radius, true);
        grown.within(radius, false)
    }

    /// Joins the parts that a disc of `radius` cells cannot pass between, and
    /// keeps what a closing of each part alone would not change.
    pub fn bridged(&self, radius: f64) -> Self {
        let parts = self.parts();
        if parts.len() < 2 {
            return self.clone();
        }
        let mut bridged = self.closed(radius);
        for part in &parts {
            let alone = part.closed(radius);
            for (cell, filled) in bridged.cells.iter_mut().enumerate() {
                *filled &= !alone.cells[cell] || self.cells[cell];
            }
        }
        bridged
    }

    /// The largest 4-connected part, its holes filled.
    pub fn largest(&self) -> Self {
        let most = |p: &Self| p.cells.iter().filter(|&&c| c).count();
        let mut best = Self::new(self.width, self.height);
        let mut size = 0;
        for part in self.parts() {
            let cells = most(&part);
            if cells > size {
                (best, size) = (part, cells);
            }
        }
        best.fill_holes();
        best
    }

    /// Corners of the outer boundary of a connected mask, counter-clockwise
    /// with y up: one a boundary cell side, in cell units.
    pub fn contour(&self) -> Vec<(f64, f64)> {
        let Some(first) = self.cells.iter().position(|&c| c) else {
            return Vec::new();
        };
        let start = ((first % self.width) as i64, (first / self.width) as i64);
        // Below the lowest row of the mask is nothing, so its first cell's
        // lower side is on the boundary; the mask stays to the left.
        let (mut at, mut step) = (start, (1_i64, 0_i64));
        let mut corners = Vec::new();
        loop {
            corners.push((at.0 as f64, at.1 as f64));
            at = (at.0 + step.0, at.1 + step.1);
            step = self.turn(at, step);
            if at == start || corners.len() > 4 * self.cells.len() {
                return corners;
            }
        }
    }

    /// The next step along the boundary from a cell corner.
    fn turn(&self, at: (i64, i64), step: (i64, i64)) -> (i64, i64) {
        let left_step = (-step.1, step.0);
        let cell = |forward: i64, left: i64| {
            let dx = step.0 * forward + left_step.0 * left;
            let dy = step.1 * forward + left_step.1 * left;
            self.at(at.0 + (dx - 1) / 2, at.1 + (dy - 1) / 2)
        };
        let (ahead_left, ahead_right) = (cell(1, 1), cell(1, -1));
        match (ahead_left, ahead_right) {
            (true, true) => (-left_step.0, -left_step.1),
            (true, false) => step,
            (false, _) => left_step,
        }
    }

    /// Cells within `radius` of a cell that equals `filled`.
    fn within(&self, radius: f64, filled: bool) -> Self {
        let reach = radius.floor() as i64;
        let spans: Vec<(i64, i64)> = (-reach..=reach)
            .map(|dy| (dy, (radius * radius - (dy * dy) as f64).max(0.0).sqrt() as i64))
            .collect();
        let mut result = vec![!filled; self.cells.len()];
        for y in 0..self.height as i64 {
            let mut x = 0;
            while x < self.width as i64 {
                if self.at(x, y) != filled {
                    x += 1;
                    continue;
                }
                let start = x;
                while x < self.width as i64 && self.at(x, y) == filled {
                    x += 1;
                }
                for &(dy, half) in &spans {
                    self.paint(&mut result, y + dy, start - half, x - 1 + half, filled);
                }
            }
        }
        Self {
            width: self.width,
            height: self.height,
            cells: result,
        }
    }

    fn paint(&self, cells: &mut [bool], y: i64, from: i64, to: i64, value: bool) {
        if y < 0 || y >= self.height as i64 {
            return;
        }
        let row = y as usize * self.width;
        let (from, to) = (from.max(0) as usize, to.min(self.width as i64 - 1) as usize);
        cells[row + from..=row + to].fill(value);
    }

    /// The 4-connected parts of more than a few cells.
    fn parts(&self) -> Vec<Self> {
        let mut open = self.cells.clone();
        let mut parts = Vec::new();
        for seed in 0..open.len() {
            if !open[seed] {
                continue;
            }
            let mut part = Self::new(self.width, self.height);
            let cells = flood(&mut open, self.width, seed);
            if cells.len() > 9 {
                cells.iter().for_each(|&c| part.cells[c] = true);
                parts.push(part);
            }
        }
        parts
    }

    fn fill_holes(&mut self) {
        let mut outside: Vec<bool> = self.cells.iter().map(|&c| !c).collect();
        let (w, h) = (self.width, self.height);
        let frame = (0..w)
            .flat_map(|x| [x, (h - 1) * w + x])
            .chain((0..h).flat_map(|y| [y * w, y * w + w - 1]));
        let mut reached = vec![false; self.cells.len()];
        for seed in frame {
            if outside[seed] {
                flood(&mut outside, w, seed).iter().for_each(|&c| reached[c] = true);
            }
        }
        self.cells = reached.iter().map(|&r| !r).collect();
    }
}

/// Takes the 4-connected cells about `seed` out of `open`.
fn flood(open: &mut [bool], width: usize, seed: usize) -> Vec<usize> {
    let (mut found, mut next) = (vec![seed], 0);
    open[seed] = false;
    while let Some(&cell) = found.get(next) {
        next += 1;
        let x = cell % width;
        let beside = [
            (x > 0).then(|| cell - 1),
            (x + 1 < width).then(|| cell + 1),
            cell.checked_sub(width),
            Some(cell + width).filter(|&c| c < open.len()),
        ];
        for other in beside.into_iter().flatten() {
            if std::mem::take(&mut open[other]) {
                found.push(other);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(mask: &mut Mask, x: std::ops::Range<usize>, y: std::ops::Range<usize>) {
        y.for_each(|v| x.clone().for_each(|u| mask.set(u, v)));
    }

    #[test]
    fn a_contour_runs_counter_clockwise_around_the_cells() {
        let mut mask = Mask::new(10, 10);
        rectangle(&mut mask, 2..7, 3..6);
        rectangle(&mut mask, 2..4, 6..8);
        let corners = mask.contour();
        assert_eq!(corners.len(), 2 * (5 + 5));
        let area: f64 = (0..corners.len())
            .map(|k| (corners[k], corners[(k + 1) % corners.len()]))
            .map(|(a, b)| (a.0 * b.1 - b.0 * a.1) / 2.0)
            .sum();
        assert!((area - 19.0).abs() < 1e-12);
    }

    #[test]
    fn a_groove_is_bridged_and_a_notch_is_kept() {
        let mut mask = Mask::new(60, 40);
        rectangle(&mut mask, 5..25, 5..35);
        rectangle(&mut mask, 30..55, 5..35);
        let mut with_notch = Mask::new(60, 40);
        rectangle(&mut with_notch, 5..55, 5..15);
        rectangle(&mut with_notch, 5..25, 15..35);
        rectangle(&mut with_notch, 30..55, 15..35);
        assert!(mask.bridged(6.0).at(27, 20) && mask.bridged(6.0).at(27, 6));
        assert!(!with_notch.bridged(6.0).at(27, 30));
    }
}
