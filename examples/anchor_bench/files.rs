//! The harnesses' files, little-endian. A camera looks along +z, x right and y down.
//!
//! - `.vpc`: u32 frames; a frame is 12 f32 of a row-major 3 × 4 camera-to-world matrix,
//!   u32 n and n · 3 f32 of points in world axes.
//! - `.vdi`: u32 frames, width and height, f32 fx fy cx cy; a frame is its matrix as
//!   above and width · height f32 of z-depth in metres, 0 or not a number for no reading.
//! - `.vmesh`: u32 vertices and triangles, 3 f32 a vertex, 3 u32 a triangle.
//!
//! Nothing is set aside for what a file promises before it is read, so a wrong count
//! ends in an error and not in all of the memory.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Pose};
use vpl::sense::{ColourImage, DepthImage, Mesh, Observation, Paint};

/// Of an image, a side.
const MOST_PIXELS: usize = 16_384;

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
        let rows = nalgebra::Matrix3x4::from_row_slice(&self.floats::<12>()?);
        let turn = rows.fixed_columns::<3>(0).into_owned();
        let off = (turn.transpose() * turn - nalgebra::Matrix3::identity()).amax();
        // What is not a number is no rotation.
        let turns = off < 1e-3 && turn.determinant() > 0.0;
        if !turns || !rows.column(3).iter().all(|c| c.is_finite()) {
            return Err("a camera-to-world matrix is no rotation and place".to_owned());
        }
        let rotation = nalgebra::Rotation3::from_matrix(&turn);
        Ok(Pose::from_parts(rows.column(3).into_owned().into(), rotation.into()))
    }

    /// A vertex number below `vertices`.
    fn corner(&mut self, vertices: usize) -> Result<u32, String> {
        let k = self.count()?;
        let known = (k < vertices).then_some(k as u32);
        known.ok_or_else(|| format!("a triangle names vertex {k} of {vertices}, counted from 0"))
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
    let focal = [fx, fy].iter().all(|f| f.is_finite() && *f > 0.0);
    if !focal || ![cx, cy].iter().all(|c| c.is_finite()) {
        return Err(format!(
            "no camera has focal lengths {fx}, {fy} and its axis at {cx}, {cy}"
        ));
    }
    if !(1..=MOST_PIXELS).contains(&width) || !(1..=MOST_PIXELS).contains(&height) {
        return Err(format!(
            "an image has 1 to {MOST_PIXELS} pixels a side, not {width} x {height}"
        ));
    }
    let pixels = width as u64 * height as u64;
    if (pixels + 12).saturating_mul(frames as u64) > file.left {
        return Err(format!(
            "the file ends before its {frames} images of {width} × {height} pixels"
        ));
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

/// The mesh of a `.vmesh` file, plainly grey.
pub fn mesh(path: &Path) -> Result<Mesh, String> {
    let mut file = Reader::open(path)?;
    let [vertices, triangles] = [file.count()?, file.count()?];
    let vertex = |file: &mut Reader| {
        let p = Point::from(file.floats::<3>()?);
        let finite = p.iter().all(|c| c.is_finite());
        finite.then_some(p).ok_or_else(|| "a vertex is not a number".to_owned())
    };
    let triangle = |file: &mut Reader| Ok([file.corner(vertices)?, file.corner(vertices)?, file.corner(vertices)?]);
    let vertices = (0..vertices)
        .map(|_| vertex(&mut file))
        .collect::<Result<_, String>>()?;
    let triangles = (0..triangles)
        .map(|_| triangle(&mut file))
        .collect::<Result<Vec<_>, String>>()?;
    Ok(Mesh {
        vertices,
        paints: vec![Paint::Flat([128; 3]); triangles.len()],
        triangles,
        ..Mesh::default()
    })
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
