//! BOP scenes: `scene_camera.json`, `scene_gt.json`, `depth/`, `rgb/` (or `gray/`).
//!
//! `cam_K` is row-major, `cam_R_w2c` and `cam_t_w2c` (mm) map world to camera,
//! OpenCV axes; raw depth × `depth_scale` is mm. Without world poses the axes of
//! an object that `scene_gt.json` has once in every picture are the world.
//! `models_info.json` gives the size of models, in mm. One frame on its own is
//! `camera.json` beside `depth.png` and `rgb.png`; its camera is the world.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Translation3};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::frame::{Colour, Depth, Frame, Picture};
use super::{Layout, Recording, Taken, files, picture, pose, shots};
use crate::geometry::{Pose, Vector};

#[derive(Deserialize)]
struct Camera {
    #[serde(rename = "cam_K")]
    k: [f64; 9],
    #[serde(default = "one")]
    depth_scale: f64,
    #[serde(rename = "cam_R_w2c")]
    rotation: Option<[f64; 9]>,
    #[serde(rename = "cam_t_w2c")]
    translation: Option<[f64; 3]>,
}

fn one() -> f64 {
    1.0
}

/// An object in a picture.
#[derive(Deserialize)]
struct Truth {
    obj_id: u32,
    #[serde(rename = "cam_R_m2c")]
    rotation: [f64; 9],
    #[serde(rename = "cam_t_m2c")]
    translation: [f64; 3],
}

#[derive(Deserialize)]
struct Model {
    size_x: f64,
    size_y: f64,
    size_z: f64,
}

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let scene = path.join("scene_camera.json");
    if !scene.is_file() {
        return single(path, stated);
    }
    let cameras = numbered::<Camera>(&scene)?;
    let truth = match path.join("scene_gt.json") {
        file if file.is_file() => Some(numbered::<Vec<Truth>>(&file)?),
        _ => None,
    };
    let mut notes = sizes(path, truth.as_ref())?;
    let world = match cameras
        .values()
        .all(|c| c.rotation.is_some() && c.translation.is_some())
    {
        true => None,
        false => Some(common_object(&scene, &cameras, truth.as_ref())?),
    };
    if let Some(object) = world {
        notes.push(format!(
            "there are no world poses; the axes of object {object} are the world"
        ));
    }
    let mut frames = Vec::new();
    for (&n, camera) in &cameras {
        let wrong = |what: String| FrameError::malformed(&scene, format!("picture {n}: {what}"));
        let camera_from_world = match (world, truth.as_ref().and_then(|t| t.get(&n))) {
            (Some(object), Some(truths)) => truths
                .iter()
                .find(|t| t.obj_id == object)
                .map(|t| rigid(&t.rotation, &t.translation)),
            _ => camera.rotation.zip(camera.translation).map(|(r, t)| rigid(&r, &t)),
        };
        let pose = camera_from_world.ok_or_else(|| wrong("it has no pose".into()))?;
        let name = format!("{n:06}");
        let Some(depth) = files::with_ending(&path.join("depth"), &name, &[".png"]) else {
            continue;
        };
        let colour = ["rgb", "gray"]
            .iter()
            .find_map(|f| files::with_ending(&path.join(f), &name, super::slambook::COLOUR));
        frames.push((name, depth, colour, pose.map_err(wrong)?.inverse(), camera));
    }
    if frames.is_empty() {
        return Err(FrameError::empty(
            path,
            "`depth/` has no picture of those in `scene_camera.json`",
        ));
    }
    recording(path, stated, frames, notes)
}

/// One frame beside its camera.
fn single(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let camera: Camera = json(&path.join("camera.json"))?;
    let colour = files::with_ending(path, "rgb", super::slambook::COLOUR);
    let frames = vec![(
        "0".to_owned(),
        path.join("depth.png"),
        colour,
        Pose::identity(),
        &camera,
    )];
    let note = "one frame without a pose: its camera's axes are the world".to_owned();
    recording(path, stated, frames, vec![note])
}

type Shot<'a> = (String, PathBuf, Option<PathBuf>, Pose, &'a Camera);

fn recording(path: &Path, stated: &Stated, shots: Vec<Shot>, notes: Vec<String>) -> Result<Recording, FrameError> {
    let mut frames: Vec<Frame> = Vec::new();
    let mut taken: Option<Taken> = None;
    let mut sizes: Option<([u32; 2], Option<[u32; 2]>)> = None;
    for (name, depth, colour, world_from_camera, camera) in shots {
        let (size, colour_size) = match sizes {
            Some(known) => known,
            None => {
                let of_colour = colour.as_deref().map(picture::size).transpose()?;
                (picture::size(&depth)?, of_colour)
            }
        };
        sizes = Some((size, colour_size));
        let k = Pinhole::of(camera.k[0], camera.k[4], camera.k[2], camera.k[5]);
        let intrinsics = stated.depth(size, Some(Known::new(k, "cam_K")))?;
        let scale = stated.scale(Known::new(1000.0 / camera.depth_scale, "depth_scale"))?;
        let colour_camera = match colour_size {
            Some(size) => shots::resized(&intrinsics.value, size),
            None => None,
        };
        taken.get_or_insert_with(|| Taken {
            layout: Layout::Bop,
            colour: shots::described(colour_camera.as_ref(), None),
            depth_scale: Some(scale.clone()),
            depth: intrinsics.clone(),
        });
        frames.push(Frame {
            name,
            world_from_camera,
            depth_camera: intrinsics.value,
            depth: Depth::Picture(depth, scale.value),
            colour: colour_camera.zip(colour).map(|(camera, file)| Colour {
                picture: Picture::File(file),
                camera,
                colour_from_depth: None,
            }),
        });
    }
    let taken = taken.ok_or_else(|| FrameError::empty(path, "it has no picture"))?;
    Ok(Recording {
        path: path.to_owned(),
        taken,
        frames,
        notes,
        max_depth: stated.max_depth(),
    })
}

/// The smallest id of an object that every picture has exactly once.
fn common_object(
    path: &Path,
    cameras: &BTreeMap<u64, Camera>,
    truth: Option<&BTreeMap<u64, Vec<Truth>>>,
) -> Result<u32, FrameError> {
    let once = |n: &u64, id: u32| {
        let objects = truth.and_then(|t| t.get(n)).map(Vec::as_slice).unwrap_or_default();
        objects.iter().filter(|o| o.obj_id == id).count() == 1
    };
    let first = cameras.keys().next().and_then(|n| truth?.get(n));
    let ids = first.map(Vec::as_slice).unwrap_or_default().iter().map(|o| o.obj_id);
    let common = ids.filter(|&id| cameras.keys().all(|n| once(n, id))).min();
    common.ok_or_else(|| {
        let what = "where its cameras stand: it has no `cam_R_w2c` and `cam_t_w2c`, and `scene_gt.json` no object that is once in every picture";
        FrameError::not_stated(path, what)
    })
}

/// The sizes of the objects of a scene, where `models_info.json` is near.
fn sizes(path: &Path, truth: Option<&BTreeMap<u64, Vec<Truth>>>) -> Result<Vec<String>, FrameError> {
    let places = [
        "models_info.json",
        "../models/models_info.json",
        "../../models/models_info.json",
        "../../models_eval/models_info.json",
    ];
    let Some(file) = places.iter().map(|p| path.join(p)).find(|f| f.is_file()) else {
        return Ok(Vec::new());
    };
    let models = numbered::<Model>(&file)?;
    let mut ids: Vec<u32> = truth
        .into_iter()
        .flat_map(BTreeMap::values)
        .flatten()
        .map(|t| t.obj_id)
        .collect();
    ids.sort_unstable();
    ids.dedup();
    let line = |id: u32| {
        let m = models.get(&u64::from(id))?;
        let [x, y, z] = [m.size_x, m.size_y, m.size_z].map(|mm| mm / 1000.0);
        Some(format!("object {id} is {x:.3} × {y:.3} × {z:.3} m"))
    };
    Ok(ids.into_iter().filter_map(line).collect())
}

/// A rotation, row by row, and a translation in mm.
fn rigid(r: &[f64; 9], t: &[f64; 3]) -> Result<Pose, String> {
    let rotation = pose::rotation(&Matrix3::from_row_slice(r))?;
    if t.iter().any(|x| !x.is_finite()) {
        return Err("a translation that is not finite".to_owned());
    }
    Ok(Pose::from_parts(
        Translation3::from(Vector::from(*t) / 1000.0),
        rotation,
    ))
}

/// A JSON object whose keys are whole numbers, in their order.
fn numbered<T: DeserializeOwned>(path: &Path) -> Result<BTreeMap<u64, T>, FrameError> {
    let entries: BTreeMap<String, T> = json(path)?;
    let number = |(key, value): (String, T)| {
        let wrong = |_| FrameError::malformed(path, format!("the key `{key}` is no whole number"));
        Ok((key.parse().map_err(wrong)?, value))
    };
    entries.into_iter().map(number).collect()
}

fn json<T: DeserializeOwned>(path: &Path) -> Result<T, FrameError> {
    let text = files::text(path)?;
    serde_json::from_str(&text).map_err(|e| FrameError::malformed(path, e.to_string()))
}
