//! The harnesses' files, little-endian. A camera looks along +z, x right and y down.
//!
//! - `.vpc`: u32 frames; a frame is 12 f32 of a row-major 3 × 4 camera-to-world matrix,
//!   u32 n and n · 3 f32 of points in world axes.
//! - `.vdi`: u32 frames, width and height, f32 fx fy cx cy; a frame is its matrix as
//!   above and width · height f32 of z-depth in metres, 0 for no reading.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Pose};
use vpl::sense::{ColourImage, DepthImage, Observation};

/// Reads the file's values one after the other. A count is believed only as far
/// as the file goes: a file of garbage asks for no memory.
struct Reader {
    file: BufReader<File>,
    /// Words not read yet.
    left: u64,
}

impl Reader {
    fn open(path: &Path) -> Result<Self, String> {
        let file = File::open(path).map_err(|e| e.to_string())?;
        let bytes = file.metadata().map_err(|e| e.to_string())?.len();
        Ok(Self {
            file: BufReader::new(file),
            left: bytes / 4,
        })
    }

    fn word(&mut self) -> Result<[u8; 4], String> {
        let mut bytes = [0; 4];
        self.left = self.left.saturating_sub(1);
        let read = self.file.read_exact(&mut bytes);
        read.map(|()| bytes).map_err(|_| "the file ends too early".to_owned())
    }

    fn count(&mut self) -> Result<usize, String> {
        self.word().map(|bytes| u32::from_le_bytes(bytes) as usize)
    }

    /// A count of things that have so many words each.
    fn count_of(&mut self, what: &str, words: u64) -> Result<usize, String> {
        let count = self.count()?;
        if count as u64 * words > self.left {
            return Err(format!("the file ends before its {count} {what}"));
        }
        Ok(count)
    }

    fn float(&mut self) -> Result<f32, String> {
        self.word().map(f32::from_le_bytes)
    }

    fn floats<const N: usize>(&mut self) -> Result<[f64; N], String> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = f64::from(self.float()?);
        }
        Ok(values)
    }

    fn pose(&mut self) -> Result<Pose, String> {
        let values = self.floats::<12>()?;
        if !values.iter().all(|v| v.is_finite()) {
            return Err("a pose that is not finite".to_owned());
        }
        let rows = nalgebra::Matrix3x4::from_row_slice(&values);
        let rotation = nalgebra::Rotation3::from_matrix(&rows.fixed_columns::<3>(0).into_owned());
        Ok(Pose::from_parts(rows.column(3).into_owned().into(), rotation.into()))
    }
}

/// A cloud and the eye that measured it, world axes.
pub struct Cloud {
    pub eye: Point,
    pub points: Vec<Point>,
}

/// Clouds of a `.vpc` file, the first `most` of them unless that is 0.
pub fn clouds(path: &Path, most: usize) -> Result<Vec<Cloud>, String> {
    let mut file = Reader::open(path)?;
    let frames = file.count_of("clouds", 13)?;
    let cloud = |file: &mut Reader| {
        let eye = Point::from(file.pose()?.translation.vector);
        let n = file.count_of("points of a cloud", 3)?;
        let points = (0..n).map(|_| file.floats::<3>().map(Point::from));
        Ok(Cloud {
            eye,
            points: points.collect::<Result<_, _>>()?,
        })
    };
    (0..at_most(frames, most)).map(|_| cloud(&mut file)).collect()
}

/// Depth images of a `.vdi` file, the first `most` of them unless that is 0.
pub fn depth_images(path: &Path, most: usize) -> Result<Vec<Observation>, String> {
    let mut file = Reader::open(path)?;
    let [frames, width, height] = [file.count()?, file.count()?, file.count()?];
    let [fx, fy, cx, cy] = file.floats()?;
    let pixels = width as u64 * height as u64;
    if (pixels + 12).saturating_mul(frames as u64) > file.left {
        return Err(format!(
            "the file ends before its {frames} images of {width} × {height} pixels"
        ));
    }
    if !(fx > 0.0 && fy > 0.0 && cx.is_finite() && cy.is_finite() && pixels > 0) {
        return Err("the camera has no image or no focal length".to_owned());
    }
    let image = Intrinsics {
        width: width as u32,
        height: height as u32,
        fx,
        fy,
        cx,
        cy,
    };
    let frame = |file: &mut Reader| {
        let world_from_camera = file.pose()?;
        let metres = (0..width * height).map(|_| file.float()).collect::<Result<_, _>>()?;
        Ok(Observation {
            camera: Camera {
                depth: image,
                colour: image,
                range: DepthRange { min: 0.0, max: 1e3 },
            },
            world_from_camera,
            colour: ColourImage {
                width: 0,
                height: 0,
                pixels: Vec::new(),
            },
            depth: DepthImage {
                width: width as u32,
                height: height as u32,
                metres,
            },
        })
    };
    (0..at_most(frames, most)).map(|_| frame(&mut file)).collect()
}

fn at_most(frames: usize, most: usize) -> usize {
    if most == 0 { frames } else { frames.min(most) }
}

/// The box of eyes and measured points, which a space has to hold.
pub fn extent(points: impl Iterator<Item = Point>) -> (Point, Point) {
    let none = (Point::from([f64::INFINITY; 3]), Point::from([f64::NEG_INFINITY; 3]));
    let finite = points.filter(|p| p.iter().all(|c| c.is_finite()));
    finite.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}
