//! OctoMap trees as lists of leaves.

use super::{BINARY, DEPTH, FULL, ORIGIN_KEY};
use crate::geometry::{Bounds, Point};

/// Log-odds that OctoMap gives the leaves of a `.bt` file.
const FREE: f32 = -2.0;
const OCCUPIED: f32 = 3.5;
/// Longest header, bytes.
const MOST_HEADER: usize = 4096;

/// An OctoMap file.
#[derive(Clone, Debug, PartialEq)]
pub struct OctoMap {
    /// The kind of tree: `OcTree` or `ColorOcTree`.
    pub id: String,
    /// Edge of a voxel, metres.
    pub resolution: f64,
    /// Nodes, the inner ones included.
    pub nodes: u64,
    /// The leaves, in the file's order.
    pub leaves: Vec<Leaf>,
}

/// A cube of voxels that are alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// Key of its smallest voxel; the origin of the world has key 32768.
    pub key: [u16; 3],
    /// It is 2^`height` voxels an edge.
    pub height: u32,
    /// Log-odds of being occupied. In a `.bt` file OctoMap's clamps, −2 and 3.5.
    pub log_odds: f32,
}

/// Why a file is no OctoMap tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BadOctoMap(String);

impl Leaf {
    /// P(occupied).
    pub fn probability(&self) -> f64 {
        1.0 / (1.0 + (-f64::from(self.log_odds)).exp())
    }

    /// Its place, metres.
    pub fn bounds(&self, resolution: f64) -> Bounds {
        let corner = |offset: i64| {
            Point::from(
                self.key
                    .map(|k| (i64::from(k) - ORIGIN_KEY + offset) as f64 * resolution),
            )
        };
        Bounds {
            min: corner(0),
            max: corner(1 << self.height),
        }
    }
}

impl OctoMap {
    /// Reads a `.bt` or `.ot` file; its first line tells which it is.
    ///
    /// # Errors
    /// The header or the tree breaks the format, or the file ends too soon.
    pub fn read(bytes: &[u8]) -> Result<Self, BadOctoMap> {
        let header = Header::read(bytes)?;
        let mut tree = Tree {
            rest: &bytes[header.length..],
            extra: header.extra,
            nodes: 0,
            leaves: Vec::new(),
        };
        if header.nodes > 0 {
            match header.binary {
                true => tree.states(DEPTH, [0; 3])?,
                false => tree.values(DEPTH, [0; 3])?,
            }
        }
        if tree.nodes != header.nodes {
            return Err(BadOctoMap(format!(
                "its header states {} nodes and its tree has {}",
                header.nodes, tree.nodes
            )));
        }
        Ok(Self {
            id: header.id,
            resolution: header.resolution,
            nodes: tree.nodes,
            leaves: tree.leaves,
        })
    }

    /// The box around the leaves; `None` where there are none.
    pub fn bounds(&self) -> Option<Bounds> {
        let boxes = self.leaves.iter().map(|leaf| leaf.bounds(self.resolution));
        let corners: Vec<Point> = boxes.flat_map(|b| [b.min, b.max]).collect();
        Bounds::around(&corners)
    }
}

struct Header {
    binary: bool,
    id: String,
    nodes: u64,
    resolution: f64,
    /// Bytes of a node beside its value, in a full file.
    extra: usize,
    length: usize,
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self, BadOctoMap> {
        let wrong = |what: &str| BadOctoMap(what.to_owned());
        let head = &bytes[..bytes.len().min(MOST_HEADER)];
        let end = head
            .windows(6)
            .position(|w| w == b"\ndata\n")
            .ok_or_else(|| wrong("it has no line `data`"))?;
        let text = std::str::from_utf8(&head[..end]).map_err(|_| wrong("its header is no text"))?;
        let mut lines = text.lines();
        let binary = match lines.next() {
            Some(BINARY) => true,
            Some(FULL) => false,
            _ => return Err(BadOctoMap(format!("its first line is neither `{BINARY}` nor `{FULL}`"))),
        };
        let fields: Vec<(&str, &str)> = lines.filter_map(|line| line.split_once(' ')).collect();
        let field = |name: &str| {
            let found = fields
                .iter()
                .find(|(key, _)| *key == name)
                .map(|(_, value)| value.trim());
            found.ok_or_else(|| BadOctoMap(format!("its header has no `{name}`")))
        };
        let id = field("id")?.to_owned();
        let extra = match id.as_str() {
            "OcTree" => 0,
            "ColorOcTree" => 3,
            _ => {
                return Err(BadOctoMap(format!(
                    "it is of the kind `{id}`; OcTree and ColorOcTree are read"
                )));
            }
        };
        let nodes = field("size")?
            .parse()
            .map_err(|_| wrong("its `size` is no whole number"))?;
        let resolution: f64 = field("res")?.parse().map_err(|_| wrong("its `res` is no number"))?;
        if !(resolution.is_finite() && resolution > 0.0) {
            return Err(wrong("its `res` is not above 0"));
        }
        let length = end + 6;
        #[rustfmt::skip]
        let header = Self { binary, id, nodes, resolution, extra, length };
        Ok(header)
    }
}

struct Tree<'a> {
    rest: &'a [u8],
    extra: usize,
    nodes: u64,
    leaves: Vec<Leaf>,
}

impl Tree<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], BadOctoMap> {
        let (bytes, rest) = self
            .rest
            .split_first_chunk()
            .ok_or_else(|| BadOctoMap(format!("it ends within its tree, after {} nodes", self.nodes)))?;
        self.rest = rest;
        Ok(*bytes)
    }

    /// An inner node of a `.bt` file.
    fn states(&mut self, height: u32, key: [u16; 3]) -> Result<(), BadOctoMap> {
        let word = u16::from_le_bytes(self.take()?);
        self.nodes += 1;
        let below = self.below(height)?;
        for child in 0..8 {
            let key = child_key(key, below, child);
            match word >> (2 * child) & 3 {
                0b01 => self.leaf(key, below, FREE),
                0b10 => self.leaf(key, below, OCCUPIED),
                0b11 => self.states(below, key)?,
                _ => {}
            }
        }
        Ok(())
    }

    /// A node of an `.ot` file.
    fn values(&mut self, height: u32, key: [u16; 3]) -> Result<(), BadOctoMap> {
        let value = f32::from_le_bytes(self.take()?);
        for _ in 0..self.extra {
            self.take::<1>()?;
        }
        let [children] = self.take()?;
        if children == 0 {
            self.leaf(key, height, value);
            return Ok(());
        }
        self.nodes += 1;
        let below = self.below(height)?;
        for child in (0..8).filter(|child| children >> child & 1 == 1) {
            self.values(below, child_key(key, below, child))?;
        }
        Ok(())
    }

    fn leaf(&mut self, key: [u16; 3], height: u32, log_odds: f32) {
        self.nodes += 1;
        self.leaves.push(Leaf { key, height, log_odds });
    }

    fn below(&self, height: u32) -> Result<u32, BadOctoMap> {
        let below = height.checked_sub(1);
        below.ok_or_else(|| {
            BadOctoMap(format!(
                "its tree is deeper than {DEPTH} levels, after {} nodes",
                self.nodes
            ))
        })
    }
}

/// The key of a child of a node whose children are 2^`below` voxels an edge.
fn child_key(key: [u16; 3], below: u32, child: u32) -> [u16; 3] {
    [0, 1, 2].map(|k| key[k] | ((child >> k & 1) << below) as u16)
}
