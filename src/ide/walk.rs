//! Every expression of a file, in the order of the text.

use crate::lang::syntax::tree::{
    Evidence, ExpectationKind as Expected, Expr, ExprKind, File, Item, Library, Parameter, Setting, Study,
    StudyStatementKind as Studied, TaskStatementKind as Kind, Test,
};

/// Calls `see` with every expression, the outer before the inner.
pub(super) fn expressions<'t>(file: &'t File, see: &mut impl FnMut(&'t Expr)) {
    for item in &file.items {
        match item {
            Item::Let(item) => {
                defaults(&item.parameters, see);
                inside(&item.body, see);
            }
            Item::Library(library) => in_library(library, see),
            Item::Task(task) => task.statements.iter().for_each(|s| in_statement(&s.kind, see)),
            Item::Scene(scene) => {
                scene.backdrops.iter().for_each(|b| inside(&b.value, see));
                for object in &scene.objects {
                    let turned = object.turned.iter();
                    [&object.shape, &object.at]
                        .into_iter()
                        .chain(turned)
                        .for_each(|e| inside(e, see));
                }
            }
            Item::Test(test) => in_test(test, see),
            Item::Study(study) => in_study(study, see),
            Item::Use(_) => {}
        }
    }
}

fn in_test<'t>(test: &'t Test, see: &mut impl FnMut(&'t Expr)) {
    for supposed in &test.given {
        match &supposed.what {
            Evidence::State(_) => {}
            Evidence::Face(face) => inside(face, see),
            Evidence::Marker { at, facing } => {
                inside(at, see);
                inside(facing, see);
            }
        }
    }
    for expectation in &test.expected {
        match &expectation.kind {
            Expected::Class(_, a, within) | Expected::Weight(_, a, within) => {
                inside(a, see);
                within.iter().for_each(|e| inside(e, see));
            }
            Expected::Equal(a, b, within) => {
                [a, b].into_iter().chain(within).for_each(|e| inside(e, see));
            }
            Expected::Count(a, b) => {
                inside(a, see);
                inside(b, see);
            }
            Expected::Rules(e) | Expected::Predicts(_, e) | Expected::Predicted(_, e) => inside(e, see),
            Expected::Placed(placed) => {
                let rest = placed.facing.iter().chain(&placed.within);
                std::iter::once(&placed.at).chain(rest).for_each(|e| inside(e, see));
            }
            Expected::Classes(_) | Expected::Flag(..) | Expected::Next(_) | Expected::State(..) => {}
        }
    }
}

fn in_study<'t>(study: &'t Study, see: &mut impl FnMut(&'t Expr)) {
    for statement in &study.statements {
        match &statement.kind {
            Studied::Objects(objects) => objects.iter().for_each(|e| inside(e, see)),
            Studied::Starts(e) | Studied::Seeds(e) => inside(e, see),
            Studied::Variant(variant) => variant.settings.iter().for_each(|(s, _)| in_setting(s, see)),
            Studied::Setting(setting) => in_setting(setting, see),
            Studied::Program(_)
            | Studied::Task(_)
            | Studied::Methods(_)
            | Studied::Noise(_)
            | Studied::Published(_) => {}
        }
    }
}

fn in_setting<'t>(setting: &'t Setting, see: &mut impl FnMut(&'t Expr)) {
    match setting {
        Setting::Task(kind) => in_statement(kind, see),
        Setting::Voxel(e) | Setting::Backdrop(e) => inside(e, see),
    }
}

fn defaults<'t>(parameters: &'t [Parameter], see: &mut impl FnMut(&'t Expr)) {
    let defaults = parameters.iter().filter_map(|p| p.default.as_ref());
    defaults.for_each(|e| inside(e, see));
}

fn in_library<'t>(library: &'t Library, see: &mut impl FnMut(&'t Expr)) {
    defaults(library.parameters.as_deref().unwrap_or_default(), see);
    let arguments = library.uses.iter().flat_map(|u| &u.call.arguments);
    arguments.for_each(|a| inside(&a.value, see));
    let rows = library
        .tables
        .iter()
        .flat_map(|t| &t.rows)
        .filter_map(|r| r.prior.as_ref());
    let priors = library.classes.iter().filter_map(|c| c.prior.as_ref()).chain(rows);
    priors.for_each(|e| inside(e, see));
    for rule in &library.rules {
        let parts = rule.detect.iter().chain(&rule.measure).chain(&rule.predict);
        parts.for_each(|s| inside(&s.value, see));
    }
    for place in library.layouts.iter().flat_map(|l| &l.places) {
        inside(&place.at, see);
        inside(&place.facing, see);
    }
}

fn in_statement<'t>(kind: &'t Kind, see: &mut impl FnMut(&'t Expr)) {
    match kind {
        Kind::Camera(e) | Kind::Views(e) | Kind::Limit(e) | Kind::Overlap(e) | Kind::GainFloor(e) => inside(e, see),
        Kind::Space(space) => [&space.shape, &space.at, &space.voxel]
            .into_iter()
            .for_each(|e| inside(e, see)),
        Kind::Thresholds(fields) | Kind::SensorModel(fields) => fields.iter().for_each(|f| inside(&f.value, see)),
        Kind::Library(_)
        | Kind::Goal(_)
        | Kind::Method(_)
        | Kind::Inspected(_)
        | Kind::Visibility(_)
        | Kind::Verify(_)
        | Kind::Insertion(_) => {}
    }
}

fn inside<'t>(e: &'t Expr, see: &mut impl FnMut(&'t Expr)) {
    see(e);
    match &e.kind {
        ExprKind::Call(call) => call.arguments.iter().for_each(|a| inside(&a.value, see)),
        ExprKind::List(items) => items.iter().for_each(|item| inside(item, see)),
        ExprKind::Group(a) | ExprKind::Negate(a) => inside(a, see),
        ExprKind::Binary(_, a, b) | ExprKind::Else(a, b) => {
            inside(a, see);
            inside(b, see);
        }
        ExprKind::Quantity(_)
        | ExprKind::Text(_)
        | ExprKind::Colour(_)
        | ExprKind::Direction(..)
        | ExprKind::Reference(_) => {}
    }
}
