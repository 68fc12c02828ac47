//! One page that opens offline: tables and plots, nothing loaded from anywhere.

use super::plots::Plot;
use super::table::{Table, escaped};
use crate::study::design::Design;

/// The page of a study.
pub fn page(design: &Design, done: usize, tables: &[Table], plots: &[Plot]) -> String {
    let study = &design.study;
    let name = escaped(&study.name);
    let settings = settings(design);
    let state = match done == design.jobs.len() {
        true => format!("{done} runs."),
        false => format!("<strong>Unfinished: {done} of {} runs.</strong>", design.jobs.len()),
    };
    let (first, rest) = tables
        .split_first()
        .map_or((String::new(), tables), |(t, rest)| (t.html(), rest));
    let rest: String = rest.iter().map(Table::html).collect();
    let plots: String = plots
        .iter()
        .map(|plot| {
            format!(
                "<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
                plot.svg,
                escaped(&plot.title)
            )
        })
        .collect();
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name}: a vpl study</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>{name}</h1>\n<p>{state}</p>\n{settings}{first}{plots}{rest}</main>\n</body>\n</html>\n"
    )
}

/// What was run, so that the numbers can be made again.
fn settings(design: &Design) -> String {
    let study = &design.study;
    let mut out = "<dl>\n".to_owned();
    let mut say = |term: &str, what: String| {
        out += &format!("<dt>{term}</dt><dd>{}</dd>\n", escaped(&what));
    };
    let source = study.rules.sources.first().map_or("", |s| s.path.as_str());
    say("task", format!("{} of {source}", study.task));
    say("objects", study.objects.len().to_string());
    say(
        "starts",
        format!(
            "{} of {} views, indices ⌊k · count / starts⌋",
            study.starts, design.variants[0].views
        ),
    );
    say("noise", study.noises.join(", "));
    for variant in &design.variants {
        let task = &variant.task;
        let name = if variant.name.is_empty() {
            "settings"
        } else {
            &variant.name
        };
        let model = &task.sensor_model;
        say(
            name,
            format!(
                "voxel {} mm, near {} mm, limit {} views, gain floor {} voxels, hit {} %, miss {} %; ties: the nearest view, then the lowest index",
                short(task.space.voxel * 1e3),
                short(task.thresholds.near * 1e3),
                task.limit,
                task.gain_floor,
                short(model.hit * 100.0),
                short(model.miss * 100.0),
            ),
        );
    }
    say("vpl", env!("CARGO_PKG_VERSION").to_owned());
    out + "</dl>\n"
}

fn short(x: f64) -> String {
    format!("{}", (x * 1e6).round() / 1e6)
}

const STYLE: &str = "\
:root { color-scheme: light dark; --line: color-mix(in srgb, currentColor 18%, transparent); }
body { margin: 0; font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 76rem; margin: 0 auto; padding: 1rem; }
h1 { margin: 0.5rem 0; } h2 { margin: 2rem 0 0.5rem; font-size: 1.2rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.1rem 1rem; font-size: 0.9rem; }
dt { font-weight: 600; } dd { margin: 0; overflow-wrap: anywhere; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25rem 0.6rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th:first-child { text-align: left; position: sticky; left: 0; background: Canvas; }
figure { margin: 2rem 0; overflow-x: auto; }
figure svg { background: white; max-width: 100%; min-width: 34rem; height: auto; }
figcaption { font-size: 0.9rem; }
";
