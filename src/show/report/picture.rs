//! What the camera saw: a picture with the measured instances drawn in.

use std::io;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use super::scene::Face;
use crate::geometry::{Point, Polygon};
use crate::sense::{ColourImage, Observation};

/// Widest picture; larger ones are scaled down by a whole number.
const MOST_COLUMNS: u32 = 720;
/// A face is in sight where the depth at its middle differs by less, metres.
const IN_SIGHT: f64 = 0.03;

/// A picture and what is marked in it.
#[derive(Serialize)]
pub(super) struct Picture {
    /// A PNG as data URI.
    source: String,
    /// Size of the camera's image, pixels: what the marks count in.
    width: u32,
    height: u32,
    marks: Vec<Mark>,
}

/// An instance in a picture.
#[derive(Serialize)]
struct Mark {
    feature: String,
    key: String,
    /// Whether this measurement brought it.
    new: bool,
    /// Its outline, pixels.
    outline: Vec<[f64; 2]>,
}

impl Picture {
    /// The colour image of an observation, with the instances in sight. `before`
    /// are those that were known before.
    pub fn of(observation: &Observation, found: &[Face], before: Option<&[Face]>) -> Option<Self> {
        let small = reduced(&observation.colour);
        let known = |face: &Face| {
            let same = |old: &Face| old.feature == face.feature && old.key == face.key;
            before.is_some_and(|faces| faces.iter().any(same))
        };
        let marks = found.iter().flat_map(|face| {
            let outlines = face.polygons.iter().filter_map(|p| seen(observation, p));
            outlines.map(|outline| Mark {
                feature: face.feature.clone(),
                key: face.key.clone(),
                new: !known(face),
                outline,
            })
        });
        Some(Self {
            source: format!("data:image/png;base64,{}", STANDARD.encode(png(&small).ok()?)),
            width: observation.colour.width,
            height: observation.colour.height,
            marks: marks.collect(),
        })
    }
}

/// The outline of a face that is in sight, pixels of the colour image.
fn seen(observation: &Observation, face: &Polygon) -> Option<Vec<[f64; 2]>> {
    let (eye, middle) = (observation.eye(), face.centre());
    let in_camera = |p: &Point| observation.world_from_camera.inverse_transform_point(p);
    if face.normal().dot(&(eye - middle)) <= 0.0 {
        return None;
    }
    let middle = in_camera(&middle);
    let (u, v) = observation.camera.depth.project(&middle)?;
    let hidden = |z: f64| z < middle.z - IN_SIGHT;
    if observation.depth.at(u as u32, v as u32).is_some_and(hidden) {
        return None;
    }
    let k = &observation.camera.colour;
    let pixel = |p: &Point| {
        let p = in_camera(p);
        let pixel = [k.fx * p.x / p.z + k.cx, k.fy * p.y / p.z + k.cy];
        (p.z > 0.0).then(|| pixel.map(|c| (c * 10.0).round() / 10.0))
    };
    face.vertices().iter().map(pixel).collect()
}

/// The image at most [`MOST_COLUMNS`] wide, each pixel the mean of those it covers.
fn reduced(image: &ColourImage) -> ColourImage {
    let factor = image.width.div_ceil(MOST_COLUMNS).max(1);
    let (width, height) = ((image.width / factor).max(1), (image.height / factor).max(1));
    if factor == 1 {
        return image.clone();
    }
    let mean = |u: u32, v: u32| {
        let covered = (0..factor * factor).map(|k| image.at(u * factor + k % factor, v * factor + k / factor));
        let sum = covered.fold([0_u32; 3], |sum, p| [0, 1, 2].map(|c| sum[c] + u32::from(p[c])));
        sum.map(|s| (s / (factor * factor)) as u8)
    };
    let pixels = (0..width * height).map(|k| mean(k % width, k / width)).collect();
    ColourImage { width, height, pixels }
}

fn png(image: &ColourImage) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width, image.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(image.pixels.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wide_image_is_reduced_by_means() {
        let width = 2 * MOST_COLUMNS;
        let pixels = (0..width * 2).map(|k| [if k % 2 == 0 { 10 } else { 20 }, 0, 255]);
        let image = ColourImage {
            width,
            height: 2,
            pixels: pixels.collect(),
        };
        let small = reduced(&image);
        assert_eq!((small.width, small.height), (MOST_COLUMNS, 1));
        assert!(small.pixels.iter().all(|p| *p == [15, 0, 255]));
    }

    #[test]
    fn a_picture_reads_back() {
        let image = ColourImage {
            width: 2,
            height: 1,
            pixels: vec![[1, 2, 3], [250, 0, 7]],
        };
        let bytes = png(&image).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(&pixels[..6], [1, 2, 3, 250, 0, 7]);
    }
}
