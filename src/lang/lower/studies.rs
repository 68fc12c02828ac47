//! Studies: the program's task and objects by name, settings in SI units.

use std::collections::BTreeMap;

use super::expand::Env;
use super::{Lowered, Lowering};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::source::Span;
use crate::lang::studies::{Studied, folder};
use crate::lang::syntax::tree::Name;
use crate::lang::types::studies::{Object, Settings as Typed, Study as TypedStudy};
use crate::lang::types::typed;
use crate::lang::world::normal;
use crate::primitives;
use crate::rules::{Call, RuleSet, Scene, SceneObject, Settings, Study, Subject, Value, Variant};

/// Start views where a study does not say.
const USUAL_STARTS: u32 = 16;
/// Most start views or seeds.
const MOST_COUNTED: u64 = 1_000_000;

/// Objects that a study can name: those of the program, then those of its own file.
type Shown<'a> = Vec<(&'a Scene, &'a SceneObject, &'a str)>;

impl<'a> Lowering<'a> {
    /// The studies of the main file, as far as they are right.
    pub(super) fn studies(&mut self, lowered: &Lowered, programs: &[Option<Studied>]) -> Vec<Study> {
        let typed = self.typed;
        let both = typed.studies.iter().zip(programs);
        both.filter_map(|(study, program)| self.study(study, &lowered.rules, program.as_ref()))
            .collect()
    }

    fn study(&mut self, study: &'a TypedStudy, own: &RuleSet, program: Option<&Studied>) -> Option<Study> {
        let main = self
            .sources
            .get(crate::lang::FileId(0))
            .map_or("", |f| f.display.as_str());
        let here = folder(main).to_owned();
        let (rules, mut shown): (&RuleSet, Shown<'_>) = match (&study.program, program) {
            (None, _) => (own, objects(own, &here)),
            (Some(_), Some(studied)) => {
                let rules = studied.compiled.rules.as_ref()?;
                (rules, objects(rules, &studied.folder))
            }
            (Some(_), None) => return None,
        };
        if study.program.is_some() {
            shown.extend(objects(own, &here));
        }
        let task = self.studied_task(study, rules);
        let objects = self.subjects(study, &shown, &here);
        let starts = self.counted(study.starts.as_ref(), USUAL_STARTS, "`starts`");
        let seeds = self.counted(study.seeds.as_ref(), 1, "`seeds`");
        let variants = self.variants(study);
        let published = study
            .published
            .as_ref()
            .map(|path| normal(&format!("{here}{}", path.text)));
        Some(Study {
            name: study.name.clone(),
            rules: rules.clone(),
            task: task?,
            objects: objects?,
            methods: study.methods.clone(),
            starts: starts?,
            seeds: seeds?,
            noises: match study.noises.as_slice() {
                [] => vec!["none".to_owned()],
                some => some.to_vec(),
            },
            published,
            variants: variants?,
        })
    }

    fn studied_task(&mut self, study: &TypedStudy, rules: &RuleSet) -> Option<String> {
        let names = || rules.tasks.iter().map(|t| t.name.as_str());
        match &study.task {
            Some(task) if names().any(|n| n == task.text) => Some(task.text.clone()),
            Some(task) => {
                self.unknown("task", task, names());
                None
            }
            None => {
                let first = names().next().map(str::to_owned);
                if first.is_none() {
                    let message = format!("study `{}` has no task to run", study.name);
                    let help = "name the program that has one: `program \"solids.vpl\"`";
                    self.report(Diagnostic::new(Code::E0506, study.span, message).help(help));
                }
                first
            }
        }
    }

    fn subjects(&mut self, study: &'a TypedStudy, shown: &Shown<'_>, here: &str) -> Option<Vec<Subject>> {
        let out: Option<Vec<Subject>> = match &study.objects {
            None => Some(
                shown
                    .iter()
                    .map(|(scene, object, folder)| subject(scene, object, folder))
                    .collect(),
            ),
            Some(objects) => {
                let found: Vec<Option<Subject>> = objects
                    .iter()
                    .map(|object| match object {
                        Object::Named(name) => self.named_subject(name, shown),
                        Object::Mesh(e) => self.mesh_subject(e, shown, here),
                    })
                    .collect();
                found.into_iter().collect()
            }
        };
        let out = out?;
        if out.is_empty() {
            let message = format!("study `{}` has no object", study.name);
            let help = "declare objects in a `scene` of the program or of this file, or name mesh files";
            self.report(Diagnostic::new(Code::E0506, study.span, message).help(help));
            return None;
        }
        self.told_apart(&out, study.span).then_some(out)
    }

    /// Rows go by the names of objects: each must be its own.
    fn told_apart(&mut self, subjects: &[Subject], at: Span) -> bool {
        let mut seen = std::collections::BTreeSet::new();
        let twice = subjects.iter().find(|s| !seen.insert(s.object.name.as_str()));
        if let Some(twice) = twice {
            let message = format!("two objects of this study are called `{}`", twice.object.name);
            let help = "give one of them another name: its rows could not be told apart";
            self.report(Diagnostic::new(Code::E0202, at, message).help(help));
        }
        twice.is_none()
    }

    fn named_subject(&mut self, name: &Name, shown: &Shown<'_>) -> Option<Subject> {
        let found = shown.iter().find(|(_, object, _)| object.name == name.text);
        if found.is_none() {
            self.unknown("object", name, shown.iter().map(|(_, object, _)| object.name.as_str()));
        }
        found.map(|(scene, object, folder)| subject(scene, object, folder))
    }

    /// A mesh by its file, called as the file without its extension.
    fn mesh_subject(&mut self, e: &'a typed::Expr, shown: &Shown<'_>, here: &str) -> Option<Subject> {
        let shape = self.primitive(e, &Env::default())?;
        let file = shape.text("file").unwrap_or_default();
        let name = file.rsplit('/').next().unwrap_or(file);
        let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem).to_owned();
        let backdrop = shown.first().map(|(scene, ..)| scene.backdrop);
        Some(Subject {
            object: SceneObject {
                name,
                shape,
                world_from_object: crate::geometry::Pose::identity(),
                markers: Vec::new(),
                place: self.place(e.span),
            },
            backdrop: backdrop.unwrap_or(Some(crate::lang::types::forms::usual_backdrop())),
            centred: true,
            folder: here.to_owned(),
        })
    }

    fn unknown<'n>(&mut self, kind: &str, name: &Name, known: impl Iterator<Item = &'n str> + Clone) {
        let out = Diagnostic::new(Code::E0208, name.span, format!("there is no {kind} `{}`", name.text));
        self.report(match closest(&name.text, known.clone()) {
            Some(near) => out.meant(near),
            None if known.clone().next().is_none() => out.help(format!("the program has no {kind}")),
            None => out.help(format!("there is {}", one_of(known).replace(" or ", " and "))),
        });
    }

    fn counted(&mut self, given: Option<&'a typed::Expr>, usual: u32, what: &str) -> Option<u32> {
        let Some(e) = given else { return Some(usual) };
        match self.value(e, &Env::default())? {
            Value::Count(n) if (1..=MOST_COUNTED).contains(&n) => Some(n as u32),
            _ => {
                let message = format!("{what} is between 1 and {MOST_COUNTED}");
                self.report(Diagnostic::new(Code::E0309, e.span, message));
                None
            }
        }
    }

    fn variants(&mut self, study: &'a TypedStudy) -> Option<Vec<Variant>> {
        let common = self.settings(&study.common);
        let changed: Vec<Option<Variant>> = study
            .variants
            .iter()
            .map(|(name, settings)| {
                let settings = self.settings(settings)?;
                Some(Variant {
                    name: name.text.clone(),
                    settings,
                })
            })
            .collect();
        let common = common?;
        let mut out = vec![Variant {
            name: String::new(),
            settings: common.clone(),
        }];
        for variant in changed {
            let Variant { name, settings } = variant?;
            out.push(Variant {
                name,
                settings: settings.or(&common),
            });
        }
        Some(out)
    }

    fn settings(&mut self, typed: &'a Typed) -> Option<Settings> {
        let mut out = Settings {
            inspected: typed.inspected,
            verify: typed.verify,
            ..Settings::default()
        };
        for (word, e) in &typed.values {
            self.set(word, e, &mut out)?;
        }
        out.thresholds = self.fields(&typed.thresholds)?;
        out.sensor_model = self.fields(&typed.sensor_model)?;
        out.backdrop = match &typed.backdrop {
            None => None,
            Some(None) => Some(None),
            Some(Some(e)) => Some(Some(self.backdrop(e)?)),
        };
        Some(out)
    }

    fn set(&mut self, word: &str, e: &'a typed::Expr, out: &mut Settings) -> Option<()> {
        if matches!(word, "camera" | "views") {
            let call: Call = self.primitive(e, &Env::default())?;
            match word {
                "camera" => out.camera = Some(primitives::camera(&call).ok()?),
                _ => out.views = Some(call),
            }
            return Some(());
        }
        let small = |n: u64| u32::try_from(n).unwrap_or(u32::MAX);
        match (word, self.value(e, &Env::default())?) {
            ("voxel", Value::Length(x)) if x > 0.0 => out.voxel = Some(x),
            ("overlap", Value::Share(x)) if (0.0..=1.0).contains(&x) => out.overlap = Some(x),
            ("limit", Value::Count(n)) if n > 0 => out.limit = Some(small(n)),
            ("gain_floor", Value::Count(n)) => out.gain_floor = Some(small(n)),
            _ => {
                let message = format!("`{word}` is out of range");
                self.report(Diagnostic::new(Code::E0309, e.span, message));
                return None;
            }
        }
        Some(())
    }

    fn fields(&mut self, typed: &'a BTreeMap<&'static str, typed::Expr>) -> Option<BTreeMap<String, f64>> {
        let mut out = BTreeMap::new();
        for (name, e) in typed {
            let value = match self.value(e, &Env::default())? {
                Value::Length(x) if x > 0.0 => x,
                Value::Share(x) if (0.0..=1.0).contains(&x) => x,
                _ => {
                    let message = format!("`{name}` is out of range");
                    self.report(Diagnostic::new(Code::E0309, e.span, message));
                    return None;
                }
            };
            out.insert((*name).to_owned(), value);
        }
        Some(out)
    }
}

fn objects<'a>(rules: &'a RuleSet, folder: &'a str) -> Shown<'a> {
    let scenes = rules.scenes.iter();
    scenes
        .flat_map(|scene| scene.objects.iter().map(move |o| (scene, o, folder)))
        .collect()
}

fn subject(scene: &Scene, object: &SceneObject, folder: &str) -> Subject {
    Subject {
        object: object.clone(),
        backdrop: scene.backdrop,
        centred: false,
        folder: folder.to_owned(),
    }
}
