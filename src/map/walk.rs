//! Exact traversal of the voxels on a segment (Amanatides and Woo 1987).
//!
//! Times of crossing are fixed-point integers, so a step costs a compare and an
//! add. The last voxel is known from the outset: a walk ends there whatever
//! rounding does, and never leaves the grid.

/// One in fixed point; twice the segment still fits a `u64`.
const ONE: f64 = (1_u64 << 62) as f64;

/// A place on the way from one voxel to another.
#[derive(Clone, Copy)]
pub(super) struct Walk {
    /// Where the walk stands.
    pub cell: [usize; 3],
    /// Where it ends.
    pub end: [usize; 3],
    step: [usize; 3],
    /// When the next border along each axis is crossed; `MAX` where none is.
    next: [u64; 3],
    period: [u64; 3],
}

impl Walk {
    /// The walk along the part of the segment that lies in the grid; both ends
    /// in units of voxels. `None` where no part does or an end is not finite.
    #[inline]
    pub fn clipped(size: [u32; 3], from: [f64; 3], to: [f64; 3]) -> Option<Self> {
        let along = each(|k| to[k] - from[k]);
        let (enter, leave) = clip(size, from, along)?;
        let cell_at = |t: f64| each(|k| inside(from[k] + t * along[k], size[k]));
        let end = if leave == 1.0 {
            each(|k| inside(to[k], size[k]))
        } else {
            cell_at(leave)
        };
        Some(Self::between(cell_at(enter), end, from, along))
    }

    #[inline(always)]
    fn between(cell: [usize; 3], end: [usize; 3], from: [f64; 3], along: [f64; 3]) -> Self {
        let (mut step, mut next, mut period) = ([0; 3], [u64::MAX; 3], [0; 3]);
        for k in 0..3 {
            if cell[k] == end[k] {
                continue;
            }
            let up = end[k] > cell[k];
            let border = if up { cell[k] + 1 } else { cell[k] };
            step[k] = if up { 1 } else { usize::MAX };
            next[k] = ((border as f64 - from[k]) / along[k] * ONE) as u64;
            period[k] = (ONE / along[k].abs()) as u64;
        }
        Self {
            cell,
            end,
            step,
            next,
            period,
        }
    }

    /// Goes to the next voxel; `false` where the walk has ended.
    #[inline(always)]
    pub fn advance(&mut self) -> bool {
        let [x, y, z] = self.next;
        if x <= y && x <= z {
            x != u64::MAX && self.cross::<0>()
        } else if y <= z {
            self.cross::<1>()
        } else {
            self.cross::<2>()
        }
    }

    #[inline(always)]
    fn cross<const K: usize>(&mut self) -> bool {
        self.cell[K] = self.cell[K].wrapping_add(self.step[K]);
        let later = self.next[K].wrapping_add(self.period[K]);
        self.next[K] = if self.cell[K] == self.end[K] { u64::MAX } else { later };
        true
    }
}

/// The part of the segment inside the box from 0 to `size`, as parameters.
#[inline]
fn clip(size: [u32; 3], from: [f64; 3], along: [f64; 3]) -> Option<(f64, f64)> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for k in 0..3 {
        let high = f64::from(size[k]);
        if along[k] == 0.0 {
            if !(0.0 <= from[k] && from[k] < high) {
                return None;
            }
            continue;
        }
        let (a, b) = (-from[k] / along[k], (high - from[k]) / along[k]);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    let finite = along[0].is_finite() && along[1].is_finite() && along[2].is_finite();
    (finite && enter < leave).then_some((enter, leave))
}

/// The cell of a coordinate, brought into the grid first: then it is not
/// negative and truncation is the floor.
#[inline(always)]
fn inside(coordinate: f64, size: u32) -> usize {
    coordinate.max(0.0).min(f64::from(size - 1)) as u32 as usize
}

/// One value an axis; unlike `array::map` it always becomes straight code.
#[inline(always)]
pub(super) fn each<T>(value: impl Fn(usize) -> T) -> [T; 3] {
    [value(0), value(1), value(2)]
}
