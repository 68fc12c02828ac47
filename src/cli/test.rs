//! `vpl test`: whether the facts that a program states hold.

use std::io::IsTerminal;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::files::{Disk, human};
use super::{Failure, Outcome, print, report};
use crate::facts::{self, Coverage, RuleCoverage, Verdict};
use crate::lang::{self, Code, Compilation, Diagnostic, Format, Severity, SourceMap, render};
use crate::rules::Fact;

/// Run the tests of programs: what follows from stated evidence, and what definitions give.
#[derive(Args)]
#[command(after_help = "Example: vpl test examples/tanks/tanks.vpl --coverage")]
pub(crate) struct Test {
    /// The programs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Say which rules the facts made use of, and which none did.
    #[arg(long)]
    coverage: bool,
    /// Run only facts whose name contains this text.
    #[arg(long, value_name = "TEXT")]
    filter: Option<String>,
    /// How to write the result.
    #[arg(long, value_enum, default_value_t = Form::Human)]
    format: Form,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// A line a fact; what fails with its source on standard error.
    Human,
    /// One object, on standard output.
    Json,
}

/// A file and what its facts showed.
struct Tested {
    file: String,
    compiled: Compilation,
    /// Those that were run.
    facts: Vec<Fact>,
    verdicts: Vec<Verdict>,
    /// Why the file cannot be run, or which facts fail.
    found: Vec<Diagnostic>,
    coverage: Vec<Coverage>,
}

pub(crate) fn run(options: &Test) -> Result<Outcome, Failure> {
    let tested: Vec<Tested> = options.files.iter().map(|file| test(file, options)).collect();
    match options.format {
        Form::Json => print(&json_of(&tested))?,
        Form::Human => {
            let marks = Marks::of_terminal();
            for one in &tested {
                print(&one.lines(marks))?;
                report(&render(&one.found, &one.compiled.sources, human()))?;
                print(&one.coverage.iter().map(table).collect::<String>())?;
            }
            print(&summary(&tested))?;
        }
    }
    let failed = tested.iter().any(|t| !t.found.is_empty());
    Ok(if failed { Outcome::WrongInput } else { Outcome::Done })
}

fn test(file: &str, options: &Test) -> Tested {
    let mut compiled = lang::compile(file, &Disk);
    let wanted = |fact: &Fact| options.filter.as_ref().is_none_or(|text| fact.name.contains(text));
    let mut facts = std::mem::take(&mut compiled.facts);
    facts.retain(wanted);
    let errors = compiled.diagnostics.iter().filter(|d| d.severity == Severity::Error);
    let mut found: Vec<Diagnostic> = errors.cloned().collect();
    let (mut verdicts, mut coverage) = (Vec::new(), Vec::new());
    if let Some(rules) = &compiled.rules {
        verdicts = facts::run(rules, &facts);
        let failed = facts.iter().zip(&verdicts);
        found.extend(failed.flat_map(|(fact, verdict)| verdict.failures.iter().map(|f| diagnostic(fact, f))));
        if options.coverage {
            coverage = facts::coverage(rules, &facts, &verdicts);
        }
    }
    Tested {
        file: file.to_owned(),
        compiled,
        facts,
        verdicts,
        found,
        coverage,
    }
}

fn diagnostic(fact: &Fact, failure: &facts::Failure) -> Diagnostic {
    let out = Diagnostic::at_place(Code::E0701, failure.place, failure.message.clone());
    let out = out.maybe_help(failure.help.clone());
    if failure.place == fact.place {
        return out;
    }
    out.related(fact.place, "in this test")
}

/// The marks before a fact that holds and one that fails.
#[derive(Clone, Copy)]
struct Marks {
    holds: &'static str,
    fails: &'static str,
}

impl Marks {
    fn of_terminal() -> Self {
        let colour = std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
        match (std::io::stdout().is_terminal(), colour) {
            (true, true) => Self {
                holds: "\u{1b}[32m✓\u{1b}[0m",
                fails: "\u{1b}[31m✗\u{1b}[0m",
            },
            (true, false) => Self {
                holds: "✓", fails: "✗"
            },
            (false, _) => Self {
                holds: "ok  ",
                fails: "FAIL",
            },
        }
    }
}

impl Tested {
    /// A line a fact, under the file's name.
    fn lines(&self, marks: Marks) -> String {
        let mut out = format!("{}\n", self.file);
        if self.compiled.rules.is_none() {
            out.push_str("  not run: the program is wrong\n");
        } else if self.facts.is_empty() {
            out.push_str("  no facts\n");
        }
        for (fact, verdict) in self.facts.iter().zip(&self.verdicts) {
            let mark = if verdict.holds() { marks.holds } else { marks.fails };
            out.push_str(&format!("  {mark} {}\n", fact.name));
        }
        out
    }
}

/// `12 facts hold in 2 files`.
fn summary(tested: &[Tested]) -> String {
    let verdicts = || tested.iter().flat_map(|t| &t.verdicts);
    let holding = verdicts().filter(|v| v.holds()).count();
    let failing = verdicts().count() - holding;
    let broken = tested.iter().filter(|t| t.compiled.rules.is_none()).count();
    let mut parts = vec![format!(
        "{} {}",
        plural(holding, "fact"),
        if holding == 1 { "holds" } else { "hold" }
    )];
    if failing > 0 {
        parts.push(format!("{failing} {}", if failing == 1 { "fails" } else { "fail" }));
    }
    if broken > 0 {
        parts.push(format!("{} could not be run", plural(broken, "file")));
    }
    format!("{}, in {}\n", parts.join(", "), plural(tested.len(), "file"))
}

fn plural(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// The rules of a library with how often facts used them, then those that none did.
fn table(coverage: &Coverage) -> String {
    let used = coverage.rules.iter().filter(|r| r.is_used()).count();
    let all = plural(coverage.rules.len(), "rule");
    let mut out = format!("\nlibrary `{}`: {used} of {all} used\n", coverage.library);
    let width = |of: fn(&RuleCoverage) -> &String| coverage.rules.iter().map(|r| of(r).chars().count()).max();
    let (id, head) = (width(|r| &r.id).unwrap_or(0), width(|r| &r.head).unwrap_or(0));
    for rule in &coverage.rules {
        let counts = match (rule.detected, rule.predicted) {
            (0, 0) => "never used".to_owned(),
            (detected, predicted) => format!("detected {detected}, predicted {predicted}"),
        };
        out.push_str(&format!("  {:id$}  {:head$}  {counts}\n", rule.id, rule.head));
    }
    out
}

fn json_of(tested: &[Tested]) -> String {
    let mut sources = SourceMap::default();
    let mut found: Vec<Diagnostic> = Vec::new();
    for one in tested {
        let first = sources.append(&one.compiled.sources);
        found.extend(one.found.iter().cloned().map(|d| d.moved(first)));
    }
    let diagnostics: Value = serde_json::from_str(&render(&found, &sources, Format::Json)).unwrap_or_default();
    let facts: Vec<Value> = tested.iter().flat_map(facts_in_json).collect();
    let holding = facts.iter().filter(|f| f["holds"] == true).count();
    let mut out = json!({
        "summary": { "facts": facts.len(), "hold": holding, "fail": facts.len() - holding },
        "facts": facts,
        "diagnostics": diagnostics,
    });
    if tested.iter().any(|t| !t.coverage.is_empty()) {
        out["coverage"] = tested.iter().flat_map(coverage_in_json).collect();
    }
    format!("{out:#}\n")
}

fn facts_in_json(tested: &Tested) -> Vec<Value> {
    let one = |(fact, verdict): (&Fact, &Verdict)| {
        let failures: Vec<&String> = verdict.failures.iter().map(|f| &f.message).collect();
        json!({
            "file": tested.file, "line": fact.place.line, "name": fact.name,
            "holds": verdict.holds(), "failures": failures,
        })
    };
    tested.facts.iter().zip(&tested.verdicts).map(one).collect()
}

fn coverage_in_json(tested: &Tested) -> Vec<Value> {
    let rule =
        |r: &RuleCoverage| json!({ "rule": r.id, "head": r.head, "detected": r.detected, "predicted": r.predicted });
    let library = |c: &Coverage| {
        let rules: Vec<Value> = c.rules.iter().map(rule).collect();
        json!({ "file": tested.file, "library": c.library, "rules": rules })
    };
    tested.coverage.iter().map(library).collect()
}
