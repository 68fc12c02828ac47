//! Depth images of a mesh, drawn by the simulator and held against stored ones.

use std::path::PathBuf;

use serde_json::{Value, json};
use vpl::geometry::{Pose, Vector};
use vpl::rules::Space;
use vpl::sense::{DepthImage, Mesh, Noise, Observation, Simulator};

use super::meter::timed;
use super::{Arguments, files};

/// A difference that counts, metres.
const OFF: f32 = 1e-3;

/// Most pixels that are asked about.
const MOST_CAST: usize = 200;

/// One line: every stored image's pose drawn once.
pub fn depth(arguments: &Arguments) -> Result<Vec<Value>, String> {
    let mesh = files::mesh(&arguments.file)?;
    let stored = files::depth_images(&images(arguments), arguments.frames)?;
    let Some(first) = stored.first() else {
        return Err("no depth images".to_owned());
    };
    let triangles = mesh.triangles.len();
    let simulator = Simulator::from_mesh(mesh.clone(), Pose::identity(), None, &around(&mesh));
    let (mut ms, mut compared) = (Vec::new(), Compared::default());
    for frame in &stored {
        let (drawn, took) = timed(|| simulator.depth(&frame.camera, &frame.world_from_camera, Noise::None, 0, 0));
        ms.push(took.seconds(arguments.threads) * 1e3);
        compared.add(&drawn, frame, &mesh);
    }
    ms.sort_by(f64::total_cmp);
    let median = ms[ms.len() / 2];
    let (width, height) = (first.depth.width, first.depth.height);
    Ok(vec![json!({
        "lib": "vpl",
        "job": "depth",
        "mode": "raster",
        "threads": arguments.threads,
        "triangles": triangles,
        "wh": format!("{width}x{height}"),
        "views": stored.len(),
        "ms_median": median,
        "mrays_per_s": f64::from(width * height) / median / 1e3,
        "hit_pixels": compared.hit,
        "differing_pixels": compared.differing,
        "worst_m": compared.worst,
        "wrong_pixels": compared.wrong,
    })])
}

/// The file of depth images: the one named, or the mesh's own beside it where a
/// voxel's edge stands in its place.
fn images(arguments: &Arguments) -> PathBuf {
    match arguments.against.parse::<f64>() {
        Ok(_) => arguments.file.with_extension("vdi"),
        Err(_) => PathBuf::from(&arguments.against),
    }
}

/// A model space around a mesh: rendering needs one, and does not depend on it.
fn around(mesh: &Mesh) -> Space {
    let bounds = mesh.bounds();
    Space {
        centre: nalgebra::center(&bounds.min, &bounds.max),
        size: bounds.size() + Vector::repeat(0.1),
        voxel: 0.01,
    }
}

/// How drawn images differ from stored ones.
#[derive(Default)]
struct Compared {
    /// Drawn pixels that show the mesh.
    hit: usize,
    differing: usize,
    /// Those where a caster that tries every triangle disagrees with what was drawn:
    /// stored depths are of single precision, and may be off where an edge is near.
    /// Of very many, most are not asked about, and count.
    wrong: usize,
    /// The most that other pixels differ, metres.
    worst: f32,
}

impl Compared {
    fn add(&mut self, drawn: &DepthImage, stored: &Observation, mesh: &Mesh) {
        for (k, (&drawn, &depth)) in drawn.metres.iter().zip(&stored.depth.metres).enumerate() {
            self.hit += usize::from(drawn > 0.0);
            if agree(drawn, depth) {
                self.worst = self.worst.max((drawn - depth).abs());
            } else {
                self.differing += 1;
                let right = self.differing <= MOST_CAST && agree(drawn, cast(mesh, stored, k));
                self.wrong += usize::from(!right);
            }
        }
    }
}

/// Whether two depths are one; what is not a number agrees with nothing.
fn agree(a: f32, b: f32) -> bool {
    (a > 0.0) == (b > 0.0) && (a - b).abs() <= OFF
}

/// The depth of pixel `k`: the nearest triangle of all, 0 for none (Möller and Trumbore).
fn cast(mesh: &Mesh, view: &Observation, k: usize) -> f32 {
    let (image, width) = (&view.camera.depth, view.depth.width as usize);
    let ray = view.world_from_camera * image.ray((k % width) as f64 + 0.5, (k / width) as f64 + 0.5);
    let depths = (0..mesh.triangles.len()).filter_map(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        let (ab, ac, from) = (b - a, c - a, view.eye() - a);
        let (p, q) = (ray.cross(&ac), from.cross(&ab));
        let scale = 1.0 / ab.dot(&p);
        let (u, v, t) = (from.dot(&p) * scale, ray.dot(&q) * scale, ac.dot(&q) * scale);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    });
    let nearest = depths.fold(f64::INFINITY, f64::min);
    if nearest.is_finite() { nearest as f32 } else { 0.0 }
}
