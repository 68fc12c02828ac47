//! Times of the language: reading, checking and a keystroke in a large library.
//!
//! `cargo bench --bench language [-- LINES]`. Every time is the shortest of several, as
//! whatever else runs only adds, and is given beside its ratio to the time of parsing:
//! only compare ratios across machines. An edit at the end of the file stands for a keystroke: what an editor
//! waits for is the second analysis, not the expansion behind it.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use vpl::lang::syntax::parse;
use vpl::lang::{FileId, Memory, analyse, compile, tokens};

const FILE: &str = "large.vpl";
const ROUNDS: usize = 15;

fn main() {
    let lines = std::env::args().find_map(|a| a.parse().ok()).unwrap_or(5_000);
    let text = program(lines);
    let world = Memory::of(FILE, &text);
    let checked = compile(FILE, &world);
    println!(
        "{} lines, {} kB, {} rules, {} diagnostics",
        text.lines().count(),
        text.len() / 1000,
        checked
            .rules
            .map_or(0, |r| r.libraries.iter().map(|l| l.rules.len()).sum()),
        checked.diagnostics.len()
    );
    let parsing = shortest(|| drop(black_box(parse(FileId(0), &text))));
    let said = |what: &str, ms: f64| println!("  {what:<28} {ms:8.2} ms {:6.2} × parse", ms / parsing);
    said("parse", parsing);
    said("tokens", shortest(|| drop(black_box(tokens(&text)))));
    said(
        "names and types",
        shortest(|| drop(black_box(analyse(FILE, &world)))) - parsing,
    );
    let analysis = analyse(FILE, &world);
    said("expansion and checks", shortest(|| drop(black_box(analysis.expand()))));
    said("check", shortest(|| drop(black_box(compile(FILE, &world)))));
    let edited = Memory::of(FILE, &format!("{text}\n// x"));
    said("keystroke", shortest(|| drop(black_box(analyse(FILE, &edited)))));
}

fn shortest(mut work: impl FnMut()) -> f64 {
    let times = (0..ROUNDS).map(|_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e3
    });
    times.fold(f64::INFINITY, f64::min)
}

/// A library of boxes, each with two faces, a marker and their rules, and a task on it.
fn program(lines: usize) -> String {
    const LINES_OF_A_BOX: usize = 24;
    let boxes = (lines.saturating_sub(30) / LINES_OF_A_BOX).max(2);
    let mut text = String::from(
        "vpl 1\n\nuse std.cameras.kinect_v2\nuse std.detect.coloured_plane\nuse std.markers.large_qr\nuse std.solids.upright_rectangle\nuse std.views.sphere\n\n/// Many boxes.\nlibrary boxes {\n",
    );
    for k in 0..boxes {
        let _ = write!(
            text,
            "  feature bottom{k} : polygon            // what box {k} stands on
  feature side{k} : polygon many
  feature print{k} : marker
  class box{k} {{ bottom{k}, side{k}, print{k} }}

  rule -> bottom{k} {{
    detect  coloured_plane(#{:06x})
    measure outline(begin: lowest)
  }}

  rule bottom{k} -> side{k} {{
    for each edge in bottom{k}.edges
    detect  plane_beside(edge, dihedral: 90 deg, within: 10 deg)
    measure outline(first: edge)
    predict upright_rectangle(on: edge, height: side{k}.height else {} mm)
  }}

  // The code of box {k} is printed on one of its sides.
  rule -> print{k} {{
    detect  large_qr(\"box{k}\")
    measure marker_pose()
  }}

",
            k * 37 % 0xff_ff_ff,
            100 + k
        );
    }
    text.push_str("}\n\ntask find {\n  library boxes\n  goal confident\n  camera kinect_v2\n  space cube(600 mm) at [0 mm, 0 mm, 300 mm] voxel 10 mm\n  views sphere(radius: 1.4 m, count: 64)\n  thresholds { near: 20 mm, absent: 99 %, confidence: 99 % }\n  limit 20 views\n}\n");
    text
}
