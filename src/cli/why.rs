//! `vpl why`: why something happened in a run, or did not.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::files::{Disk, STDIN};
use super::{Failure, Outcome, print};
use crate::lang::{self, syntax::block};
use crate::rules::Place;
use crate::show::log::Run;
use crate::show::why::{self, Subject, Unknown, Written};

/// Largest log that is read, bytes.
const MOST_BYTES: u64 = 256 << 20;

/// Say why something happened in a run, or did not: a rule, a feature, a class, a view.
#[derive(Args)]
#[command(after_help = "Examples:
  vpl why run.jsonl r4             why rule r4 fired, or did not
  vpl why run.jsonl 'code[3]'      how a feature came to its state
  vpl why run.jsonl tk9            which evidence excluded a class, or left it
  vpl why run.jsonl view 3         why the third measurement was made from where it was
  vpl why run.jsonl view '#45'     what became of candidate view 45")]
pub(crate) struct Why {
    /// The run log that `vpl plan --log` wrote; `-` is standard input.
    #[arg(value_name = "RUN.jsonl")]
    log: PathBuf,
    /// A rule, a feature, an instance's key, a class, or `view N`.
    #[arg(required = true, num_args = 1..=2, value_name = "SUBJECT")]
    subject: Vec<String>,
    /// As of the N-th measurement; the last where left out.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    at: Option<u32>,
    /// How to write the answer.
    #[arg(long, value_enum, default_value_t = Form::Human)]
    format: Form,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// Text for people.
    Human,
    /// The same as data.
    Json,
}

pub(crate) fn run(options: &Why) -> Result<Outcome, Failure> {
    let bytes = read(&options.log).map_err(|error| Failure::Log(named(&options.log), error.to_string()))?;
    let run = Run::read(&bytes).map_err(|error| Failure::NoLog(named(&options.log), error.to_string()))?;
    let subject = Subject::parse(&options.subject.join(" "), &run).map_err(unknown)?;
    let at = moment(options.at, &subject, &run)?;
    let written = match &subject {
        Subject::Rule(id) => written(&run, id, &options.log),
        _ => Written::Unasked,
    };
    let explanation = why::explain(&run, &subject, at, &written);
    print(&match options.format {
        Form::Human => explanation.to_text(),
        Form::Json => explanation.to_json(),
    })?;
    Ok(Outcome::Done)
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let most = MOST_BYTES + 1;
    if path == Path::new(STDIN) {
        io::stdin().lock().take(most).read_to_end(&mut bytes)?;
    } else {
        File::open(path)?.take(most).read_to_end(&mut bytes)?;
    }
    if bytes.len() as u64 > MOST_BYTES {
        let limit = MOST_BYTES >> 20;
        return Err(io::Error::other(format!(
            "it is larger than {limit} MiB, which no run log is"
        )));
    }
    Ok(bytes)
}

/// The measurement that the question is asked at.
fn moment(at: Option<u32>, subject: &Subject, run: &Run) -> Result<u32, Failure> {
    let last = run.views.len() as u32;
    match (at, subject) {
        (Some(n), Subject::View(view)) if n < *view => Err(Failure::Moment(format!(
            "view {view} comes after measurement {n}; leave out `--at`"
        ))),
        (Some(n), _) if n > last => Err(Failure::Moment(format!(
            "there is no measurement {n}; the log tells of {last}"
        ))),
        (Some(_), Subject::View(_)) | (None, _) => Ok(subject.moment(run)),
        (Some(n), _) => Ok(n),
    }
}

/// A rule as the run's program writes it, if that is still the program.
fn written(run: &Run, rule: &str, log: &Path) -> Written {
    let file = &run.start.file;
    if file == STDIN {
        return Written::Gone("the program came on standard input, so its text is not shown".into());
    }
    let beside = log
        .parent()
        .map(|folder| folder.join(file))
        .filter(|path| path.exists());
    let path = if Path::new(file).exists() {
        Some(PathBuf::from(file))
    } else {
        beside
    };
    let Some(path) = path else {
        return Written::Gone(format!(
            "`{file}`, which the log names, is not here, so the rule's text is not shown"
        ));
    };
    let compiled = lang::compile(&path.to_string_lossy(), &Disk);
    let sources = &compiled.sources;
    match &compiled.rules {
        Some(rules) => Written::of(rules, &run.start, rule, |place: Place| {
            let file = sources.get(lang::FileId(place.file))?;
            let text = block(&file.text, place.start as usize);
            Some((file.display.clone(), text.to_owned()))
        }),
        None => Written::Gone(format!("`{file}` no longer compiles, so the rule's text is not shown")),
    }
}

fn unknown(unknown: Unknown) -> Failure {
    match unknown {
        Unknown::Name { name, has, known } => {
            let near = lang::closest(&name, known.iter().map(String::as_str));
            let help = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => "name a rule (`r4`), a feature, a class, an instance's key as `vpl why RUN FEATURE` lists it (`1`, `bottom.1/edge.2`), or `view N`".to_owned(),
            };
            Failure::Subject(format!("the run knows no `{name}`; it has {has}\n  help: {help}"))
        }
        Unknown::View { view, has } => Failure::Moment(format!(
            "there is no view `{view}`; {has}\n  help: `view 1` is the first measurement, `view '#45'` the candidate view 45"
        )),
    }
}

fn named(path: &Path) -> String {
    if path == Path::new(STDIN) {
        return "standard input".into();
    }
    format!("`{}`", path.display())
}
