//! Maps as OctoMap trees.

use std::collections::HashMap;
use std::io::{self, Write};

use super::{BINARY, DEPTH, FULL, ORIGIN_KEY};
use crate::map::{Map, Occupancy};

/// Writes the free and occupied voxels of a map as an OctoMap binary tree.
///
/// # Errors
/// Writing fails, or the space reaches farther than 32,768 voxels from the
/// origin of the world (`InvalidInput`).
pub fn write_bt(map: &Map, out: &mut impl Write) -> io::Result<()> {
    let state = |voxel| {
        if map.occupancy(voxel) == Occupancy::Occupied {
            1.0
        } else {
            -1.0
        }
    };
    write(map, state, Form::States, out)
}

/// Writes the log-odds of the measured voxels of a map as an OctoMap tree.
///
/// # Errors
/// As [`write_bt`].
pub fn write_ot(map: &Map, out: &mut impl Write) -> io::Result<()> {
    let log_odds = |voxel| {
        let p = map.probability(voxel).unwrap_or(0.5);
        (p / (1.0 - p)).ln() as f32
    };
    write(map, log_odds, Form::LogOdds, out)
}

#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// Of each leaf only whether it is occupied.
    States,
    LogOdds,
}

fn write(map: &Map, value: impl Fn(crate::map::Voxel) -> f32, form: Form, out: &mut impl Write) -> io::Result<()> {
    let first = first_key(map)?;
    let mut values: Vec<f32> = Vec::new();
    let mut known: HashMap<u32, usize> = HashMap::new();
    let mut leaves: Vec<u64> = Vec::new();
    for voxel in map.measured() {
        let value = value(voxel);
        let index = *known.entry(value.to_bits()).or_insert_with(|| {
            values.push(value);
            values.len() - 1
        });
        let cell = map.grid().cell(voxel);
        leaves.push(interleaved([0, 1, 2].map(|k| cell[k] + first[k])) << 16 | index as u64);
    }
    leaves.sort_unstable();
    let bytes = Vec::new();
    let mut tree = Tree { values, form, bytes };
    let nodes = match leaves.as_slice() {
        [] => 0,
        leaves => tree.node(leaves, DEPTH).nodes(),
    };
    let line = if form == Form::States { BINARY } else { FULL };
    writeln!(out, "{line}\nid OcTree\nsize {nodes}\nres {}\ndata", map.grid().voxel)?;
    out.write_all(&tree.bytes)
}

/// OctoMap's key of the first cell of the grid.
fn first_key(map: &Map) -> io::Result<[i64; 3]> {
    let grid = map.grid();
    let key = [0, 1, 2].map(|k| (grid.origin[k] / grid.voxel).round() as i64 + ORIGIN_KEY);
    let last = 2 * ORIGIN_KEY;
    if (0..3).all(|k| key[k] >= 0 && key[k] + i64::from(grid.size[k]) <= last) {
        return Ok(key);
    }
    let reason = "the space reaches farther than 32768 voxels from the origin, which an OctoMap file cannot hold";
    Err(io::Error::new(io::ErrorKind::InvalidInput, reason))
}

/// The bits of a key, x lowest, from the root's level down: 48 of them.
fn interleaved(key: [i64; 3]) -> u64 {
    let bit = |level: u32, k: usize| (key[k] as u64 >> level & 1) << (3 * level + k as u32);
    (0..DEPTH).fold(0, |code, level| code | bit(level, 0) | bit(level, 1) | bit(level, 2))
}

struct Tree {
    /// The values that leaves name.
    values: Vec<f32>,
    form: Form,
    bytes: Vec<u8>,
}

#[derive(Clone, Copy, PartialEq)]
enum Node {
    Unknown,
    /// Its value by index.
    Leaf(u16),
    /// Nodes from here down, leaves among them, and the largest value.
    Inner {
        nodes: u64,
        largest: f32,
    },
}

impl Node {
    fn nodes(self) -> u64 {
        match self {
            Self::Unknown => 0,
            Self::Leaf(_) => 1,
            Self::Inner { nodes, .. } => nodes,
        }
    }
}

impl Tree {
    /// Writes the node of 2^`height` voxels an edge that holds some leaves, in
    /// order of their keys.
    fn node(&mut self, leaves: &[u64], height: u32) -> Node {
        if height == 0 {
            return leaves.first().map_or(Node::Unknown, |leaf| self.leaf(*leaf as u16));
        }
        let at = self.bytes.len();
        self.bytes.resize(at + if self.form == Form::States { 2 } else { 5 }, 0);
        let shift = 16 + 3 * (height - 1);
        let mut rest = leaves;
        let children = [0, 1, 2, 3, 4, 5, 6, 7].map(|child| {
            let (here, later) = rest.split_at(rest.partition_point(|leaf| leaf >> shift & 7 <= child));
            rest = later;
            if here.is_empty() {
                Node::Unknown
            } else {
                self.node(here, height - 1)
            }
        });
        self.close(at, &children)
    }

    fn leaf(&mut self, value: u16) -> Node {
        if self.form == Form::LogOdds {
            let value = self.values[usize::from(value)];
            self.bytes.extend(value.to_le_bytes());
            self.bytes.push(0);
        }
        Node::Leaf(value)
    }

    /// Writes what the children are, or prunes them where they are one.
    fn close(&mut self, at: usize, children: &[Node; 8]) -> Node {
        if let Node::Leaf(value) = children[0]
            && children.iter().all(|c| *c == children[0])
        {
            self.bytes.truncate(at);
            return self.leaf(value);
        }
        let largest = children.iter().filter_map(|c| self.value(c)).fold(f32::MIN, f32::max);
        match self.form {
            Form::States => {
                let word = (0..8).fold(0_u16, |word, i| word | self.code(&children[i]) << (2 * i));
                self.bytes[at..at + 2].copy_from_slice(&word.to_le_bytes());
            }
            Form::LogOdds => {
                let there = |i: usize| u8::from(children[i] != Node::Unknown) << i;
                self.bytes[at..at + 4].copy_from_slice(&largest.to_le_bytes());
                self.bytes[at + 4] = (0..8).fold(0, |mask, i| mask | there(i));
            }
        }
        let nodes = 1 + children.iter().map(|c| c.nodes()).sum::<u64>();
        Node::Inner { nodes, largest }
    }

    fn value(&self, node: &Node) -> Option<f32> {
        match *node {
            Node::Unknown => None,
            Node::Leaf(value) => Some(self.values[usize::from(value)]),
            Node::Inner { largest, .. } => Some(largest),
        }
    }

    fn code(&self, node: &Node) -> u16 {
        match *node {
            Node::Unknown => 0b00,
            Node::Leaf(value) if self.values[usize::from(value)] < 0.0 => 0b01,
            Node::Leaf(_) => 0b10,
            Node::Inner { .. } => 0b11,
        }
    }
}
