//! The bricks of a space: a value for those of one value, a byte a voxel for
//! the others.

use rayon::prelude::*;

use super::brick::{Brick, is_known};
use super::layout::{Address, Bits, Layout, VOXELS, WORDS};
use super::log_odds::{LogOdds, UNKNOWN};
use super::marks::{Marked, Marks};
use super::table::{Entry, Table};

/// Chunks of marks that are applied together, a thread.
const BATCH: usize = 2;

/// All bricks of a layout.
#[derive(Clone, Debug)]
pub(super) struct Bricks {
    table: Table,
    slots: Vec<Option<Box<Brick>>>,
    /// Slots that hold nothing.
    vacant: Vec<usize>,
}

/// Measured and occupied voxels of a brick that has any.
pub(super) struct States {
    /// Which brick of the layout it is.
    pub index: usize,
    /// Measured voxels.
    pub known: Bits,
    /// Measured voxels at or above the occupancy threshold.
    pub occupied: Bits,
}

impl Bricks {
    /// Room for `len` bricks, all unknown.
    pub fn new(len: usize) -> Self {
        Self {
            table: Table::new(len),
            slots: Vec::new(),
            vacant: Vec::new(),
        }
    }

    /// Number of bricks, of whatever kind.
    pub fn len(&self) -> usize {
        self.table.len()
    }

    /// What leads to every brick, for marking a frame.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Value of a voxel.
    #[inline(always)]
    pub fn value(&self, at: Address) -> u8 {
        match self.table.get(at.brick()) {
            Entry::Tile(value) => value,
            _ => self.get(at.brick()).map_or(UNKNOWN, |brick| brick.value(at)),
        }
    }

    /// A brick by its index; `None` where its voxels have one value.
    #[inline(always)]
    pub fn get(&self, index: usize) -> Option<&Brick> {
        match self.table.get(index) {
            Entry::Slot(slot) => self.slots.get(slot)?.as_deref(),
            _ => None,
        }
    }

    /// The same, to keep readings in.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut Brick> {
        match self.table.get(index) {
            Entry::Slot(slot) => self.slots.get_mut(slot)?.as_deref_mut(),
            _ => None,
        }
    }

    /// The bricks whose voxels have more than one value, in no order that means anything.
    pub fn iter(&self) -> impl Iterator<Item = &Brick> {
        self.slots.iter().flatten().map(|brick| &**brick)
    }

    /// The states of every brick that was measured, ascending.
    pub fn states(&self, model: &LogOdds) -> impl Iterator<Item = States> {
        (0..self.len()).filter_map(|index| self.states_of(index, model))
    }

    /// The states of a brick; `None` where nothing was measured.
    pub fn states_of(&self, index: usize, model: &LogOdds) -> Option<States> {
        let all = |yes: bool| [if yes { u64::MAX } else { 0 }; WORDS];
        let (known, occupied) = match (self.table.get(index), self.get(index)) {
            (Entry::Tile(value), _) if is_known(value) => (all(true), all(model.is_occupied(value))),
            (_, Some(brick)) => (brick.at_least(UNKNOWN + 1), brick.at_least(model.occupied_from())),
            _ => return None,
        };
        Some(States { index, known, occupied })
    }

    /// Ends a frame: every voxel that was marked changes once.
    pub fn apply(&mut self, marks: Marks, layout: &Layout, model: &LogOdds) {
        let mut chunks = marks.into_chunks();
        let (mut batch, most) = (Vec::new(), BATCH * rayon::current_num_threads());
        loop {
            for chunk in chunks.by_ref().take(most) {
                batch.reserve(chunk.len());
                batch.extend(chunk.into_iter().map(|marked| self.take(marked)));
            }
            if batch.is_empty() {
                return;
            }
            let parts = batch.par_iter_mut().with_min_len(64);
            parts.for_each(|due| due.apply(layout, model));
            batch.drain(..).for_each(|due| self.put(due));
        }
    }

    fn take(&mut self, marked: Marked) -> Due {
        let brick = match marked.before {
            Entry::Slot(slot) => self.slots.get_mut(slot).and_then(Option::take),
            _ => None,
        };
        Due {
            entry: marked.before,
            marked,
            brick,
        }
    }

    fn put(&mut self, due: Due) {
        let entry = match (due.entry, due.brick) {
            (Entry::Slot(slot), Some(brick)) => {
                self.slots[slot] = Some(brick);
                Entry::Slot(slot)
            }
            (_, Some(brick)) => Entry::Slot(self.fill_vacant(brick)),
            (entry, None) => {
                if let Entry::Slot(slot) = due.marked.before {
                    self.vacant.push(slot);
                }
                entry
            }
        };
        self.table.set(due.marked.brick, entry);
    }

    fn fill_vacant(&mut self, brick: Box<Brick>) -> usize {
        if let Some(slot) = self.vacant.pop() {
            self.slots[slot] = Some(brick);
            return slot;
        }
        self.slots.push(Some(brick));
        self.slots.len() - 1
    }

    /// Number of bricks that take a byte a voxel, and the bytes that all take.
    pub fn memory(&self) -> (usize, usize) {
        let bricks = self.iter().count();
        let each = size_of::<Brick>();
        let surfaces = self.iter().filter_map(|b| b.surface.as_deref()).map(|s| s.bytes());
        let slots = (self.slots.capacity() + self.vacant.capacity()) * size_of::<usize>();
        let bytes = self.table.len() * size_of::<u32>() + slots + bricks * each;
        (bricks, bytes + surfaces.sum::<usize>())
    }

    /// All that is known of a brick.
    fn contents(&self, index: usize) -> ([u8; VOXELS], Option<&super::surface::Surface>) {
        let values = |brick: &Brick| *brick.values();
        match self.table.get(index) {
            Entry::Tile(value) => ([value; VOXELS], None),
            _ => {
                let brick = self.get(index);
                (
                    brick.map_or([UNKNOWN; VOXELS], values),
                    brick.and_then(|b| b.surface.as_deref()),
                )
            }
        }
    }
}

impl PartialEq for Bricks {
    /// Equal contents; neither the order of making matters nor how they are kept.
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && (0..self.len()).all(|i| self.contents(i) == other.contents(i))
    }
}

/// A brick that a frame changes, taken out of its slot.
struct Due {
    marked: Marked,
    entry: Entry,
    brick: Option<Box<Brick>>,
}

impl Due {
    fn apply(&mut self, layout: &Layout, model: &LogOdds) {
        let Marked {
            brick: index,
            hits,
            misses,
            ..
        } = &mut self.marked;
        let inside = layout.inside(*index);
        (0..WORDS).for_each(|w| misses[w] &= inside[w]);
        let (no_hits, all_missed) = (*hits == [0; WORDS], *misses == [u64::MAX; WORDS]);
        if let Entry::Tile(value) = self.entry {
            match (no_hits, all_missed) {
                (true, true) => self.entry = Entry::Tile(model.missed(value)),
                (true, false) if *misses == [0; WORDS] => {}
                _ => self.brick = Some(Box::new(Brick::filled(*index, value))),
            }
        }
        let Some(brick) = &mut self.brick else { return };
        brick.apply(hits, misses, model);
        if let (true, true, Some(value)) = (no_hits, all_missed, brick.uniform()) {
            (self.entry, self.brick) = (Entry::Tile(value), None);
        }
    }
}
