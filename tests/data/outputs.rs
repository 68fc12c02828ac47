//! What a run learnt, in the formats of other tools.

use std::fs;
use std::path::Path;

use vpl::geometry::Point;
use vpl::map::OctoMap;
use vpl::sense::{Axis, MeshOptions, Units, mesh};

use crate::octomap::voxels;
use crate::support::{Ran, folder, vpl};

const SOLIDS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/solids/solids.vpl");

fn run(base: &Path, views: &str, outputs: &[(&str, &str)]) -> Ran {
    let paths: Vec<(String, String)> = outputs
        .iter()
        .map(|(o, name)| ((*o).to_owned(), base.join(name).to_str().unwrap().to_owned()))
        .collect();
    let options: Vec<&str> = paths
        .iter()
        .flat_map(|(option, path)| [option.as_str(), path.as_str()])
        .collect();
    vpl(&[
        &["plan", SOLIDS, "--object", "m2", "--max-views", views],
        options.as_slice(),
    ]
    .concat())
}

#[test]
fn a_run_leaves_maps_clouds_faces_and_poses() {
    let base = folder("outputs");
    let files = [
        ("--map", "m.ot"),
        ("--cloud", "c.ply"),
        ("--predicted", "p.ply"),
        ("--poses", "t.txt"),
    ];
    run(&base, "2", &files).expect(3, &[]);
    let others = [
        ("--map", "m.bt"),
        ("--cloud", "c.pcd"),
        ("--predicted", "p.obj"),
        ("--poses", "t.json"),
    ];
    run(&base, "2", &others).expect(3, &[]);
    let read = |name: &str| fs::read(base.join(name)).unwrap();
    let [odds, states] = ["m.ot", "m.bt"].map(|name| voxels(&OctoMap::read(&read(name)).unwrap()));
    let occupied = states.values().filter(|x| **x > 0.0).count();
    assert!(states.len() == odds.len() && occupied > 100);
    // A point a voxel that was ever hit, the same in both forms.
    let (ply, pcd) = (read("c.ply"), read("c.pcd"));
    let text = String::from_utf8_lossy(&ply);
    let count: usize = text
        .split_once("element vertex ")
        .unwrap()
        .1
        .lines()
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(count >= occupied, "{count} points, {occupied} occupied voxels");
    assert_eq!(ply[ply.len() - 12 * count..], pcd[pcd.len() - 12 * count..]);
    // Both meshes are read back as the same faces.
    let options = MeshOptions {
        units: Some(Units::Metres),
        up: Some(Axis::Z),
    };
    let [a, b] = ["p.ply", "p.obj"].map(|name| mesh::read(&base.join(name), &options).unwrap());
    // (OBJ is read in 32-bit floats.)
    assert!(a.triangles == b.triangles && !a.triangles.is_empty());
    let near = |(p, q): (&Point, &Point)| (p - q).norm() < 1e-6;
    assert!(a.vertices.iter().zip(&b.vertices).all(near));
    let text = String::from_utf8(read("t.txt")).unwrap();
    assert_eq!(text.lines().count(), 3);
    let json: serde_json::Value = serde_json::from_slice(&read("t.json")).unwrap();
    let x = json["frames"][1]["transform_matrix"][0][3].as_f64().unwrap();
    let written: f64 = text.lines().nth(2).unwrap().split(' ').nth(1).unwrap().parse().unwrap();
    assert_eq!(x, written);
}

#[test]
fn endings_that_name_no_form_are_refused_with_those_that_do() {
    let base = folder("endings");
    for (option, name, words) in [
        ("--map", "m.vdb", "end it in `.bt` or `.ot`"),
        ("--cloud", "c.las", "end it in `.ply` or `.pcd`"),
        ("--predicted", "p.stl", "end it in `.ply` or `.obj`"),
        ("--poses", "t.csv", "end it in `.txt` or `.json`"),
    ] {
        run(&base, "1", &[(option, name)]).expect(2, &[words]);
    }
    run(&base, "1", &[("--map", "x.ply"), ("--cloud", "x.ply")]).expect(2, &["would overwrite"]);
    run(&base, "1", &[("--cloud", "no/such/c.ply")]).expect(1, &["error[E0601]"]);
    assert_eq!(fs::read_dir(&base).unwrap().count(), 0);
}

/// Where the disk is full nothing is half written, and the old file stays.
#[test]
fn a_full_disk_leaves_nothing_half_written() {
    if !Path::new("/dev/full").exists() {
        eprintln!("skipped: there is no /dev/full here");
        return;
    }
    let base = folder("full");
    for option in ["--map", "--cloud", "--predicted", "--poses"] {
        let ran = vpl(&[
            "plan",
            SOLIDS,
            "--object",
            "m2",
            "--max-views",
            "1",
            option,
            "/dev/full",
        ]);
        ran.expect(1, &["error[E0601]", "`/dev/full`"]);
    }
    // A file that is replaced is replaced whole, and a link keeps pointing to it.
    fs::write(base.join("old.ply"), "old").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(base.join("old.ply"), base.join("link.ply")).unwrap();
    run(&base, "1", &[("--cloud", "link.ply")]).expect(3, &[]);
    assert!(fs::read(base.join("old.ply")).unwrap().starts_with(b"ply\n"));
    let names: Vec<_> = fs::read_dir(&base).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert!(
        names.iter().all(|n| !n.to_string_lossy().starts_with(".vpl")),
        "{names:?}"
    );
}
