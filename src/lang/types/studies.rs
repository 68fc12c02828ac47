//! Studies: each statement once, each value of its type. Which tasks and objects there
//! are is known once the program is read, and checked where the study is lowered.

use std::collections::BTreeMap;

use super::Checker;
use super::expressions::Due;
use super::scope::Scope;
use super::task::Draft;
use super::typed::Expr;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::names;
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, Name, Setting, StudyStatementKind as Kind};
use crate::primitives::Type;
use crate::rules::Inspected;

/// What a depth camera can do to depth.
pub(in crate::lang) const NOISES: &[&str] = &["none", "structured_light", "stereo", "tof"];

/// A checked study.
#[derive(Debug)]
pub(in crate::lang) struct Study {
    pub name: String,
    /// The path as written.
    pub program: Option<Name>,
    pub task: Option<Name>,
    /// None: all.
    pub objects: Option<Vec<Object>>,
    pub methods: Vec<String>,
    pub starts: Option<Expr>,
    pub seeds: Option<Expr>,
    pub noises: Vec<String>,
    pub published: Option<Name>,
    /// What all variants change.
    pub common: Settings,
    pub variants: Vec<(Name, Settings)>,
    pub span: Span,
}

/// An object by its name, or a mesh by its file.
#[derive(Debug)]
pub(in crate::lang) enum Object {
    Named(Name),
    Mesh(Expr),
}

/// What is changed of a task and a scene.
#[derive(Debug, Default)]
pub(in crate::lang) struct Settings {
    /// `camera`, `views`, `voxel`, `limit`, `overlap`, `gain_floor`.
    pub values: BTreeMap<&'static str, Expr>,
    pub thresholds: BTreeMap<&'static str, Expr>,
    pub sensor_model: BTreeMap<&'static str, Expr>,
    pub inspected: Option<Inspected>,
    pub verify: bool,
    /// `Some(None)`: no backdrop.
    pub backdrop: Option<Option<Expr>>,
}

impl<'a> Checker<'a> {
    pub(super) fn study(&mut self, study: &'a tree::Study) -> Study {
        let mut out = Study {
            name: study.name.text.clone(),
            program: None,
            task: None,
            objects: None,
            methods: Vec::new(),
            starts: None,
            seeds: None,
            noises: Vec::new(),
            published: None,
            common: Settings::default(),
            variants: Vec::new(),
            span: study.head,
        };
        let mut settings = Vec::new();
        for statement in self.each_once(study) {
            match &statement.kind {
                Kind::Setting(setting) => settings.push((setting, statement.span)),
                Kind::Variant(variant) => {
                    let changed = self.settings(variant.settings.iter().map(|(s, span)| (s, *span)));
                    out.variants.push((variant.name.clone(), changed));
                }
                kind => self.study_statement(kind, &mut out),
            }
        }
        out.common = self.settings(settings);
        names::unique("variant", out.variants.iter().map(|(name, _)| name), &mut self.found);
        if study.whole && out.methods.is_empty() {
            let message = format!("study `{}` has no `methods`", study.name.text);
            let help = "add the methods that it compares: `methods gn, random`";
            self.report(Diagnostic::new(Code::E0308, study.name.span, message).help(help));
        }
        out
    }

    /// The statements without those that stand there twice; variants may.
    fn each_once(&mut self, study: &'a tree::Study) -> Vec<&'a tree::StudyStatement> {
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        let mut out = Vec::new();
        for statement in &study.statements {
            let word = statement.kind.word();
            match seen.get(word) {
                Some(first) if word != "variant" => self.surplus(statement.span, *first, word),
                _ => {
                    seen.insert(word, statement.span);
                    out.push(statement);
                }
            }
        }
        out
    }

    fn study_statement(&mut self, kind: &'a Kind, out: &mut Study) {
        match kind {
            Kind::Program(path) => out.program = Some(path.clone()),
            Kind::Task(name) => out.task = Some(name.clone()),
            Kind::Published(path) => out.published = Some(path.clone()),
            Kind::Objects(objects) => {
                let objects: Vec<Object> = objects.iter().filter_map(|o| self.studied(o)).collect();
                let named = objects.iter().filter_map(|o| match o {
                    Object::Named(name) => Some(name),
                    Object::Mesh(_) => None,
                });
                names::unique("object", named, &mut self.found);
                out.objects = Some(objects);
            }
            Kind::Methods(methods) => {
                names::unique("method", methods, &mut self.found);
                out.methods = methods.iter().filter_map(|name| self.method(name)).collect();
            }
            Kind::Noise(noises) => {
                names::unique("noise", noises, &mut self.found);
                let known = |name: &'a Name| self.one_of_words(name, "`noise`", NOISES).map(str::to_owned);
                out.noises = noises.iter().filter_map(known).collect();
            }
            Kind::Starts(e) => out.starts = self.count_of(e, "`starts`"),
            Kind::Seeds(e) => out.seeds = self.count_of(e, "`seeds`"),
            Kind::Variant(_) | Kind::Setting(_) => {}
        }
    }

    fn count_of(&mut self, e: &tree::Expr, what: &str) -> Option<Expr> {
        self.check(e, Due { ty: Type::Count, what }, Scope::of(self.program.main()))
    }

    fn studied(&mut self, object: &tree::Expr) -> Option<Object> {
        match &object.kind {
            tree::ExprKind::Reference(r) if r.index.is_none() && r.fields.is_empty() => {
                Some(Object::Named(r.name.clone()))
            }
            tree::ExprKind::Call(call) if call.name.text == "mesh" => {
                let due = Due {
                    ty: Type::Shape,
                    what: "an object",
                };
                self.check(object, due, Scope::of(self.program.main()))
                    .map(Object::Mesh)
            }
            _ => {
                let message = "an object of a study is a name, or a mesh by its file";
                let help =
                    "declare it as an `object` of a `scene` in this file, or write `mesh(file: …, units: mm, up: z)`";
                self.report(Diagnostic::new(Code::E0301, object.span, message).help(help));
                None
            }
        }
    }

    /// What some settings change.
    fn settings<'s>(&mut self, settings: impl IntoIterator<Item = (&'s Setting, Span)>) -> Settings {
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        let mut draft = Draft::default();
        let mut backdrop = None;
        for (setting, at) in settings {
            if let Some(first) = seen.insert(setting.word(), at) {
                self.surplus(at, first, setting.word());
                continue;
            }
            match setting {
                Setting::Task(kind) => self.setting(kind, at, &mut draft, &[]),
                Setting::Voxel(e) => self.value(&mut draft, "voxel", e, Type::Length),
                Setting::Backdrop(e) => backdrop = Some(self.backdrop(Some(e), at)),
            }
        }
        let given = |fields: BTreeMap<&'static str, Option<Expr>>| {
            fields.into_iter().filter_map(|(name, e)| Some((name, e?))).collect()
        };
        Settings {
            values: draft.values,
            thresholds: given(draft.thresholds),
            sensor_model: given(draft.sensor_model),
            inspected: draft.inspected,
            verify: draft.verify,
            backdrop,
        }
    }
}
