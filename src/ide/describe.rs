//! What a name denotes, in a line of VPL and a few sentences.

use super::find::{Declaration, declaration, heads};
use super::{Snapshot, docs, values};
use crate::lang::index::{Entity, Kind, Signature};
use crate::lang::syntax::tree::{self, Index};
use crate::lang::{FileId, Span, callable, vocabulary};
use crate::primitives::{self, Primitive, Type, attributes, written};
use crate::rules::{FeatureKind, Library};

/// Longest excerpt of a definition's body, bytes.
const LONGEST_EXCERPT: usize = 400;

/// What there is to say about a thing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Description {
    /// As it would be written.
    pub code: String,
    /// Sentences about it, as they follow from the program.
    pub facts: Vec<String>,
    /// Its documentation.
    pub docs: String,
}

impl Description {
    fn new(code: impl Into<String>) -> Self {
        Self {
            code: code.into(),
            ..Self::default()
        }
    }

    fn docs(mut self, text: impl Into<String>) -> Self {
        self.docs = text.into();
        self
    }

    fn fact(mut self, text: impl Into<String>) -> Self {
        self.facts.push(text.into());
        self
    }

    /// In Markdown.
    pub fn markdown(&self) -> String {
        let code = (!self.code.is_empty()).then(|| format!("```vpl\n{}\n```", self.code));
        let parts = code.into_iter().chain([self.docs.clone(), self.facts.join("  \n")]);
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n\n")
    }
}

/// Describes what a name denotes.
pub(super) fn describe(snapshot: &Snapshot, entity: Entity) -> Option<Description> {
    Some(match entity {
        Entity::Declared(kind, name) => return declared(snapshot, kind, name),
        Entity::Module(file) => module(snapshot, file)?,
        Entity::Primitive(name) => primitive(callable(name)?),
        Entity::Argument(callee, name) => argument(callable(callee)?, name)?,
        Entity::Attribute(kind, name) => attribute(kind.into(), name)?,
        Entity::Type(name) => type_of(name),
        Entity::Unit(name) => unit(name),
        Entity::Colour(name) => {
            let colour = vocabulary::colours().find(|(n, _)| *n == name)?.1;
            Description::new(name).docs(format!("The colour `{colour}`."))
        }
        Entity::Field(statement, name) => {
            let ty = vocabulary::fields(statement).iter().find(|(n, _)| *n == name)?.1;
            let code = format!("{statement} {{ {name}: {} }}", written(ty));
            Description::new(code).docs(docs::field(statement, name).unwrap_or_default())
        }
        Entity::Word(word) => Description::new(word).docs(docs::word(word).unwrap_or_default()),
    })
}

fn declared(snapshot: &Snapshot, kind: Kind, name: Span) -> Option<Description> {
    let found = declaration(snapshot.tree(name.file)?, name)?;
    let text = snapshot.sources().get(name.file).map_or("", |file| &file.text);
    let above = docs::above(text, name.start);
    Some(match found {
        Declaration::Let(item) => definition(snapshot, item).docs(above),
        Declaration::Parameter(owner, found) => parameter(snapshot, owner, found),
        Declaration::Library(library) => of_library(snapshot, library).docs(above),
        Declaration::Feature(library, feature) => of_feature(snapshot, library, feature).docs(above),
        Declaration::Class => class(snapshot, name).docs(above),
        Declaration::Layout(layout) => rules_of(
            snapshot,
            layout.head,
            Description::new(format!("layout {}", layout.name.text))
                .fact(format!("{}.", counted(layout.places.len(), "place"))),
        )
        .docs(above),
        Declaration::Variable(library, rule) => variable(snapshot, kind, library, rule, name),
        Declaration::Task(task) => of_task(snapshot, task).docs(above),
        Declaration::Scene(scene) => Description::new(format!("scene {}", scene.name.text))
            .fact(format!("{}.", counted(scene.objects.len(), "object")))
            .docs(above),
        Declaration::Object(object) => Description::new(excerpt(snapshot, object.span)).docs(above),
    })
}

/// The signature of a definition and what it stands for.
fn definition(snapshot: &Snapshot, item: &tree::Let) -> Description {
    let usual = Signature::default();
    let signature = snapshot.index().signature(item.name.span).unwrap_or(&usual);
    let head = format!("let {}", call(&item.name.text, signature));
    let home = snapshot.sources().get(item.name.span.file).map_or("", |f| &f.path);
    let body = excerpt(snapshot, item.body.span);
    let out = Description::new(format!("{head}\n  = {body}"));
    match item.name.span.file {
        super::MAIN => out,
        _ => out.fact(format!("From `{home}`.")),
    }
}

/// `large_qr(text: text) -> detector`.
pub(super) fn call(name: &str, signature: &Signature) -> String {
    let parameters = signature.parameters.iter();
    let mark = |optional| if optional { "?" } else { "" };
    let parameters = parameters.map(|p| format!("{}: {}{}", p.name, type_name(p.ty), mark(p.optional)));
    let parameters: Vec<String> = parameters.collect();
    let list = match parameters.as_slice() {
        [] => String::new(),
        all => format!("({})", all.join(", ")),
    };
    format!("{name}{list} -> {}", type_name(signature.result))
}

pub(super) fn type_name(ty: Option<Type>) -> String {
    ty.map_or_else(|| "?".to_owned(), written)
}

fn parameter(snapshot: &Snapshot, owner: &tree::Name, found: &tree::Parameter) -> Description {
    let span = found.default.as_ref().map_or(found.ty.span, |default| default.span);
    let code = excerpt(snapshot, found.name.span.to(span));
    let out = Description::new(code).fact(format!("A parameter of `{}`.", owner.text));
    match snapshot.index().type_of(found.name.span) {
        Some(ty) => out.docs(in_words(ty)),
        None => out,
    }
}

/// `A length, like `10 mm`.`
fn in_words(ty: Type) -> String {
    let what = capital(&vocabulary::describe(ty));
    match vocabulary::example(ty) {
        Some(example) => format!("{what}, {example}."),
        None => format!("{what}."),
    }
}

fn of_library(snapshot: &Snapshot, library: &tree::Library) -> Description {
    let out = Description::new(format!("library {}", library.name.text));
    match expanded(snapshot, library) {
        Some(rules) => out.fact(format!(
            "{}, {}, {}.",
            counted(rules.features.len(), "feature"),
            counted(rules.classes.len(), "class"),
            counted(rules.rules.len(), "rule")
        )),
        None => out,
    }
}

/// The library as it expands.
fn expanded<'s>(snapshot: &'s Snapshot, library: &tree::Library) -> Option<&'s Library> {
    let libraries = &snapshot.expansion().rules.as_ref()?.libraries;
    libraries.iter().find(|l| l.name == library.name.text)
}

fn of_feature(snapshot: &Snapshot, library: &tree::Library, feature: &tree::Feature) -> Description {
    let mut out = Description::new(excerpt(snapshot, feature.span));
    if let Some((_, kind)) = vocabulary::kinds().find(|(name, _)| *name == feature.kind.text) {
        let names: Vec<String> = attributes(kind).iter().map(|a| format!("`.{}`", a.name)).collect();
        out = out.fact(format!("Measured, it has {}.", names.join(", ")));
    }
    let Some(rules) = expanded(snapshot, library) else {
        return out;
    };
    let members = || {
        rules
            .feature_ids()
            .filter(|id| Span::from(rules.feature(*id).place) == feature.span)
    };
    let with = rules.classes.iter().filter(|c| members().any(|id| c.presence.has(id)));
    let concluded = rules.rules.iter().filter(|r| members().any(|id| id == r.consequent));
    out.fact(format!(
        "In {} of {}, concluded by {}.",
        with.count(),
        counted(rules.classes.len(), "class"),
        counted(concluded.count(), "rule")
    ))
}

/// A class with its presence row and its prior.
fn class(snapshot: &Snapshot, name: Span) -> Description {
    let rules = snapshot.expansion().rules.iter();
    let found = rules.flat_map(|r| &r.libraries).find_map(|library| {
        let here = |c: &&crate::rules::Class| {
            let span = Span::from(c.place);
            span.file == name.file && span.start <= name.start && name.end <= span.end
        };
        Some((library, library.classes.iter().find(here)?))
    });
    let written = snapshot.sources().text(name);
    let Some((library, class)) = found else {
        return Description::new(format!("class {written}"));
    };
    let has = library.feature_ids().filter(|id| class.presence.has(*id));
    let has: Vec<&str> = has.map(|id| library.feature(id).name.as_str()).collect();
    let row = String::from(class.presence.clone());
    Description::new(format!("class {written} {{ {} }}", shortened(&has)))
        .fact(format!("Presence row `{}`.", cut(&row, 64)))
        .fact(format!("Prior {} %.", values::short(class.prior * 100.0)))
}

fn shortened(names: &[&str]) -> String {
    const MOST: usize = 12;
    match names.len() {
        n if n > MOST => format!("{}, … {} more", names[..MOST].join(", "), n - MOST),
        _ => names.join(", "),
    }
}

/// How many rules something written once stands for.
pub(super) fn rules_from(snapshot: &Snapshot, head: Span) -> usize {
    let libraries = snapshot.expansion().rules.iter().flat_map(|r| &r.libraries);
    let rules = libraries.flat_map(|l| &l.rules);
    rules.filter(|r| Span::from(r.place) == head).count()
}

fn rules_of(snapshot: &Snapshot, head: Span, out: Description) -> Description {
    match rules_from(snapshot, head) {
        0 => out,
        n => out.fact(format!("{}.", counted(n, "rule"))),
    }
}

/// A rule, by its first line.
pub(super) fn rule(snapshot: &Snapshot, rule: &tree::Rule) -> Description {
    let out = Description::new(excerpt(snapshot, rule.head));
    let out = rules_of(snapshot, rule.head, out);
    match rule.antecedents.is_empty() {
        true => out.fact("A definite rule: it needs nothing detected before."),
        false => out,
    }
}

fn variable(snapshot: &Snapshot, kind: Kind, library: &tree::Library, rule: &tree::Rule, name: Span) -> Description {
    let written = snapshot.sources().text(name);
    if kind == Kind::Variable {
        let each = rule.each.iter().find(|e| e.variable.span == name);
        let over = each.map_or("", |e| snapshot.sources().text(e.over.span));
        let ty = snapshot.index().type_of(name);
        return Description::new(format!("{written}: {}", type_name(ty))).fact(format!("Each of `{over}` in turn."));
    }
    let out = Description::new(written).fact("An index of this rule.");
    match range(library, rule, written) {
        Some((first, last)) => out.fact(format!("`{first}` to `{last}`.")),
        None => out,
    }
}

/// The values that all families of an index variable have.
fn range(library: &tree::Library, rule: &tree::Rule, variable: &str) -> Option<(u64, u64)> {
    let uses = heads(rule).filter(|f| matches!(&f.index, Some(Index::Variable(v)) if v.text == variable));
    let declared = uses.filter_map(|f| {
        let feature = library.features.iter().find(|d| d.name.name.text == f.name.text)?;
        match feature.name.index {
            Some(Index::Range(first, last, _)) => Some((first, last)),
            Some(Index::Literal(n, _)) => Some((n, n)),
            _ => None,
        }
    });
    declared.reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)))
}

fn of_task(snapshot: &Snapshot, task: &tree::Task) -> Description {
    let out = Description::new(format!("task {}", task.name.text));
    let rules = snapshot.expansion().rules.as_ref();
    let Some(done) = rules.and_then(|r| r.tasks.iter().find(|t| t.name == task.name.text)) else {
        return out;
    };
    let cells = done.space.size.map(|x| (x / done.space.voxel).round());
    let views = primitives::poses(&done.views, &done.space).map_or(0, |poses| poses.len());
    out.fact(format!(
        "{}, at most {} taken.",
        counted(views, "candidate view"),
        done.limit
    ))
    .fact(format!("A map of {} × {} × {} voxels.", cells.x, cells.y, cells.z))
    .fact(format!("Method `{}`.", done.method))
}

fn module(snapshot: &Snapshot, file: FileId) -> Option<Description> {
    let names: Vec<&str> = snapshot.index().scope(file).map(|(name, _)| name).collect();
    let path = &snapshot.sources().get(file)?.path;
    let list: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
    Some(Description::new(format!("\"{path}\"")).fact(format!("In scope there: {}.", list.join(", "))))
}

fn primitive(primitive: &Primitive) -> Description {
    let parameters: Vec<String> = primitive.parameters.iter().map(primitives::signature).collect();
    let kinds: Vec<String> = primitive.features.iter().map(|k| format!("{k}s")).collect();
    let code = format!(
        "{}({}) -> {}",
        primitive.name,
        parameters.join(", "),
        written(primitive.result)
    );
    let out = Description::new(code).docs(primitive.doc);
    let out = primitive
        .parameters
        .iter()
        .fold(out, |out, p| out.fact(format!("`{}`: {}", p.name, p.doc)));
    match kinds.as_slice() {
        [] => out,
        kinds => out.fact(format!("For {}.", kinds.join(" and "))),
    }
}

fn argument(callee: &Primitive, name: &str) -> Option<Description> {
    let parameter = callee.parameters.iter().find(|p| p.name == name)?;
    let out = Description::new(primitives::signature(parameter)).docs(parameter.doc);
    Some(out.fact(format!("A parameter of `{}`.", callee.name)))
}

fn attribute(kind: FeatureKind, name: &str) -> Option<Description> {
    let found = attributes(kind).iter().find(|a| a.name == name)?;
    let out = Description::new(format!("{name}: {}", written(found.ty))).docs(found.doc);
    Some(out.fact(format!("An attribute of a measured {kind}.")))
}

fn type_of(name: &str) -> Description {
    let out = Description::new(name);
    if let Some((_, kind)) = vocabulary::kinds().find(|(n, _)| *n == name) {
        let names = attributes(kind).iter().map(|a| format!("`.{}`: {}", a.name, a.doc));
        return names.fold(out, Description::fact);
    }
    match vocabulary::types().find(|(n, _)| *n == name) {
        Some((_, ty)) => out.docs(in_words(ty)),
        None => out,
    }
}

fn unit(name: &str) -> Description {
    let out = Description::new(name);
    let Some((_, ty, si)) = vocabulary::units().find(|(n, ..)| *n == name) else {
        return out.docs("A noun after a whole number.");
    };
    let one = vocabulary::quantity(1.0, name).as_ref().and_then(values::said);
    let out = out.docs(format!("A unit of {}.", article_off(&vocabulary::describe(ty))));
    match one.filter(|_| si != 1.0) {
        Some(one) => out.fact(format!("1 {name} = {one}")),
        None => out,
    }
}

/// `1 rule`, `2 classes`.
pub(super) fn counted(n: usize, noun: &str) -> String {
    match (n, noun.ends_with('s')) {
        (1, _) => format!("1 {noun}"),
        (_, true) => format!("{n} {noun}es"),
        (_, false) => format!("{n} {noun}s"),
    }
}

fn article_off(words: &str) -> &str {
    words.split_once(' ').map_or(words, |(_, noun)| noun)
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars
        .next()
        .map_or(String::new(), |c| c.to_uppercase().chain(chars).collect())
}

/// The text under a span, on one line and not too long.
fn excerpt(snapshot: &Snapshot, span: Span) -> String {
    let text = snapshot.sources().text(span);
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(line).trim());
    let words: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    cut(&words.join(" "), LONGEST_EXCERPT)
}

fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text.to_owned(),
    }
}
