//! The checked program: every name resolved, every expression of one type.

use std::collections::{BTreeMap, BTreeSet};

use crate::lang::names::DefinitionId;
use crate::lang::source::Span;
use crate::lang::syntax::tree::Operator;
use crate::primitives::{Primitive, Type};
use crate::rules::{FeatureId, FeatureKind, Goal, Insertion, Inspected, Value, Visibility};

/// A checked program.
#[derive(Debug, Default)]
pub(in crate::lang) struct Program {
    /// By definition; `None` where it is wrong.
    pub definitions: Vec<Option<Definition>>,
    pub libraries: Vec<Library>,
    pub tasks: Vec<Task>,
    pub scenes: Vec<Scene>,
    pub facts: Vec<super::stated::Fact>,
    pub studies: Vec<super::studies::Study>,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Definition {
    pub parameters: Vec<Parameter>,
    pub body: Expr,
}

/// A parameter of a definition or a template.
#[derive(Clone, Debug)]
pub(in crate::lang) struct Parameter {
    pub name: String,
    /// Sees no parameters.
    pub default: Option<Expr>,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Expr {
    pub kind: ExprKind,
    pub ty: Type,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) enum ExprKind {
    Value(Value),
    Text(Vec<TextPart>),
    /// A parameter of the definition or the template around it.
    Parameter(String),
    /// An attribute of a parameter that stands for a feature.
    ParameterAttribute(String, &'static str),
    /// A `for each` variable.
    Variable(String),
    Attribute(FeatureUse, String),
    Else(Box<Expr>, Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
    Negate(Box<Expr>),
    /// A list, a point or a direction, by the type.
    List(Vec<Expr>),
    Primitive(&'static Primitive, BTreeMap<&'static str, Expr>),
    /// With its arguments; `None` where the default stands in.
    Definition(DefinitionId, Vec<Option<Expr>>),
}

#[derive(Clone, Debug)]
pub(in crate::lang) enum TextPart {
    Literal(String),
    /// An index variable or a parameter.
    Hole(String),
}

/// A feature, or a member of a family that an index variable picks.
#[derive(Clone, Debug)]
pub(in crate::lang) struct FeatureUse {
    pub family: String,
    pub index: IndexUse,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::lang) enum IndexUse {
    None,
    Literal(u64),
    Variable(String),
}

/// The features of a library by name.
#[derive(Clone, Debug, Default)]
pub(in crate::lang) struct Families {
    pub by_name: BTreeMap<String, Family>,
    /// Names whose declaration is wrong, which was reported.
    pub lost: BTreeSet<String>,
    /// Whether some could not be taken over, which was reported.
    pub open: bool,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Family {
    pub kind: FeatureKind,
    pub members: Members,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) enum Members {
    One(FeatureId),
    Indexed(BTreeMap<u64, FeatureId>),
}

impl Families {
    /// The feature that a use means, given the index variables.
    pub fn resolve(&self, feature: &FeatureUse, indices: &BTreeMap<String, u64>) -> Option<FeatureId> {
        match (&self.by_name.get(&feature.family)?.members, &feature.index) {
            (Members::One(id), IndexUse::None) => Some(*id),
            (Members::Indexed(ids), IndexUse::Literal(n)) => ids.get(n).copied(),
            (Members::Indexed(ids), IndexUse::Variable(v)) => ids.get(indices.get(v)?).copied(),
            _ => None,
        }
    }
}

/// A library, with what it takes over.
#[derive(Clone, Debug)]
pub(in crate::lang) struct Library {
    pub name: String,
    /// Those of a template; `None` where they are wrong.
    pub parameters: Option<Vec<Parameter>>,
    /// What parameters of the libraries that were taken over stand for.
    pub environments: Vec<Environment>,
    pub families: Families,
    pub features: Vec<Feature>,
    pub classes: Vec<Class>,
    pub rules: Vec<Rule>,
    pub layouts: Vec<Layout>,
    pub span: Span,
    /// Whether everything in it is right: only then it is analysed.
    pub whole: bool,
}

/// What the parameters of a library that was taken over stand for.
#[derive(Clone, Debug)]
pub(in crate::lang) struct Environment {
    /// Where the arguments are evaluated: an earlier environment, or the library itself.
    pub parent: Option<EnvironmentId>,
    pub bindings: Vec<Binding>,
    /// The `use`.
    pub at: Span,
}

/// Index into [`Library::environments`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::lang) struct EnvironmentId(pub usize);

#[derive(Clone, Debug)]
pub(in crate::lang) struct Binding {
    pub name: String,
    pub value: Expr,
    /// Whether it is the parameter's default, which sees no parameters.
    pub default: bool,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Feature {
    pub name: String,
    pub kind: FeatureKind,
    pub many: bool,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Class {
    /// None for the library's own.
    pub environment: Option<EnvironmentId>,
    pub name: String,
    pub presence: Vec<bool>,
    pub prior: Option<Expr>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Rule {
    /// None for the library's own.
    pub environment: Option<EnvironmentId>,
    pub antecedents: Vec<FeatureUse>,
    pub consequent: FeatureUse,
    /// Index variables with the values that all their families have.
    pub indices: Vec<(String, Vec<u64>)>,
    pub each: Vec<Each>,
    pub detect: Expr,
    pub measure: Expr,
    pub predict: Option<Expr>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Each {
    pub variable: String,
    pub feature: FeatureUse,
    pub attribute: String,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct Layout {
    /// None for the library's own.
    pub environment: Option<EnvironmentId>,
    pub name: String,
    pub places: Vec<LayoutPlace>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) struct LayoutPlace {
    pub feature: FeatureId,
    pub at: Expr,
    pub facing: Expr,
    pub span: Span,
}

#[derive(Debug)]
pub(in crate::lang) struct Task {
    pub name: String,
    pub library: String,
    pub goal: Goal,
    pub goal_span: Span,
    pub camera: Expr,
    /// `cube` or `box`.
    pub shape: Expr,
    pub at: Expr,
    pub voxel: Expr,
    pub views: Expr,
    pub near: Expr,
    pub absent: Expr,
    pub confidence: Expr,
    pub overlap: Option<Expr>,
    pub limit: Option<Expr>,
    pub gain_floor: Option<Expr>,
    pub method: String,
    pub inspected: Inspected,
    pub visibility: Visibility,
    pub verify: bool,
    pub insertion: Insertion,
    /// By field name.
    pub sensor_model: BTreeMap<&'static str, Expr>,
    pub span: Span,
}

#[derive(Debug)]
pub(in crate::lang) struct Scene {
    pub name: String,
    /// `None`: empty air; otherwise a `sphere`.
    pub backdrop: Option<Expr>,
    pub backdrop_span: Span,
    pub objects: Vec<Object>,
    pub span: Span,
}

#[derive(Debug)]
pub(in crate::lang) struct Object {
    pub name: String,
    pub shape: Expr,
    pub at: Expr,
    pub turned: Option<Expr>,
    pub marked: Option<Marked>,
    pub span: Span,
}

/// Indices into the program: library, its layout, its class.
#[derive(Debug)]
pub(in crate::lang) struct Marked {
    pub library: usize,
    pub layout: usize,
    pub class: usize,
    pub span: Span,
}
