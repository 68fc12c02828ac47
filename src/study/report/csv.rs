//! `summary.csv`: a line a method and object, `all` for the mean over objects.

use crate::study::design::Design;
use crate::study::summary::{Line, Summary};

const HEAD: &str = "suite,method,object,starts,views_mean,views_lo,views_hi,unfinished,\
    to95_mean,to97_mean,to99_mean,missing97,coverage_mean,right,wrong,undecided\n";

/// The summary. Cells that say nothing of a kind of task are empty.
pub fn csv(design: &Design, summary: &Summary) -> String {
    let mut out = HEAD.to_owned();
    for line in &summary.lines {
        out += &row(design, line);
    }
    out
}

fn row(design: &Design, line: &Line) -> String {
    let arm = &design.arms[line.arm];
    let recognition = design.variant(line.arm).task.goal.confident;
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.4}"));
    let count = |n: usize, shown: bool| if shown { n.to_string() } else { String::new() };
    let views = |of: fn(&crate::study::Interval) -> f64| number(line.views.as_ref().map(of));
    let to = |k: usize| number(line.to[k].map(|i| i.mean));
    let cells = [
        quoted(&design.study.name),
        quoted(&arm.label),
        quoted(&line.object),
        line.starts.to_string(),
        views(|i| i.mean),
        views(|i| i.low),
        views(|i| i.high),
        line.unfinished.to_string(),
        to(0),
        to(1),
        to(2),
        count(line.missing[1], !recognition),
        number(line.coverage),
        count(line.decided[0], recognition),
        count(line.decided[1], recognition),
        count(line.decided[2], recognition),
    ];
    cells.join(",") + "\n"
}

/// A name as a cell: file names may hold anything.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
