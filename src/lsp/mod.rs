//! The language server: what `crate::ide` knows, over the Language Server Protocol.
//!
//! One thread reads messages, one answers them in order. Texts of open documents stand
//! before those on disk. A keystroke only makes what was known about its file stale:
//! names and types are looked at again when something is asked, and diagnostics are
//! published when nothing else is waiting.

mod answers;
mod capabilities;
mod convert;
mod documents;
mod frames;
mod paths;
mod position;
mod publish;
mod requests;
mod server;
mod standard;
mod workspace;

pub use server::serve;
