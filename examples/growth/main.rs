//! How time and memory grow with the work.
//!
//! ```text
//! cargo run --release --example growth [-- TABLE…]
//! ```
//!
//! `TABLE` is one of voxel, views, image, features, measurements, large; all but `large`
//! where left out. Each line is a run of its own, in a process of its own: a carton with a
//! label that predicts faces, on one thread. Times are the process's, a mean over its
//! measurements; memory is the most that the process has held. `--program` before a
//! line's six numbers prints its program.

mod meter;
mod program;
mod run;

use std::process::{Command, ExitCode};

use program::Setting;
use run::Cost;

/// What varies, and how.
struct Table {
    name: &'static str,
    varies: &'static str,
    settings: Vec<(String, Setting)>,
}

fn tables() -> Vec<Table> {
    let usual = Setting::USUAL;
    let large = Setting {
        space: 2000.0,
        voxel: 2.0,
        views: 5000,
        ..usual
    };
    vec![
        table(
            "voxel",
            "voxel, mm",
            over(&[20.0, 10.0, 5.0, 4.0, 2.5, 2.0], |voxel| Setting {
                voxel,
                ..Setting::USUAL
            }),
        ),
        table(
            "views",
            "candidate views",
            over(&[32.0, 100.0, 320.0, 1000.0, 3200.0, 10_000.0], |n| Setting {
                views: n as usize,
                ..Setting::USUAL
            }),
        ),
        table(
            "image",
            "columns of the depth image",
            over(&[160.0, 320.0, 640.0, 1280.0], |n| Setting {
                columns: n as usize,
                ..Setting::USUAL
            }),
        ),
        table(
            "features",
            "instances of features",
            over(&[10.0, 30.0, 100.0, 300.0, 500.0], |n| Setting {
                features: n as usize,
                ..Setting::USUAL
            }),
        ),
        table(
            "measurements",
            "views taken",
            over(&[1.0, 2.0, 4.0, 8.0, 16.0], |n| Setting {
                measurements: n as usize,
                ..Setting::USUAL
            }),
        ),
        table(
            "large",
            "space 2 m, voxel 2 mm, 5,000 views",
            vec![(
                "2 measurements".into(),
                Setting {
                    measurements: 2,
                    ..large
                },
            )],
        ),
    ]
}

fn table(name: &'static str, varies: &'static str, settings: Vec<(String, Setting)>) -> Table {
    Table { name, varies, settings }
}

fn over(values: &[f64], with: fn(f64) -> Setting) -> Vec<(String, Setting)> {
    values.iter().map(|&v| (v.to_string(), with(v))).collect()
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let done = match words.first().map(String::as_str) {
        Some("--one") => one(&words[1..]),
        Some("--program") => setting(&words[1..]).map(|setting| println!("{}", setting.program())),
        _ => print_tables(&words),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn setting(words: &[String]) -> Result<Setting, String> {
    Setting::of_words(words).ok_or_else(|| "expected SPACE VOXEL VIEWS COLUMNS FEATURES MEASUREMENTS".to_owned())
}

/// In a process of its own: runs a setting and prints its cost.
fn one(words: &[String]) -> Result<(), String> {
    let setting = setting(words)?;
    println!("{}", run::cost(&setting)?.words().join(" "));
    Ok(())
}

fn print_tables(names: &[String]) -> Result<(), String> {
    let tables = tables();
    if let Some(unknown) = names.iter().find(|name| !tables.iter().any(|t| t.name == **name)) {
        return Err(format!("there is no table `{unknown}`"));
    }
    let wanted = |t: &&Table| names.contains(&t.name.to_owned()) || names.is_empty() && t.name != "large";
    for table in tables.iter().filter(wanted) {
        println!("| {} | {} |", table.varies, Cost::HEAD.join(" | "));
        println!("|---|{}", "---|".repeat(Cost::HEAD.len()));
        for (value, setting) in &table.settings {
            println!("| {value} | {} |", in_a_process(setting)?.join(" | "));
        }
        println!();
    }
    Ok(())
}

fn in_a_process(setting: &Setting) -> Result<Vec<String>, String> {
    let me = std::env::current_exe().map_err(|e| e.to_string())?;
    let ran = Command::new(me)
        .arg("--one")
        .args(setting.words())
        .output()
        .map_err(|e| e.to_string())?;
    if !ran.status.success() {
        return Err(String::from_utf8_lossy(&ran.stderr).into_owned());
    }
    Ok(String::from_utf8_lossy(&ran.stdout)
        .split_whitespace()
        .map(str::to_owned)
        .collect())
}
