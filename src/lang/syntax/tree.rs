//! The source tree: what the text says, nothing desugared, every part with its span.

use crate::lang::source::Span;

/// A file.
#[derive(Clone, Debug, Default)]
pub struct File {
    /// The edition line, where there is a readable one.
    pub edition: Option<Name>,
    /// Declarations in order.
    pub items: Vec<Item>,
    /// Comments in order, `///` included.
    pub comments: Vec<Span>,
    /// Regions that could not be read.
    pub bad: Vec<Span>,
}

/// A name or a word, as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    pub text: String,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum Item {
    Use(Use),
    Let(Let),
    Library(Library),
    Task(Task),
    Scene(Scene),
    Test(Test),
    Study(Study),
}

/// `use std.views.{sphere, ring}`.
#[derive(Clone, Debug)]
pub struct Use {
    pub module: Module,
    pub names: Vec<Name>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum Module {
    /// Dotted words, without the imported name: `std.views`.
    Dotted(Vec<Name>),
    /// A path relative to this file.
    Path(Name),
}

/// `let name(parameters) = body`.
#[derive(Clone, Debug)]
pub struct Let {
    pub name: Name,
    pub parameters: Vec<Parameter>,
    pub body: Expr,
    /// The `///` lines before it.
    pub doc: String,
}

#[derive(Clone, Debug)]
pub struct Parameter {
    pub name: Name,
    pub ty: TypeName,
    /// What stands in where an argument is left out.
    pub default: Option<Expr>,
}

#[derive(Clone, Debug)]
pub struct TypeName {
    /// `length` of `[length]`.
    pub element: Name,
    /// Pairs of brackets around it.
    pub depth: usize,
    pub span: Span,
}

/// `library solids { … }`, or a template: `library tagged_box(width: length) { … }`.
#[derive(Clone, Debug)]
pub struct Library {
    pub name: Name,
    /// Those of a template, perhaps none; absent for a library of its own.
    pub parameters: Option<Vec<Parameter>>,
    /// Libraries that are taken over.
    pub uses: Vec<Inclusion>,
    pub features: Vec<Feature>,
    pub classes: Vec<Class>,
    pub tables: Vec<ClassTable>,
    pub rules: Vec<Rule>,
    pub layouts: Vec<Layout>,
    pub head: Span,
    /// Whether every entry could be read.
    pub whole: bool,
    pub doc: String,
}

/// `use tagged_box(width: 300 mm)`.
#[derive(Clone, Debug)]
pub struct Inclusion {
    /// The library with its arguments, perhaps none.
    pub call: Call,
    pub span: Span,
}

/// `feature code[1..7] : marker many`.
#[derive(Clone, Debug)]
pub struct Feature {
    pub name: FeatureRef,
    pub kind: Name,
    pub many: bool,
    pub span: Span,
}

/// `code[1]`, `code[i]`, `code[1..7]`, `bottom`.
#[derive(Clone, Debug)]
pub struct FeatureRef {
    pub name: Name,
    pub index: Option<Index>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum Index {
    Literal(u64, Span),
    Range(u64, u64, Span),
    Variable(Name),
}

impl Index {
    pub fn span(&self) -> Span {
        match self {
            Self::Literal(_, span) | Self::Range(_, _, span) => *span,
            Self::Variable(name) => name.span,
        }
    }
}

/// `class prism { bottom, prism_side } prior 30 %`.
#[derive(Clone, Debug)]
pub struct Class {
    pub name: Name,
    pub features: Vec<FeatureRef>,
    pub prior: Option<Expr>,
    pub span: Span,
}

/// `classes by code[1..7] { … }`.
#[derive(Clone, Debug)]
pub struct ClassTable {
    pub columns: Vec<FeatureRef>,
    pub rows: Vec<Row>,
}

#[derive(Clone, Debug)]
pub struct Row {
    pub name: Name,
    pub cells: Vec<bool>,
    pub prior: Option<Expr>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Rule {
    pub antecedents: Vec<FeatureRef>,
    pub consequent: FeatureRef,
    pub each: Vec<ForEach>,
    pub detect: Vec<Statement>,
    pub measure: Vec<Statement>,
    pub predict: Vec<Statement>,
    pub head: Span,
    /// Whether every statement could be read.
    pub whole: bool,
}

/// `for each edge in bottom.edges`.
#[derive(Clone, Debug)]
pub struct ForEach {
    pub variable: Name,
    pub over: Reference,
    pub span: Span,
}

/// A word and its expression.
#[derive(Clone, Debug)]
pub struct Statement {
    pub value: Expr,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Layout {
    pub name: Name,
    pub places: Vec<LayoutPlace>,
    pub head: Span,
    /// Whether every place could be read.
    pub whole: bool,
}

/// `code[1] at [450 mm, 0 mm, 250 mm] facing +x`.
#[derive(Clone, Debug)]
pub struct LayoutPlace {
    pub feature: FeatureRef,
    pub at: Expr,
    pub facing: Expr,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Task {
    pub name: Name,
    pub statements: Vec<TaskStatement>,
    pub head: Span,
    /// Whether every statement could be read.
    pub whole: bool,
    pub doc: String,
}

#[derive(Clone, Debug)]
pub struct TaskStatement {
    pub kind: TaskStatementKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum TaskStatementKind {
    Library(Name),
    Goal(Vec<Name>),
    Camera(Expr),
    Space(Box<SpaceStatement>),
    Views(Expr),
    Thresholds(Vec<Field>),
    Limit(Expr),
    Overlap(Expr),
    Method(Name),
    GainFloor(Expr),
    Inspected(Name),
    Visibility(Name),
    Verify(Name),
    Insertion(Name),
    SensorModel(Vec<Field>),
}

/// `space cube(600 mm) at [0 mm, 0 mm, 300 mm] voxel 10 mm`.
#[derive(Clone, Debug)]
pub struct SpaceStatement {
    pub shape: Expr,
    pub at: Expr,
    pub voxel: Expr,
}

impl TaskStatementKind {
    /// The word that begins it.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Library(_) => "library",
            Self::Goal(_) => "goal",
            Self::Camera(_) => "camera",
            Self::Space(_) => "space",
            Self::Views(_) => "views",
            Self::Thresholds(_) => "thresholds",
            Self::Limit(_) => "limit",
            Self::Overlap(_) => "overlap",
            Self::Method(_) => "method",
            Self::GainFloor(_) => "gain_floor",
            Self::Inspected(_) => "inspected",
            Self::Visibility(_) => "visibility",
            Self::Verify(_) => "verify",
            Self::Insertion(_) => "insertion",
            Self::SensorModel(_) => "sensor_model",
        }
    }
}

/// `near: 10 mm`.
#[derive(Clone, Debug)]
pub struct Field {
    pub name: Name,
    pub value: Expr,
}

#[derive(Clone, Debug)]
pub struct Scene {
    pub name: Name,
    pub backdrops: Vec<Statement>,
    pub objects: Vec<Object>,
    pub head: Span,
}

#[derive(Clone, Debug)]
pub struct Object {
    pub name: Name,
    pub shape: Expr,
    pub at: Expr,
    pub turned: Option<Expr>,
    pub marked: Option<Marked>,
    pub span: Span,
}

/// `marked tanks.hull as tk1`. Of `marked hull` the library and the class are empty
/// names where they would stand.
#[derive(Clone, Debug)]
pub struct Marked {
    pub library: Name,
    pub layout: Name,
    pub class: Name,
}

/// `test "name" { … }`: what is given, and what is expected then.
#[derive(Clone, Debug)]
pub struct Test {
    /// The text between the quotes.
    pub name: Name,
    /// `library` statements; one is meant.
    pub libraries: Vec<Name>,
    pub given: Vec<Supposed>,
    pub expected: Vec<Expectation>,
    pub head: Span,
    /// Whether every statement could be read.
    pub whole: bool,
    pub doc: String,
}

/// `code[4] absent`, `bottom = polygon([…])`, `code[1] at […] facing +x`.
#[derive(Clone, Debug)]
pub struct Supposed {
    pub feature: FeatureRef,
    pub what: Evidence,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum Evidence {
    /// `detected` or `absent`.
    State(Name),
    Face(Expr),
    Marker {
        at: Expr,
        facing: Expr,
    },
}

/// What stands after `expect`.
#[derive(Clone, Debug)]
pub struct Expectation {
    pub kind: ExpectationKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum ExpectationKind {
    /// `classes tk5, tk9`.
    Classes(Vec<Name>),
    /// `class tk9 50 % within 1 %`.
    Class(Name, Expr, Option<Expr>),
    /// `confident`, `not contradicted`: the word, and whether it holds.
    Flag(Name, bool),
    /// `next code[3]`.
    Next(Vec<FeatureRef>),
    /// `rules 49`.
    Rules(Expr),
    /// `rule bottom -> prism_side predicts 4`.
    Predicts(RuleHead, Expr),
    /// `code[1] absent`.
    State(FeatureRef, Name),
    /// `code[3] weight 0.92`.
    Weight(FeatureRef, Expr, Option<Expr>),
    /// `prism_side predicted 4`.
    Predicted(FeatureRef, Expr),
    /// `code[2] at […] facing -x`, `prism_side at polygon([…]) within 1 mm`.
    Placed(Placed),
    /// `above(…) = [0 m, 0 m, 1 m] within 1 mm`.
    Equal(Expr, Expr, Option<Expr>),
    /// `sphere(radius: 1 m, count: 64) count 64`.
    Count(Expr, Expr),
}

/// `study reconstruction { … }`.
#[derive(Clone, Debug)]
pub struct Study {
    pub name: Name,
    pub statements: Vec<StudyStatement>,
    pub head: Span,
    /// Whether every statement could be read.
    pub whole: bool,
    pub doc: String,
}

#[derive(Clone, Debug)]
pub struct StudyStatement {
    pub kind: StudyStatementKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum StudyStatementKind {
    /// A path relative to this file.
    Program(Name),
    Task(Name),
    /// Names and `mesh(…)`.
    Objects(Vec<Expr>),
    Methods(Vec<Name>),
    Starts(Expr),
    Seeds(Expr),
    Noise(Vec<Name>),
    /// A path relative to this file.
    Published(Name),
    Variant(Variant),
    Setting(Setting),
}

impl StudyStatementKind {
    /// The word that begins it.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Program(_) => "program",
            Self::Task(_) => "task",
            Self::Objects(_) => "objects",
            Self::Methods(_) => "methods",
            Self::Starts(_) => "starts",
            Self::Seeds(_) => "seeds",
            Self::Noise(_) => "noise",
            Self::Published(_) => "published",
            Self::Variant(_) => "variant",
            Self::Setting(setting) => setting.word(),
        }
    }
}

/// `variant fine { voxel 5 mm }`.
#[derive(Clone, Debug)]
pub struct Variant {
    pub name: Name,
    pub settings: Vec<(Setting, Span)>,
}

/// What a study changes of its task and scene.
#[derive(Clone, Debug)]
pub enum Setting {
    Task(TaskStatementKind),
    Voxel(Expr),
    Backdrop(Expr),
}

impl Setting {
    /// The word that begins it.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Task(kind) => kind.word(),
            Self::Voxel(_) => "voxel",
            Self::Backdrop(_) => "backdrop",
        }
    }
}

/// `bottom, prism_side -> prism_shape`.
#[derive(Clone, Debug)]
pub struct RuleHead {
    pub antecedents: Vec<FeatureRef>,
    pub consequent: FeatureRef,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Placed {
    pub feature: FeatureRef,
    pub at: Expr,
    pub facing: Option<Expr>,
    pub within: Option<Expr>,
}

#[derive(Clone, Debug)]
pub struct Expr {
    pub kind: ExprKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum ExprKind {
    /// `64`, `10 mm`, `30 %`.
    Quantity(Quantity),
    /// `"f{i}"`.
    Text(Vec<TextPart>),
    /// `#ff8000`, without the `#`.
    Colour(String),
    /// `+x`: sign and axis.
    Direction(f64, usize),
    Reference(Reference),
    Call(Call),
    List(Vec<Expr>),
    Group(Box<Expr>),
    Negate(Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
    Else(Box<Expr>, Box<Expr>),
}

#[derive(Clone, Debug)]
pub struct Quantity {
    pub value: f64,
    /// Whether it was written without fraction or exponent.
    pub whole: Option<u64>,
    pub unit: Option<Name>,
    pub number: Span,
}

#[derive(Clone, Debug)]
pub enum TextPart {
    Literal(String),
    /// `{i}`.
    Hole(Name),
}

/// `edge`, `bottom.edges`, `code[i].pose`.
#[derive(Clone, Debug)]
pub struct Reference {
    pub name: Name,
    pub index: Option<Index>,
    pub fields: Vec<Name>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Call {
    pub name: Name,
    pub arguments: Vec<Argument>,
}

#[derive(Clone, Debug)]
pub struct Argument {
    pub name: Option<Name>,
    pub value: Expr,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
}

impl Operator {
    /// As it is written.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
        }
    }
}
