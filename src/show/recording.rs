//! What recorded frames and maps were taken for, as text for people.

use std::fmt::Write;
use std::path::Path;

use crate::geometry::Bounds;
use crate::map::{Map, OctoMap};
use crate::sense::frames::{Better, Pair, Poses, Recording, Suspicion};

/// Layout, camera and conventions.
pub fn taken(recording: &Recording) -> String {
    let taken = &recording.taken;
    let (k, conventions) = (&taken.depth.value, taken.layout.conventions());
    let scale = match &taken.depth_scale {
        Some(known) => format!("raw / {} = metres ({})", known.value, known.source),
        None => "metres, or 16UC1 in millimetres".to_owned(),
    };
    let mut text = row("layout", taken.layout.description());
    text += &row("frames", &recording.frames.len().to_string());
    text += &row("depth", &format!("{} × {}, {scale}", k.width, k.height));
    text += &row(
        "camera",
        &format!(
            "fx {:.2}, fy {:.2}, cx {:.2}, cy {:.2} ({})",
            k.fx,
            k.fy,
            k.cx - 0.5,
            k.cy - 0.5,
            taken.depth.source
        ),
    );
    text += &row("colour", &taken.colour);
    text += &row("poses", &format!("{}; {}", conventions.pose, conventions.axes));
    text += &row("pixels", conventions.centres);
    for note in &recording.notes {
        text += &row("note", note);
    }
    text
}

/// Where things are and what was not read.
pub fn seen(bounds: Option<&Bounds>, without: f64, frames: usize) -> String {
    let mut text = row(
        "no reading",
        &format!("{:.1} % of the pixels of {frames} frames", 100.0 * without),
    );
    if let Some(b) = bounds {
        let (min, max) = (b.min, b.max);
        let around = format!(
            "[{:.3}, {:.3}, {:.3}] to [{:.3}, {:.3}, {:.3}] m, points and cameras",
            min.x, min.y, min.z, max.x, max.y, max.z
        );
        text += &row("bounds", &around);
    }
    text
}

/// How frames agree, and what was probably mistaken.
pub fn agreement(recording: &Recording, pairs: &[Pair], suspicion: &Suspicion) -> String {
    let mut text = String::new();
    if !pairs.is_empty() {
        text += "\nframes           shared   depth differs   nearest point\n";
    }
    for pair in pairs {
        let name = |k: usize| recording.frames[k].name.as_str();
        let frames = format!("{} in {}", name(pair.first), name(pair.second));
        let millimetres = |m: Option<f64>| m.map_or("–".to_owned(), |m| format!("{:.1} mm", 1000.0 * m));
        let _ = writeln!(
            text,
            "{frames:<16} {:>4.0} %   {:>13}   {:>13}",
            100.0 * pair.shared,
            millimetres(pair.difference),
            millimetres(pair.nearest)
        );
    }
    text + "\n" + &verdict(recording, suspicion)
}

/// The verdict on a recording: it agrees, or what is probably wrong.
pub fn verdict(recording: &Recording, suspicion: &Suspicion) -> String {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let now = suspicion.difference.map(percent);
    if let Some(better) = &suspicion.better {
        let than = now.map_or("no overlap".to_owned(), |now| format!("{now} of depth"));
        let difference = percent(better.difference);
        return format!(
            "likely mistake: {}\n  frames would differ by {difference} of depth instead of {than}\n",
            mistake(recording, better)
        );
    }
    match now {
        None if recording.frames.len() < 2 => "one frame: nothing to compare it with\n".to_owned(),
        None => "frames do not overlap: nothing tells whether their poses are right\n".to_owned(),
        Some(now) if suspicion.agrees() => format!("frames agree: they differ by {now} of depth\n"),
        Some(now) => format!(
            "frames disagree by {now} of depth, and none of the usual mistakes explains it; are the intrinsics and the transform between the cameras right?\n"
        ),
    }
}

/// What was probably mistaken, and what to do about it.
fn mistake(recording: &Recording, better: &Better) -> String {
    let poses = match better.poses {
        Poses::AsTaken => None,
        Poses::Inverse => {
            Some("the poses are the other way round, world to camera for camera to world or back; write their inverses")
        }
        Poses::OtherAxes => {
            Some("the camera axes are the other convention's, OpenGL for OpenCV or back; turn y and z over")
        }
        Poses::InverseOtherAxes => Some(
            "the poses are the other way round and in the other axes, OpenGL for OpenCV or back; write their inverses with y and z turned over",
        ),
    };
    let scale = (better.factor != 1.0).then(|| {
        let way = match &recording.taken.depth_scale {
            Some(known) => format!("say `--depth-scale {}`", known.value / better.factor),
            None => "the messages hold depth in another unit, or the poses do".to_owned(),
        };
        format!(
            "depth is {} times what was read, or poses are in another unit; {way}",
            better.factor
        )
    });
    let both: Vec<String> = poses.map(str::to_owned).into_iter().chain(scale).collect();
    both.join("; and ")
}

/// What a map of all frames holds.
pub fn mapped(map: &Map, out: &Path) -> String {
    let counts = map.counts();
    let voxel = map.grid().voxel * 1000.0;
    let text = format!(
        "{} occupied and {} free voxels of {voxel} mm, in `{}`",
        counts.occupied,
        counts.free,
        out.display()
    );
    row("map", &text)
}

/// What an OctoMap file holds.
pub fn octomap(file: &OctoMap) -> String {
    let count = |holds: fn(f32) -> bool| file.leaves.iter().filter(|l| holds(l.log_odds)).count();
    let (free, even, occupied) = (count(|x| x < 0.0), count(|x| x == 0.0), count(|x| x > 0.0));
    let mut text = row("layout", &format!("OctoMap, {}", file.id));
    text += &row("voxel", &format!("{} mm", file.resolution * 1000.0));
    text += &row("nodes", &file.nodes.to_string());
    text += &row("leaves", &format!("{occupied} occupied, {free} free"));
    if even > 0 {
        let note = format!(
            "{even} leaves are exactly even (p = 0.5): their writer keeps unknown space, which OctoMap counts as occupied"
        );
        text += &row("note", &note);
    }
    if let Some(b) = file.bounds() {
        let (min, max) = (b.min, b.max);
        let around = format!(
            "[{:.3}, {:.3}, {:.3}] to [{:.3}, {:.3}, {:.3}] m",
            min.x, min.y, min.z, max.x, max.y, max.z
        );
        text += &row("bounds", &around);
    }
    text
}

fn row(name: &str, value: &str) -> String {
    format!("{name:<12}{value}\n")
}
