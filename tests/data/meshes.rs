//! Every mesh of the shared data, held to what another reader said of it.

use std::fs;

use vpl::sense::{Axis, MeshOptions, MeshWarning, Units, mesh};

use crate::support::shared;

/// A row of the data's README: `N tri; bbox X x Y x Z; watertight`.
fn claims(row: &str) -> Option<(&str, usize, [f64; 3], bool)> {
    let cells: Vec<&str> = row.split('|').map(str::trim).collect();
    let (file, checked) = (cells.get(1)?, cells.iter().find(|c| c.contains(" tri; bbox "))?);
    let (triangles, rest) = checked.split_once(" tri; bbox ")?;
    let (size, rest) = rest.split_once(';')?;
    let extents: Vec<f64> = size.split(" x ").filter_map(|x| x.trim().parse().ok()).collect();
    Some((
        file,
        triangles.parse().ok()?,
        extents.try_into().ok()?,
        !rest.contains("not watertight"),
    ))
}

#[test]
fn every_mesh_of_others_is_read_as_another_reader_read_it() {
    let Some(base) = shared("") else { return };
    let text = fs::read_to_string(base.join("README.md")).unwrap();
    let mut read = 0;
    let mut wrong = String::new();
    for (file, triangles, extents, watertight) in text.lines().filter_map(claims) {
        // Units and axes as they are in the file; glTF's are its own.
        let options = MeshOptions {
            units: Some(Units::Metres),
            up: Some(Axis::Z),
        };
        let mesh = match mesh::read(&base.join(file), &options) {
            Ok(mesh) => mesh,
            Err(error) => {
                wrong += &format!("{file}: {error}\n");
                continue;
            }
        };
        let dropped: usize = mesh
            .warnings
            .iter()
            .map(|w| if let MeshWarning::DegenerateFaces(n) = w { *n } else { 0 })
            .sum();
        let mut found: Vec<f64> = mesh.bounds().size().iter().copied().collect();
        let mut stated = extents.to_vec();
        found.sort_by(f64::total_cmp);
        stated.sort_by(f64::total_cmp);
        let sized = found
            .iter()
            .zip(&stated)
            .all(|(a, b)| (a - b).abs() <= 2e-3 * b.abs().max(1e-6));
        let counted = mesh.triangles.len() + dropped;
        let open = mesh.warnings.iter().any(|w| matches!(w, MeshWarning::OpenEdges(_)));
        // The scanned can of BOP is closed too, but 17 of its edges are wound one way twice.
        let closed = watertight && file.starts_with("meshes/");
        if counted != triangles || !sized || (closed && open) {
            wrong += &format!(
                "{file}: {counted} triangles of {triangles}, {found:?} for {stated:?}, {:?}\n",
                mesh.warnings
            );
        }
        read += 1;
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(read >= 20, "{read} meshes");
}
