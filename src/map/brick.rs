//! A brick of 8³ voxels: a byte of log-odds each, and what was seen of surfaces.

use super::layout::{Address, Bits, VOXELS, WORDS};
use super::log_odds::{LogOdds, UNKNOWN};
use super::surface::Surface;

/// 8³ voxels.
#[derive(Clone, Debug)]
pub(super) struct Brick {
    /// Which brick of the layout it is.
    pub index: usize,
    /// Log-odds as [`LogOdds`] keeps them, [`UNKNOWN`] where never measured.
    values: [u8; VOXELS],
    /// Present once a reading ended in the brick and is kept.
    pub surface: Option<Box<Surface>>,
}

impl Brick {
    /// A brick whose voxels have one value.
    pub fn filled(index: usize, value: u8) -> Self {
        Self {
            index,
            values: [value; VOXELS],
            surface: None,
        }
    }

    /// Value of a voxel.
    #[inline(always)]
    pub fn value(&self, address: Address) -> u8 {
        self.values[address.local()]
    }

    /// All values.
    pub fn values(&self) -> &[u8; VOXELS] {
        &self.values
    }

    /// The value of all voxels, where they have one and nothing else is kept.
    pub fn uniform(&self) -> Option<u8> {
        let first = self.values[0];
        let corners = [7, VOXELS / 2, VOXELS - 1].iter().all(|&i| self.values[i] == first);
        let all = corners && self.surface.is_none() && self.values.iter().all(|&v| v == first);
        all.then_some(first)
    }

    /// Voxels of at least a value.
    pub fn at_least(&self, value: u8) -> Bits {
        let (words, _) = self.values.as_chunks::<64>();
        std::array::from_fn(|w| words.get(w).map_or(0, |word| at_least(word, value)))
    }

    /// Ends a frame: hit voxels become likelier, missed ones that were not hit
    /// less likely, each once.
    pub fn apply(&mut self, hits: &Bits, misses: &Bits, model: &LogOdds) {
        let (words, _) = self.values.as_chunks_mut::<64>();
        for (word, values) in words.iter_mut().enumerate().take(WORDS) {
            match (hits[word], misses[word] & !hits[word]) {
                (0, 0) => {}
                (0, u64::MAX) => values.iter_mut().for_each(|v| *v = model.missed(*v)),
                (hit, miss) => change(values, &spread(hit), &spread(miss), model),
            }
        }
    }
}

/// Moves the values whose byte of `hit` or `miss` is set.
fn change(values: &mut [u8; 64], hit: &[u8; 64], miss: &[u8; 64], model: &LogOdds) {
    for i in 0..64 {
        let moved = model.moved(values[i], hit[i], miss[i]);
        let marked = hit[i] | miss[i];
        values[i] = (moved & marked) | (values[i] & !marked);
    }
}

fn at_least(values: &[u8; 64], value: u8) -> u64 {
    let mut flags = [0_u8; 64];
    for i in 0..64 {
        flags[i] = u8::from(values[i] >= value);
    }
    let (eights, _) = flags.as_chunks::<8>();
    let gathered = eights.iter().map(|flags| {
        // Moves bit 0 of byte i to bit 56 + i; no two summands meet.
        u64::from_le_bytes(*flags).wrapping_mul(0x0102_0408_1020_4080) >> 56
    });
    gathered.enumerate().fold(0, |bits, (i, byte)| bits | byte << (8 * i))
}

/// A byte a bit, all ones where it is set.
#[inline(always)]
fn spread(word: u64) -> [u8; 64] {
    let mut bytes = [0; 64];
    let (eights, _) = bytes.as_chunks_mut::<8>();
    for (eight, bits) in eights.iter_mut().zip(word.to_le_bytes()) {
        *eight = SPREAD[usize::from(bits)];
    }
    bytes
}

/// What [`spread`] makes of every byte.
static SPREAD: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut bits = 0;
    while bits < 256 {
        let mut i = 0;
        while i < 8 {
            table[bits][i] = if bits >> i & 1 == 1 { 0xff } else { 0 };
            i += 1;
        }
        bits += 1;
    }
    table
};

/// Whether a value was measured.
#[inline(always)]
pub(super) fn is_known(value: u8) -> bool {
    value != UNKNOWN
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::{BYTES_PER_VOXEL, SensorModel};

    #[test]
    fn a_voxel_takes_the_memory_that_is_stated() {
        let table = size_of::<u32>() + size_of::<Box<Brick>>();
        let bytes = (size_of::<Brick>() + table) as f64 / VOXELS as f64;
        assert!((bytes - BYTES_PER_VOXEL).abs() < 0.15, "{bytes} bytes");
    }

    /// Every pair of marks on every value, against the same one by one.
    #[test]
    fn a_word_changes_as_its_voxels_do() {
        let model = LogOdds::quantised(&SensorModel::default());
        let marks = [
            (0x00ff_3c5a_0000_ffff, 0xffff_0000_dead_beef),
            (0, 1 << 63),
            (u64::MAX, 0),
            (0, u64::MAX),
        ];
        for (hit, miss) in marks {
            for start in 0..=255_u8 {
                let mut brick = Brick::filled(0, 0);
                (0..VOXELS).for_each(|i| brick.values[i] = start.wrapping_add(i as u8));
                let before = brick.values;
                brick.apply(&[hit; WORDS], &[miss; WORDS], &model);
                for (i, &was) in before.iter().enumerate() {
                    let (hit, miss) = (hit >> (i % 64) & 1 == 1, miss >> (i % 64) & 1 == 1);
                    let expected = match (hit, miss) {
                        (true, _) => model.moved(was, 0xff, 0),
                        (false, true) => model.missed(was),
                        (false, false) => was,
                    };
                    assert_eq!(brick.values[i], expected);
                }
                let at_least = brick.at_least(100);
                assert!((0..VOXELS).all(|i| (at_least[i / 64] >> (i % 64) & 1 == 1) == (brick.values[i] >= 100)));
            }
        }
    }
}
