//! Finder patterns: the three nested squares, dark 1 : light 1 : dark 3 : 1 : 1.

use super::patch::Patch;

/// A finder pattern in patch coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Finder {
    /// Column of its centre.
    pub x: f64,
    /// Row of its centre.
    pub y: f64,
    /// Edge of a module, pixels.
    pub module: f64,
    /// Rows that met it.
    hits: f64,
}

/// How far a run may be off its nominal length, modules.
const RUN_WITHIN: f64 = 0.7;
/// Rows that must meet a pattern, in units of its modules.
const LEAST_HITS: f64 = 0.5;
/// A pixel is dark below this share of its surroundings.
const DARK: f64 = 0.92;
/// Most patterns considered, the best met first.
const MOST: usize = 24;

/// Finder patterns of a patch, those that most rows met first.
pub fn finders(patch: &Patch) -> Vec<Finder> {
    let dark = darkness(patch);
    let mut found: Vec<Finder> = Vec::new();
    for y in 0..patch.height {
        let row = &dark[y * patch.width..(y + 1) * patch.width];
        for (x, _) in patterns(row) {
            if let Some(finder) = confirmed(patch, &dark, x, y) {
                add(&mut found, finder);
            }
        }
    }
    found.retain(|f| f.hits >= LEAST_HITS * f.module);
    found.sort_by(|a, b| b.hits.total_cmp(&a.hits));
    found.truncate(MOST);
    found
}

/// Means of the meetings of one pattern.
fn add(found: &mut Vec<Finder>, new: Finder) {
    let close = |f: &&mut Finder| (f.x - new.x).hypot(f.y - new.y) < 2.0 * f.module.min(new.module);
    match found.iter_mut().find(close) {
        Some(f) => {
            let mean = |a: f64, b: f64| (a * f.hits + b) / (f.hits + 1.0);
            *f = Finder {
                x: mean(f.x, new.x),
                y: mean(f.y, new.y),
                module: mean(f.module, new.module),
                hits: f.hits + 1.0,
            };
        }
        None => found.push(new),
    }
}

/// Checks a pattern met in row `y` about column `x` in the column, then in the row of its middle.
fn confirmed(patch: &Patch, dark: &[bool], x: f64, y: usize) -> Option<Finder> {
    let column = |x: usize| -> Vec<bool> { (0..patch.height).map(|v| dark[v * patch.width + x]).collect() };
    let (middle_y, tall) = around(&column(x as usize), y)?;
    let row = middle_y as usize;
    let (middle_x, wide) = around(&dark[row * patch.width..(row + 1) * patch.width], x as usize)?;
    let square = (0.6..1.65).contains(&(wide / tall));
    square.then(|| Finder {
        x: middle_x,
        y: middle_y,
        module: (wide + tall) / 14.0,
        hits: 1.0,
    })
}

/// The pattern on a line that has `at` in its middle run: centre and length, pixels.
fn around(line: &[bool], at: usize) -> Option<(f64, f64)> {
    if !*line.get(at)? {
        return None;
    }
    let run = |mut k: i64, step: i64, wanted: bool| {
        let from = k;
        while k >= 0 && (k as usize) < line.len() && line[k as usize] == wanted {
            k += step;
        }
        (k - from).abs()
    };
    let at = at as i64;
    let (up, down) = (run(at, -1, true), run(at, 1, true));
    let light_up = run(at - up, -1, false);
    let light_down = run(at + down, 1, false);
    let dark_up = run(at - up - light_up, -1, true);
    let dark_down = run(at + down + light_down, 1, true);
    let runs = [dark_up, light_up, up + down - 1, light_down, dark_down];
    if !proportioned(runs.map(|r| r as f64)) {
        return None;
    }
    let start = at - up - light_up - dark_up + 1;
    let length = runs.iter().sum::<i64>() as f64;
    Some((start as f64 + length / 2.0, length))
}

/// Patterns along a line: centre and length, pixels.
fn patterns(line: &[bool]) -> Vec<(f64, f64)> {
    let mut starts = vec![0];
    starts.extend((1..line.len()).filter(|&k| line[k] != line[k - 1]));
    starts.push(line.len());
    starts
        .windows(6)
        .filter(|s| line[s[0]])
        .filter(|s| proportioned([0, 1, 2, 3, 4].map(|k| (s[k + 1] - s[k]) as f64)))
        .map(|s| ((s[2] + s[3]) as f64 / 2.0, (s[5] - s[0]) as f64))
        .collect()
}

fn proportioned(runs: [f64; 5]) -> bool {
    let module = runs.iter().sum::<f64>() / 7.0;
    let slack = RUN_WITHIN * module;
    module >= 1.0
        && [1.0, 1.0, 3.0, 1.0, 1.0].iter().zip(runs).all(|(nominal, run)| {
            let allowed = if *nominal > 1.0 { 1.5 * slack } else { slack };
            run > 0.0 && (run - nominal * module).abs() <= allowed
        })
}

/// Whether each pixel is darker than its surroundings.
fn darkness(patch: &Patch) -> Vec<bool> {
    let (w, h) = (patch.width, patch.height);
    let radius = (w.min(h) / 8).max(24);
    let sums = integral(patch);
    let mut dark = vec![false; w * h];
    for y in 0..h {
        let (top, bottom) = (y.saturating_sub(radius), (y + radius + 1).min(h));
        for x in 0..w {
            let (left, right) = (x.saturating_sub(radius), (x + radius + 1).min(w));
            let at = |u: usize, v: usize| sums[v * (w + 1) + u];
            let sum = at(right, bottom) + at(left, top) - at(left, bottom) - at(right, top);
            let area = ((right - left) * (bottom - top)) as f64;
            dark[y * w + x] = f64::from(patch.values[y * w + x]) * area < DARK * sum as f64;
        }
    }
    dark
}

/// Summed brightness above and left of each grid corner.
fn integral(patch: &Patch) -> Vec<u64> {
    let (w, h) = (patch.width, patch.height);
    let mut sums = vec![0_u64; (w + 1) * (h + 1)];
    for y in 0..h {
        let mut row = 0;
        for x in 0..w {
            row += u64::from(patch.values[y * w + x]);
            sums[(y + 1) * (w + 1) + x + 1] = sums[y * (w + 1) + x + 1] + row;
        }
    }
    sums
}
