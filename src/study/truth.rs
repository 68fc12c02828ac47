//! Which class an object is of.

use std::collections::BTreeSet;

use crate::rules::{Library, SceneObject};

/// The class of an object: that of its name or, where none is called so, the only one
/// that has just the markers that it bears.
pub fn truth(library: &Library, object: &SceneObject) -> Option<String> {
    let classes = &library.classes;
    if let Some(class) = classes.iter().find(|c| c.name == object.name) {
        return Some(class.name.clone());
    }
    let printed: BTreeSet<&str> = object.markers.iter().map(|m| m.text.as_str()).collect();
    if printed.is_empty() {
        return None;
    }
    let texts: Vec<Option<&str>> = library
        .feature_ids()
        .map(|id| {
            let rules = library.rules.iter().filter(|r| r.consequent == id);
            rules.filter_map(|r| r.detect.text("text").ok()).next()
        })
        .collect();
    let mut fitting = classes.iter().filter(|class| {
        let has = library
            .feature_ids()
            .zip(&texts)
            .filter(|(id, _)| class.presence.has(*id));
        has.filter_map(|(_, text)| *text).collect::<BTreeSet<_>>() == printed
    });
    match (fitting.next(), fitting.next()) {
        (Some(only), None) => Some(only.name.clone()),
        _ => None,
    }
}
