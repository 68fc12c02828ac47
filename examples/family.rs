//! A family of objects that nobody tuned anything to, as VPL text on standard output.
//!
//! ```text
//! cargo run --release --example family -- solids [--count N] [--seed S] > solids.vpl
//! cargo run --release --example family -- codes [--classes C] [--features F] [--seed S] > codes.vpl
//! ```
//!
//! `solids` are prisms, frusta and pyramids over n-gons of up to eight sides, dented,
//! notched, stepped, stretched and leaning, some with the colours of both kinds, which
//! are of no class; a study of them runs the rules of `examples/solids/solids.vpl`.
//! `codes` are libraries of 4 to 64 classes told apart by 4 to 24 codes on a drum, with
//! objects of the classes and some of none. The same arguments give the same bytes.

use std::process::ExitCode;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn main() -> ExitCode {
    match text(std::env::args().skip(1)) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

struct Settings {
    count: u64,
    classes: u64,
    features: u64,
    seed: u64,
}

fn text(mut arguments: impl Iterator<Item = String>) -> Result<String, String> {
    let kind = arguments.next().ok_or("`solids` or `codes`?")?;
    let mut settings = Settings {
        count: 24,
        classes: 12,
        features: 8,
        seed: 0,
    };
    while let Some(option) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("`{option}` needs a number"))?;
        let value: u64 = value.parse().map_err(|_| format!("`{value}` is no whole number"))?;
        match option.as_str() {
            "--count" => settings.count = value,
            "--classes" => settings.classes = value,
            "--features" => settings.features = value,
            "--seed" => settings.seed = value,
            _ => return Err(format!("unknown option `{option}`")),
        }
    }
    let random = Pcg64::seed_from_u64(settings.seed);
    let within = |what: &str, value: u64, least: u64, most: u64| match value {
        n if (least..=most).contains(&n) => Ok(()),
        _ => Err(format!("{what} is between {least} and {most}")),
    };
    within("--count", settings.count, 1, 1000)?;
    within("--classes", settings.classes, 4, 64)?;
    within("--features", settings.features, 4, 24)?;
    if (1 << settings.features) < 2 * settings.classes {
        return Err(format!(
            "{} codes cannot tell {} classes apart with some left over",
            settings.features, settings.classes
        ));
    }
    match kind.as_str() {
        "solids" => Ok(solids(&settings, random)),
        "codes" => Ok(codes(&settings, random)),
        _ => Err(format!("`{kind}` is neither `solids` nor `codes`")),
    }
}

// ---- Solids -----------------------------------------------------------------

fn solids(settings: &Settings, mut random: Pcg64) -> String {
    let objects: String = (1..=settings.count).map(|k| solid(k, &mut random)).collect();
    format!(
        "vpl 1\n\n// Written by `family solids --count {} --seed {}`.\n\n\
         scene family {{\n  backdrop sphere(radius: 2 m, colour: grey)\n{objects}}}\n\n\
         /// The rules of the thirteen solids on others.\nstudy family {{\n  program \"../solids/solids.vpl\"\n  \
         task    reconstruct\n  objects {}\n  methods gn, gno, joint, random\n  starts  8\n}}\n",
        settings.count,
        settings.seed,
        (1..=settings.count)
            .map(|k| format!("g{k}"))
            .collect::<Vec<_>>()
            .join(", "),
    )
}

fn solid(number: u64, random: &mut Pcg64) -> String {
    let sides = random.random_range(3..=8);
    let pyramid = random.random_range(0..5) < 2;
    let stranger = random.random_range(0..8) == 0;
    let radius = random.random_range(if pyramid { 165..=220 } else { 125..=165 });
    let height = random.random_range(if pyramid { 170..=260 } else { 200..=290 });
    let mut arguments = vec![format!("sides: {sides}, radius: {radius} mm, height: {height} mm")];
    if random.random_range(0..3) == 0 {
        arguments.push(format!("stretch: 1.{}", random.random_range(1..=3)));
    }
    if random.random_range(0..3) == 0 {
        arguments.push(format!("lean: {} deg", random.random_range(1..=8)));
    }
    if !pyramid && random.random_range(0..2) == 0 {
        // A frustum, upwards or downwards.
        arguments.push(format!("taper: {} deg", random.random_range(-8..=9)));
    }
    if stranger {
        // The colour of the other kind's sides: nothing in the library looks so.
        arguments.push(format!("side: {}", if pyramid { "green" } else { "blue" }));
    }
    let deformed = deformations(sides, pyramid, f64::from(radius), f64::from(height), random);
    let kind = if pyramid { "pyramid" } else { "prism" };
    let (x, y, z) = (
        random.random_range(-15..=15),
        random.random_range(-15..=15),
        random.random_range(292..=312),
    );
    format!(
        "  object g{number} = {kind}({}, deformed: [\n{deformed}  ]) at [{x} mm, {y} mm, {z} mm] turned {} deg\n",
        arguments.join(", "),
        random.random_range(0..360),
    )
}

/// Dents that hide their own walls, grooves, and blocks that stand out like steps; one a
/// side at most, so that none meets another.
fn deformations(sides: u64, pyramid: bool, radius: f64, height: f64, random: &mut Pcg64) -> String {
    let width = 2.0 * radius * (std::f64::consts::PI / sides as f64).sin();
    let mut out = String::new();
    let mut side = random.random_range(1..=sides);
    for _ in 0..random.random_range(2..=4_u64.min(sides)) {
        let kind = random.random_range(0..5);
        let across = (width * if pyramid { 0.4 } else { 0.5 }).min(95.0) as u64;
        let tall = (height * if pyramid { 0.28 } else { 0.42 }).min(115.0) as u64;
        let up = if pyramid { 28 } else { random.random_range(40..=60) };
        let deep = (radius * if pyramid { 0.22 } else { 0.42 }).min(70.0) as u64;
        out += &match kind {
            0 => {
                let narrow = (width * 0.3).min(50.0) as u64;
                format!(
                    "    notch(side: {side}, width: {narrow} mm, depth: {} mm),\n",
                    deep.min(50)
                )
            }
            1 => format!(
                "    bump(side: {side}, up: {} %, width: {across} mm, height: {} mm, depth: {} mm),\n",
                if pyramid { 22 } else { 25 },
                (tall / 2).max(30),
                deep.min(40),
            ),
            _ => format!(
                "    dent(side: {side}, up: {up} %, width: {across} mm, height: {tall} mm, depth: {deep} mm),\n"
            ),
        };
        side = side % sides + 1;
    }
    out
}

// ---- Codes --------------------------------------------------------------------

/// Sides of the drum.
const SIDES: u64 = 8;
/// Radius of the circle through its corners, metres.
const RADIUS: f64 = 0.5;
/// Height of the drum, metres.
const HEIGHT: f64 = 0.7;

fn codes(settings: &Settings, mut random: Pcg64) -> String {
    let (f, classes) = (settings.features, settings.classes);
    let rows = presences(f, classes, &mut random);
    let table = |name: &str, rows: &[u64]| -> String {
        let cells = |row: u64| (0..f).map(|k| format!(" {}", row >> k & 1)).collect::<String>();
        let width = name.len() + rows.len().to_string().len();
        let rows = rows.iter().enumerate();
        rows.map(|(k, row)| format!("    {:<width$} {}\n", format!("{name}{}", k + 1), cells(*row)))
            .collect()
    };
    let (known, strange) = rows.split_at(classes as usize);
    let places: String = (0..f).map(place).collect();
    let objects = |name: &str, library: &str, count: usize, random: &mut Pcg64| -> String {
        let object = |k: usize| {
            let turned = random.random_range(0..360);
            let (x, y) = (random.random_range(-25..=25), random.random_range(-25..=25));
            format!(
                "  object {name}{k} = prism(sides: {SIDES}, radius: {} mm, height: {} mm, bottom: grey, side: grey, top: grey) \
                 at [{x} mm, {y} mm, 600 mm] turned {turned} deg marked {library}.body as {name}{k}\n",
                RADIUS * 1e3,
                HEIGHT * 1e3,
            )
        };
        (1..=count).map(object).collect()
    };
    let of_a_class = objects("c", "family", known.len(), &mut random);
    let of_none = objects("s", "strangers", strange.len(), &mut random);
    format!(
        "vpl 1\n\n// Written by `family codes --classes {classes} --features {f} --seed {}`.\n\n\
         use std.cameras.kinect_v2\nuse std.views.sphere\n\n\
         /// Codes on a drum.\nlibrary drum() {{\n  feature code[1..{f}] : marker\n\n  rule -> code[i] {{\n    \
         detect  qr(text: \"c{{i}}\", size: 150 mm)\n    measure marker_pose()\n  }}\n\n  layout body {{\n{places}  }}\n}}\n\n\
         library family {{\n  use drum()\n\n  classes by code[1..{f}] {{\n{}  }}\n}}\n\n\
         /// What bears these codes and is of no class.\nlibrary strangers {{\n  use drum()\n\n  \
         classes by code[1..{f}] {{\n{}  }}\n}}\n\n\
         task recognise {{\n  library    family\n  goal       confident\n  camera     kinect_v2\n  \
         space      cube(1.2 m) at [0 mm, 0 mm, 600 mm] voxel 20 mm\n  \
         views      sphere(radius: 1.65 m, count: 64)\n  \
         thresholds {{ near: 30 mm, absent: 95 %, confidence: 99 % }}\n  limit      20 views\n}}\n\n\
         scene workshop {{\n  backdrop sphere(radius: 2 m, colour: grey)\n{of_a_class}{of_none}}}\n\n\
         study family {{\n  methods gn, joint, random\n  starts  16\n}}\n",
        settings.seed,
        table("c", known),
        table("s", strange),
    )
}

/// Which codes the classes have, a bit each, and a quarter more that are of no class. All
/// differ; every code is on some class and missing on another, and on some of no class.
fn presences(features: u64, classes: u64, random: &mut Pcg64) -> Vec<u64> {
    let every = (1_u64 << features) - 1;
    loop {
        let mut rows: Vec<u64> = Vec::new();
        while (rows.len() as u64) < classes + classes.div_ceil(4).max(2) {
            let row: u64 = random.random_range(1..=every);
            if row.count_ones() >= 2 && !rows.contains(&row) {
                rows.push(row);
            }
        }
        let (known, strange) = rows.split_at(classes as usize);
        let some = |rows: &[u64]| rows.iter().fold(0, |some, row| some | row);
        let all = known.iter().fold(every, |all, row| all & row);
        if some(known) == every && all == 0 && some(strange) == every {
            return rows;
        }
    }
}

/// Two codes a side, above each other; then the top and the bottom.
fn place(code: u64) -> String {
    let apothem = RADIUS * (std::f64::consts::PI / SIDES as f64).cos() + 0.003;
    // Round the drum in steps of three sides, so that few codes are spread out.
    let side = code * 3 % SIDES;
    let mm = |x: f64| format!("{:.1} mm", x * 1e3);
    let ([x, y, z], facing) = if code < 2 * SIDES {
        let angle = side as f64 * std::f64::consts::TAU / SIDES as f64;
        let up = if (code / SIDES + side).is_multiple_of(2) {
            0.17
        } else {
            -0.17
        };
        let facing = format!("[{:.6}, {:.6}, 0]", angle.cos(), angle.sin());
        ([apothem * angle.cos(), apothem * angle.sin(), up], facing)
    } else {
        let k = code - 2 * SIDES;
        let corner = (k / 2) as f64 * std::f64::consts::FRAC_PI_2;
        let z = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let at = [0.24 * corner.cos(), 0.24 * corner.sin(), z * (HEIGHT / 2.0 + 0.003)];
        (at, if z > 0.0 { "+z".to_owned() } else { "-z".to_owned() })
    };
    format!(
        "    code[{}] at [{}, {}, {}] facing {facing}\n",
        code + 1,
        mm(x),
        mm(y),
        mm(z)
    )
}
