//! What a run leaves: the log, a line a view, the map.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::output::{is_stdout, quoted, writable};
use crate::cli::{Failure, report};
use crate::plan::{End, Part, Phase, Session, Step};
use crate::show::log::{self, Milliseconds, Record};
use crate::show::{Report, view_line};

/// Writes each record as it comes, and shows a line a view.
pub(super) struct Recorder {
    log: Option<Log>,
    page: Option<Report>,
    records: Vec<Record>,
    last: Instant,
    ms: Milliseconds,
    bar: ProgressBar,
}

impl Recorder {
    /// Opens the log and writes its first line. A run that repeats `repeated`
    /// logged views writes nothing before it is past them: the log that it
    /// resumes may be the one that it writes.
    pub fn begin(
        path: Option<&Path>,
        page: Option<Report>,
        start: log::Start,
        repeated: usize,
    ) -> Result<Self, Failure> {
        let log = path.map(|path| Log::begin(path, repeated)).transpose()?;
        // Hidden by itself where standard error is no terminal.
        let bar = ProgressBar::new_spinner().with_style(ProgressStyle::default_spinner());
        let mut recorder = Self {
            log,
            page,
            records: Vec::new(),
            last: Instant::now(),
            ms: Milliseconds::default(),
            bar,
        };
        recorder.write(Record::Start(start))?;
        Ok(recorder)
    }

    /// Everything so far.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// Shows what is done before the first view.
    pub fn preparing(&self, doing: &str) {
        self.bar.set_message(doing.to_owned());
        self.bar.tick();
    }

    /// Starts the clock of a view.
    pub fn begin_view(&mut self) {
        self.ms = Milliseconds::default();
        self.last = Instant::now();
        self.show("measuring");
    }

    /// A part of the view has ended.
    pub fn lap(&mut self, part: Part) {
        let passed = self.last.elapsed().as_secs_f64() * 1000.0;
        let (sum, next) = match part {
            Part::Sense => (&mut self.ms.sense, "inserting"),
            Part::Session(Phase::Map) => (&mut self.ms.map, "detecting"),
            Part::Session(Phase::Detect) => (&mut self.ms.detect, "scoring views"),
            Part::Session(Phase::Score) => (&mut self.ms.score, "scoring views"),
        };
        *sum += (passed * 1000.0).round() / 1000.0;
        self.last = Instant::now();
        self.show(next);
    }

    /// Records a view: the session as it stands after a step.
    pub fn view(&mut self, session: &Session, step: &Step) -> Result<(), Failure> {
        let view = log::View::of(step, self.ms);
        if let Some(page) = &mut self.page {
            page.view(session, step, self.ms);
        }
        let before = self.records.iter().rev().find_map(|r| match r {
            Record::View(view) => Some(view.as_ref()),
            _ => None,
        });
        let line = view_line(before, &view);
        self.bar.suspend(|| report(&format!("{line}\n")))?;
        self.write(Record::View(Box::new(view)))
    }

    /// Records the end.
    pub fn end(&mut self, end: &End, coverage: Option<f64>) -> Result<(), Failure> {
        self.bar.finish_and_clear();
        let views = self.records.iter().filter(|r| matches!(r, Record::View(_))).count();
        self.write(Record::End(log::End::of(end, views as u32, coverage)))
    }

    /// The page that shows the run, where one is asked for.
    pub fn page(&self) -> Option<String> {
        let end = self.records.iter().rev().find_map(|r| match r {
            Record::End(end) => Some(end),
            _ => None,
        });
        self.page.as_ref().map(|page| page.page(end))
    }

    /// One write a line, so that an interrupted run leaves whole lines.
    fn write(&mut self, record: Record) -> Result<(), Failure> {
        if let Some(log) = &mut self.log {
            log.write(&record)?;
        }
        self.records.push(record);
        Ok(())
    }

    fn show(&self, doing: &'static str) {
        let n = self.records.iter().filter(|r| matches!(r, Record::View(_))).count() + 1;
        self.bar.set_message(format!("view {n}: {doing}"));
        self.bar.tick();
    }
}

/// A log that is opened once there is more to write than what is repeated.
struct Log {
    path: PathBuf,
    out: Option<(Box<dyn Write>, String)>,
    /// Views that are still to be repeated.
    repeated: usize,
    /// Lines that are not written yet.
    waiting: String,
}

impl Log {
    fn begin(path: &Path, repeated: usize) -> Result<Self, Failure> {
        let mut log = Self {
            path: path.to_owned(),
            out: None,
            repeated,
            waiting: String::new(),
        };
        if repeated == 0 {
            log.out = Some(create(path)?);
        } else {
            writable(path)?;
        }
        Ok(log)
    }

    fn write(&mut self, record: &Record) -> Result<(), Failure> {
        self.waiting += &(record.to_line() + "\n");
        if matches!(record, Record::View(_)) {
            self.repeated = self.repeated.saturating_sub(1);
        }
        if self.repeated > 0 && !matches!(record, Record::End(_)) {
            return Ok(());
        }
        if self.out.is_none() {
            self.out = Some(create(&self.path)?);
        }
        let Some((out, name)) = &mut self.out else {
            return Ok(());
        };
        let written = out.write_all(self.waiting.as_bytes()).and_then(|()| out.flush());
        self.waiting.clear();
        written.map_err(|error| Failure::Write(name.clone(), error))
    }
}

fn create(path: &Path) -> Result<(Box<dyn Write>, String), Failure> {
    if is_stdout(path) {
        return Ok((Box::new(io::stdout()), "standard output".into()));
    }
    match File::create(path) {
        Ok(file) => Ok((Box::new(file), quoted(path))),
        Err(error) => Err(Failure::Write(quoted(path), error)),
    }
}
