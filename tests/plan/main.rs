//! `vpl plan` from the outside, as its users meet it: the binary, its exit
//! status, its output and its files.

mod contract;
mod meshes;
mod outputs;
mod report;
mod resume;
mod support;
mod tasks;
mod usage;
mod why;
