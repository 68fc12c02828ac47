//! Which bricks of a space exist: four bytes each, whatever they hold.

use std::sync::atomic::{AtomicU32, Ordering};

use super::log_odds::UNKNOWN;

/// Entries of a slot and of a tile start with 0 and 1; of a mark, with 01.
const TILE: u32 = 1 << 31;
const MARK: u32 = 1 << 30;

/// What the table says of a brick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// All voxels have this value.
    Tile(u8),
    /// It is kept in this slot.
    Slot(usize),
    /// The frame being inserted changes it, as this mark says.
    Mark(usize),
}

impl Entry {
    /// As stored.
    pub fn code(self) -> u32 {
        match self {
            Self::Tile(value) => TILE | u32::from(value),
            Self::Slot(slot) => slot as u32,
            Self::Mark(mark) => MARK | mark as u32,
        }
    }

    /// From what was stored.
    #[inline(always)]
    pub fn of(code: u32) -> Self {
        if code & MARK != 0 {
            Self::Mark((code & !MARK) as usize)
        } else if code & TILE != 0 {
            Self::Tile(code as u8)
        } else {
            Self::Slot(code as usize)
        }
    }
}

/// An entry a brick. Changed while shared only by whoever holds the lock of the
/// frame's marks.
#[derive(Debug)]
pub(super) struct Table(Vec<AtomicU32>);

impl Table {
    /// So many unknown bricks.
    pub fn new(len: usize) -> Self {
        let unknown = Entry::Tile(UNKNOWN).code();
        Self((0..len).map(|_| AtomicU32::new(unknown)).collect())
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The entry of a brick; unknown for one that there is not.
    #[inline(always)]
    pub fn get(&self, brick: usize) -> Entry {
        let code = self.0.get(brick).map(|entry| entry.load(Ordering::Acquire));
        code.map_or(Entry::Tile(UNKNOWN), Entry::of)
    }

    /// Sets the entry of a brick.
    pub fn set(&self, brick: usize, entry: Entry) {
        if let Some(place) = self.0.get(brick) {
            place.store(entry.code(), Ordering::Release);
        }
    }
}

impl Clone for Table {
    fn clone(&self) -> Self {
        let copy = |entry: &AtomicU32| AtomicU32::new(entry.load(Ordering::Acquire));
        Self(self.0.iter().map(copy).collect())
    }
}
