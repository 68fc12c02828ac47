//! `transforms.json` as radiance-field tools write it, with depth pictures.
//!
//! `transform_matrix` is camera to world with OpenGL axes (x right, y up, z
//! backward); lengths are taken as metres. Intrinsics are `fl_x`, `fl_y`, `cx`,
//! `cy`, `w`, `h` of the file or the frame, or `camera_angle_x`; pixels are
//! centred at halves. `depth_file_path` names 16-bit PNG: raw × `depth_unit_scale_factor`
//! (or `integer_depth_scale`) is metres, 0.001 where neither is there.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::frame::{Colour, Depth, Frame, Picture};
use super::{Layout, Recording, Taken, files, picture, pose, shots};
use crate::geometry::Intrinsics;

#[derive(Deserialize)]
struct File {
    #[serde(flatten)]
    lens: Lens,
    depth_unit_scale_factor: Option<f64>,
    integer_depth_scale: Option<f64>,
    frames: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    #[serde(flatten)]
    lens: Lens,
    file_path: Option<String>,
    depth_file_path: Option<String>,
    transform_matrix: [[f64; 4]; 4],
}

#[derive(Deserialize)]
struct Lens {
    fl_x: Option<f64>,
    fl_y: Option<f64>,
    cx: Option<f64>,
    cy: Option<f64>,
    w: Option<f64>,
    h: Option<f64>,
    camera_angle_x: Option<f64>,
    k1: Option<f64>,
}

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let file = if path.is_dir() {
        path.join("transforms.json")
    } else {
        path.to_owned()
    };
    let text = files::text(&file)?;
    let content: File = serde_json::from_str(&text).map_err(|e| FrameError::malformed(&file, e.to_string()))?;
    let mut notes = Vec::new();
    if content.lens.k1.is_some_and(|k| k != 0.0) {
        notes.push("its lens distorts (`k1`), which is not undone".to_owned());
    }
    let unit = content.depth_unit_scale_factor.or(content.integer_depth_scale);
    let own = match unit {
        Some(metres) => Known::new(1.0 / metres, "depth_unit_scale_factor"),
        None => Known::new(1000.0, "the usual 0.001 m a unit"),
    };
    let scale = stated.scale(own)?;
    let mut opened = Opened {
        file: &file,
        stated,
        lens: &content.lens,
        scale,
        taken: None,
    };
    let without = content.frames.iter().filter(|f| f.depth_file_path.is_none()).count();
    if without > 0 {
        notes.push(format!("{without} frames have no `depth_file_path` and are left out"));
    }
    let mut frames = Vec::new();
    for (k, entry) in content.frames.iter().enumerate() {
        if let Some(depth) = &entry.depth_file_path {
            frames.push(opened.frame(k, entry, depth)?);
        }
    }
    let taken = opened
        .taken
        .ok_or_else(|| FrameError::empty(&file, "no frame has a `depth_file_path`"))?;
    Ok(Recording {
        path: path.to_owned(),
        taken,
        frames,
        notes,
        max_depth: stated.max_depth(),
    })
}

struct Opened<'a> {
    file: &'a Path,
    stated: &'a Stated,
    lens: &'a Lens,
    scale: Known<f64>,
    taken: Option<Taken>,
}

impl Opened<'_> {
    fn frame(&mut self, k: usize, entry: &Entry, depth: &str) -> Result<Frame, FrameError> {
        let wrong = |what: String| FrameError::malformed(self.file, format!("frame {k}: {what}"));
        let world_from_camera = pose::from_rows(&entry.transform_matrix).map_err(wrong)?;
        let (depth, colour) = (self.beside(depth), entry.file_path.as_deref().map(|f| self.beside(f)));
        let colour = colour.filter(|file| file.is_file());
        let depth_size = picture::size(&depth)?;
        let colour_size = colour.as_deref().map(picture::size).transpose()?;
        let camera = self
            .camera(&entry.lens, colour_size.unwrap_or(depth_size))
            .map_err(wrong)?;
        let apart = || wrong("its depth and colour pictures are not of one shape".to_owned());
        let depth_camera = shots::resized(&camera, depth_size).ok_or_else(apart)?;
        let stated = pinhole(&depth_camera);
        let known = self
            .stated
            .depth(depth_size, Some(Known::new(stated, "transforms.json")))?;
        let colour_camera = colour_size.map(|size| shots::resized(&known.value, size).unwrap_or(camera));
        self.taken.get_or_insert_with(|| Taken {
            layout: Layout::Transforms,
            colour: shots::described(colour_camera.as_ref(), None),
            depth_scale: Some(self.scale.clone()),
            depth: known.clone(),
        });
        Ok(Frame {
            name: files::stem(&depth),
            world_from_camera: pose::opencv_from_opengl(&world_from_camera),
            depth_camera: known.value,
            depth: Depth::Picture(depth, self.scale.value),
            colour: colour_camera.zip(colour).map(|(camera, file)| Colour {
                picture: Picture::File(file),
                camera,
                colour_from_depth: None,
            }),
        })
    }

    fn beside(&self, name: &str) -> PathBuf {
        self.file.parent().unwrap_or(Path::new("")).join(name)
    }

    /// Intrinsics of a picture of `size`, of the frame or else of the file.
    fn camera(&self, own: &Lens, [width, height]: [u32; 2]) -> Result<Intrinsics, String> {
        let lens = |value: fn(&Lens) -> Option<f64>| value(own).or_else(|| value(self.lens));
        let (w, h) = (f64::from(width), f64::from(height));
        let angle = lens(|l| l.camera_angle_x).map(|angle| w / 2.0 / (angle / 2.0).tan());
        // Numbers are of a picture of w × h, which a smaller copy need not be.
        let shrunk = w / lens(|l| l.w).unwrap_or(w);
        if (h / lens(|l| l.h).unwrap_or(h) / shrunk - 1.0).abs() > 0.01 {
            return Err(format!(
                "`w` and `h` are not of the shape of its pictures, {width} × {height}"
            ));
        }
        let scaled = |value: Option<f64>| value.map(|v| v * shrunk);
        let fx = scaled(lens(|l| l.fl_x))
            .or(angle)
            .ok_or("there is neither `fl_x` nor `camera_angle_x`")?;
        let fy = scaled(lens(|l| l.fl_y)).unwrap_or(fx);
        let cx = scaled(lens(|l| l.cx)).unwrap_or(w / 2.0);
        let cy = scaled(lens(|l| l.cy)).unwrap_or(h / 2.0);
        Pinhole::of(fx, fy, cx - 0.5, cy - 0.5).sized([width, height])
    }
}

/// Intrinsics in OpenCV's convention.
fn pinhole(camera: &Intrinsics) -> Pinhole {
    Pinhole::of(camera.fx, camera.fy, camera.cx - 0.5, camera.cy - 0.5)
}
