//! An organised point cloud as a depth image.
//!
//! The points of a depth camera obey u = fx x/z + cx and v = fy y/z + cy, so the
//! intrinsics follow from the points by least squares, and the depth image is
//! exactly what it was.

use super::messages::{Cloud, Field};
use crate::geometry::Intrinsics;
use crate::sense::frames::picture::fits;
use crate::sense::{ColourImage, DepthImage};

/// Largest distance of a point from its pixel's ray, pixels.
const OFF: f64 = 0.5;
const FLOAT32: u8 = 7;

/// Depth and colour of a cloud, and the camera that took it.
pub(super) struct Converted {
    pub depth: DepthImage,
    pub colour: Option<ColourImage>,
    pub camera: Intrinsics,
}

/// Converts a cloud; what is wrong otherwise.
pub(super) fn convert(cloud: &Cloud) -> Result<Converted, String> {
    let [width, height] = cloud.size;
    fits(cloud.size)?;
    if height == 1 {
        return Err(format!(
            "a cloud of {width} points without rows; an organised one has rows and columns as its depth image had"
        ));
    }
    let field = |name: &str| cloud.fields.iter().find(|f| f.name == name);
    let coordinate = |name: &str| {
        let field = field(name).ok_or_else(|| format!("a cloud without a field `{name}`"))?;
        let float = field.datatype == FLOAT32 && field.offset.saturating_add(4) <= cloud.point_step;
        float
            .then_some(field)
            .ok_or_else(|| format!("a cloud whose `{name}` is no 32-bit float within the point"))
    };
    let (x, y, z) = (coordinate("x")?, coordinate("y")?, coordinate("z")?);
    let (rows, columns) = (height as usize, width as usize);
    let row = columns.saturating_mul(cloud.point_step).max(cloud.row_step);
    if row
        .saturating_mul(rows - 1)
        .saturating_add(columns.saturating_mul(cloud.point_step))
        > cloud.data.len()
    {
        return Err(format!(
            "a cloud of {width} × {height} points that has {} bytes",
            cloud.data.len()
        ));
    }
    let at = |u: usize, v: usize| &cloud.data[v * row + u * cloud.point_step..][..cloud.point_step];
    let (mut depth, mut across, mut down) = (Vec::with_capacity(rows * columns), Fit::default(), Fit::default());
    for (v, u) in (0..rows).flat_map(|v| (0..columns).map(move |u| (v, u))) {
        let point = [x, y, z].map(|field| float(at(u, v), field, cloud.big_endian));
        let there = point.iter().all(|c| c.is_finite()) && point[2] > 0.0;
        depth.push(if there { point[2] } else { 0.0 });
        if there {
            let [x, y, z] = point.map(f64::from);
            across.add(x / z, u as f64);
            down.add(y / z, v as f64);
        }
    }
    let camera = camera(cloud.size, &across, &down)?;
    let colour = field("rgb")
        .or_else(|| field("rgba"))
        .filter(|f| f.offset.saturating_add(4) <= cloud.point_step);
    let colour = colour.map(|field| ColourImage {
        width,
        height,
        pixels: (0..rows * columns)
            .map(|k| rgb(at(k % columns, k / columns), field, cloud.big_endian))
            .collect(),
    });
    Ok(Converted {
        depth: DepthImage {
            width,
            height,
            metres: depth,
        },
        colour,
        camera,
    })
}

fn camera([width, height]: [u32; 2], across: &Fit, down: &Fit) -> Result<Intrinsics, String> {
    let lines = across.line().zip(down.line());
    let (((fx, cx), off_x), ((fy, cy), off_y)) = lines.ok_or("a cloud with too few points to tell its camera by")?;
    if fx <= 0.0 || fy <= 0.0 || off_x.max(off_y) > OFF {
        let off = off_x.max(off_y);
        return Err(format!(
            "a cloud whose points are not those of one pinhole camera in its optical frame (they are {off:.1} pixels off; x right, y down, z forward)"
        ));
    }
    let (cx, cy) = (cx + 0.5, cy + 0.5);
    #[rustfmt::skip]
    let camera = Intrinsics { width, height, fx, fy, cx, cy };
    Ok(camera)
}

/// Least squares of a line.
#[derive(Default)]
struct Fit {
    n: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Fit {
    fn add(&mut self, x: f64, y: f64) {
        self.n += 1.0;
        self.x += x;
        self.y += y;
        self.xx += x * x;
        self.xy += x * y;
        self.yy += y * y;
    }

    /// Slope and offset, and the root mean square of what is left.
    fn line(&self) -> Option<((f64, f64), f64)> {
        let spread = self.xx - self.x * self.x / self.n;
        if self.n < 16.0 || spread <= 1e-9 * self.n {
            return None;
        }
        let slope = (self.xy - self.x * self.y / self.n) / spread;
        let offset = (self.y - slope * self.x) / self.n;
        let rest = self.yy - self.y * self.y / self.n - slope * slope * spread;
        Some(((slope, offset), (rest.max(0.0) / self.n).sqrt()))
    }
}

fn float(point: &[u8], field: &Field, big_endian: bool) -> f32 {
    f32::from_bits(word(point, field, big_endian))
}

/// Colour packed as 0xRRGGBB.
fn rgb(point: &[u8], field: &Field, big_endian: bool) -> [u8; 3] {
    let [_, r, g, b] = word(point, field, big_endian).to_be_bytes();
    [r, g, b]
}

fn word(point: &[u8], field: &Field, big_endian: bool) -> u32 {
    let bytes: [u8; 4] = std::array::from_fn(|k| point[field.offset + k]);
    if big_endian {
        u32::from_be_bytes(bytes)
    } else {
        u32::from_le_bytes(bytes)
    }
}
