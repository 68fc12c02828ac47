//! What fits at the cursor.

use super::context::{Block, Context};
use super::due::{Frame, Reading, is_word, parameters};
use super::imports::{self, defined};
use super::snippets::{keyword, statements};
use super::standard;
use super::{Completion, CompletionKind as Kind};
use crate::ide::describe::type_name;
use crate::ide::find::{Declaration, declaration};
use crate::ide::{MAIN, Snapshot, docs};
use crate::lang::syntax::TokenClass;
use crate::lang::syntax::tree::{self, Index, Item};
use crate::lang::{World, vocabulary};
use crate::primitives::{self, Type, attributes, written};
use crate::rules::FeatureKind;

/// Everything that fits.
pub(super) fn offers(snapshot: &Snapshot, world: &dyn World, context: &Context<'_>) -> Vec<Completion> {
    let offering = Offering {
        snapshot,
        world,
        context,
        reading: Reading::of(context, snapshot),
    };
    offering.all()
}

/// Most libraries whose features are looked at.
const MOST_TAKEN: usize = 64;

struct Offering<'a> {
    snapshot: &'a Snapshot,
    world: &'a dyn World,
    context: &'a Context<'a>,
    reading: Reading<'a>,
}

impl Offering<'_> {
    fn all(&self) -> Vec<Completion> {
        let import = self.context.statement.first().is_some_and(|w| w.text == "use");
        match self.context.block {
            Block::Prose => return Vec::new(),
            Block::Imports => return imports::offers(self.snapshot, self.world, self.context),
            Block::Top if import => return imports::offers(self.snapshot, self.world, self.context),
            _ => {}
        }
        if matches!(self.reading.keyword(), "let" | "library") && self.context.block == Block::Top {
            return self.in_definition();
        }
        let last = self.reading.last.map_or("", |w| w.text);
        if last == "." {
            return self.after_dot();
        }
        if self.reading.last.is_some_and(|w| w.class == TokenClass::Number) {
            return self.units();
        }
        match self.reading.frames.last() {
            Some(Frame::Call(callee, ..)) => self.in_call(callee),
            Some(Frame::Index(feature)) => self.indices(feature),
            Some(Frame::List(due) | Frame::Group(due)) => self.values(*due),
            _ => self.in_statement(),
        }
    }

    // ---- Statements ---------------------------------------------------------

    fn in_statement(&self) -> Vec<Completion> {
        let begins = self.context.statement.iter().all(|w| matches!(w.text, "{" | "}" | ","));
        match (self.context.block, self.reading.keyword()) {
            (Block::Class | Block::Table, _) if self.context.block == Block::Class => self.features(),
            (Block::Layout, "") => self.features(),
            (Block::Fields(statement), _) => self.fields(statement),
            (_, "") if begins && self.closed() => vec![keyword("prior")],
            (block, "") if begins => statements(block),
            (_, word) => self.in_words(word),
        }
    }

    /// Whether the statement is a class that just closed its brace.
    fn closed(&self) -> bool {
        let head = self.context.head.first().map_or("", |w| w.text);
        head == "class" && self.context.statement.last().is_some_and(|w| w.text == "}")
    }

    /// Behind the keyword of a statement.
    fn in_words(&self, word: &str) -> Vec<Completion> {
        if self.reading.after_value() {
            let next = self.next_keywords(word);
            if !next.is_empty() || !matches!(word, "rule" | "by" | "feature") {
                return next;
            }
        }
        match word {
            "library" | "marked" if self.context.block != Block::Top => self.libraries(),
            "as" => self.classes(),
            "goal" | "and" => words_of("goal"),
            "method" | "methods" | "noise" | "inspected" | "visibility" | "verify" | "insertion" => words_of(word),
            "space" => vocabulary::forms("space").iter().map(called).collect(),
            "backdrop" => {
                let none = Completion::new("none", Kind::Word).docs("Empty air.");
                vocabulary::forms("backdrop").iter().map(called).chain([none]).collect()
            }
            "class" | "classes" if self.context.block == Block::Test => classes(self.library()),
            "rule" | "by" | "given" | "expect" => self.features(),
            "use" => self.templates(),
            "in" => self.lists(),
            "for" => vec![keyword("each"), keyword("in")],
            "classes" => vec![keyword("by")],
            "feature" => self.of_feature(),
            "class" | "layout" | "task" | "scene" | "study" | "variant" | "objects" => Vec::new(),
            _ => self.values(self.reading.due),
        }
    }

    /// Keywords that can follow a finished value.
    fn next_keywords(&self, word: &str) -> Vec<Completion> {
        let next: &[&str] = match (self.context.block, word) {
            (Block::Task, "space") => &["at"],
            (Block::Task, "at") => &["voxel"],
            (Block::Task, "goal") => &["and"],
            (Block::Layout, "") => &["at"],
            (Block::Layout, "at") => &["facing"],
            (Block::Scene, "object") => &["at"],
            (Block::Scene, "at") => &["turned", "marked"],
            (Block::Scene, "turned") => &["marked"],
            (Block::Scene, "marked") => &["as"],
            (Block::Rule, "detect" | "measure" | "predict") => &["else"],
            (Block::Rule, "for") => &["in"],
            (Block::Library, "classes") => &["by"],
            (Block::Library, "feature") if !self.has(":") => &[],
            (Block::Library, "feature") => &["many"],
            (Block::Table, _) => &["prior"],
            _ => &[],
        };
        next.iter().map(|word| keyword(word)).collect()
    }

    fn has(&self, mark: &str) -> bool {
        self.context.statement.iter().any(|w| w.text == mark)
    }

    /// `feature name : KIND many`.
    fn of_feature(&self) -> Vec<Completion> {
        if !self.has(":") {
            return Vec::new();
        }
        let kinds = vocabulary::kinds();
        kinds
            .map(|(name, _)| Completion::new(name, Kind::Type).detail("kind of feature"))
            .collect()
    }

    /// `let name(parameter: TYPE) = VALUE`.
    fn in_definition(&self) -> Vec<Completion> {
        if self.has("=") {
            return self.values(None);
        }
        match self.reading.last.map(|w| w.text) {
            Some(":" | "[") if self.reading.frames.len() > 1 => vocabulary::types()
                .map(|(name, ty)| Completion::new(name, Kind::Type).detail(vocabulary::describe(ty)))
                .collect(),
            _ => Vec::new(),
        }
    }

    fn fields(&self, statement: &'static str) -> Vec<Completion> {
        if self.reading.last.is_some_and(|w| w.text == ":") {
            return self.values(self.reading.due);
        }
        let named = |name: &str| self.context.statement.iter().any(|w| w.text == name);
        let fields = vocabulary::fields(statement).iter().filter(|(name, _)| !named(name));
        let offer = |(name, ty): &(&str, Type)| {
            Completion::new(*name, Kind::Argument)
                .detail(written(*ty))
                .docs(docs::field(statement, name).unwrap_or_default())
                .snippet(format!("{name}: $0"))
        };
        fields.map(offer).collect()
    }

    // ---- Names --------------------------------------------------------------

    fn library(&self) -> Option<&tree::Library> {
        let named = self.context.before.windows(2).find(|w| w[0].text == "library");
        match (self.context.block, named) {
            (Block::Test, Some(words)) => self.snapshot.library(words[1].text),
            _ => self.snapshot.library(self.context.library.as_deref()?),
        }
    }

    /// The features of the library, those that it takes over included.
    fn declared_features(&self) -> Vec<&tree::Feature> {
        let mut libraries: Vec<&tree::Library> = self.library().into_iter().collect();
        let mut next = 0;
        while let Some(library) = libraries.get(next).copied().filter(|_| next < MOST_TAKEN) {
            let taken = library
                .uses
                .iter()
                .filter_map(|inclusion| self.taken(library, inclusion));
            libraries.extend(taken.collect::<Vec<_>>());
            next += 1;
        }
        libraries.iter().flat_map(|l| &l.features).collect()
    }

    /// A library that another takes over.
    fn taken(&self, library: &tree::Library, inclusion: &tree::Inclusion) -> Option<&tree::Library> {
        let file = library.name.span.file;
        let mut known = self.snapshot.index().libraries(file);
        let (_, at) = known.find(|(name, _)| *name == inclusion.call.name.text)?;
        match declaration(self.snapshot.tree(at.file)?, at)? {
            Declaration::Library(library) => Some(library),
            _ => None,
        }
    }

    fn features(&self) -> Vec<Completion> {
        let features = self.declared_features().into_iter();
        features
            .map(|feature| {
                let name = &feature.name.name.text;
                let (shown, snippet) = match (&feature.name.index, self.context.block) {
                    (None, _) => (name.clone(), None),
                    (Some(_), Block::Library) => (format!("{name}[i]"), Some(format!("{name}[${{1:i}}]$0"))),
                    (Some(_), _) => (name.clone(), Some(format!("{name}[$1]$0"))),
                };
                let offer = Completion::new(shown, Kind::Feature).detail(self.written(feature));
                Completion { snippet, ..offer }
            })
            .collect()
    }

    fn written(&self, feature: &tree::Feature) -> String {
        self.snapshot
            .sources()
            .text(feature.span)
            .trim_start_matches("feature ")
            .to_owned()
    }

    /// Libraries that another can take over.
    fn templates(&self) -> Vec<Completion> {
        let own = self.context.library.as_deref();
        let known = self
            .snapshot
            .index()
            .libraries(MAIN)
            .filter(|(name, _)| Some(*name) != own);
        known
            .map(|(name, _)| Completion::new(name, Kind::Library).snippet(format!("{name}($0)")))
            .collect()
    }

    fn libraries(&self) -> Vec<Completion> {
        let items = self.snapshot.tree(MAIN).into_iter().flat_map(|tree| &tree.items);
        items
            .filter_map(|item| match item {
                Item::Library(library) => Some(Completion::new(&library.name.text, Kind::Library).docs(&library.doc)),
                _ => None,
            })
            .collect()
    }

    /// The classes of the library whose layout is `marked`.
    fn classes(&self) -> Vec<Completion> {
        let named = self.context.statement.iter().skip_while(|w| w.text != "marked").nth(1);
        classes(named.and_then(|w| self.snapshot.library(w.text)))
    }

    fn feature(&self, name: &str) -> Option<&tree::Feature> {
        self.declared_features().into_iter().find(|f| f.name.name.text == name)
    }

    fn kind_of(&self, feature: &str) -> Option<FeatureKind> {
        let declared = self.feature(feature)?;
        vocabulary::kinds()
            .find(|(name, _)| *name == declared.kind.text)
            .map(|(_, kind)| kind)
    }

    /// Behind a dot: the attributes of a feature, or the layouts of a library.
    fn after_dot(&self) -> Vec<Completion> {
        let words = &self.context.statement;
        let before = &words[..words.len().saturating_sub(1)];
        let name = match before.last().map(|w| w.text) {
            Some("]") => before.iter().rev().skip_while(|w| w.text != "[").nth(1),
            _ => before.last(),
        };
        let Some(name) = name else { return Vec::new() };
        if let Some(library) = self
            .snapshot
            .library(name.text)
            .filter(|_| self.reading.keyword() == "marked")
        {
            let layouts = library.layouts.iter();
            return layouts.map(|l| Completion::new(&l.name.text, Kind::Layout)).collect();
        }
        let kind = self.kind_of(name.text);
        let offer = |a: &primitives::Attribute| {
            let due = self.reading.due;
            let fits = due.is_none_or(|due| fits(a.ty, due));
            Completion::new(a.name, Kind::Attribute)
                .detail(written(a.ty))
                .docs(a.doc)
                .rank(if fits { 0 } else { 2 })
        };
        kind.into_iter().flat_map(attributes).map(offer).collect()
    }

    /// `bottom.edges`: the lists that `for each` can go over.
    fn lists(&self) -> Vec<Completion> {
        let antecedents = self.rule_features().0;
        let lists = antecedents.iter().flat_map(|name| {
            let attributes = self.kind_of(name).into_iter().flat_map(attributes);
            attributes
                .filter(|a| a.ty == Type::Edges)
                .map(move |a| Completion::new(format!("{name}.{}", a.name), Kind::Attribute).docs(a.doc))
        });
        lists.collect()
    }

    /// The features of the rule around the cursor, before and behind its arrow, as written.
    fn rule_features(&self) -> (Vec<String>, Option<String>) {
        let mut features: Vec<String> = Vec::new();
        let mut antecedents = 0;
        let mut open = false;
        for word in self.context.head.iter().skip(1) {
            match word.text {
                "->" => antecedents = features.len(),
                "," => {}
                text if word.glued || open => {
                    open = text != "]";
                    features.last_mut().into_iter().for_each(|f| f.push_str(text));
                }
                text => features.push(text.to_owned()),
            }
        }
        let consequent = features.split_off(antecedents.min(features.len())).pop();
        (features, consequent)
    }

    fn indices(&self, feature: &str) -> Vec<Completion> {
        let declared = self
            .library()
            .and_then(|l| l.features.iter().find(|f| f.name.name.text == feature));
        let range = match declared.map(|f| &f.name.index) {
            Some(Some(Index::Range(first, last, _))) => *first..=(*last).min(first.saturating_add(63)),
            _ => return Vec::new(),
        };
        let numbers = range.map(|n| Completion::new(n.to_string(), Kind::Word));
        let pairs = self.context.head.windows(2);
        let in_head = pairs.filter(|w| w[0].text == "[" && is_word(w[1])).map(|w| w[1].text);
        let usual = (self.context.block == Block::Library).then_some("i");
        let variables = in_head.chain(usual).map(|v| Completion::new(v, Kind::Variable).rank(0));
        variables.chain(numbers).collect()
    }

    // ---- Values -------------------------------------------------------------

    fn units(&self) -> Vec<Completion> {
        let due = self.reading.due;
        let units = vocabulary::units().filter(|(_, ty, _)| due.is_none_or(|due| due == *ty));
        let nouns = match self.reading.keyword() {
            "limit" => &["views"][..],
            "gain_floor" => &["voxels"],
            _ => &[],
        };
        let nouns = nouns.iter().map(|noun| Completion::new(*noun, Kind::Unit).rank(0));
        let units = units.map(|(name, ty, _)| Completion::new(name, Kind::Unit).detail(vocabulary::describe(ty)));
        if due.is_some_and(|due| !vocabulary::units().any(|(_, ty, _)| ty == due)) {
            return nouns.collect();
        }
        nouns.chain(units).collect()
    }

    /// Names of arguments that are not given yet, and values of the one that is due.
    fn in_call(&self, callee: &str) -> Vec<Completion> {
        let begins = self.reading.last.is_some_and(|w| matches!(w.text, "(" | ","));
        let mut offers = if self.reading.after_value() {
            Vec::new()
        } else {
            self.values(self.reading.due)
        };
        if begins
            && !vocabulary::forms(self.reading.keyword())
                .iter()
                .any(|f| f.name == callee)
        {
            offers.extend(self.argument_names(callee));
        }
        offers
    }

    fn argument_names(&self, callee: &str) -> Vec<Completion> {
        let open = self.reading.callee.map_or(0, |w| w.at);
        let given = |name: &str| self.context.statement.iter().any(|w| w.at > open && w.text == name);
        let docs = |name: &str| {
            let declared = crate::lang::callable(callee)?
                .parameters
                .iter()
                .find(|p| p.name == name)?;
            Some(declared.doc)
        };
        let parameters = parameters(self.snapshot, callee).unwrap_or_default().into_iter();
        parameters
            .filter(|(name, _)| !given(name))
            .map(|(name, ty)| {
                Completion::new(format!("{name}:"), Kind::Argument)
                    .detail(type_name(ty))
                    .docs(docs(&name).unwrap_or_default())
                    .snippet(format!("{name}: $0"))
                    .rank(0)
            })
            .collect()
    }

    /// Values of a type; of any type that can be written where none is due.
    fn values(&self, due: Option<Type>) -> Vec<Completion> {
        let mut offers = self.callables(due);
        match due {
            Some(Type::Colour) => offers.extend(
                vocabulary::colours().map(|(name, c)| Completion::new(name, Kind::Colour).detail(c.to_string())),
            ),
            Some(Type::Choice(words)) => offers.extend(words.iter().map(|w| Completion::new(*w, Kind::Word))),
            Some(Type::Direction) => offers.extend(
                ["+x", "-x", "+y", "-y", "+z", "-z"].map(|d| Completion::new(d, Kind::Word).detail("direction")),
            ),
            _ => {}
        }
        offers.extend(self.parameters(due));
        if self.context.block == Block::Rule {
            offers.extend(self.measured(due));
        }
        offers
    }

    fn callables(&self, due: Option<Type>) -> Vec<Completion> {
        let consequent = self.rule_features().1;
        let consequent = consequent.as_deref().map(|name| name.split('[').next().unwrap_or(name));
        let kind = consequent.and_then(|name| self.kind_of(name));
        let wanted = |result: Option<Type>, features: &[FeatureKind]| {
            let typed = match (due, result) {
                (Some(due), Some(result)) => fits(result, due),
                (None, _) => true,
                (Some(_), None) => false,
            };
            typed && (features.is_empty() || kind.is_none_or(|kind| features.contains(&kind)))
        };
        let index = self.snapshot.index();
        let mut offers = Vec::new();
        for (name, at) in index.scope(MAIN) {
            if let Some(signature) = index.signature(at).filter(|s| wanted(s.result, s.features)) {
                let text = self.snapshot.sources().get(at.file).map_or("", |f| &f.text);
                let offer = defined(name, signature, &docs::above(text, at.start)).rank(0);
                offers.push(with_arguments(offer, name, signature.parameters.len()));
            }
        }
        let primitives = primitives::all().filter(|p| wanted(Some(p.result), p.features));
        offers.extend(primitives.map(called));
        let known = |name: &str| index.scope(MAIN).any(|(n, _)| n == name);
        for found in standard::all()
            .iter()
            .filter(|d| wanted(d.signature.result, d.signature.features))
        {
            if !known(&found.name) && due.is_some() {
                let offer = defined(&found.name, &found.signature, &found.docs).rank(3);
                let offer = with_arguments(offer, &found.name, found.signature.parameters.len());
                offers.push(Completion {
                    import: self.import(&format!("use std.{}.{}", found.module, found.name)),
                    ..offer
                });
            }
        }
        offers
    }

    /// The line that imports a name, behind the last import or the edition.
    fn import(&self, line: &str) -> Option<(usize, String)> {
        let tree = self.snapshot.tree(MAIN)?;
        let uses = tree.items.iter().filter_map(|item| match item {
            Item::Use(import) => Some(import.span.end),
            _ => None,
        });
        match uses.max() {
            Some(end) => Some((end, format!("\n{line}"))),
            None => Some((tree.edition.as_ref()?.span.end, format!("\n\n{line}"))),
        }
    }

    /// Parameters of the definition or the template around the cursor.
    fn parameters(&self, due: Option<Type>) -> Vec<Completion> {
        let words = &self.context.statement;
        let head = words.iter().take_while(|w| w.text != "=").collect::<Vec<_>>();
        let pairs = head
            .windows(3)
            .filter(|w| w[1].text == ":" && self.reading.keyword() == "let");
        let own = pairs.map(|w| {
            let ty = vocabulary::types().find(|(name, _)| *name == w[2].text);
            (w[0].text, ty.map(|(_, ty)| ty))
        });
        let template = self.library().and_then(|l| l.parameters.as_deref()).unwrap_or_default();
        let types = |p: &tree::Parameter| self.snapshot.index().type_of(p.name.span);
        let template = template.iter().map(|p| (p.name.text.as_str(), types(p)));
        own.chain(template)
            .filter(|(_, ty)| due.is_none_or(|due| ty.is_some_and(|ty| fits(ty, due))))
            .map(|(name, ty)| Completion::new(name, Kind::Variable).detail(type_name(ty)).rank(0))
            .collect()
    }

    /// Variables of the rule, and attributes of its features.
    fn measured(&self, due: Option<Type>) -> Vec<Completion> {
        let mut offers = Vec::new();
        if due.is_none_or(|due| fits(Type::Edge, due)) {
            let each = self.context.before.windows(2).filter(|w| w[0].text == "each");
            offers.extend(each.map(|w| Completion::new(w[1].text, Kind::Variable).detail("edge").rank(0)));
        }
        let (antecedents, consequent) = self.rule_features();
        for name in antecedents.iter().chain(&consequent) {
            let plain = name.split('[').next().unwrap_or(name);
            let Some(kind) = self.kind_of(plain) else { continue };
            if kind == FeatureKind::Polygon && due.is_none_or(|due| due == Type::Polygon) {
                offers.push(Completion::new(name, Kind::Feature).rank(0));
            }
            let fitting = attributes(kind)
                .iter()
                .filter(|a| due.is_none_or(|due| fits(a.ty, due)));
            offers.extend(fitting.map(|a| {
                Completion::new(format!("{name}.{}", a.name), Kind::Attribute)
                    .detail(written(a.ty))
                    .docs(a.doc)
            }));
        }
        offers
    }
}

/// Whether a value of one type can stand where another is due.
fn fits(found: Type, due: Type) -> bool {
    found == due
        || matches!(
            (found, due),
            (Type::Count, Type::Number) | (Type::Edges, Type::List(Type::Edge))
        )
}

fn classes(library: Option<&tree::Library>) -> Vec<Completion> {
    let rows = library.into_iter().flat_map(|l| &l.tables).flat_map(|t| &t.rows);
    let classes = library.into_iter().flat_map(|l| &l.classes).map(|c| &c.name);
    let names = classes.chain(rows.map(|r| &r.name));
    names.map(|name| Completion::new(&name.text, Kind::Class)).collect()
}

fn words_of(statement: &str) -> Vec<Completion> {
    let words = vocabulary::words(statement).iter();
    words
        .map(|word| Completion::new(*word, Kind::Word).docs(docs::word(word).unwrap_or_default()))
        .collect()
}

/// A primitive or a form as a call.
fn called(primitive: &primitives::Primitive) -> Completion {
    let parameters: Vec<String> = primitive.parameters.iter().map(primitives::signature).collect();
    let offer = Completion::new(primitive.name, Kind::Function)
        .detail(format!("{}({})", primitive.name, parameters.join(", ")))
        .docs(primitive.doc);
    let snippet = match primitive.parameters.is_empty() {
        true => format!("{}()", primitive.name),
        false => format!("{}($0)", primitive.name),
    };
    offer.snippet(snippet)
}

fn with_arguments(offer: Completion, name: &str, parameters: usize) -> Completion {
    match parameters {
        0 => offer,
        _ => offer.snippet(format!("{name}($0)")),
    }
}
