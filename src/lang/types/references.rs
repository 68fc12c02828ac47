//! References: parameters, variables, definitions, features and their attributes.

use super::expressions::{constant, made};
use super::features::feature_use;
use super::scope::{Role, RuleScope, Scope};
use super::typed::{Expr, ExprKind, FeatureUse};
use super::{Checker, colours, units};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::{Entity, Kind};
use crate::lang::names::{
    DefinitionId, standard_home,
    suggest::{closest, one_of},
};
use crate::lang::syntax::tree;
use crate::primitives::{self, Attribute, Type, attributes};
use crate::rules::{FeatureKind, Value};

impl Checker<'_> {
    pub(super) fn reference(&mut self, r: &tree::Reference, scope: Scope<'_>) -> Option<Expr> {
        let name = &r.name.text;
        if let Some(ty) = scope.parameter(name) {
            self.uses_parameter(&r.name, scope);
            return self.parameter(r, ty?);
        }
        if let Some(ty) = scope.variable(name) {
            self.names.uses_local(&r.name);
            self.no_parts(r, "a `for each` variable")?;
            return Some(made(ExprKind::Variable(name.clone()), ty?, r.span));
        }
        if let (Some(rule), true) = (scope.rule, scope.family(name).is_some()) {
            return self.feature_part(r, rule, scope);
        }
        match scope.module.scope.get(name) {
            Some(Some(id)) => self.bare_definition(*id, r),
            Some(None) => None,
            None => self.bare_word(r, scope),
        }
    }

    /// Records a parameter.
    pub(super) fn uses_parameter(&mut self, name: &tree::Name, scope: Scope<'_>) {
        if let Some((_, at)) = scope.parameters.and_then(|p| p.get(&name.text)) {
            self.names.uses(name.span, Entity::Declared(Kind::Parameter, *at));
        }
    }

    /// `width`, or `face.edges` where the parameter is a face.
    fn parameter(&mut self, r: &tree::Reference, ty: Type) -> Option<Expr> {
        let name = &r.name.text;
        if r.index.is_none() && r.fields.is_empty() {
            return Some(made(ExprKind::Parameter(name.clone()), ty, r.span));
        }
        let (Type::Polygon, None, [field]) = (ty, &r.index, r.fields.as_slice()) else {
            let message = format!("`{name}` is {} and has no parts", units::describe(ty));
            let out = Diagnostic::new(Code::E0206, r.span, message);
            self.report(out.help("attributes are read from a feature, or from a parameter of type `polygon`"));
            return None;
        };
        let found = self.attribute(name, field, FeatureKind::Polygon)?;
        let kind = ExprKind::ParameterAttribute(name.clone(), found.name);
        Some(made(kind, found.ty, r.span))
    }

    fn no_parts(&mut self, r: &tree::Reference, what: &str) -> Option<()> {
        if r.index.is_none() && r.fields.is_empty() {
            return Some(());
        }
        self.report(
            Diagnostic::new(
                Code::E0206,
                r.span,
                format!("`{}` is {what} and has no parts", r.name.text),
            )
            .help("attributes are read from the features of a rule, like `bottom.edges`"),
        );
        None
    }

    /// `kinect_v2`: a definition without parameters.
    fn bare_definition(&mut self, id: DefinitionId, r: &tree::Reference) -> Option<Expr> {
        self.names.uses(r.name.span, self.entity(id));
        self.no_parts(r, "a definition")?;
        let parameters = &self.signatures[id.0];
        if parameters.iter().all(|p| p.optional) {
            let arguments = parameters.iter().map(|_| None).collect();
            let ty = self.definition(id)?;
            return Some(made(ExprKind::Definition(id, arguments), ty, r.span));
        }
        let required = parameters.iter().filter(|p| !p.optional);
        let names: Vec<String> = required.map(|p| format!("{}: …", p.name)).collect();
        let help = format!("call it: `{}({})`", r.name.text, names.join(", "));
        let message = format!("`{}` needs arguments", r.name.text);
        self.report(Diagnostic::new(Code::E0303, r.span, message).help(help));
        None
    }

    /// A name that nothing declares: a primitive without its parentheses, a colour, or unknown.
    fn bare_word(&mut self, r: &tree::Reference, scope: Scope<'_>) -> Option<Expr> {
        let name = &r.name.text;
        if let Some(primitive) = primitives::find(name) {
            self.names.uses(r.name.span, Entity::Primitive(primitive.name));
            let call = format!("{name}()");
            let out = Diagnostic::new(Code::E0303, r.span, format!("`{name}` is called with parentheses"));
            let out = if primitive
                .parameters
                .iter()
                .any(|p| matches!(p.default, primitives::Default::Required))
            {
                let names: Vec<&str> = primitive.parameters.iter().map(|p| p.name).collect();
                out.help(format!("write `{name}({}: …)`", names.join(": …, ")))
            } else {
                out.help(format!("write `{call}`"))
                    .fix(format!("write `{call}`"), r.span, call)
            };
            self.report(out);
            return None;
        }
        if r.index.is_none()
            && r.fields.is_empty()
            && let Some((word, colour)) = colours::all().find(|(n, _)| n == name)
        {
            self.names.uses(r.span, Entity::Colour(word));
            return Some(constant(Value::Colour(colour), Type::Colour, r.span));
        }
        self.unknown_name(&r.name, scope);
        None
    }

    fn unknown_name(&mut self, name: &tree::Name, scope: Scope<'_>) {
        if scope.lost(&name.text) || !self.first_time("name", name) {
            return;
        }
        if scope.module.libraries.contains_key(&name.text) {
            return self.library_as_value(name);
        }
        let mut known: Vec<&str> = scope.module.scope.keys().map(String::as_str).collect();
        if let Some(parameters) = scope.parameters {
            known.extend(parameters.keys().map(String::as_str));
        }
        if let Some(rule) = scope.rule {
            known.extend(rule.each.iter().map(|(n, _)| n.as_str()));
        }
        if let Some(families) = scope.families {
            known.extend(families.by_name.keys().map(String::as_str));
        }
        for colour in colours::names() {
            known.push(colour);
        }
        let out = Diagnostic::new(Code::E0201, name.span, format!("there is no `{}` here", name.text));
        let near = closest(&name.text, known).map(str::to_owned);
        self.report(match (near, standard_home(&name.text)) {
            (_, Some(module)) => out.help(format!(
                "it is in the standard library: add `use std.{module}.{}`",
                name.text
            )),
            (Some(near), _) => out.meant(&near),
            (None, None) if name.text == "std" => {
                out.help("import it at the top, `use std.cameras.kinect_v2`, and name it alone: `kinect_v2`")
            }
            (None, None) => out.help("define it with `let`, or import it with `use`"),
        });
    }

    /// `bottom`, `bottom.edges`, `code[i].pose`.
    fn feature_part(&mut self, r: &tree::Reference, rule: &RuleScope, scope: Scope<'_>) -> Option<Expr> {
        let family = scope.family(&r.name.text)?;
        let feature = feature_use(self, &r.name, r.index.as_ref(), r.span, scope)?;
        let attribute = match r.fields.as_slice() {
            [] => whole_face(self, r, family.kind)?,
            [field] => {
                let found = self.attribute(&feature.family, field, family.kind)?;
                (found.name.to_owned(), found.ty)
            }
            [_, extra, ..] => {
                let message = format!("`{}` is read from a feature, not from an attribute", extra.text);
                self.report(Diagnostic::new(Code::E0206, extra.span, message));
                return None;
            }
        };
        self.in_reach(&feature, rule)?;
        let (name, ty) = attribute;
        Some(made(ExprKind::Attribute(feature, name), ty, r.span))
    }

    /// The attribute of a kind of feature by name.
    pub(super) fn attribute(
        &mut self,
        owner: &str,
        field: &tree::Name,
        kind: FeatureKind,
    ) -> Option<&'static Attribute> {
        let known: &'static [Attribute] = attributes(kind);
        if let Some(found) = known.iter().find(|a| a.name == field.text) {
            self.names.uses(field.span, Entity::Attribute(kind.into(), found.name));
            return Some(found);
        }
        let names = || known.iter().map(|a| a.name);
        let out = Diagnostic::new(
            Code::E0206,
            field.span,
            format!("a {kind} like `{owner}` has no attribute `{}`", field.text),
        );
        self.report(match closest(&field.text, names()) {
            Some(near) => out.meant(near),
            None => out.help(format!("it has {}", one_of(names()).replace(" or ", " and "))),
        });
        None
    }

    /// Only antecedents and the consequent are measured when a rule is looked at.
    fn in_reach(&mut self, feature: &FeatureUse, rule: &RuleScope) -> Option<()> {
        if rule.role(feature) != Role::Neither {
            return Some(());
        }
        self.report(
            Diagnostic::new(
                Code::E0205,
                feature.span,
                format!(
                    "`{}` is neither an antecedent nor the consequent of this rule",
                    feature.family
                ),
            )
            .related(rule.consequent.span, "the rule concludes this")
            .help(format!("add `{}` before the `->`, so that it is known", feature.family)),
        );
        None
    }
}

/// A polygon's own name stands for the whole face.
fn whole_face(checker: &mut Checker<'_>, r: &tree::Reference, kind: FeatureKind) -> Option<(String, Type)> {
    if kind == FeatureKind::Polygon {
        return Some(("self".into(), Type::Polygon));
    }
    let first = attributes(kind).first();
    let help = first.map(|a| {
        format!(
            "name an attribute: `{}.{}` is {}",
            r.name.text,
            a.name,
            units::describe(a.ty)
        )
    });
    let message = format!("`{}` is a {kind}, which is no value by itself", r.name.text);
    checker.report(Diagnostic::new(Code::E0301, r.span, message).maybe_help(help));
    None
}
