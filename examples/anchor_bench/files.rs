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

/// Reads the file's values one after the other.
struct Reader(BufReader<File>);

impl Reader {
    fn open(path: &Path) -> Result<Self, String> {
        File::open(path)
            .map(|f| Self(BufReader::new(f)))
            .map_err(|e| e.to_string())
    }

    fn word(&mut self) -> Result<[u8; 4], String> {
        let mut bytes = [0; 4];
        let read = self.0.read_exact(&mut bytes);
        read.map(|()| bytes).map_err(|_| "the file ends too early".to_owned())
    }

    fn count(&mut self) -> Result<usize, String> {
        self.word().map(|bytes| u32::from_le_bytes(bytes) as usize)
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
        let rows = nalgebra::Matrix3x4::from_row_slice(&self.floats::<12>()?);
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
    let frames = file.count()?;
    let cloud = |file: &mut Reader| {
        let eye = Point::from(file.pose()?.translation.vector);
        let n = file.count()?;
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

/// Eyes and measured points, which a space has to hold.
pub fn extent(points: impl Iterator<Item = Point>) -> (Point, Point) {
    let none = (Point::from([f64::INFINITY; 3]), Point::from([f64::NEG_INFINITY; 3]));
    points.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}
