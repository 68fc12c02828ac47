//! Meshes of the user's: readable ones, broken ones, ones in other units.

use std::fs;
use std::path::{Path, PathBuf};

use super::support::*;

/// Corners and triangles of a cube of one edge, outward.
fn cube(edge: f32) -> (Vec<[f32; 3]>, Vec<[usize; 3]>) {
    let corner = |k: usize| [k >> 2 & 1, k >> 1 & 1, k & 1].map(|bit| bit as f32 * edge);
    let faces = [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ];
    ((0..8).map(corner).collect(), faces.to_vec())
}

fn stl(edge: f32) -> Vec<u8> {
    let (corners, faces) = cube(edge);
    let mut bytes = vec![0; 80];
    bytes.extend((faces.len() as u32).to_le_bytes());
    for face in faces {
        bytes.extend([0; 12]);
        bytes.extend(face.into_iter().flat_map(|k| corners[k]).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

fn obj(edge: f32) -> String {
    let (corners, faces) = cube(edge);
    let corners = corners.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = faces
        .iter()
        .map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    corners.chain(faces).collect()
}

fn ply(edge: f32) -> String {
    let (corners, faces) = cube(edge);
    let head = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
                element face 12\nproperty list uchar int vertex_indices\nend_header\n";
    let corners = corners.iter().map(|[x, y, z]| format!("{x} {y} {z}\n"));
    let faces = faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n"));
    head.to_owned() + &corners.chain(faces).collect::<String>()
}

fn glb(edge: f32) -> Vec<u8> {
    let (corners, faces) = cube(edge);
    let mut data: Vec<u8> = corners.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    data.extend(faces.iter().flatten().flat_map(|k| (*k as u16).to_le_bytes()));
    let json = serde_json::json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [edge, edge, edge]},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"byteLength": 168}]});
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk = |kind: &[u8; 4], data: &[u8]| [&(data.len() as u32).to_le_bytes(), &kind[..], data].concat();
    let body = [chunk(b"JSON", &json), chunk(b"BIN\0", &data)].concat();
    let head = [2, 12 + body.len() as u32].map(u32::to_le_bytes).concat();
    [&b"glTF"[..], &head, &body].concat()
}

const MM: [&str; 4] = ["--units", "mm", "--up", "z"];

/// A grey part has none of the coloured faces, and is explored all the same.
#[test]
fn a_grey_part_of_any_format_is_explored_whole() {
    let folder = folder("formats");
    fs::write(folder.join("part.stl"), stl(250.0)).unwrap();
    fs::write(folder.join("part.obj"), obj(250.0)).unwrap();
    fs::write(folder.join("part.ply"), ply(250.0)).unwrap();
    fs::write(folder.join("part.glb"), glb(0.25)).unwrap();
    for (part, units) in [
        ("part.stl", &MM[..]),
        ("part.obj", &MM),
        ("part.ply", &MM),
        ("part.glb", &[]),
    ] {
        let ran = plan(
            &folder,
            &[&[SOLIDS, "--object", part, "--log", "run.jsonl"], units].concat(),
        );
        ran.expect(0, &[]);
        assert!(
            ran.out.contains(&format!("no view can show more of {part}")),
            "{}",
            ran.out
        );
        let records = records(&folder.join("run.jsonl"));
        let end = records.last().unwrap();
        assert!(
            end["coverage"].as_f64().unwrap() > 0.97 && end["class"].is_null(),
            "{end}"
        );
    }
}

#[test]
fn units_are_asked_for_and_held_against_the_space() {
    let folder = folder("units");
    fs::write(folder.join("part.stl"), stl(300.0)).unwrap();
    let with = |options: &[&str]| {
        plan(
            &folder,
            &[&[SOLIDS, "--object", "part.stl", "--dry-run"], options].concat(),
        )
    };
    let asked = [
        "E0504",
        "`units: mm` gives 0.3000 by",
        "`units: m` gives 300.0000 by",
        "--units mm",
    ];
    with(&[]).expect(1, &asked);
    with(&["--units", "mm"]).expect(1, &["E0504", "which axis points up", "--up z"]);
    let large = [
        "E0504",
        "300.0000 × 300.0000 × 300.0000 m, far larger",
        "it would fit with `--units mm`",
    ];
    with(&["--units", "m", "--up", "z"]).expect(1, &large);
    with(&MM).expect(0, &[]);
    fs::write(folder.join("part.stl"), stl(0.3)).unwrap();
    with(&MM).expect(1, &["E0504", "hardly a speck in", "it would fit with `--units m`"]);
    fs::write(folder.join("part.stl"), stl(900.0)).unwrap();
    with(&MM).expect(0, &["warning: `part.stl` reaches out of the space"]);
}

/// A mesh in a scene is found beside its program, wherever one stands.
#[test]
fn a_mesh_of_a_scene_is_relative_to_its_program() {
    let folder = folder("scene");
    fs::create_dir(folder.join("parts")).unwrap();
    fs::write(folder.join("parts/cube.stl"), stl(250.0)).unwrap();
    let program = |mesh: &str| {
        let text = fs::read_to_string(SOLIDS).unwrap();
        let (text, _) = text.split_once("  object m1").unwrap();
        let text = format!("{text}  object cube = mesh({mesh}) at [0 mm, 0 mm, 300 mm]\n}}\n");
        fs::write(folder.join("my.vpl"), text).unwrap();
    };
    let above = folder.parent().unwrap();
    let run = || plan(above, &["scene/my.vpl", "--dry-run"]);
    program(r#"file: "parts/cube.stl", units: mm, up: z"#);
    run().expect(0, &[]);
    program(r#"file: "parts/cube.stl", up: z"#);
    run().expect(1, &["E0504", "state them: `units: mm` gives", "my.vpl:"]);
    program(r#"file: "parts/cube.stl", units: m, up: z"#);
    run().expect(1, &["E0504", "far larger", "`units: mm`", "in the scene"]);
    program(r#"file: "parts/gone.stl", units: mm, up: z"#);
    run().expect(1, &["E0504", "gone.stl", "my.vpl:"]);
}

#[test]
fn broken_meshes_are_refused_with_a_code() {
    let folder = folder("broken");
    let whole = stl(300.0);
    let with = |from: &str, to: &str| ply(300.0).replace(from, to).into_bytes();
    let cases: &[(&str, Vec<u8>)] = &[
        ("empty.stl", vec![]),
        ("short.stl", whole[..300].to_vec()),
        ("lies.stl", [&whole[..80], &[255; 4], &whole[84..]].concat()),
        ("no_faces.stl", vec![0; 84]),
        ("nan.stl", stl(f32::NAN)),
        ("infinite.stl", stl(f32::INFINITY)),
        ("point.stl", stl(0.0)),
        ("noise.stl", (0..5000_u32).map(|k| (k * k % 251) as u8).collect()),
        (
            "words.stl",
            b"solid x\nfacet normal 0 0 nan\nouter loop\nvertex a b c\n".to_vec(),
        ),
        ("short.ply", ply(300.0).into_bytes()[..300].to_vec()),
        ("many.ply", with("face 12", "face 99999999999")),
        ("index.ply", with("3 0 1 3", "3 0 1 300")),
        ("negative.ply", with("3 0 1 3", "3 0 -1 3")),
        ("index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n".to_vec()),
        ("no_faces.obj", b"v 0 0 0\n".to_vec()),
        ("short.glb", glb(0.3)[..200].to_vec()),
        (
            "noise.glb",
            b"glTF\x02\0\0\0\xff\xff\xff\xff\xf0\xff\xff\xffJSON{}".to_vec(),
        ),
        ("part.step", b"ISO-10303-21;".to_vec()),
    ];
    for (name, bytes) in cases {
        fs::write(folder.join(name), bytes).unwrap();
        for options in [&[][..], &MM] {
            plan(&folder, &[&[SOLIDS, "--object", name], options].concat()).expect(1, &["E0504", name]);
        }
    }
    plan(&folder, &[SOLIDS, "--object", "gone.stl"]).expect(1, &["E0504", "gone.stl"]);
}

/// Meshes of other people, which are not part of this project.
#[test]
fn real_meshes_are_explored() {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let data = std::env::var_os("VPL_DATA").map_or_else(beside, PathBuf::from);
    let folder = folder("real");
    for (part, units) in [
        ("ariac/battery_collision.stl", "m"),
        ("objects/can.stl", "m"),
        ("scans/bunny.ply", "m"),
        ("cad/plate_holes.STL", "mm"),
    ] {
        let path = data.join("meshes").join(part);
        let Some(path) = path.to_str().filter(|_| path.exists()) else {
            eprintln!("skipped: there is no {}", path.display());
            continue;
        };
        let options = [
            SOLIDS,
            "--object",
            path,
            "--units",
            units,
            "--up",
            "z",
            "--log",
            "run.jsonl",
        ];
        plan(&folder, &options).expect(0, &[]);
        let records = records(&folder.join("run.jsonl"));
        assert!(records.last().unwrap()["coverage"].as_f64().unwrap() > 0.95, "{part}");
    }
}
