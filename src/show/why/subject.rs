//! What a question is about, as it is typed.

use std::collections::BTreeSet;

use super::words::plural;
use crate::show::log::Run;

/// What a question is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A rule by its id.
    Rule(String),
    /// A feature by its name.
    Feature(String),
    /// An instance by its key.
    Instance(String),
    /// A class by its name.
    Class(String),
    /// The n-th measurement, from 1.
    View(u32),
    /// A candidate view by its index, from 0.
    Candidate(usize),
}

/// Why there is no such subject in a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// Nothing of the run has that name.
    Name {
        /// The name.
        name: String,
        /// What has names, in words.
        has: String,
        /// Every name.
        known: Vec<String>,
    },
    /// There was no such measurement, or there is no such candidate view.
    View {
        /// As typed.
        view: String,
        /// What there is.
        has: String,
    },
}

/// The names that a run knows.
struct Names {
    rules: BTreeSet<String>,
    features: Vec<String>,
    classes: Vec<String>,
    instances: BTreeSet<String>,
    /// Whether the log lists the rules.
    listed: bool,
}

impl Subject {
    /// Reads a subject: `r4`, `code[3]`, `tk9`, `bottom.1/edge.2`, `view 3`, `view #45`,
    /// or a name with its kind before it (`class tk9`). A bare name is a rule's, else a
    /// feature's, else a class's, else an instance's.
    ///
    /// # Errors
    /// The run knows no such thing.
    pub fn parse(typed: &str, run: &Run) -> Result<Self, Unknown> {
        let typed = typed.trim();
        let (kind, rest) = typed.split_once(char::is_whitespace).unwrap_or(("", typed));
        let rest = rest.trim();
        if kind == "view" || typed.starts_with('#') {
            return view(rest, run);
        }
        let names = Names::of(run);
        let owned = rest.to_owned();
        let found = match kind {
            "rule" => names.has_rule(rest).then_some(Self::Rule(owned)),
            "feature" => names.features.contains(&owned).then_some(Self::Feature(owned)),
            "class" => names.classes.contains(&owned).then_some(Self::Class(owned)),
            "instance" => names.instance(rest),
            _ => names.find(typed),
        };
        let name = if found.is_none() && kind.is_empty() {
            typed
        } else {
            rest
        };
        found.ok_or_else(|| names.without(name))
    }

    /// The measurement at which a question about it is best asked: that of a
    /// view, else the last.
    pub fn moment(&self, run: &Run) -> u32 {
        match self {
            Self::View(n) => *n,
            _ => run.views.len() as u32,
        }
    }
}

fn view(typed: &str, run: &Run) -> Result<Subject, Unknown> {
    let count = run.views.len();
    let (candidate, has) = match typed.strip_prefix('#') {
        Some(index) => {
            let last = run.start.candidates.saturating_sub(1);
            (Some(index), format!("the candidate views are #0 to #{last}"))
        }
        None => (None, format!("the log tells of {}", plural(count, "measurement"))),
    };
    let found = match candidate {
        Some(index) => {
            let index = index.parse().ok().filter(|k| *k < run.start.candidates);
            index.map(Subject::Candidate)
        }
        None => {
            let n = typed.parse().ok().filter(|n| (1..=count).contains(n));
            n.map(|n| Subject::View(n as u32))
        }
    };
    let view = typed.to_owned();
    found.ok_or(Unknown::View { view, has })
}

impl Names {
    fn of(run: &Run) -> Self {
        let instances = || {
            run.views
                .iter()
                .flat_map(|v| &v.features.0)
                .flat_map(|(_, f)| &f.instances)
        };
        let mut rules: BTreeSet<String> = instances().flat_map(|i| i.predicted_by.iter().cloned()).collect();
        let mut classes: Vec<String> = Vec::new();
        if let Some(library) = &run.start.library {
            rules.extend(library.rules.names().map(str::to_owned));
            classes.extend(library.classes.names().map(str::to_owned));
        } else if let Some(view) = run.views.first() {
            classes.extend(view.classes.names().map(str::to_owned));
        }
        Self {
            rules,
            features: run.start.weights.names().map(str::to_owned).collect(),
            classes,
            instances: instances().map(|i| i.key.clone()).collect(),
            listed: run.start.library.is_some(),
        }
    }

    /// A log that does not list its rules may be of any.
    fn has_rule(&self, id: &str) -> bool {
        let digits = id.strip_prefix('r').filter(|n| !n.is_empty() && n.len() < 10);
        let plausible = !self.listed && digits.is_some_and(|n| n.bytes().all(|b| b.is_ascii_digit()));
        plausible || self.rules.contains(id)
    }

    fn find(&self, name: &str) -> Option<Subject> {
        let owned = name.to_owned();
        if self.has_rule(name) {
            Some(Subject::Rule(owned))
        } else if self.features.contains(&owned) {
            Some(Subject::Feature(owned))
        } else if self.classes.contains(&owned) {
            Some(Subject::Class(owned))
        } else {
            self.instance(name)
        }
    }

    /// An instance by its key, or by its feature and its key: `side.2/edge.1`.
    fn instance(&self, name: &str) -> Option<Subject> {
        let known = |key: &str| self.instances.contains(key).then(|| Subject::Instance(key.to_owned()));
        let of_feature = || {
            let (feature, key) = name.split_once('.')?;
            let is_one = self.features.iter().any(|f| f == feature);
            known(key).filter(|_| is_one)
        };
        known(name).or_else(of_feature)
    }

    fn without(self, name: &str) -> Unknown {
        let (rules, features, classes) = (self.rules.len(), self.features.len(), self.classes.len());
        let classes = if classes == 1 {
            "1 class".to_owned()
        } else {
            format!("{classes} classes")
        };
        let has = format!(
            "{}, {} and {classes}",
            plural(rules, "rule"),
            plural(features, "feature")
        );
        let known = self
            .rules
            .into_iter()
            .chain(self.features)
            .chain(self.classes)
            .chain(self.instances);
        Unknown::Name {
            name: name.to_owned(),
            has,
            known: known.collect(),
        }
    }
}
