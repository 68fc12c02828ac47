//! The pages of the codes: their form, their programs, and their index.

use std::collections::BTreeMap;

use vpl::facts;
use vpl::lang::{self, Code, Memory, Severity, title};

/// Codes that no single text gives: files, bytes, runs.
const FROM_OUTSIDE: &[&str] = &[
    "E0105", "E0106", "E0107", "E0503", "E0504", "E0601", "E0602", "E0603", "E0604", "E0605", "E0611", "E0612",
    "E0711", "E0712", "E0713", "E0714",
];

const FORM: &str = "docs/diagnostics/CODE.md is: `# CODE: title` with the title of codes.rs, a few words on \
    what it means and the way out, `## Fails` with one ```vpl block that gives the code, `## Fixed` with one \
    ```vpl block that gives it no more and has no errors, and `## See also` if there is something. A code that no \
    single text gives has ```sh blocks instead, and stands in FROM_OUTSIDE of this test";

/// A page taken apart: what stands under each heading, and the fenced block there.
struct Page<'a> {
    title: &'a str,
    sections: BTreeMap<&'a str, &'a str>,
}

impl<'a> Page<'a> {
    fn of(code: Code) -> Page<'static> {
        let text = lang::page(code);
        let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
        let mut parts = rest.split("\n## ");
        let mut sections: BTreeMap<&str, &str> = [("", parts.next().unwrap_or(""))].into();
        sections.extend(parts.filter_map(|part| part.split_once('\n')));
        Page { title: first, sections }
    }

    /// The one block of a language in a section.
    fn block(&self, section: &str, language: &str) -> Option<&'a str> {
        let text = self.sections.get(section)?;
        let (_, block) = text.split_once(&format!("```{language}\n"))?;
        let end = if block.starts_with("```") {
            0
        } else {
            block.find("\n```")? + 1
        };
        (text.matches("```").count() == 2).then_some(&block[..end])
    }
}

/// The codes that a program and its facts give, and whether it compiles.
fn codes(text: &str) -> (Vec<Code>, bool) {
    let compiled = lang::compile("main.vpl", &Memory::of("main.vpl", text));
    let mut codes: Vec<Code> = compiled.diagnostics.iter().map(|d| d.code).collect();
    if let Some(rules) = &compiled.rules {
        let failed = facts::run(rules, &compiled.facts)
            .into_iter()
            .flat_map(|verdict| verdict.failures);
        codes.extend(failed.map(|_| Code::E0701));
    }
    (codes, compiled.rules.is_some())
}

/// Panics with everything that is wrong, and with what is right.
#[track_caller]
fn nothing_wrong(wrong: &[String]) {
    assert!(wrong.is_empty(), "\n{}\n\n{FORM}", wrong.join("\n"));
}

fn is_from_outside(code: Code) -> bool {
    FROM_OUTSIDE.contains(&code.as_str())
}

#[test]
fn every_page_has_its_title_and_its_sections() {
    let mut wrong = Vec::new();
    for code in Code::ALL {
        let page = Page::of(*code);
        let title = format!("# {code}: {}", title(*code));
        if page.title != title {
            wrong.push(format!("{code}: the first line is `{title}`"));
        }
        if page.sections[""].trim().len() < 80 {
            wrong.push(format!("{code}: say what it means"));
        }
        let language = if is_from_outside(*code) { "sh" } else { "vpl" };
        for section in ["Fails", "Fixed"] {
            if page.block(section, language).is_none() {
                wrong.push(format!("{code}: `## {section}` has one block of {language}"));
            }
        }
        let mut lines = lang::page(*code).lines();
        if let Some(long) = lines.find(|line| line.chars().count() > 110 && !line.contains("((((")) {
            wrong.push(format!("{code}: a terminal has fewer columns than `{long}`"));
        }
    }
    nothing_wrong(&wrong);
}

/// What fails on a page fails for one reason, so that nobody reads past it.
#[test]
fn what_a_page_says_fails_fails_and_what_is_fixed_is_fixed() {
    let mut wrong = Vec::new();
    for code in Code::ALL.iter().filter(|code| !is_from_outside(**code)) {
        let page = Page::of(*code);
        let (given, _) = codes(page.block("Fails", "vpl").unwrap_or(""));
        let is_other_error = |c: &&Code| *c != code && c.severity() == Severity::Error;
        if !given.contains(code) || given.iter().any(|c| is_other_error(&c)) {
            wrong.push(format!("{code}: `## Fails` gives {given:?}"));
        }
        let fixed = page.block("Fixed", "vpl").unwrap_or("");
        if lang::format(fixed).text != fixed {
            wrong.push(format!("{code}: `## Fixed` is not laid out as `vpl fmt` does"));
        }
        let (given, compiles) = codes(fixed);
        if !compiles || given.contains(code) {
            wrong.push(format!("{code}: `## Fixed` gives {given:?}"));
        }
    }
    nothing_wrong(&wrong);
}

#[test]
fn pages_refer_to_pages_by_their_titles() {
    for code in Code::ALL {
        let page = Page::of(*code);
        for line in page
            .sections
            .get("See also")
            .unwrap_or(&"")
            .lines()
            .filter(|l| l.starts_with("- ["))
        {
            let named = line
                .strip_prefix("- [")
                .and_then(|l| l.split_once(']'))
                .map(|(code, _)| code);
            let named: Code = named
                .unwrap_or(line)
                .parse()
                .unwrap_or_else(|_| panic!("{code}: {line}. {FORM}"));
            assert_eq!(
                line,
                format!("- [{named}]({named}.md): {}", title(named)),
                "{code}. {FORM}"
            );
        }
    }
}

#[test]
fn every_page_is_of_a_code_and_the_index_has_all() {
    for entry in std::fs::read_dir("docs/diagnostics").unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let code = name.trim_end_matches(".md").parse::<Code>();
        assert!(name == "README.md" || code.is_ok(), "{name} is of no code");
    }
    let held = std::fs::read_to_string("docs/diagnostics/README.md").unwrap();
    assert_eq!(
        held,
        lang::index_of_codes(),
        "docs/diagnostics/README.md is stale; its first lines name the command"
    );
}
