//! `vpl lsp`, driven over its protocol through the real binary.

mod client;
mod fixtures;
mod lifecycle;
mod mutations;
mod positions;
mod workspace;
