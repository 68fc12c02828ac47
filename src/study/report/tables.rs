//! The tables of a study.

use super::table::Table;
use crate::study::design::{Design, Kind};
use crate::study::published::Published;
use crate::study::statistics::Interval;
use crate::study::summary::{ALL, Line, Summary, is_method};

/// All tables, in the order in which they are read.
pub fn tables(design: &Design, summary: &Summary, published: Option<&Published>) -> Vec<Table> {
    let mut out = vec![overview(design, summary)];
    out.push(by_object(design, summary, "Views to the stop", |line| line.views));
    if !design.is_recognition() {
        out.push(by_object(design, summary, "Views to 97 % coverage", |line| line.to[1]));
    }
    out.extend(published.map(theirs));
    out.push(paired(design, summary));
    out.push(outcomes(design, summary));
    out
}

fn overview(design: &Design, summary: &Summary) -> Table {
    let lines: Vec<&Line> = (0..design.arms.len())
        .filter_map(|arm| summary.line(arm, ALL))
        .collect();
    let mut table = Table {
        title: format!("{}: all objects", design.study.name),
        note: "Means over objects and starts with 95 % bootstrap intervals. ".to_owned(),
        ..Table::default()
    };
    if design.is_recognition() {
        table.note += "`× bound` divides by the best adaptive policy, which is told layout and pose; `from first \
            code` counts from the view that first decoded one, beside the best that was possible from there.";
        table.head = strings(&[
            "method",
            "runs",
            "views",
            "× bound",
            "from first code",
            "best",
            "×",
            "right",
            "wrong",
            "undecided",
            "path",
        ]);
        table.rows = lines.iter().map(|line| recognised(design, summary, line)).collect();
    } else {
        table.note += "A run without a stop of its own is unfinished and counts the limit, as does one that never \
            came to a coverage (missing). `× bound` divides views to 97 % by the fewest from the same start. The \
            bound and the oracle know the shape and stop at 97 %.";
        table.head = strings(&[
            "method",
            "runs",
            "views",
            "to 95 %",
            "to 97 %",
            "to 99 %",
            "missing 97 %",
            "× bound",
            "coverage",
            "area",
            "path",
            "unfinished",
        ]);
        table.rows = lines.iter().map(|line| reconstructed(design, summary, line)).collect();
    }
    table
}

fn reconstructed(design: &Design, summary: &Summary, line: &Line) -> Vec<String> {
    let bound = bound_of(design, line.arm).and_then(|arm| summary.line(arm, ALL)?.to[1]);
    let ratio = line.to[1].zip(bound).map(|(own, bound)| own.mean / bound.mean);
    let to = |k: usize| line.to[k].map_or(dash(), |i| format!("{:.2}", i.mean));
    vec![
        design.arms[line.arm].label.clone(),
        line.runs.to_string(),
        interval(line.views),
        to(0),
        interval(line.to[1]),
        to(2),
        line.missing[1].to_string(),
        ratio.map_or(dash(), |r| format!("{r:.2}")),
        line.coverage.map_or(dash(), |c| format!("{:.1} %", c * 100.0)),
        line.area.map_or(dash(), |a| format!("{a:.3}")),
        line.path.map_or(dash(), |p| format!("{p:.2} m")),
        line.unfinished.to_string(),
    ]
}

fn recognised(design: &Design, summary: &Summary, line: &Line) -> Vec<String> {
    let bound = bound_of(design, line.arm).and_then(|arm| summary.line(arm, ALL)?.views);
    let ratio = line.views.zip(bound).map(|(own, bound)| own.mean / bound.mean);
    let first = line.from_first;
    vec![
        design.arms[line.arm].label.clone(),
        line.runs.to_string(),
        interval(line.views),
        ratio.map_or(dash(), |r| format!("{r:.2}")),
        first.map_or(dash(), |(own, _)| interval(Some(own))),
        first.map_or(dash(), |(_, best)| format!("{best:.2}")),
        first.map_or(dash(), |(own, best)| format!("{:.2}", own.mean / best)),
        line.decided[0].to_string(),
        line.decided[1].to_string(),
        line.decided[2].to_string(),
        line.path.map_or(dash(), |p| format!("{p:.2} m")),
    ]
}

/// The bound of the same variant, or the study's own where it has none.
fn bound_of(design: &Design, arm: usize) -> Option<usize> {
    let bounds = || (0..design.arms.len()).filter(|k| design.arms[*k].kind == Kind::Bound);
    bounds()
        .find(|k| design.arms[*k].variant == design.arms[arm].variant)
        .or_else(|| bounds().next())
}

fn by_object(design: &Design, summary: &Summary, title: &str, of: fn(&Line) -> Option<Interval>) -> Table {
    let objects: Vec<&str> = design.study.objects.iter().map(|s| s.object.name.as_str()).collect();
    let columns = || objects.iter().copied().chain([ALL]);
    let rows = (0..design.arms.len()).map(|arm| {
        let cell = |object| {
            summary
                .line(arm, object)
                .and_then(of)
                .map_or(dash(), |i| format!("{:.2}", i.mean))
        };
        let name = design.arms[arm].label.clone();
        std::iter::once(name).chain(columns().map(cell)).collect()
    });
    Table {
        title: title.to_owned(),
        note: format!("Means over {} starts an object.", design.study.starts),
        head: std::iter::once("method").chain(columns()).map(str::to_owned).collect(),
        rows: rows.collect(),
    }
}

/// The numbers of others, with nothing of ours in it.
fn theirs(published: &Published) -> Table {
    let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len().max(1) as f64;
    let rows = published.rows.iter().map(|(method, numbers)| {
        let cells = numbers.iter().map(|x| x.to_string());
        let mut row = vec![method.clone()];
        row.extend(cells);
        row.push(format!("{:.2}", mean(numbers)));
        row
    });
    let mut head = vec!["method".to_owned()];
    head.extend(published.objects.iter().cloned());
    head.push("mean".to_owned());
    Table {
        title: "The paper's numbers".to_owned(),
        note: format!("{} Not ours: other objects, views and sizes.", published.source),
        head,
        rows: rows.collect(),
    }
}

fn paired(design: &Design, summary: &Summary) -> Table {
    let first = design.arms.first().map_or("", |arm| arm.label.as_str());
    let said = |i: Option<Interval>| {
        i.map_or(dash(), |i| {
            let mark = if i.excludes_zero() { "" } else { " (0 inside)" };
            format!("{:+.2} [{:+.2}, {:+.2}]{mark}", i.mean, i.low, i.high)
        })
    };
    let mut head = strings(&["method", "pairs", "views to the stop"]);
    if !design.is_recognition() {
        head.push("views to 97 %".to_owned());
    }
    let rows = summary.paired.iter().map(|p| {
        let mut row = vec![design.arms[p.arm].label.clone(), p.pairs.to_string(), said(p.views)];
        if !design.is_recognition() {
            row.push(said(p.to97));
        }
        row
    });
    Table {
        title: format!("More views than {first}"),
        note: "Paired differences on the same object from the same start, with 95 % bootstrap intervals.".to_owned(),
        head,
        rows: rows.collect(),
    }
}

fn outcomes(design: &Design, summary: &Summary) -> Table {
    let lines: Vec<&Line> = (0..design.arms.len())
        .filter_map(|arm| summary.line(arm, ALL))
        .collect();
    let mut names: Vec<String> = lines
        .iter()
        .filter(|line| is_method(design, line.arm))
        .flat_map(|line| line.outcomes.keys().cloned())
        .collect();
    names.sort();
    names.dedup();
    let rows = lines.iter().filter(|line| is_method(design, line.arm)).map(|line| {
        let mut row = vec![design.arms[line.arm].label.clone(), line.runs.to_string()];
        row.extend(
            names
                .iter()
                .map(|n| line.outcomes.get(n).copied().unwrap_or(0).to_string()),
        );
        row
    });
    let open: usize = lines.iter().map(|line| line.open).sum();
    let note = match open {
        0 => "Every bound is exact.".to_owned(),
        n => format!("{n} bounds are not proven to be reached: they hold, and more may be needed."),
    };
    let mut head = strings(&["method", "runs"]);
    head.extend(names.iter().cloned());
    Table {
        title: "How runs ended".to_owned(),
        note,
        head,
        rows: rows.collect(),
    }
}

fn interval(i: Option<Interval>) -> String {
    i.map_or(dash(), |i| format!("{:.2} [{:.2}, {:.2}]", i.mean, i.low, i.high))
}

fn dash() -> String {
    "–".to_owned()
}

fn strings(words: &[&str]) -> Vec<String> {
    words.iter().map(|w| (*w).to_owned()).collect()
}
