//! The page that `--report` writes: what it holds, and that a browser draws it.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::support::*;

/// A tank recognised in three views, and its page.
fn recognised(test: &str) -> (PathBuf, String) {
    let folder = folder(test);
    let options = [TANKS, "--object", "tk9", "--start", "40", "--report", "run.html"];
    plan(&folder, &options).expect(0, &[]);
    let page = fs::read_to_string(folder.join("run.html")).unwrap();
    (folder, page)
}

fn data(page: &str) -> Value {
    let (_, rest) = page
        .split_once("<script id=\"data\" type=\"application/json\">")
        .unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_report_holds_the_run_and_loads_nothing() {
    let (_, page) = recognised("report");
    let run = data(&page);
    assert_eq!(run["head"]["object"], "tk9");
    assert_eq!((&run["end"]["class"], &run["end"]["views"]), (&"tk9".into(), &3.into()));
    assert_eq!(run["candidates"].as_array().unwrap().len(), 64);
    let frames = run["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 3);
    let taken: Vec<&Value> = frames.iter().map(|f| &f["view"]["view"]).collect();
    assert_eq!(taken, [40, 45, 37]);

    let first = &frames[0];
    assert_eq!(first["found"][0]["feature"], "code[2]");
    assert_eq!(first["found"][0]["outlines"][0].as_array().unwrap().len(), 5);
    let predicted = first["predicted"].as_array().unwrap();
    assert!(
        predicted
            .iter()
            .any(|p| p["feature"] == "code[3]" && !p["open"].as_array().unwrap().is_empty())
    );
    assert_eq!(first["gains"].as_array().unwrap().len(), 63);
    assert_eq!(first["picture"]["marks"][0]["feature"], "code[2]");
    assert_eq!(first["picture"]["marks"][0]["new"], true);

    let columns = ["x", "y", "z", "colour", "from", "to"].map(|c| run["surface"][c].as_array().unwrap().len());
    assert!(columns[0] > 1000 && columns.iter().all(|n| *n == columns[0]));
    let from: BTreeSet<u64> = run["surface"]["from"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(Value::as_u64)
        .collect();
    assert_eq!(from, BTreeSet::from([0, 1, 2]));

    assert!(page.contains("default-src 'none'"));
    for loading in ["<link", "<script src", "<img src=\"http", "@import"] {
        assert!(!page.contains(loading), "{loading}");
    }
}

#[test]
fn a_report_that_cannot_be_written_loses_nothing() {
    if !Path::new("/dev/full").exists() {
        eprintln!("SKIPPED: there is no /dev/full here");
        return;
    }
    let folder = folder("report_full");
    let options = [SOLIDS, "--object", "m2", "--log", "run.jsonl", "--report", "/dev/full"];
    plan(&folder, &options).expect(1, &["error[E0601]", "`/dev/full`"]);
    assert_eq!(records(&folder.join("run.jsonl")).last().unwrap()["outcome"], "goal");
    plan(&folder, &[SOLIDS, "--map", "a", "--report", "./a"]).expect(2, &["`--report ./a` would overwrite `a`"]);
}

/// A browser of the machine that can be run without a screen.
fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names.into_iter().find(|name| {
        Command::new(name)
            .arg("--version")
            .output()
            .is_ok_and(|o| o.status.success())
    })
}

/// Loads a page without a screen or a network.
fn browse(browser: &str, folder: &Path, size: &str, page: &str, more: &[&str]) -> String {
    let profile = folder.join("profile");
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--hide-scrollbars",
            "--enable-unsafe-swiftshader",
        ])
        .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=20000"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("--window-size={size}"))
        .args(more)
        .arg(format!("file://{}/{page}", folder.display()))
        .output()
        .unwrap();
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What the page's script says of itself, `data-NAME` of its body.
#[track_caller]
fn told(dom: &str, name: &str) -> Option<usize> {
    let (_, rest) = dom.split_once(&format!("data-{name}=\""))?;
    rest.split_once('"')?.0.parse().ok()
}

/// Colours of a picture, each channel by its upper five bits.
fn colours(path: &Path) -> usize {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap()))
        .read_info()
        .unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut bytes).unwrap();
    let pixels = bytes[..frame.buffer_size()].chunks(frame.color_type.samples());
    pixels
        .map(|p| [p[0] >> 3, p[1] >> 3, p[2] >> 3])
        .collect::<BTreeSet<_>>()
        .len()
}

#[test]
fn a_browser_draws_the_report_at_any_width() {
    let Some(browser) = browser() else {
        eprintln!("SKIPPED: no Chromium here; the report is not drawn");
        return;
    };
    let (folder, _) = recognised("report_drawn");
    let mut shown = Vec::new();
    for view in [1, 3] {
        let dom = browse(
            browser,
            &folder,
            "1280,900",
            &format!("run.html#view={view}"),
            &["--dump-dom"],
        );
        assert!(
            !dom.contains("data-error"),
            "{:?}",
            dom.split_once("data-error").map(|(_, rest)| &rest[..80])
        );
        assert_eq!(told(&dom, "shown"), Some(view));
        assert!(told(&dom, "traces").unwrap() >= 5);
        assert!(dom.contains("<polygon") && dom.contains("class=\"chosen\"") == (view == 1));
        shown.push(told(&dom, "surface").unwrap());
    }
    assert!(
        0 < shown[0] && shown[0] < shown[1],
        "the slider moves the scene: {shown:?}"
    );
    for size in ["1280,900", "390,844"] {
        let picture = folder.join(format!("{size}.png"));
        browse(
            browser,
            &folder,
            size,
            "run.html",
            &[&format!("--screenshot={}", picture.display())],
        );
        assert!(colours(&picture) > 50, "{size} is blank");
    }
}
