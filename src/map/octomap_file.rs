//! Writes a map as an OctoMap `.bt` file: states only, pruned.
//!
//! Voxels keep their places exactly, since a grid's borders lie at multiples of
//! the voxel. The format is OctoMap's: a text header, then for every inner node
//! in pre-order 2 bits a child (01 free, 10 occupied, 11 inner, 00 unknown).

use std::io::{self, Write};

use super::layout::Layout;
use super::{Map, Occupancy};

/// Levels of OctoMap's tree below its root.
const DEPTH: u32 = 16;
/// The key of the voxel whose smallest corner is the origin of the world.
const ORIGIN_KEY: i64 = 1 << (DEPTH - 1);

/// Writes the free and occupied voxels of a map as an OctoMap binary tree.
///
/// # Errors
/// Writing fails, or the space reaches farther than 32,768 voxels from the
/// origin of the world (`InvalidInput`).
pub fn write_bt(map: &Map, out: &mut impl Write) -> io::Result<()> {
    let mut tree = Tree {
        map,
        first_key: first_key(map)?,
        bytes: Vec::new(),
    };
    let nodes = match tree.node(DEPTH, [0; 3]) {
        Node::Inner(nodes) => nodes,
        Node::Leaf(_) => 0,
    };
    writeln!(out, "# Octomap OcTree binary file")?;
    writeln!(out, "id OcTree\nsize {nodes}\nres {}\ndata", map.grid.voxel)?;
    out.write_all(&tree.bytes)
}

/// OctoMap's key of the first cell of the grid.
fn first_key(map: &Map) -> io::Result<[i64; 3]> {
    let key = [0, 1, 2].map(|k| (map.grid.origin[k] / map.grid.voxel).round() as i64 + ORIGIN_KEY);
    let last = 2 * ORIGIN_KEY;
    if (0..3).all(|k| key[k] >= 0 && key[k] + i64::from(map.grid.size[k]) <= last) {
        return Ok(key);
    }
    let reason = "the space reaches farther than 32768 voxels from the origin, which an OctoMap file cannot hold";
    Err(io::Error::new(io::ErrorKind::InvalidInput, reason))
}

struct Tree<'a> {
    map: &'a Map,
    first_key: [i64; 3],
    /// Inner nodes in pre-order.
    bytes: Vec<u8>,
}

/// A node, written where it is an inner one.
#[derive(Clone, Copy, PartialEq)]
enum Node {
    Leaf(Occupancy),
    /// With this many nodes from here down.
    Inner(u64),
}

impl Tree<'_> {
    /// Writes the node of 2^`height` voxels an edge whose first key is `key`.
    fn node(&mut self, height: u32, key: [i64; 3]) -> Node {
        let first = [0, 1, 2].map(|k| key[k] - self.first_key[k]);
        if height == 0 {
            let voxel = self.map.grid.at(first);
            return Node::Leaf(voxel.map_or(Occupancy::Unknown, |v| self.map.occupancy(v)));
        }
        if self.is_untouched(first, 1 << height) {
            return Node::Leaf(Occupancy::Unknown);
        }
        let at = self.bytes.len();
        self.bytes.extend([0; 2]);
        let half = 1 << (height - 1);
        let children: [Node; 8] = std::array::from_fn(|i| {
            let corner = [0, 1, 2].map(|k| key[k] + (i as i64 >> k & 1) * half);
            self.node(height - 1, corner)
        });
        self.close(at, &children)
    }

    /// Writes what the children are, or prunes them where they are one.
    fn close(&mut self, at: usize, children: &[Node; 8]) -> Node {
        if matches!(children[0], Node::Leaf(_)) && children.iter().all(|c| *c == children[0]) {
            self.bytes.truncate(at);
            return children[0];
        }
        let bits = |i: usize| code(children[i]) << (2 * i);
        let word = (0..8).fold(0_u16, |word, i| word | bits(i));
        self.bytes[at..at + 2].copy_from_slice(&word.to_le_bytes());
        Node::Inner(1 + children.iter().map(count).sum::<u64>())
    }

    /// Whether no brick exists in a cube of cells. Looks at bricks only where
    /// they are few.
    fn is_untouched(&self, first: [i64; 3], edge: i64) -> bool {
        let size = self.map.grid.size.map(i64::from);
        if (0..3).any(|k| first[k] >= size[k] || first[k] + edge <= 0) {
            return true;
        }
        edge == 8 && corners(first, edge, size).all(|cell| self.no_brick_at(&self.map.layout, cell))
    }

    fn no_brick_at(&self, layout: &Layout, cell: [usize; 3]) -> bool {
        let brick = layout.address(cell).brick();
        self.map.bricks.states_of(brick, &self.map.model).is_none()
    }
}

/// The corner cells of a cube, clamped to the grid.
fn corners(first: [i64; 3], edge: i64, size: [i64; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..8).map(move |i| [0, 1, 2].map(|k| (first[k] + (i >> k & 1) * (edge - 1)).clamp(0, size[k] - 1) as usize))
}

fn code(node: Node) -> u16 {
    match node {
        Node::Leaf(Occupancy::Unknown) => 0b00,
        Node::Leaf(Occupancy::Free) => 0b01,
        Node::Leaf(Occupancy::Occupied) => 0b10,
        Node::Inner(_) => 0b11,
    }
}

fn count(node: &Node) -> u64 {
    match node {
        Node::Leaf(Occupancy::Unknown) => 0,
        Node::Leaf(_) => 1,
        Node::Inner(nodes) => *nodes,
    }
}
