//! The tree-sitter parser of VPL, and the queries that editors run on its trees.
//!
//! Built from `src/parser.c`, which the program `generate` writes from `grammar.js`.

use tree_sitter_language::LanguageFn;

unsafe extern "C" {
    fn tree_sitter_vpl() -> *const ();
}

/// The language, for `tree_sitter::Parser::set_language`.
// SAFETY: the generated function takes nothing and gives a pointer to static tables.
pub const LANGUAGE: LanguageFn = unsafe { LanguageFn::from_raw(tree_sitter_vpl) };

/// What is coloured how.
pub const HIGHLIGHTS: &str = include_str!("../../queries/highlights.scm");
/// What folds.
pub const FOLDS: &str = include_str!("../../queries/folds.scm");
/// What indents.
pub const INDENTS: &str = include_str!("../../queries/indents.scm");
/// Scopes, definitions and references.
pub const LOCALS: &str = include_str!("../../queries/locals.scm");
