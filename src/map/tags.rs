//! Which instances' predictions name which voxels.

use std::collections::BTreeMap;

use super::layout::{Address, Bits, VOXELS, WORDS};

/// Names an instance whose prediction tags voxels; the session hands these out.
pub type Tag = u32;

/// The voxels of every tag, as bits of bricks in ascending order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tags(BTreeMap<Tag, Vec<(usize, Bits)>>);

impl Tags {
    /// Gives a tag its voxels; the bricks that hold them, and where.
    pub fn set(&mut self, tag: Tag, mut voxels: Vec<Address>) -> &[(usize, Bits)] {
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
        let held = self.0.entry(tag).or_default();
        *held = bricks;
        held
    }

    /// Drops a tag; the bricks that held its voxels.
    pub fn drop(&mut self, tag: Tag) -> Vec<usize> {
        let bricks = self.0.remove(&tag).unwrap_or_default();
        bricks.into_iter().map(|b| b.0).collect()
    }

    /// Voxels of a brick with any tag.
    pub fn of_brick(&self, brick: usize) -> Bits {
        let of_tags = self.0.values().filter_map(|bricks| bits_in(bricks, brick));
        of_tags.fold([0; WORDS], |all, bits| std::array::from_fn(|w| all[w] | bits[w]))
    }

    /// The tags of a voxel, ascending.
    pub fn of_voxel(&self, at: Address) -> Vec<Tag> {
        let has = |bricks: &[(usize, Bits)]| bits_in(bricks, at.brick()).is_some_and(|b| b[at.word()] & at.bit() != 0);
        self.0
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
