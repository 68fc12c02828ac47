//! What is said about a program: the pages of the codes, the renderings, the
//! fixes, and the verbs that show or make them.

mod explain;
mod fixes;
mod outside;
mod pages;
mod renderings;
mod support;
mod verbs;
