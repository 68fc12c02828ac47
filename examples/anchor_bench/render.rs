//! Depth images of a mesh, drawn by the simulator and held against stored ones.

use std::path::PathBuf;

use serde_json::{Value, json};
use vpl::geometry::{Bounds, Pose, Vector};
use vpl::rules::Space;
use vpl::sense::{DepthImage, Mesh, Noise, Observation, Simulator};

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
