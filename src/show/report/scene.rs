//! The parts of a scene as plain numbers: surface, predicted places, faces.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::geometry::{Point, Polygon};
use crate::map::{Grid, Map, Voxel};
use crate::plan::Session;
use crate::sense::Observation;

/// Most surface voxels that a page draws.
const MOST_SURFACE: usize = 60_000;
/// Most voxels of a predicted place that a page draws.
const MOST_OF_A_PLACE: usize = 2_000;

/// The voxel grid.
#[derive(Serialize)]
pub(super) struct Space {
    /// The corner with the smallest coordinates, metres.
    origin: [f64; 3],
    /// Edge of a voxel, metres.
    voxel: f64,
    /// Voxels along x, y and z.
    size: [u32; 3],
}

impl Space {
    pub fn of(grid: &Grid) -> Self {
        Self {
            origin: grid.origin.into(),
            voxel: grid.voxel,
            size: grid.size,
        }
    }
}

/// When each voxel was a surface, and its colour.
#[derive(Default)]
pub(super) struct Surface {
    /// Voxels that are occupied now, with their place in `spans`.
    now: BTreeMap<Voxel, usize>,
    spans: Vec<Span>,
}

/// A voxel while it was occupied.
struct Span {
    cell: [i64; 3],
    /// sRGB, 0xRRGGBB.
    colour: u32,
    /// First frame that shows it.
    from: usize,
    /// First frame that shows it no more.
    to: Option<usize>,
}

/// The surface as columns.
#[derive(Serialize)]
pub(super) struct Drawn {
    /// One voxel in so many is drawn.
    every: usize,
    x: Vec<i64>,
    y: Vec<i64>,
    z: Vec<i64>,
    colour: Vec<u32>,
    from: Vec<usize>,
    to: Vec<Option<usize>>,
}

impl Surface {
    /// Brings the surface up to a map after frame number `frame` (from 0).
    pub fn update(&mut self, map: &Map, observation: &Observation, frame: usize) {
        let occupied = map.occupied();
        let mut now = BTreeMap::new();
        for voxel in occupied {
            let known = self.now.remove(&voxel);
            let at = known.unwrap_or_else(|| {
                self.spans.push(Span {
                    cell: map.grid().cell(voxel),
                    colour: colour_at(observation, &map.grid().centre(voxel)),
                    from: frame,
                    to: None,
                });
                self.spans.len() - 1
            });
            now.insert(voxel, at);
        }
        for gone in std::mem::replace(&mut self.now, now).into_values() {
            self.spans[gone].to = Some(frame);
        }
    }

    /// Its columns, thinned where there are too many voxels to turn smoothly.
    pub fn drawn(&self) -> Drawn {
        let every = self.spans.len().div_ceil(MOST_SURFACE).max(1);
        let spans: Vec<&Span> = self.spans.iter().step_by(every).collect();
        let axis = |k: usize| spans.iter().map(|s| s.cell[k]).collect();
        Drawn {
            every,
            x: axis(0),
            y: axis(1),
            z: axis(2),
            colour: spans.iter().map(|s| s.colour).collect(),
            from: spans.iter().map(|s| s.from).collect(),
            to: spans.iter().map(|s| s.to).collect(),
        }
    }
}

/// The colour of the pixel at which a point is seen; grey outside the image.
fn colour_at(observation: &Observation, p: &Point) -> u32 {
    let image = &observation.colour;
    let seen = observation.world_from_camera.inverse_transform_point(p);
    let pixel = observation.camera.colour.project(&seen);
    let [r, g, b] = pixel.map_or([128; 3], |(u, v)| image.at(u as u32, v as u32));
    u32::from(r) << 16 | u32::from(g) << 8 | u32::from(b)
}

/// A measured instance.
#[derive(Serialize)]
pub(super) struct Face {
    pub feature: String,
    pub key: String,
    /// Closed outlines, metres.
    pub outlines: Vec<Vec<[f64; 3]>>,
    #[serde(skip)]
    pub polygons: Vec<Polygon>,
}

/// A predicted instance.
#[derive(Serialize)]
pub(super) struct Place {
    feature: String,
    key: String,
    /// w_i · what is left of it may still draw the camera.
    weight: f64,
    /// Inspected share.
    inspected: f64,
    outlines: Vec<Vec<[f64; 3]>>,
    /// Voxels that are not inspected, cells.
    open: Vec<[i64; 3]>,
    /// Inspected ones.
    done: Vec<[i64; 3]>,
}

/// The measured instances of all features.
pub(super) fn found(session: &Session) -> Vec<Face> {
    let named = session.library().features.iter().zip(&session.status().features);
    let faces = named.flat_map(|(feature, status)| {
        status.found.iter().map(|found| {
            let polygons = found.measurement.faces();
            Face {
                feature: feature.name.clone(),
                key: found.key.clone(),
                outlines: polygons.iter().map(outline).collect(),
                polygons,
            }
        })
    });
    faces.collect()
}

/// The predicted instances of all features that are still looked for.
pub(super) fn predicted(session: &Session) -> Vec<Place> {
    let grid = session.map().grid();
    let (library, status) = (session.library(), session.status());
    let open = (0..library.features.len()).filter(|k| status.features[*k].is_predicted());
    let places = open.flat_map(|k| {
        status.features[k].predicted.iter().map(move |(key, predicted)| {
            let every = predicted.voxels.len().div_ceil(MOST_OF_A_PLACE).max(1);
            let drawn = || predicted.voxels.iter().zip(&predicted.inspected).step_by(every);
            let cells = |inspected: bool| {
                let chosen = drawn().filter(|(_, done)| **done == inspected);
                chosen.map(|(v, _)| grid.cell(v.voxel)).collect()
            };
            Place {
                feature: library.features[k].name.clone(),
                key: key.clone(),
                weight: status.weights[k],
                inspected: predicted.share(),
                outlines: predicted.polygons.iter().map(outline).collect(),
                open: cells(false),
                done: cells(true),
            }
        })
    });
    places.collect()
}

fn outline(polygon: &Polygon) -> Vec<[f64; 3]> {
    let millimetres = |p: &Point| [0, 1, 2].map(|k| (p[k] * 1e4).round() / 1e4);
    let vertices = polygon.vertices();
    vertices.iter().chain(vertices.first()).map(millimetres).collect()
}
