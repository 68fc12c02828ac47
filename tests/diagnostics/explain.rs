//! `vpl explain`.

use vpl::lang::{self, Code, title};

use super::support::*;

#[test]
fn a_code_is_explained_whatever_its_capitals() {
    let ran = vpl(&["explain", "e0302"]);
    assert_eq!(ran.status.code(), Some(0));
    assert_eq!(out(&ran), lang::explain(Code::E0302, false));
    insta::assert_snapshot!("explain_E0302", out(&ran));
}

#[test]
fn every_page_reads_as_text() {
    for code in Code::ALL {
        let text = lang::explain(*code, false);
        assert!(text.starts_with(&format!("{code}: {}\n", title(*code))), "{code}");
        let marked = text
            .lines()
            .find(|line| line.starts_with("```") || line.starts_with('#') || line.contains("]("));
        assert_eq!(marked, None, "{code}: Markdown is left");
        let coloured = lang::explain(*code, true);
        assert!(coloured.starts_with("\u{1b}[1m"), "{code}");
    }
}

#[test]
fn without_a_code_all_are_listed() {
    let ran = vpl(&["explain"]);
    assert_eq!(out(&ran).lines().count(), Code::ALL.len());
    assert!(out(&ran).contains("E0401  two classes that nothing tells apart\n"));
}

#[test]
fn an_unknown_code_names_those_near_it() {
    let unknown = |code: &str, near: &str| {
        let ran = vpl(&["explain", code]);
        assert_eq!(ran.status.code(), Some(2));
        assert!(err(&ran).contains(near), "{}", err(&ran));
    };
    unknown("W0301", "near it are `E0301`");
    unknown("302", "near it are `E0302`");
    unknown("E9999999999999999", "`vpl explain` lists all");
    unknown("units", "`vpl explain` lists all");
}
