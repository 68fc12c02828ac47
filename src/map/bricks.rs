//! The bricks of a space, made when something first happens in them.

use rayon::prelude::*;

use super::brick::Brick;
use super::layout::{Address, Bits};

/// No brick yet.
const NONE: u32 = u32::MAX;

/// A table of all bricks of a layout, of which few may exist.
#[derive(Clone, Debug)]
pub(super) struct Bricks {
    slots: Vec<u32>,
    made: Vec<Brick>,
}

impl Bricks {
    /// Room for `len` bricks, none made.
    pub fn new(len: usize) -> Self {
        Self {
            slots: vec![NONE; len],
            made: Vec::new(),
        }
    }

    /// Number of bricks, made or not.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// A brick by its index; `None` where it was not made.
    #[inline(always)]
    pub fn get(&self, index: usize) -> Option<&Brick> {
        self.made.get(self.slots[index] as usize)
    }

    /// A brick by its index, made where it was not.
    pub fn make(&mut self, index: usize) -> &mut Brick {
        if self.slots[index] == NONE {
            self.slots[index] = self.made.len() as u32;
            self.made.push(Brick::unknown(index));
        }
        &mut self.made[self.slots[index] as usize]
    }

    /// Makes all bricks that `wanted` names, with no slack in memory.
    pub fn make_all(&mut self, wanted: impl Fn(usize) -> bool) {
        let missing: Vec<_> = (0..self.len())
            .filter(|&i| self.slots[i] == NONE && wanted(i))
            .collect();
        self.made.reserve_exact(missing.len());
        for index in missing {
            self.make(index);
        }
    }

    /// The bricks that exist, in the order of their making.
    pub fn iter(&self) -> impl Iterator<Item = &Brick> {
        self.made.iter()
    }

    /// The same, on all threads.
    pub fn par_iter_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut Brick> {
        self.made.par_iter_mut()
    }

    fn contents(&self, index: usize) -> Option<&Brick> {
        self.get(index).filter(|&b| *b != Brick::unknown(index))
    }

    /// Whether one of a brick's bits is set at an address.
    #[inline(always)]
    pub fn test(&self, address: Address, bits: impl Fn(&Brick) -> &Bits) -> bool {
        self.get(address.brick())
            .is_some_and(|b| bits(b)[address.word()] & address.bit() != 0)
    }
}

impl PartialEq for Bricks {
    /// Equal contents; neither the order of making matters nor blank bricks.
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && (0..self.len()).all(|i| self.contents(i) == other.contents(i))
    }
}
