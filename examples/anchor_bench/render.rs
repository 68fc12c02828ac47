//! Depth images of a mesh, drawn by the simulator and held against stored ones.

use std::path::PathBuf;

use serde_json::{Value, json};
use vpl::geometry::{Pose, Vector};
use vpl::rules::Space;
use vpl::sense::{DepthImage, Mesh, Noise, Simulator};

use super::meter::timed;
use super::{Arguments, files};

/// A difference that counts, metres.
const OFF: f32 = 1e-3;

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
        compared.add(&drawn, &frame.depth);
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
    /// The most that others differ, metres.
    worst: f32,
}

impl Compared {
    fn add(&mut self, drawn: &DepthImage, stored: &DepthImage) {
        for (&drawn, &stored) in drawn.metres.iter().zip(&stored.metres) {
            let apart = (drawn - stored).abs();
            self.hit += usize::from(drawn > 0.0);
            // So written that a reading that is not a number differs.
            if (drawn > 0.0) == (stored > 0.0) && apart <= OFF {
                self.worst = self.worst.max(apart);
            } else {
                self.differing += 1;
            }
        }
    }
}
