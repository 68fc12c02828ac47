//! Rendered frames of a small scene, and the layouts that they can be written in.

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;

use nalgebra::Matrix4;
use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Pose, Vector, look_at};
use vpl::rules::Space;
use vpl::sense::{Mesh, Noise, Observation, Paint, Simulator};

pub const FRAMES: usize = 4;

/// The camera: nothing about it is symmetric.
pub fn camera() -> Camera {
    let image = Intrinsics {
        width: 96,
        height: 72,
        fx: 90.0,
        fy: 93.0,
        cx: 50.5,
        cy: 33.5,
    };
    let range = DepthRange { min: 0.1, max: 5.0 };
    Camera {
        depth: image,
        colour: image,
        range,
    }
}

/// Three boxes, seen by four cameras on a rising arc.
pub fn frames() -> Vec<Observation> {
    let mut mesh = Mesh::default();
    for (centre, size, colour) in [
        ([0.0, 0.0, 0.05], [0.6, 0.5, 0.1], [200, 40, 30]),
        ([0.12, -0.05, 0.2], [0.2, 0.15, 0.2], [30, 160, 60]),
        ([-0.15, 0.1, 0.15], [0.1, 0.2, 0.1], [40, 60, 200]),
    ] {
        append(&mut mesh, centre, size, colour);
    }
    let space = Space {
        centre: Point::new(0.0, 0.0, 0.2),
        size: Vector::repeat(1.0),
        voxel: 0.02,
    };
    let simulator = Simulator::from_mesh(mesh, Pose::identity(), None, &space);
    let look = |k: usize| {
        let angle = 0.35 * k as f64;
        let eye = Point::new(0.9 * angle.cos(), 0.9 * angle.sin(), 0.5 + 0.08 * k as f64);
        simulator.observe(
            &camera(),
            &look_at(eye, Point::new(0.0, 0.02 * k as f64, 0.1)),
            Noise::None,
            0,
            k as u32,
        )
    };
    (0..FRAMES).map(look).collect()
}

fn append(mesh: &mut Mesh, centre: [f64; 3], size: [f64; 3], colour: [u8; 3]) {
    let first = mesh.vertices.len() as u32;
    for i in 0..8_usize {
        let at = |k: usize| centre[k] + size[k] * ((i >> k & 1) as f64 - 0.5);
        mesh.vertices.push(Point::new(at(0), at(1), at(2)));
    }
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    for [a, b, c, d] in quads {
        for triangle in [[a, b, c], [a, c, d]] {
            mesh.triangles.push(triangle.map(|i| first + i));
            mesh.paints.push(Paint::Flat(colour));
        }
    }
}

/// Raw depth at `scale` units a metre, 0 where there is no reading.
pub fn raw(frame: &Observation, scale: f64) -> Vec<u16> {
    frame
        .depth
        .metres
        .iter()
        .map(|z| (f64::from(*z) * scale).round() as u16)
        .collect()
}

pub fn write_depth_png(path: &Path, frame: &Observation, scale: f64) {
    let bytes: Vec<u8> = raw(frame, scale).iter().flat_map(|z| z.to_be_bytes()).collect();
    write_png(
        path,
        [frame.depth.width, frame.depth.height],
        png::ColorType::Grayscale,
        png::BitDepth::Sixteen,
        &bytes,
    );
}

pub fn write_colour_png(path: &Path, frame: &Observation) {
    let size = [frame.colour.width, frame.colour.height];
    write_png(
        path,
        size,
        png::ColorType::Rgb,
        png::BitDepth::Eight,
        frame.colour.pixels.as_flattened(),
    );
}

fn write_png(path: &Path, [width, height]: [u32; 2], colour: png::ColorType, depth: png::BitDepth, bytes: &[u8]) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path).unwrap()), width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(bytes).unwrap();
}

/// `tx ty tz qx qy qz qw`.
pub fn quaternion_line(pose: &Pose) -> String {
    let (t, q) = (&pose.translation.vector, &pose.rotation);
    format!("{} {} {} {} {} {} {}", t.x, t.y, t.z, q.i, q.j, q.k, q.w)
}

/// Four lines of four numbers.
pub fn rows(pose: &Pose) -> String {
    let m: Matrix4<f64> = pose.to_homogeneous();
    (0..4)
        .map(|i| format!("{} {} {} {}\n", m[(i, 0)], m[(i, 1)], m[(i, 2)], m[(i, 3)]))
        .collect()
}

/// The layouts that this file writes, in the order of the manual.
pub const LAYOUTS: [&str; 7] = [
    "slambook",
    "tum",
    "seven_scenes",
    "redwood",
    "bop",
    "visp",
    "transforms",
];

/// Options that state what a layout does not carry.
pub fn options(layout: &str) -> &'static [&'static str] {
    match layout {
        // OpenCV counts pixels from their centres.
        "bop" | "visp" | "transforms" => &[],
        _ => &["--intrinsics", "90,93,50,33"],
    }
}

/// Writes frames in a layout, with poses changed by `poses`.
pub fn write(layout: &str, folder: &Path, frames: &[Observation], poses: impl Fn(&Pose) -> Pose) {
    let pose = |frame: &Observation| poses(&frame.world_from_camera);
    for (k, frame) in frames.iter().enumerate() {
        let (depth, colour) = match layout {
            "slambook" => (format!("depth/{k}.png"), format!("color/{k}.png")),
            "tum" => (format!("depth/{k}.png"), format!("rgb/{k}.png")),
            "seven_scenes" => (format!("frame-{k:06}.depth.png"), format!("frame-{k:06}.color.png")),
            "redwood" => (format!("depth/{k:06}.png"), format!("image/{k:06}.png")),
            "bop" => (format!("depth/{k:06}.png"), format!("rgb/{k:06}.png")),
            "visp" => (String::new(), format!("Images/Image_{k:04}.png")),
            _ => (format!("depth/{k}.png"), format!("images/{k}.png")),
        };
        write_colour_png(&folder.join(colour), frame);
        if layout == "visp" {
            let head = [frame.depth.height, frame.depth.width].map(u32::to_le_bytes).concat();
            let body: Vec<u8> = raw(frame, 32768.0).iter().flat_map(|z| z.to_le_bytes()).collect();
            fs::create_dir_all(folder.join("Depth")).unwrap();
            fs::write(folder.join(format!("Depth/Depth_{k:04}.bin")), [head, body].concat()).unwrap();
        } else {
            write_depth_png(
                &folder.join(depth),
                frame,
                if layout == "tum" { 5000.0 } else { 1000.0 },
            );
        }
    }
    write_poses(layout, folder, &frames.iter().map(pose).collect::<Vec<_>>());
}

fn write_poses(layout: &str, folder: &Path, poses: &[Pose]) {
    let lines = |line: &dyn Fn(usize, &Pose) -> String| -> String {
        poses.iter().enumerate().map(|(k, p)| line(k, p)).collect()
    };
    let put = |name: &str, text: String| {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    match layout {
        "slambook" => put("pose.txt", lines(&|_, p| quaternion_line(p) + "\n")),
        "tum" => {
            // Pictures 3 ms apart from each other and from poses.
            put(
                "rgb.txt",
                lines(&|k, _| format!("{:.3} rgb/{k}.png\n", k as f64 / 10.0 + 0.003)),
            );
            put(
                "depth.txt",
                lines(&|k, _| format!("{:.3} depth/{k}.png\n", k as f64 / 10.0)),
            );
            let line = |k: usize, p: &Pose| format!("{:.3} {}\n", k as f64 / 10.0 - 0.003, quaternion_line(p));
            put(
                "groundtruth.txt",
                "# timestamp tx ty tz qx qy qz qw\n".to_owned() + &lines(&line),
            );
        }
        "seven_scenes" => poses
            .iter()
            .enumerate()
            .for_each(|(k, p)| put(&format!("frame-{k:06}.pose.txt"), rows(p))),
        "redwood" => put(
            "trajectory.log",
            lines(&|k, p| format!("{k} {k} {}\n{}", k + 1, rows(p))),
        ),
        "visp" => {
            let xml = "<conf><camera><px>90</px><py>93</py><u0>50</u0><v0>33</v0></camera></conf>";
            put("Config/scene.xml", xml.to_owned());
            poses
                .iter()
                .enumerate()
                .for_each(|(k, p)| put(&format!("CameraPose/Camera_{k:03}.txt"), rows(&p.inverse())));
        }
        "bop" => {
            let camera = |k: usize, p: &Pose| {
                let m = p.inverse().to_homogeneous();
                let r: Vec<f64> = (0..9).map(|i| m[(i / 3, i % 3)]).collect();
                let t: Vec<f64> = (0..3).map(|i| m[(i, 3)] * 1000.0).collect();
                let value = serde_json::json!({
                    "cam_K": [90.0, 0.0, 50.0, 0.0, 93.0, 33.0, 0.0, 0.0, 1.0],
                    "depth_scale": 1.0, "cam_R_w2c": r, "cam_t_w2c": t,
                });
                format!("{}\"{k}\": {value}", if k == 0 { "" } else { ",\n" })
            };
            put("scene_camera.json", format!("{{{}}}", lines(&camera)));
        }
        _ => {
            let frame = |k: usize, p: &Pose| {
                let m = p.to_homogeneous();
                let sign = [1.0, -1.0, -1.0, 1.0];
                let rows: Vec<Vec<f64>> = (0..4).map(|i| (0..4).map(|j| m[(i, j)] * sign[j]).collect()).collect();
                let value = serde_json::json!({
                    "file_path": format!("images/{k}.png"), "depth_file_path": format!("depth/{k}.png"), "transform_matrix": rows,
                });
                format!("{}{value}", if k == 0 { "" } else { ",\n" })
            };
            let lens = r#""fl_x": 90.0, "fl_y": 93.0, "cx": 50.5, "cy": 33.5, "w": 96, "h": 72"#;
            put(
                "transforms.json",
                format!("{{{lens}, \"frames\": [{}]}}", lines(&frame)),
            );
        }
    }
}
