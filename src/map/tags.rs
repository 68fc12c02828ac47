//! Which instances' predictions name which voxels.

use std::collections::BTreeMap;

use super::layout::{Address, Bits, VOXELS, WORDS};

/// Names an instance whose prediction tags voxels; the session hands these out.
pub type Tag = u32;

/// The voxels of every tag, as bits of bricks in ascending order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tags {
    of: BTreeMap<Tag, Vec<(usize, Bits)>>,
    /// Voxels with any tag.
    all: BTreeMap<usize, Bits>,
}

impl Tags {
    /// Gives a tag its voxels instead of those that it had.
    pub fn set(&mut self, tag: Tag, mut voxels: Vec<Address>) {
        self.drop(tag);
        voxels.sort_unstable();
        let mut bricks: Vec<(usize, Bits)> = Vec::with_capacity(voxels.len() / VOXELS + 1);
        for at in voxels {
            if bricks.last().is_none_or(|b| b.0 != at.brick()) {
                bricks.push((at.brick(), [0; WORDS]));
            }
            if let Some((_, bits)) = bricks.last_mut() {
                bits[at.word()] |= at.bit();
            }
        }
        for (brick, bits) in &bricks {
            or_into(self.all.entry(*brick).or_default(), bits);
        }
        self.of.insert(tag, bricks);
    }

    /// Drops a tag.
    pub fn drop(&mut self, tag: Tag) {
        for (brick, _) in self.of.remove(&tag).unwrap_or_default() {
            let mut all = [0; WORDS];
            let others = self.of.values().filter_map(|bricks| bits_in(bricks, brick));
            others.for_each(|bits| or_into(&mut all, bits));
            if all == [0; WORDS] {
                self.all.remove(&brick);
            } else {
                self.all.insert(brick, all);
            }
        }
    }

    /// Voxels of a brick with any tag.
    pub fn of_brick(&self, brick: usize) -> Bits {
        self.all.get(&brick).copied().unwrap_or_default()
    }

    /// Bricks with a tagged voxel and those voxels, ascending.
    pub fn bricks(&self) -> impl Iterator<Item = (usize, &Bits)> {
        self.all.iter().map(|(&brick, bits)| (brick, bits))
    }

    /// Whether a voxel has any tag.
    pub fn has(&self, at: Address) -> bool {
        self.of_brick(at.brick())[at.word()] & at.bit() != 0
    }

    /// The tags of a voxel, ascending.
    pub fn of_voxel(&self, at: Address) -> Vec<Tag> {
        let has = |bricks: &[(usize, Bits)]| bits_in(bricks, at.brick()).is_some_and(|b| b[at.word()] & at.bit() != 0);
        self.of
            .iter()
            .filter(|(_, bricks)| has(bricks))
            .map(|(&tag, _)| tag)
            .collect()
    }
}

fn bits_in(bricks: &[(usize, Bits)], brick: usize) -> Option<&Bits> {
    let found = bricks.binary_search_by_key(&brick, |b| b.0);
    found.ok().map(|i| &bricks[i].1)
}

fn or_into(bits: &mut Bits, more: &Bits) {
    for (word, add) in bits.iter_mut().zip(more) {
        *word |= add;
    }
}
