//! The program of a run: a carton with a label, and faces that the label predicts.

use std::fmt::Write as _;

/// What a run is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Edge of the model space, millimetres.
    pub space: f64,
    /// Edge of a voxel, millimetres.
    pub voxel: f64,
    /// Candidate views.
    pub views: usize,
    /// Columns of the depth image; rows are five sixths of them.
    pub columns: usize,
    /// Predicted instances of features.
    pub features: usize,
    /// Measurements.
    pub measurements: usize,
}

impl Setting {
    pub const USUAL: Self = Self {
        space: 600.0,
        voxel: 10.0,
        views: 64,
        columns: 512,
        features: 30,
        measurements: 4,
    };

    /// As command-line words, and back.
    pub fn words(&self) -> [String; 6] {
        let whole = |n: usize| n.to_string();
        [
            self.space.to_string(),
            self.voxel.to_string(),
            whole(self.views),
            whole(self.columns),
            whole(self.features),
            whole(self.measurements),
        ]
    }

    pub fn of_words(words: &[String]) -> Option<Self> {
        let number = |k: usize| words.get(k)?.parse::<f64>().ok().filter(|n| *n > 0.0);
        Some(Self {
            space: number(0)?,
            voxel: number(1)?,
            views: number(2)? as usize,
            columns: number(3)? as usize,
            features: number(4)? as usize,
            measurements: number(5)? as usize,
        })
    }

    /// The program in the language. No face but the label's is there, so each has to be
    /// looked at before its class is ruled out.
    pub fn program(&self) -> String {
        let mut text = String::from(
            "vpl 1\n\nuse std.detect.coloured_plane\nuse std.markers.small_qr\nuse std.views.sphere\n\n\
             library cartons {\n  feature label : marker\n  class plain { label }\n\n  \
             rule -> label {\n    detect  small_qr(\"carton\")\n    measure marker_pose()\n  }\n\n  \
             layout stickers {\n    label at [151 mm, 0 mm, 0 mm] facing +x\n  }\n",
        );
        for k in 0..self.features {
            let _ = write!(
                text,
                "\n  feature face{k} : polygon\n  class with{k} {{ label, face{k} }}\n  \
                 rule label -> face{k} {{\n    detect  coloured_plane({})\n    measure outline()\n    \
                 predict rectangle_by_marker(label.pose, {}, width: 40 mm, height: 40 mm)\n  }}\n",
                blue(k),
                place(k, self.features)
            );
        }
        let (rows, radius) = (self.columns * 5 / 6, 0.9 + self.space / 1000.0);
        let _ = write!(
            text,
            "}}\n\nlet sensor = rgbd_camera(\n  depth: [{}, {rows}], depth_fov: [70.6 deg, 60 deg],\n  \
             colour: [1920, 1080], colour_fov: [84.1 deg, 53.8 deg],\n  nearest: 0.3 m, farthest: 9 m,\n)\n\n\
             task look {{\n  library cartons\n  goal confident\n  camera sensor\n  \
             space cube({} mm) at [0 mm, 0 mm, 0 mm] voxel {} mm\n  views sphere(radius: {radius} m, count: {})\n  \
             thresholds {{ near: 20 mm, absent: 99 %, confidence: 99 % }}\n  limit {} views\n}}\n\n\
             scene belt {{\n  backdrop sphere(radius: {} m, colour: grey)\n  \
             object carton = prism(sides: 4, radius: 212.1 mm, height: 300 mm) at [0 mm, 0 mm, 0 mm] \
             marked cartons.stickers as plain\n}}\n",
            self.columns,
            self.space,
            self.voxel,
            self.views,
            self.measurements,
            radius + 1.0
        );
        text
    }
}

/// A colour of its own for every face.
fn blue(k: usize) -> String {
    format!("#00{:02x}{:02x}", k / 64 * 4, 255 - k % 64 * 2)
}

/// Where a face is expected, in the axes of the label on the +x side: spread over the
/// carton's top, left, right and rear side.
fn place(k: usize, count: usize) -> String {
    let side = k % 4;
    let across = (count.div_ceil(4) as f64).sqrt().ceil();
    let at = |n: f64| 240.0 * ((n + 0.5) / across - 0.5);
    let (i, j) = (
        at((k / 4) as f64 % across),
        at((k as f64 / 4.0 / across).floor() % across),
    );
    match side {
        0 => format!("at: [{i:.1} mm, 150 mm, {:.1} mm], facing: +y", j - 151.0),
        1 => format!("at: [150 mm, {i:.1} mm, {:.1} mm], facing: +x", j - 151.0),
        2 => format!("at: [-150 mm, {i:.1} mm, {:.1} mm], facing: -x", j - 151.0),
        _ => format!("at: [{i:.1} mm, {j:.1} mm, -301 mm], facing: -z"),
    }
}
