//! What one frame does to the map: the voxels that rays hit and those that they
//! missed, as bits, in the bricks that they met.
//!
//! Marks are OR-ed, so they depend neither on the order of rays nor on threads,
//! and a voxel that thousands of rays meet changes once. There is no set of
//! keys: while a frame is marked, a brick's entry of the map's table leads to
//! its mark, which remembers the entry. Every thread has misses of its own and
//! so needs no locked instruction for them; they are joined when applied.

use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, OnceLock, PoisonError};

use super::layout::{Address, Bits, WORDS};
use super::table::{Entry, Table};

/// Marks that are made, and dropped, together.
const CHUNK: usize = 256;

/// Voxels of a brick that are marked, as one thread knows.
pub(super) type Words = [AtomicU64; WORDS];

/// Items by number, made by the chunk when first asked for.
type Chunks<T> = Vec<OnceLock<Box<[T]>>>;

/// Which brick a mark is of, and what the table said of it.
#[derive(Debug, Default)]
struct Origin {
    brick: AtomicU32,
    before: AtomicU32,
}

/// The marks of one frame.
pub(super) struct Marks {
    made: Mutex<usize>,
    origins: Chunks<Origin>,
    hits: Chunks<Words>,
    /// One a thread.
    misses: Vec<Chunks<Words>>,
}

/// A brick, what the table said of it, and the voxels hit and missed.
pub(super) struct Marked {
    pub brick: usize,
    pub before: Entry,
    pub hits: Bits,
    pub misses: Bits,
}

impl Marks {
    /// No marks yet, of at most `bricks` bricks, by the threads of this pool.
    pub fn new(bricks: usize) -> Self {
        let chunks = bricks.div_ceil(CHUNK);
        Self {
            made: Mutex::new(0),
            origins: none(chunks),
            hits: none(chunks),
            misses: (0..rayon::current_num_threads()).map(|_| none(chunks)).collect(),
        }
    }

    /// Number of bricks that were met.
    pub fn len(&self) -> usize {
        *self.made.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Marks a voxel as hit.
    #[inline(always)]
    pub fn hit(&self, table: &Table, at: Address) {
        let hits = self.number(table, at.brick()).and_then(|mark| item(&self.hits, mark));
        if let Some(word) = hits.map(|words| &words[at.word()])
            && word.load(Relaxed) & at.bit() == 0
        {
            word.fetch_or(at.bit(), Relaxed);
        }
    }

    /// The misses of a brick that this thread may mark; `None` for a brick that
    /// the table has not.
    #[inline(always)]
    pub fn misses(&self, table: &Table, brick: usize) -> Option<&Words> {
        let mark = self.number(table, brick)?;
        item(self.misses.get(rayon::current_thread_index().unwrap_or(0))?, mark)
    }

    #[inline(always)]
    fn number(&self, table: &Table, brick: usize) -> Option<usize> {
        match table.get(brick) {
            Entry::Mark(mark) => Some(mark),
            _ => self.make(table, brick),
        }
    }

    #[cold]
    #[inline(never)]
    fn make(&self, table: &Table, brick: usize) -> Option<usize> {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let before = table.get(brick);
        if let Entry::Mark(mark) = before {
            return Some(mark);
        }
        let origin = item(&self.origins, *made)?;
        origin.brick.store(brick as u32, Relaxed);
        origin.before.store(before.code(), Relaxed);
        table.set(brick, Entry::Mark(*made));
        *made += 1;
        Some(*made - 1)
    }

    /// The brick of a mark and its hits; `None` where no brick of its chunk has any.
    pub fn hits(&self, mark: usize) -> Option<(usize, Bits)> {
        let hits = bits(self.hits.get(mark / CHUNK)?.get()?.get(mark % CHUNK)?);
        let brick = item(&self.origins, mark)?.brick.load(Relaxed);
        Some((brick as usize, hits))
    }

    /// All marks in the order of their making, a chunk at a time, whose memory
    /// is then free.
    pub fn into_chunks(mut self) -> impl Iterator<Item = Vec<Marked>> {
        let made = self.len();
        (0..made.div_ceil(CHUNK)).map(move |i| {
            let origins = self.origins[i].take().unwrap_or_default();
            let hits = self.hits[i].take();
            let misses: Vec<_> = self.misses.iter_mut().filter_map(|of| of[i].take()).collect();
            let here = origins.iter().enumerate().take(made - i * CHUNK);
            here.map(|(k, origin)| Marked {
                brick: origin.brick.load(Relaxed) as usize,
                before: Entry::of(origin.before.load(Relaxed)),
                hits: hits.as_ref().map_or([0; WORDS], |hits| bits(&hits[k])),
                misses: joined(misses.iter().map(|misses| &misses[k])),
            })
            .collect()
        })
    }
}

/// Marks a voxel of a brick, by its place there, as this thread's.
#[inline(always)]
pub(super) fn mark(words: &Words, local: u32) {
    let word = &words[(local >> 6 & 7) as usize];
    word.store(word.load(Relaxed) | 1 << (local & 63), Relaxed);
}

/// Marks voxels of a brick, as this thread's.
pub(super) fn mark_all(words: &Words, bits: &Bits) {
    for (word, bits) in words.iter().zip(bits) {
        word.store(word.load(Relaxed) | bits, Relaxed);
    }
}

fn none<T>(chunks: usize) -> Chunks<T> {
    (0..chunks).map(|_| OnceLock::new()).collect()
}

#[inline(always)]
fn item<T: Default>(chunks: &Chunks<T>, number: usize) -> Option<&T> {
    let chunk = chunks.get(number / CHUNK)?;
    let chunk = chunk.get_or_init(|| (0..CHUNK).map(|_| T::default()).collect());
    chunk.get(number % CHUNK)
}

fn bits(words: &Words) -> Bits {
    std::array::from_fn(|w| words[w].load(Relaxed))
}

fn joined<'a>(parts: impl Iterator<Item = &'a Words>) -> Bits {
    parts.fold([0; WORDS], |all, part| {
        std::array::from_fn(|w| all[w] | part[w].load(Relaxed))
    })
}
