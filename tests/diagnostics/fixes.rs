//! Fixes: each removes its diagnostic, and all together never do harm.

use std::fs;
use std::path::Path;

use vpl::lang::{self, Code, Compilation, Diagnostic, Edit, Memory, Severity, World};

use super::support::*;

/// The folders of programs that something is wrong with.
const WRONG: &[&str] = &["tests/ui", "tests/broken"];

/// A program of one file as it would be.
struct With<'a> {
    path: &'a str,
    text: String,
    world: &'a dyn World,
}

impl World for With<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, lang::ReadFailure> {
        match path == self.path {
            true => Ok(self.text.clone().into_bytes()),
            false => self.world.read(path),
        }
    }
}

fn errors(compilation: &Compilation) -> usize {
    let all = compilation.diagnostics.iter();
    all.filter(|d| d.severity == Severity::Error).count()
}

/// Whether a diagnostic is still said of the same place, after edits of its file.
fn is_still_there(d: &Diagnostic, edits: &[Edit], after: &Compilation) -> bool {
    let before = edits
        .iter()
        .filter(|e| e.span.end <= d.primary.span.start && e.span.start < d.primary.span.start);
    let place = before.fold(d.primary.span.start, |at, e| {
        at + e.text.len() - (e.span.end - e.span.start)
    });
    let mut all = after.diagnostics.iter();
    all.any(|a| a.code == d.code && a.message == d.message && a.primary.span.start == place)
}

#[test]
fn every_fix_applied_alone_removes_its_diagnostic() {
    let mut wrong = Vec::new();
    for folder in WRONG {
        let world = Folder(folder.into());
        for name in programs(folder) {
            let before = lang::compile(&name, &world);
            for (d, fix) in before
                .diagnostics
                .iter()
                .flat_map(|d| d.fixes.iter().map(move |fix| (d, fix)))
            {
                let file = before.sources.get(fix.edits[0].span.file).unwrap();
                let text = lang::edited(&file.text, &fix.edits).expect("edits that can be made");
                let path = &file.display;
                let world = With {
                    path,
                    text,
                    world: &world,
                };
                if is_still_there(d, &fix.edits, &lang::compile(&name, &world)) {
                    wrong.push(format!(
                        "{folder}/{name}: `{}` is still there after `{}`",
                        d.message, fix.message
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Who is told another word can have it written.
#[test]
fn every_did_you_mean_comes_with_its_fix() {
    for folder in WRONG {
        let world = Folder(folder.into());
        for name in programs(folder) {
            for d in lang::compile(&name, &world).diagnostics {
                let asked = d.help.as_ref().is_some_and(|help| help.starts_with("did you mean"));
                assert!(
                    !asked || !d.fixes.is_empty(),
                    "{folder}/{name}: `{}` has no fix",
                    d.message
                );
            }
        }
    }
}

#[test]
fn repair_never_makes_more_errors_and_ends() {
    for folder in WRONG {
        let world = Folder(folder.into());
        for name in programs(folder) {
            let before = lang::compile(&name, &world);
            let repaired = lang::repair(&name, &world);
            let (then, now) = (errors(&before), errors(&repaired.compilation));
            assert!(now <= then, "{folder}/{name}: {then} errors became {now}");
            if let Some(text) = repaired.text {
                let world = With {
                    path: &name,
                    text: text.clone(),
                    world: &world,
                };
                let again = lang::repair(&name, &world);
                assert_eq!(again.text, Some(text), "{folder}/{name}: not repaired to the end");
            }
        }
    }
}

fn repaired(text: &str) -> (String, Vec<Code>) {
    let repaired = lang::repair("m", &Memory::of("m", text));
    let codes = repaired.applied.iter().map(|fix| fix.code).collect();
    (repaired.text.unwrap(), codes)
}

#[test]
fn one_round_makes_what_the_next_needs() {
    let text = "let a = ring(radius = 1.5 metres, count: 8, elevation: 0 deg)\n";
    let (text, codes) = repaired(text);
    assert_eq!(
        text,
        "vpl 1\n\nuse std.views.ring\n\nlet a = ring(radius : 1.5 m, count: 8, elevation: 0 deg)\n"
    );
    assert_eq!(codes, [Code::E0102, Code::E0109, Code::E0302, Code::E0203]);
}

#[test]
fn the_same_import_is_added_once() {
    let (text, _) = repaired("vpl 1\nlet a = sphere(1 m, 8)\nlet b = sphere(2 m, 8)\n");
    assert_eq!(text.matches("use std.views.sphere").count(), 1);
}

/// A name that is unknown twice is reported once, then at the other place.
#[test]
fn a_slip_made_twice_is_repaired_twice() {
    let text = fs::read_to_string("tests/ui/E0207_unknown_feature.vpl").unwrap();
    assert_eq!(text.matches("lefft").count(), 2);
    let (after, codes) = repaired(&text);
    assert_eq!(after, text.replace("lefft", "left"));
    assert_eq!(codes, [Code::E0207, Code::E0207]);
}

/// The unit would be right for the type and wrong for the task: all views would lie
/// in the space, which is an error that was not there.
#[test]
fn a_fix_that_adds_an_error_is_not_made() {
    let text = fs::read_to_string("tests/ui/E0403_views_in_the_space.vpl").unwrap();
    let text = text.replace("400 mm", "400");
    let before = lang::compile("m", &Memory::of("m", &text));
    assert!(!before.diagnostics[0].fixes.is_empty());
    let (after, codes) = repaired(&text);
    assert_eq!((after, codes), (text, vec![]));
}

#[test]
fn a_bad_fix_holds_up_no_good_one() {
    let text = fs::read_to_string("tests/ui/E0403_views_in_the_space.vpl").unwrap();
    let text = text
        .replace("400 mm", "400")
        .replace("goal confident", "goal: confident");
    let (after, codes) = repaired(&text);
    assert_eq!(after, text.replace("goal:", "goal"));
    assert_eq!(codes, [Code::E0109]);
}

#[test]
fn what_is_imported_is_left_alone() {
    let mut world = Memory::of("m", "vpl 1\nuse \"part.vpl\".a\n");
    let part = b"vpl 1\nlet a = 3 metres\n".to_vec();
    world.0.insert("part.vpl".into(), part);
    let repaired = lang::repair("m", &world);
    assert!(repaired.applied.is_empty());
    assert_eq!(errors(&repaired.compilation), 1);
}

#[test]
fn what_cannot_be_read_has_no_repair() {
    for bytes in [&b"vpl 1\nlet a = \xff\n"[..], b""] {
        let mut world = Memory::default();
        world.0.insert("m".into(), bytes.to_vec());
        let repaired = lang::repair("m", &world);
        assert!(repaired.applied.is_empty());
        assert_eq!(errors(&repaired.compilation), 1);
    }
    assert_eq!(lang::repair("m", &Memory::default()).text, None);
}

// ---- Through the binary ------------------------------------------------------

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn check_with_fix_writes_the_file_and_reports_what_remains() {
    let folder = folder("fix");
    let file = write(&folder, "a.vpl", "vpl 1\nlet a = 3 metres\nlet b = nothing\n");
    let ran = vpl(&["check", "--fix", "--format", "short", &file]);
    assert_eq!(
        err(&ran),
        format!(
            "{file}:2:11: fixed[E0302]: write `m`\nfixed 1 in {file}\n\
             {file}:3:9: error[E0201]: there is no `nothing` here\n1 error in 1 file\n"
        )
    );
    assert_eq!(ran.status.code(), Some(1));
    assert_eq!(
        fs::read_to_string(&file).unwrap(),
        "vpl 1\nlet a = 3 m\nlet b = nothing\n"
    );
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "a temporary file is left");
    let file = write(&folder, "b.vpl", "vpl 1\nlet a = 3 metres\n");
    let ran = vpl(&["check", "--fix", &file]);
    assert_eq!(ran.status.code(), Some(0), "{}", err(&ran));
}

#[test]
fn what_needs_no_fix_is_not_written() {
    let folder = folder("unfixed");
    let file = write(&folder, "a.vpl", "vpl 1\nlet a = 3 m\n");
    let before = fs::metadata(&file).unwrap().modified().unwrap();
    let ran = vpl(&["check", "--fix", &file]);
    assert_eq!(err(&ran), "no errors in 1 file\n");
    assert_eq!(fs::metadata(&file).unwrap().modified().unwrap(), before);
}

#[test]
fn standard_input_is_fixed_on_standard_output() {
    let ran = vpl_with(
        &["check", "--fix", "--format", "short", "-"],
        b"vpl 1\nlet a = 3 metres\n",
    );
    assert_eq!(out(&ran), "vpl 1\nlet a = 3 m\n");
    assert_eq!(
        err(&ran),
        "-:2:11: fixed[E0302]: write `m`\nfixed 1 in -\nno errors in 1 file\n"
    );
    let both = vpl_with(&["check", "--fix", "--format", "json", "-"], b"vpl 1\n");
    assert_eq!(both.status.code(), Some(2));
    assert!(out(&both).is_empty());
}

#[cfg(unix)]
#[test]
fn a_fixed_file_keeps_its_permissions_and_a_link_its_target() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder("permissions");
    let file = write(&folder, "a.vpl", "vpl 1\nlet a = 3 metres\n");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    let link = folder.join("link.vpl");
    symlink("a.vpl", &link).unwrap();
    vpl(&["check", "--fix", link.to_str().unwrap()]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "vpl 1\nlet a = 3 m\n");
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());

    let text = "vpl 1\nlet a = 3 metres\n";
    fs::write(&file, text).unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o440)).unwrap();
    let ran = vpl(&["check", "--fix", &file]);
    assert_eq!(ran.status.code(), Some(1));
    assert!(err(&ran).contains("error[E0601]"), "{}", err(&ran));
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
}
