//! `vpl inspect`: what recorded frames or a map were taken for.

use std::path::{Path, PathBuf};

use clap::Args;

use super::output::{self, MapForm};
use super::recording::{RecordingOptions, length, refused};
use super::{Failure, Outcome, print};
use crate::geometry::Bounds;
use crate::map::{Map, OctoMap};
use crate::rules::{SensorModel, Space};
use crate::sense::frames::{Recording, agreement, bounds_of, suspicion};
use crate::show;

/// Say what recorded frames were taken for and how well they agree.
#[derive(Args)]
#[command(after_help = "Example: vpl inspect recordings/desk --intrinsics 525,525,319.5,239.5 --map desk.bt")]
pub(crate) struct Inspect {
    /// A folder or log of recorded frames, or an OctoMap file.
    #[arg(value_name = "DATASET|MAP")]
    dataset: PathBuf,
    #[command(flatten)]
    recording: RecordingOptions,
    /// Edge of a voxel of the map.
    #[arg(long, value_name = "LENGTH", default_value = "50mm", value_parser = length)]
    voxel: f64,
    /// Write the map of all frames in order as an OctoMap file.
    #[arg(long, value_name = "OUT.bt|OUT.ot")]
    map: Option<PathBuf>,
}

/// Most pairs of frames that are compared.
const MOST_PAIRS: usize = 40;

pub(crate) fn run(options: &Inspect) -> Result<Outcome, Failure> {
    if let Some(file) = octomap(&options.dataset)? {
        print(&show::recording::octomap(&file))?;
        return Ok(Outcome::Done);
    }
    let form = options.map.as_deref().map(MapForm::of).transpose()?;
    let recording = options.recording.open(&options.dataset)?;
    if let Some(out) = &options.map {
        output::outside("--map", out, &options.dataset)?;
        output::writable(out)?;
    }
    let seen = Seen::of(&recording)?;
    let pairs = agreement(&recording, MOST_PAIRS).map_err(refused)?;
    let suspicion = suspicion(&recording).map_err(refused)?;
    let mut text = show::recording::taken(&recording);
    text += &show::recording::seen(seen.bounds.as_ref(), seen.without, recording.frames.len());
    text += &show::recording::agreement(&recording, &pairs, &suspicion);
    if let (Some(out), Some(form), Some(bounds)) = (&options.map, form, seen.bounds) {
        let map = mapped(&recording, bounds, options.voxel)?;
        output::write(out, |to| form.write(&map, to))?;
        text += &show::recording::mapped(&map, out);
    }
    if options.map.as_deref().is_some_and(output::is_stdout) {
        super::report(&text)?;
    } else {
        print(&text)?;
    }
    Ok(Outcome::Done)
}

/// What all frames together show.
struct Seen {
    /// Around all points and cameras.
    bounds: Option<Bounds>,
    /// Share of pixels without a reading.
    without: f64,
}

impl Seen {
    fn of(recording: &Recording) -> Result<Self, Failure> {
        let (mut corners, mut pixels, mut without) = (Vec::new(), 0, 0);
        for k in 0..recording.frames.len() {
            let seen = recording.observe(k).map_err(refused)?;
            pixels += seen.depth.metres.len();
            without += seen.depth.metres.iter().filter(|z| **z <= 0.0).count();
            corners.extend(bounds_of(&seen).into_iter().flat_map(|b| [b.min, b.max]));
        }
        Ok(Self {
            bounds: Bounds::around(&corners),
            without: without as f64 / pixels.max(1) as f64,
        })
    }
}

/// The map of all frames in order.
fn mapped(recording: &Recording, bounds: Bounds, voxel: f64) -> Result<Map, Failure> {
    let space = Space {
        centre: bounds.centre(),
        size: bounds.size().add_scalar(2.0 * voxel),
        voxel,
    };
    let too_large = |e: crate::map::TooLarge| Failure::Run(format!("{e}, as with `--voxel 100mm` or `--max-depth 5m`"));
    let map = Map::new(&space, SensorModel::default()).map_err(too_large)?;
    let mut map = map.of_occupancy_alone();
    for k in 0..recording.frames.len() {
        map.insert_every_ray(&recording.observe(k).map_err(refused)?);
    }
    Ok(map)
}

/// The OctoMap file of a path that ends like one.
fn octomap(path: &Path) -> Result<Option<OctoMap>, Failure> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    if !matches!(ending.as_deref(), Some("bt" | "ot")) || path.is_dir() {
        return Ok(None);
    }
    let named = |what: String| Failure::OctoMap(format!("`{}`", path.display()), what);
    let bytes = std::fs::read(path).map_err(|e| named(e.to_string()))?;
    OctoMap::read(&bytes).map(Some).map_err(|e| named(e.to_string()))
}
