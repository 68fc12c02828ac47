//! Tasks: each statement once, each value of its type.

use std::collections::BTreeMap;

use super::Checker;
use super::expressions::Due;
use super::forms::SPACES;
use super::scope::Scope;
use super::typed::{Expr, Library, Task};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::Entity;
use crate::lang::names::Module;
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, TaskStatementKind as Kind};
use crate::primitives::Type;
use crate::rules::{Goal, Insertion, Inspected, METHODS, Visibility};

/// The method where a task names none.
const USUAL_METHOD: &str = "gn";
/// What a task can aim at.
pub(in crate::lang) const GOALS: &[&str] = &["confident", "exhausted"];
/// When a feature counts as inspected.
pub(in crate::lang) const INSPECTED: &[&str] = &["observed", "near_point"];
/// How measurements enter the map.
pub(in crate::lang) const INSERTION: &[&str] = &["exact", "projective"];
/// How it is decided what hides a voxel.
pub(in crate::lang) const VISIBILITY: &[&str] = &["exact", "centre"];
/// What is verified.
pub(in crate::lang) const VERIFY: &[&str] = &["all"];
pub(in crate::lang) const THRESHOLDS: &[(&str, Type)] = &[
    ("near", Type::Length),
    ("absent", Type::Share),
    ("confidence", Type::Share),
];
pub(in crate::lang) const SENSOR_MODEL: &[(&str, Type)] = &[
    ("hit", Type::Share),
    ("miss", Type::Share),
    ("clamp_min", Type::Share),
    ("clamp_max", Type::Share),
    ("occupied", Type::Share),
];

/// What the statements of a task gave so far.
#[derive(Default)]
pub(super) struct Draft {
    seen: BTreeMap<&'static str, Span>,
    library: Option<String>,
    goal: Option<(Goal, Span)>,
    pub(super) values: BTreeMap<&'static str, Expr>,
    method: Option<String>,
    pub(super) inspected: Option<Inspected>,
    visibility: Option<Visibility>,
    pub(super) verify: bool,
    insertion: Option<Insertion>,
    pub(super) thresholds: BTreeMap<&'static str, Option<Expr>>,
    pub(super) sensor_model: BTreeMap<&'static str, Option<Expr>>,
}

impl<'a> Checker<'a> {
    pub(super) fn task(&mut self, task: &'a tree::Task, libraries: &[Library]) -> Option<Task> {
        let mut draft = Draft::default();
        for statement in &task.statements {
            let word = statement.kind.word();
            match draft.seen.get(word) {
                Some(first) => self.surplus(statement.span, *first, word),
                None => {
                    draft.seen.insert(word, statement.span);
                    self.statement(statement, &mut draft, libraries);
                }
            }
        }
        self.nothing_missing(task, &draft);
        self.thresholds_complete(&draft);
        assemble(task, draft)
    }

    fn statement(&mut self, statement: &tree::TaskStatement, draft: &mut Draft, libraries: &[Library]) {
        self.setting(&statement.kind, statement.span, draft, libraries);
    }

    /// Checks what a statement of a task says, wherever it stands.
    pub(super) fn setting(&mut self, kind: &Kind, at: Span, draft: &mut Draft, libraries: &[Library]) {
        match kind {
            Kind::Library(name) => draft.library = self.library_of(name, libraries),
            Kind::Goal(words) => {
                let last = words.last().map_or(at, |w| w.span);
                let span = words.first().map_or(at, |w| w.span.to(last));
                draft.goal = self.goal(words).map(|goal| (goal, span));
            }
            Kind::Camera(e) => self.value(draft, "camera", e, Type::Camera),
            Kind::Space(space) => {
                let scope = Scope::of(self.program.main());
                let shape = self.form(&space.shape, SPACES, "`space`", scope);
                draft.values.extend(shape.map(|shape| ("space", shape)));
                self.value(draft, "at", &space.at, Type::Point);
                self.value(draft, "voxel", &space.voxel, Type::Length);
            }
            Kind::Views(e) => self.value(draft, "views", e, Type::Views),
            Kind::Thresholds(fields) => draft.thresholds = self.fields(fields, THRESHOLDS, "thresholds"),
            Kind::Limit(e) => self.count(draft, "limit", e, "views"),
            Kind::Overlap(e) => self.value(draft, "overlap", e, Type::Share),
            Kind::Method(name) => draft.method = self.method(name),
            Kind::GainFloor(e) => self.count(draft, "gain_floor", e, "voxels"),
            Kind::Inspected(name) => {
                draft.inspected = self.one_of_words(name, "`inspected`", INSPECTED).map(|word| {
                    if word == "near_point" {
                        Inspected::NearPoint
                    } else {
                        Inspected::Observed
                    }
                });
            }
            Kind::Visibility(name) => {
                draft.visibility = self.one_of_words(name, "`visibility`", VISIBILITY).map(|word| {
                    if word == "centre" {
                        Visibility::Centre
                    } else {
                        Visibility::Exact
                    }
                });
            }
            Kind::Verify(name) => draft.verify = self.one_of_words(name, "`verify`", VERIFY).is_some(),
            Kind::Insertion(name) => {
                draft.insertion = self.one_of_words(name, "`insertion`", INSERTION).map(|word| {
                    if word == "projective" {
                        Insertion::Projective
                    } else {
                        Insertion::Exact
                    }
                });
            }
            Kind::SensorModel(fields) => draft.sensor_model = self.fields(fields, SENSOR_MODEL, "sensor_model"),
        }
    }

    pub(super) fn value(&mut self, draft: &mut Draft, word: &'static str, e: &tree::Expr, ty: Type) {
        let what = format!("`{word}`");
        let value = self.check(e, Due { ty, what: &what }, Scope::of(self.program.main()));
        draft.values.extend(value.map(|value| (word, value)));
    }

    /// A count with its own noun or none: `20 views`, not `20 voxels`.
    fn count(&mut self, draft: &mut Draft, word: &'static str, e: &tree::Expr, noun: &str) {
        if let tree::ExprKind::Quantity(q) = &e.kind
            && let Some(unit) = q
                .unit
                .as_ref()
                .filter(|u| super::units::all().any(|known| known == u.text))
            && unit.text != noun
        {
            let message = format!("`{word}` counts {noun}, not `{}`", unit.text);
            let out = Diagnostic::new(Code::E0302, unit.span, message);
            self.report(
                out.help(format!("write `{noun}`"))
                    .fix(format!("write `{noun}`"), unit.span, noun),
            );
            return;
        }
        self.value(draft, word, e, Type::Count);
    }

    fn library_of(&mut self, name: &tree::Name, libraries: &[Library]) -> Option<String> {
        if libraries.iter().any(|l| l.name == name.text) {
            self.uses_listed(name);
            return Some(name.text.clone());
        }
        self.no_library(name, libraries);
        None
    }

    /// Records a library that a task or a scene names.
    pub(super) fn uses_listed(&mut self, name: &tree::Name) {
        if let Some(Some(id)) = self.program.main().libraries.get(&name.text) {
            self.uses_library(name, *id);
        }
    }

    /// Reports a name that is no library for a task or a scene.
    pub(super) fn no_library(&mut self, name: &tree::Name, libraries: &[Library]) {
        let main = self.program.main();
        let known = libraries.iter().map(|l| l.name.as_str());
        match main.libraries.get(&name.text) {
            None => self.unknown_item("library", name, known, main),
            Some(None) => {}
            Some(Some(id)) => {
                let parameters: Vec<String> = self.library_signatures[id.0]
                    .iter()
                    .map(|p| format!("{}: …", p.name))
                    .collect();
                let call = format!("{}({})", name.text, parameters.join(", "));
                let at = self.program.library(*id).map_or(name.span, |(tree, _)| tree.head);
                let message = format!("`{}` is a template, and no library by itself", name.text);
                self.report(
                    Diagnostic::new(Code::E0212, name.span, message)
                        .related(at, "it has parameters")
                        .help(format!(
                            "take it over in a library of your own: `library NAME {{ use {call} … }}`"
                        )),
                );
            }
        }
    }

    /// Reports a library, class or layout that is not there.
    pub(super) fn unknown_item<'n>(
        &mut self,
        kind: &'static str,
        name: &tree::Name,
        known: impl Iterator<Item = &'n str> + Clone,
        module: &Module,
    ) {
        if module.lost.contains(&name.text) || !self.first_time(kind, name) {
            return;
        }
        let out = Diagnostic::new(Code::E0208, name.span, format!("there is no {kind} `{}`", name.text));
        self.report(match closest(&name.text, known.clone()) {
            Some(near) => out
                .help(format!("did you mean `{near}`?"))
                .fix(format!("write `{near}`"), name.span, near),
            None if known.clone().next().is_none() => out.help(format!("declare it: `{kind} {} {{ … }}`", name.text)),
            None => out.help(format!("there is {}", one_of(known).replace(" or ", " and "))),
        });
    }

    fn goal(&mut self, words: &[tree::Name]) -> Option<Goal> {
        let mut goal = Goal {
            confident: false,
            exhausted: false,
        };
        for name in words {
            let Some(word) = GOALS.iter().copied().find(|word| *word == name.text) else {
                self.no_goal(name);
                return None;
            };
            self.names.uses(name.span, Entity::Word(word));
            let part = match word {
                "confident" => &mut goal.confident,
                _ => &mut goal.exhausted,
            };
            if std::mem::replace(part, true) {
                let message = format!("`{}` stands twice in the goal", name.text);
                self.report(Diagnostic::new(Code::E0308, name.span, message));
            }
        }
        Some(goal)
    }

    fn no_goal(&mut self, name: &tree::Name) {
        let out = Diagnostic::new(Code::E0306, name.span, format!("`goal` cannot be `{}`", name.text));
        let ours = match name.text.to_ascii_lowercase().as_str() {
            "classify" | "recognise" | "recognize" | "identify" | "detect" | "class" => Some("confident"),
            "reconstruct" | "explore" | "scan" | "inspect" | "cover" | "complete" | "model" => Some("exhausted"),
            other => closest(other, ["confident", "exhausted"]),
        };
        let out = out.help(
            "it is `confident` (the class is known), `exhausted` (no view can gain anything) or `confident and exhausted`",
        );
        self.report(match ours {
            Some(ours) => out.fix(format!("write `{ours}`"), name.span, ours),
            None => out,
        });
    }

    pub(super) fn one_of_words(
        &mut self,
        name: &tree::Name,
        what: &str,
        words: &[&'static str],
    ) -> Option<&'static str> {
        let found = words.iter().find(|w| **w == name.text).copied();
        match found {
            Some(word) => self.names.uses(name.span, Entity::Word(word)),
            None => self.unknown_word(name, what, words),
        }
        found
    }

    pub(super) fn method(&mut self, name: &tree::Name) -> Option<String> {
        let lower = name.text.to_ascii_lowercase();
        if let Some(word) = METHODS.iter().find(|word| **word == lower) {
            self.names.uses(name.span, Entity::Word(word));
            return Some(lower);
        }
        self.unknown_word(name, "`method`", METHODS);
        None
    }

    /// Fields by name; `None` for one that is wrong, which is not missing, too.
    fn fields(
        &mut self,
        fields: &[tree::Field],
        known: &[(&'static str, Type)],
        word: &'static str,
    ) -> BTreeMap<&'static str, Option<Expr>> {
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        let mut out = BTreeMap::new();
        for field in fields {
            let name = &field.name;
            let Some((known_name, ty)) = known.iter().find(|(n, _)| *n == name.text) else {
                let names: Vec<&str> = known.iter().map(|(n, _)| *n).collect();
                self.unknown_word(name, &format!("a field of `{word}`"), &names);
                continue;
            };
            self.names.uses(name.span, Entity::Field(word, known_name));
            if let Some(first) = seen.insert(known_name, name.span) {
                self.surplus(name.span, first, &name.text);
                continue;
            }
            let what = format!("`{known_name}`");
            let due = Due { ty: *ty, what: &what };
            let value = self.check(&field.value, due, Scope::of(self.program.main()));
            out.insert(*known_name, value);
        }
        out
    }

    fn nothing_missing(&mut self, task: &tree::Task, draft: &Draft) {
        const NEEDED: &[(&str, &str)] = &[
            ("library", "library solids"),
            ("goal", "goal confident"),
            ("camera", "camera kinect_v2"),
            ("space", "space cube(600 mm) at [0 mm, 0 mm, 300 mm] voxel 10 mm"),
            ("views", "views sphere(radius: 1.4 m, count: 64)"),
            (
                "thresholds",
                "thresholds { near: 10 mm, absent: 99 %, confidence: 99 % }",
            ),
        ];
        if !task.whole {
            return;
        }
        let missing: Vec<_> = NEEDED
            .iter()
            .filter(|(word, _)| !draft.seen.contains_key(word))
            .collect();
        if missing.is_empty() {
            return;
        }
        let words: Vec<String> = missing.iter().map(|(word, _)| format!("`{word}`")).collect();
        let lines: Vec<String> = missing.iter().map(|(_, example)| format!("`{example}`")).collect();
        let message = format!("task `{}` has no {}", task.name.text, words.join(", no "));
        let help = format!("add {}", lines.join(", "));
        self.report(Diagnostic::new(Code::E0308, task.name.span, message).help(help));
    }

    fn thresholds_complete(&mut self, draft: &Draft) {
        let Some(span) = draft.seen.get("thresholds") else {
            return;
        };
        let missing: Vec<&str> = THRESHOLDS
            .iter()
            .map(|(name, _)| *name)
            .filter(|name| !draft.thresholds.contains_key(name))
            .collect();
        if !missing.is_empty() {
            let words: Vec<String> = missing.iter().map(|w| format!("`{w}`")).collect();
            let message = format!("`thresholds` lacks {}", words.join(" and "));
            let help = "write all three: `thresholds { near: 10 mm, absent: 99 %, confidence: 99 % }`";
            self.report(Diagnostic::new(Code::E0308, *span, message).help(help));
        }
    }
}

/// The task, where everything that it needs is there and right.
fn assemble(task: &tree::Task, mut draft: Draft) -> Option<Task> {
    let (goal, goal_span) = draft.goal?;
    Some(Task {
        name: task.name.text.clone(),
        library: draft.library?,
        goal,
        goal_span,
        camera: draft.values.remove("camera")?,
        shape: draft.values.remove("space")?,
        at: draft.values.remove("at")?,
        voxel: draft.values.remove("voxel")?,
        views: draft.values.remove("views")?,
        near: draft.thresholds.remove("near")??,
        absent: draft.thresholds.remove("absent")??,
        confidence: draft.thresholds.remove("confidence")??,
        overlap: draft.values.remove("overlap"),
        limit: draft.values.remove("limit"),
        gain_floor: draft.values.remove("gain_floor"),
        method: draft.method.unwrap_or_else(|| USUAL_METHOD.to_owned()),
        inspected: draft.inspected.unwrap_or(Inspected::Observed),
        visibility: draft.visibility.unwrap_or(Visibility::Exact),
        verify: draft.verify,
        insertion: draft.insertion.unwrap_or_default(),
        sensor_model: (draft.sensor_model.into_iter())
            .filter_map(|(name, e)| Some((name, e?)))
            .collect(),
        span: task.head,
    })
}
