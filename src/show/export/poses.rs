//! Where a run looked from: TUM's trajectory and `transforms.json`.

use std::io::{self, Write};

use serde_json::json;

use crate::geometry::{Camera, Pose};

/// A measured view.
pub struct Stop {
    /// Number of the measurement, from 1.
    pub n: u32,
    /// Index of the candidate view.
    pub view: usize,
    /// `world_from_camera`.
    pub world_from_camera: Pose,
}

/// Writes `n tx ty tz qx qy qz qw` a line: camera to world, OpenCV axes. The
/// number of the measurement stands for the time.
///
/// # Errors
/// Writing fails.
pub fn tum(stops: &[Stop], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "# n tx ty tz qx qy qz qw: world_from_camera, metres, OpenCV axes")?;
    for stop in stops {
        let (t, q) = (
            &stop.world_from_camera.translation.vector,
            &stop.world_from_camera.rotation,
        );
        writeln!(
            out,
            "{} {} {} {} {} {} {} {}",
            stop.n, t.x, t.y, t.z, q.i, q.j, q.k, q.w
        )?;
    }
    Ok(())
}

/// Writes `transforms.json`: camera to world, OpenGL axes, intrinsics of the
/// colour image with pixels centred at halves.
///
/// # Errors
/// Writing fails.
pub fn transforms(stops: &[Stop], camera: &Camera, out: &mut dyn Write) -> io::Result<()> {
    let k = &camera.colour;
    let frame = |stop: &Stop| {
        let m = stop.world_from_camera.to_homogeneous();
        // OpenGL's y and z point the other way.
        let sign = [1.0, -1.0, -1.0, 1.0];
        let rows: Vec<Vec<f64>> = (0..4)
            .map(|i| (0..4).map(|j| m[(i, j)] * sign[j] + 0.0).collect())
            .collect();
        json!({"n": stop.n, "view": stop.view, "transform_matrix": rows})
    };
    let frames: Vec<_> = stops.iter().map(frame).collect();
    let file = json!({
        "camera_model": "PINHOLE",
        "fl_x": k.fx, "fl_y": k.fy, "cx": k.cx, "cy": k.cy, "w": k.width, "h": k.height,
        "frames": frames,
    });
    writeln!(out, "{file:#}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{DepthRange, Intrinsics, Point, look_at};

    /// What lies ahead is at negative z of an OpenGL camera, and right stays right.
    #[test]
    fn transforms_have_opengl_axes_and_tum_has_opencv_ones() {
        let pose = look_at(Point::new(2.0, 0.0, 0.0), Point::origin());
        let stops = [Stop {
            n: 1,
            view: 7,
            world_from_camera: pose,
        }];
        let image = Intrinsics::with_fields_of_view(64, 48, 1.0, 0.8);
        let range = DepthRange { min: 0.5, max: 3.0 };
        let camera = Camera {
            depth: image,
            colour: image,
            range,
        };
        let mut bytes = Vec::new();
        transforms(&stops, &camera, &mut bytes).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
        let row = |i: usize| json["frames"][0]["transform_matrix"][i][2].as_f64().unwrap();
        assert!((row(0) - 1.0).abs() < 1e-12 && row(1).abs() < 1e-12, "{json}");
        assert_eq!(json["cx"], 32.0);
        let mut bytes = Vec::new();
        tum(&stops, &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.lines().nth(1).unwrap().starts_with("1 2 0 0 "), "{text}");
    }
}
