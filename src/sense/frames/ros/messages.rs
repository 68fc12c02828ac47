//! The messages that make a recording, as far as they are needed.

use super::cursor::{Cursor, Ended};
use crate::geometry::{Pose, Vector};
use crate::sense::frames::pose;

type Result<T> = std::result::Result<T, Ended>;

/// `std_msgs/Header`.
#[derive(Clone, Debug)]
pub(super) struct Header {
    /// Seconds.
    pub time: f64,
    pub frame: String,
}

impl Header {
    fn read(c: &mut Cursor) -> Result<Self> {
        if c.counts_headers() {
            c.u32()?;
        }
        let (seconds, nanoseconds) = (c.u32()?, c.u32()?);
        Ok(Self {
            time: f64::from(seconds) + f64::from(nanoseconds) * 1e-9,
            frame: c.string()?.trim_start_matches('/').to_owned(),
        })
    }
}

/// `sensor_msgs/Image`.
pub(super) struct Image<'a> {
    pub header: Header,
    pub size: [u32; 2],
    pub encoding: String,
    pub big_endian: bool,
    /// Bytes a row.
    pub step: usize,
    pub data: &'a [u8],
}

impl<'a> Image<'a> {
    pub fn read(data: &'a [u8], cdr: bool) -> Result<Self> {
        let c = &mut Cursor::new(data, cdr)?;
        let header = Header::read(c)?;
        let (height, width) = (c.u32()?, c.u32()?);
        Ok(Self {
            header,
            size: [width, height],
            encoding: c.string()?,
            big_endian: c.u8()? != 0,
            step: c.u32()? as usize,
            data: c.blob()?,
        })
    }
}

/// `sensor_msgs/CompressedImage`.
pub(super) struct Compressed<'a> {
    pub header: Header,
    pub format: String,
    pub data: &'a [u8],
}

impl<'a> Compressed<'a> {
    pub fn read(data: &'a [u8], cdr: bool) -> Result<Self> {
        let c = &mut Cursor::new(data, cdr)?;
        Ok(Self {
            header: Header::read(c)?,
            format: c.string()?,
            data: c.blob()?,
        })
    }
}

/// `sensor_msgs/CameraInfo`.
#[derive(Clone)]
pub(super) struct CameraInfo {
    pub header: Header,
    pub size: [u32; 2],
    pub distorts: bool,
    /// Row-major K.
    pub k: [f64; 9],
}

impl CameraInfo {
    pub fn read(data: &[u8], cdr: bool) -> Result<Self> {
        let c = &mut Cursor::new(data, cdr)?;
        let header = Header::read(c)?;
        let (height, width) = (c.u32()?, c.u32()?);
        c.string()?;
        let distortion = c.f64s()?;
        let mut k = [0.0; 9];
        for value in &mut k {
            *value = c.f64()?;
        }
        Ok(Self {
            header,
            size: [width, height],
            distorts: distortion.iter().any(|d| d.abs() > 1e-9),
            k,
        })
    }
}

/// A field of a point.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub name: String,
    pub offset: usize,
    /// 7 is 32-bit float, 8 is 64-bit float.
    pub datatype: u8,
}

/// `sensor_msgs/PointCloud2`.
pub(super) struct Cloud<'a> {
    pub header: Header,
    pub size: [u32; 2],
    pub fields: Vec<Field>,
    pub big_endian: bool,
    pub point_step: usize,
    pub row_step: usize,
    pub data: &'a [u8],
}

impl<'a> Cloud<'a> {
    pub fn read(data: &'a [u8], cdr: bool) -> Result<Self> {
        let c = &mut Cursor::new(data, cdr)?;
        let header = Header::read(c)?;
        let (height, width) = (c.u32()?, c.u32()?);
        let count = c.u32()?;
        if count > 1024 {
            return Err(Ended);
        }
        let mut field = || {
            let (name, offset, datatype) = (c.string()?, c.u32()? as usize, c.u8()?);
            c.u32()?;
            Ok(Field { name, offset, datatype })
        };
        let fields = (0..count).map(|_| field()).collect::<Result<_>>()?;
        Ok(Self {
            header,
            size: [width, height],
            fields,
            big_endian: c.u8()? != 0,
            point_step: c.u32()? as usize,
            row_step: c.u32()? as usize,
            data: c.blob()?,
        })
    }
}

/// `geometry_msgs/TransformStamped`.
pub(super) struct Transform {
    pub header: Header,
    pub child: String,
    pub parent_from_child: Pose,
}

/// The transforms of a `tf2_msgs/TFMessage`; what is wrong otherwise.
pub(super) fn transforms(data: &[u8], cdr: bool) -> std::result::Result<Vec<Transform>, String> {
    let ended = |_: Ended| "it ends within its fields".to_owned();
    let c = &mut Cursor::new(data, cdr).map_err(ended)?;
    let count = c.u32().map_err(ended)?;
    if count as usize > data.len() {
        return Err("it ends within its fields".to_owned());
    }
    (0..count).map(|_| transform(c).map_err(ended)?).collect()
}

fn transform(c: &mut Cursor) -> Result<std::result::Result<Transform, String>> {
    let header = Header::read(c)?;
    let child = c.string()?.trim_start_matches('/').to_owned();
    let mut number = || c.f64();
    let t = Vector::new(number()?, number()?, number()?);
    let q = [number()?, number()?, number()?, number()?];
    Ok(pose::from_quaternion(t.into(), q).map(|parent_from_child| Transform {
        header,
        child,
        parent_from_child,
    }))
}
