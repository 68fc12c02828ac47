use proptest::prelude::*;

use super::*;
use crate::sense::Mesh;

/// A file of the shared samples; `None` (with a word about it) where absent.
fn sample(name: &str) -> Option<PathBuf> {
    let root = std::env::var_os("VPL_DATA").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"),
        PathBuf::from,
    );
    let path = root.join("meshes").join(name);
    if !path.exists() {
        eprintln!("skipped: {} is not here", path.display());
        return None;
    }
    Some(path)
}

const METRES: MeshOptions = MeshOptions {
    units: Some(Units::Metres),
    up: Some(Axis::Z),
};

/// Reads a text as a file of some format.
fn read_bytes(format: Format, bytes: &[u8], options: &MeshOptions) -> Result<Mesh, MeshError> {
    let mut soup = Soup::new(Path::new("part"));
    format.read(bytes, &mut soup)?;
    soup.finish(format, options)
}

#[track_caller]
fn check_extents(mesh: &Mesh, triangles: usize, extents: [f64; 3], slack: f64) {
    let dropped = mesh.warnings.iter().find_map(|w| match w {
        MeshWarning::DegenerateFaces(n) => Some(*n),
        _ => None,
    });
    assert_eq!(mesh.triangles.len() + dropped.unwrap_or(0), triangles);
    let size = mesh.bounds().size();
    for k in 0..3 {
        assert!((size[k] - extents[k]).abs() < slack, "{size:?}");
    }
}

#[test]
fn ascii_and_binary_stl_give_the_same_triangles() {
    let (Some(a), Some(b)) = (sample("formats/Spider_ascii.stl"), sample("formats/Spider_binary.stl")) else {
        return;
    };
    let (a, b) = (read(&a, &METRES).unwrap(), read(&b, &METRES).unwrap());
    check_extents(&a, 1368, [6.23, 8.0, 3.299], 0.01);
    assert_eq!(a.triangles.len(), b.triangles.len());
    for k in 0..a.triangles.len() {
        for (p, q) in a.corners(k).iter().zip(b.corners(k)) {
            assert!((p - q).norm() < 1e-4);
        }
    }
    assert!(a.open_edges() > 0);
}

#[test]
fn sample_parts_have_the_sizes_that_others_measured() {
    let mm = MeshOptions {
        units: Some(Units::Millimetres),
        up: Some(Axis::Z),
    };
    for (name, options, triangles, extents, closed) in [
        ("ariac/battery_collision.stl", METRES, 108, [0.132, 0.05, 0.04], true),
        ("cad/1002_tray_bottom.STL", mm, 4520, [0.3556, 0.003175, 0.3556], true),
        ("cad/7_8ths_cube.stl", mm, 24, [0.04, 0.04, 0.04], true),
        (
            "cad/octagonal_pocket.ply",
            METRES,
            3262,
            [0.2286, 0.1647, 0.01588],
            true,
        ),
        ("cad/tet.ply", METRES, 4, [2.0, 2.0, 2.0], true),
        ("formats/cube.ply", METRES, 12, [1.0, 1.0, 1.0], true),
        ("scans/bunny.ply", METRES, 16301, [0.1555, 0.1533, 0.1206], false),
        ("scans/spot.obj", METRES, 5856, [0.9431, 1.69, 1.718], true),
        // Its corners differ in the last digit: closed once they are welded.
        ("objects/can.stl", METRES, 956, [0.05, 0.05, 0.08], true),
    ] {
        let Some(path) = sample(name) else { return };
        let mesh = read(&path, &options).unwrap();
        check_extents(
            &mesh,
            triangles,
            extents,
            0.01 * extents.iter().fold(0.0_f64, |a, b| a.max(*b)),
        );
        assert_eq!(
            mesh.open_edges() == 0,
            closed,
            "{name}: {} {}",
            mesh.open_edges(),
            mesh.vertices.len()
        );
    }
}

#[test]
fn gltf_stands_upright_with_its_textures() {
    let none = MeshOptions::default();
    let (Some(tank), Some(truck)) = (sample("tanks/Tank2.glb"), sample("vehicles/vehicle-truck-green.glb")) else {
        return;
    };
    let tank = read(&tank, &none).unwrap();
    check_extents(&tank, 7224, [17.68, 12.71, 4.111], 0.01);
    let truck = read(&truck, &none).unwrap();
    check_extents(&truck, 1104, [1.5, 2.903, 1.4], 0.001);
    assert_eq!((truck.textures.len(), truck.textures[0].width), (1, 512));
    let textured = truck.paints.iter().filter(|p| matches!(p, Paint::Image { .. })).count();
    assert_eq!(textured, truck.paints.len());
}

#[test]
fn a_file_without_units_says_what_it_would_measure() {
    let cube = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n40 0 0\n0 20 0\n3 0 1 2\n";
    let error = read_bytes(Format::Ply, cube, &MeshOptions::default()).unwrap_err();
    assert_eq!(error.code(), "mesh_units");
    assert!(
        error
            .to_string()
            .contains("`units: mm` gives 0.0400 by 0.0200 by 0.0000 m"),
        "{error}"
    );
    let units = MeshOptions {
        units: Some(Units::Inches),
        up: None,
    };
    assert_eq!(read_bytes(Format::Ply, cube, &units).unwrap_err().code(), "mesh_up");
    let whole = MeshOptions {
        up: Some(Axis::Y),
        ..units
    };
    let mesh = read_bytes(Format::Ply, cube, &whole).unwrap();
    assert!((mesh.bounds().size() - crate::geometry::Vector::new(1.016, 0.0, 0.508)).norm() < 1e-9);
    assert!((mesh.vector_area(0).normalize() + crate::geometry::Vector::y()).norm() < 1e-12);
}

#[test]
fn turning_a_mesh_upright_is_a_rotation() {
    for axis in [Axis::X, Axis::Y, Axis::Z] {
        let [x, y, z] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]].map(|p| axis.upright(&Point::from(p)).coords);
        assert!((x.cross(&y) - z).norm() < 1e-12, "{axis:?}");
    }
    assert_eq!(Axis::X.upright(&Point::new(1., 0., 0.)), Point::new(0., 0., 1.));
}

/// One vertex list and one pentagon, in both byte orders.
fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 5\nproperty double x\nproperty float y\n\
         property float z\nproperty float quality\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face 1\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    .into_bytes();
    for (x, y) in [(0., 0.), (2., 0.), (3., 2.), (1., 3.), (-1., 2.)] {
        let (x, y): (f64, f32) = (x, y);
        bytes.extend(if big { x.to_be_bytes() } else { x.to_le_bytes() });
        for value in [y, 0.0, 7.0] {
            bytes.extend(if big { value.to_be_bytes() } else { value.to_le_bytes() });
        }
        bytes.extend([10, 20, 30]);
    }
    bytes.push(5);
    for i in 0..5_u32 {
        bytes.extend(if big { i.to_be_bytes() } else { i.to_le_bytes() });
    }
    bytes
}

#[test]
fn binary_ply_of_both_byte_orders_fans_its_polygons() {
    for big in [false, true] {
        let mesh = read_bytes(Format::Ply, &binary_ply(big), &METRES).unwrap();
        assert_eq!(mesh.triangles.len(), 3);
        assert_eq!(mesh.paints[0], Paint::Corners([[10, 20, 30]; 3]));
        let area: f64 = (0..3).map(|k| mesh.vector_area(k).z / 2.0).sum();
        assert!((area - 8.0).abs() < 1e-9, "{area}");
    }
}

#[test]
fn a_binary_stl_that_begins_with_solid_is_binary() {
    let mut bytes = b"solid part".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(1_u32.to_le_bytes());
    for value in [0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.] {
        let value: f32 = value;
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0, 0]);
    let mesh = read_bytes(Format::Stl, &bytes, &METRES).unwrap();
    assert_eq!(mesh.triangles.len(), 1);
    assert_eq!(mesh.warnings, vec![MeshWarning::OpenEdges(3)]);

    let mut short = bytes.clone();
    short[80] = 9;
    short[0] = b'x';
    let error = read_bytes(Format::Stl, &short, &METRES).unwrap_err();
    assert!(error.to_string().contains("states 9 triangles and holds 1"), "{error}");

    let nan = bytes.len() - 14;
    bytes[nan..nan + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let error = read_bytes(Format::Stl, &bytes, &METRES).unwrap_err();
    assert_eq!(error.code(), "mesh_not_finite");
}

#[test]
fn an_obj_keeps_working_faces_of_its_missing_material() {
    let text = "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl x\nf 1 2 3 4\nf 1 2 2\n";
    let mesh = read_bytes(Format::Obj, text.as_bytes(), &METRES).unwrap();
    assert_eq!(mesh.triangles.len(), 2);
    assert!(mesh.warnings.contains(&MeshWarning::DegenerateFaces(1)));
    assert!(mesh.warnings.iter().any(|w| matches!(w, MeshWarning::MissingFile(_))));
    let bad = read_bytes(Format::Obj, b"v 0 0 0\nf 1 2 3\n", &METRES).unwrap_err();
    assert_eq!(bad.code(), "mesh_malformed");
}

#[test]
fn a_gltf_text_with_a_data_uri_is_read() {
    // Three corners as f32: (0,0,0), (1,0,0), (0,1,0).
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"scale":[2,2,-2]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[1,0.2158605,0,1]}}}}],
        "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{data}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}]}}"#
    );
    let mesh = read_bytes(Format::Gltf, text.as_bytes(), &MeshOptions::default()).unwrap();
    assert_eq!(mesh.paints, vec![Paint::Flat([255, 128, 0])]);
    assert_eq!(mesh.bounds().max, Point::new(2.0, 0.0, 2.0));
    // The node mirrors z, so the face that looked along +z looks along −z: +y here.
    assert!(mesh.vector_area(0).y > 0.0);
    let circle = text.replace("\"scale\":[2,2,-2]", "\"children\":[0]");
    let error = read_bytes(Format::Gltf, circle.as_bytes(), &MeshOptions::default()).unwrap_err();
    assert!(error.to_string().contains("node 0 has two parents"), "{error}");
    let short = text.replace("\"count\":3", "\"count\":300");
    assert_eq!(
        read_bytes(Format::Gltf, short.as_bytes(), &MeshOptions::default())
            .unwrap_err()
            .code(),
        "mesh_malformed"
    );
}

#[test]
fn broken_files_are_refused_by_name() {
    let missing = read(Path::new("nowhere/part.stl"), &METRES).unwrap_err();
    assert_eq!(missing.code(), "mesh_unreadable");
    assert_eq!(read(Path::new("part.step"), &METRES).unwrap_err().code(), "mesh_format");
    let empty = b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n";
    assert_eq!(
        read_bytes(Format::Ply, empty, &METRES).unwrap_err().code(),
        "mesh_empty"
    );
    let vast = b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n";
    assert_eq!(
        read_bytes(Format::Ply, vast, &METRES).unwrap_err().code(),
        "mesh_malformed"
    );
    for format in [Format::Stl, Format::Obj, Format::Ply, Format::Gltf] {
        assert!(read_bytes(format, b"glTF nonsense \xff\x00", &METRES).is_err());
    }
}

proptest! {
    #[test]
    fn damaged_files_are_read_or_refused_but_never_panic(
        flips in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 0..6),
        keep in 0.2..1.0_f64,
    ) {
        let obj = b"v 0 0 0\nv 1 0 0 1 0 0\nvt 0 1\nv 0 1 0\no part\nusemtl a\nf 1/1 2/1 3/1\nf -1 -2 -3\n".to_vec();
        let stl = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
        for (format, bytes) in [
            (Format::Ply, binary_ply(false)),
            (Format::Ply, binary_ply(true)),
            (Format::Obj, obj),
            (Format::Stl, stl.to_vec()),
        ] {
            let mut bytes = bytes[..(bytes.len() as f64 * keep) as usize].to_vec();
            for (at, value) in &flips {
                let k = at.index(bytes.len());
                bytes[k] = *value;
            }
            let _ = read_bytes(format, &bytes, &METRES);
        }
    }
}
