//! What the parameters of libraries that were taken over stand for.

use super::Lowering;
use super::expand::Env;
use crate::lang::source::Span;
use crate::lang::types::typed::{self, EnvironmentId};

/// The environments of a library, by id; a parameter whose argument is wrong is left out.
pub(super) struct Environments<'a>(Vec<Env<'a>>);

impl<'a> Environments<'a> {
    /// What a part of the library sees.
    pub fn of(&self, id: Option<EnvironmentId>) -> Env<'a> {
        id.and_then(|id| self.0.get(id.0)).cloned().unwrap_or_default()
    }
}

impl<'a> Lowering<'a> {
    /// Expands the arguments of every `use`, outer ones first.
    pub(super) fn environments(&mut self, library: &'a typed::Library) -> Environments<'a> {
        let mut out = Environments(Vec::new());
        for environment in &library.environments {
            let parent = out.of(environment.parent);
            let inner = Env::called(parent.call.unwrap_or(environment.at));
            let mut env = inner.clone();
            for binding in &environment.bindings {
                self.taken_over(&parent, binding.value.span, |lowering| {
                    let seen = if binding.default { &inner } else { &parent };
                    let given = lowering.expand(&binding.value, seen);
                    env.parameters.extend(given.map(|given| (binding.name.as_str(), given)));
                });
            }
            out.0.push(env);
        }
        out
    }

    /// Lowers a part; what is wrong with one that was taken over is said at the `use`
    /// and names the part.
    pub(super) fn taken_over(&mut self, env: &Env<'_>, part: Span, lower: impl FnOnce(&mut Self)) {
        let before = self.found.len();
        lower(self);
        if env.call.is_none() {
            return;
        }
        let new = self.found.drain(before..).collect::<Vec<_>>();
        self.found.extend(
            new.into_iter()
                .map(|d| d.related(part, "in this part of the library that is taken over")),
        );
    }
}
