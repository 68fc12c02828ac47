//! Layouts: markers with their places and facings.

use std::collections::BTreeMap;

use super::Checker;
use super::expressions::Due;
use super::scope::Scope;
use super::typed::{Layout, LayoutPlace};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::{FeatureId, FeatureKind};

impl Checker<'_> {
    pub(super) fn layout(&mut self, layout: &tree::Layout, scope: Scope<'_>) -> Layout {
        let mut seen: BTreeMap<FeatureId, Span> = BTreeMap::new();
        let mut places = Vec::new();
        for place in &layout.places {
            let Some(checked) = self.layout_place(place, scope) else {
                continue;
            };
            if let Some(first) = seen.insert(checked.feature, place.span) {
                let message = format!("`{}` has two places in this layout", place.feature.name.text);
                let out = Diagnostic::new(Code::E0202, place.feature.span, message);
                self.report(out.related(first, "first placed here"));
                continue;
            }
            places.push(checked);
        }
        if layout.whole && layout.places.is_empty() {
            let message = format!("layout `{}` has no places", layout.name.text);
            let help = "give each feature a place: `code[1] at [450 mm, 0 mm, 250 mm] facing +x`";
            self.report(Diagnostic::new(Code::E0308, layout.name.span, message).help(help));
        }
        Layout {
            environment: None,
            name: layout.name.text.clone(),
            places,
            span: layout.head,
        }
    }

    fn layout_place(&mut self, place: &tree::LayoutPlace, scope: Scope<'_>) -> Option<LayoutPlace> {
        let feature = self.one_feature(&place.feature, scope);
        let at = Due {
            ty: Type::Point,
            what: "a place",
        };
        let facing = Due {
            ty: Type::Direction,
            what: "`facing`",
        };
        let (at, facing) = (
            self.check(&place.at, at, scope),
            self.check(&place.facing, facing, scope),
        );
        Some(LayoutPlace {
            feature: feature?,
            at: at?,
            facing: facing?,
            span: place.span,
        })
    }

    /// A single marker; layouts place markers.
    fn one_feature(&mut self, feature: &tree::FeatureRef, scope: Scope<'_>) -> Option<FeatureId> {
        let used = super::features::feature_use(self, &feature.name, feature.index.as_ref(), feature.span, scope)?;
        let family = scope.family(&feature.name.text)?;
        if family.kind != FeatureKind::Marker {
            let message = format!(
                "`{}` is a {}, and a layout places markers",
                feature.name.text, family.kind
            );
            let out = Diagnostic::new(Code::E0307, feature.span, message);
            self.report(out.related(family.span, "declared here"));
            return None;
        }
        scope.families?.resolve(&used, &BTreeMap::new())
    }
}
