//! The least number of candidate views that cover a share of what all of them
//! observe, for every object of a program's scene: exact minimum set cover.
//!
//! ```text
//! cargo run --release --example bounds -- FILE [SHARE]
//! ```

use vpl::cli::Disk;
use vpl::lang;
use vpl::plan::{Options, Session};
use vpl::sense::{Coverage, Noise, Simulator, least_views};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("which program?")?;
    let share: f64 = arguments.next().map_or(Ok(0.97), |s| s.parse())?;
    let rules = lang::compile(&file, &Disk)
        .rules
        .ok_or("the program has errors; see `vpl check`")?;
    let (task, scene) = (rules.tasks.first(), rules.scenes.first());
    let (task, scene) = task.zip(scene).ok_or("the program needs a task and a scene")?;
    let views = Session::new(&rules, &task.name, Options::default())?.views().to_vec();
    println!("| object | least views for {} % | which |", share * 100.0);
    println!("|---|--:|---|");
    for object in &scene.objects {
        let simulator = Simulator::new(object, scene.backdrop, &task.space, std::path::Path::new("."))?;
        let near = task.thresholds.near;
        let all = Coverage::new(&simulator, &task.camera, &views, near);
        let from = |pose| {
            let mut one = all.within(near);
            one.observe(&simulator.observe(&task.camera, pose, Noise::None, 0, 1));
            one.seen().to_vec()
        };
        let seen: Vec<Vec<bool>> = views.iter().map(from).collect();
        let least = least_views(&seen, share).ok_or("no cover")?;
        println!("| {} | {} | {least:?} |", object.name, least.len());
    }
    Ok(())
}
