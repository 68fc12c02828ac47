//! A brick of 8³ voxels: log-odds, state bits, and what was seen of surfaces.

use super::frame::Reading;
use super::layout::{Address, Bits, VOXELS, WORDS};
use super::log_odds::LogOdds;
use super::points::Points;

/// 8³ voxels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Brick {
    /// Which brick of the layout it is.
    pub index: usize,
    /// Measured voxels.
    pub known: Bits,
    /// Measured voxels at or above the occupancy threshold.
    pub occupied: Bits,
    /// Voxels with a tag, whatever their state.
    pub tagged: Bits,
    log_odds: [i8; VOXELS],
    /// Present once a reading ended in the brick.
    pub surface: Option<Box<Surface>>,
}

/// What readings that ended in a brick left there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surface {
    /// Voxels hit by the frame that is being inserted.
    hits: Bits,
    /// What was measured there.
    pub points: Points,
    /// Faces turned away from an eye that hit the voxel: bits −x +x −y +y −z +z.
    pub far: [u8; VOXELS],
}

impl Brick {
    /// An unknown brick.
    pub fn unknown(index: usize) -> Self {
        Self {
            index,
            known: [0; WORDS],
            occupied: [0; WORDS],
            tagged: [0; WORDS],
            log_odds: [0; VOXELS],
            surface: None,
        }
    }

    /// Log-odds of a voxel; `None` where it was never measured.
    pub fn log_odds(&self, address: Address) -> Option<i8> {
        (self.known[address.word()] & address.bit() != 0).then(|| self.log_odds[address.local()])
    }

    /// Notes a reading that ends in a voxel of the brick.
    pub fn hit(&mut self, reading: &Reading, far: u8) {
        let address = reading.address;
        let surface = self.surface.get_or_insert_default();
        surface.hits[address.word()] |= address.bit();
        surface.far[address.local()] |= far;
        surface.points.keep(address, reading.octant, reading.point);
    }

    /// Ends a frame: hit voxels become likelier, missed ones that were not hit
    /// less likely, each once.
    pub fn apply(&mut self, misses: Bits, model: &LogOdds) {
        let hits = self
            .surface
            .as_mut()
            .map_or([0; WORDS], |s| std::mem::take(&mut s.hits));
        for word in 0..WORDS {
            let (hit, miss) = (hits[word], misses[word] & !hits[word]);
            if hit | miss != 0 {
                self.apply_word(word, hit, miss, model);
            }
        }
    }

    fn apply_word(&mut self, word: usize, hit: u64, miss: u64, model: &LogOdds) {
        let values = &mut self.log_odds[word * 64..][..64];
        if miss == u64::MAX {
            add(values, |_| model.miss, model);
        } else {
            let change = |i: usize| model.hit * bit(hit, i) + model.miss * bit(miss, i);
            add(values, change, model);
        }
        self.known[word] |= hit | miss;
        if hit | self.occupied[word] != 0 || model.miss_can_occupy() {
            let above = values
                .iter()
                .enumerate()
                .map(|(i, &v)| u64::from(v >= model.occupied) << i);
            self.occupied[word] = above.fold(0, |bits, b| bits | b) & self.known[word];
        }
    }
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            hits: [0; WORDS],
            points: Points::default(),
            far: [0; VOXELS],
        }
    }
}

#[inline(always)]
fn bit(word: u64, i: usize) -> i8 {
    (word >> i & 1) as i8
}

#[inline(always)]
fn add(values: &mut [i8], change: impl Fn(usize) -> i8, model: &LogOdds) {
    for (i, value) in values.iter_mut().enumerate() {
        *value = value.saturating_add(change(i)).max(model.min).min(model.max);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::BYTES_PER_VOXEL;

    #[test]
    fn a_voxel_takes_the_memory_that_is_stated() {
        let table = size_of::<u64>();
        let bytes = (size_of::<Brick>() + table) as f64 / VOXELS as f64;
        assert!((bytes - BYTES_PER_VOXEL).abs() < 0.15, "{bytes} bytes");
    }
}
