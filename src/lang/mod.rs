//! The language: source text to a checked, compiled rule set.
