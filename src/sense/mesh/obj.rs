//! Wavefront OBJ with MTL colours and textures. What a file refers to may be
//! missing: its faces are then grey, with a warning.

use std::cell::RefCell;
use std::io::Cursor;
use std::path::Path;

use super::read::{GREY, Soup, load};
use super::{MeshError, MeshWarning, Paint, image};
use crate::geometry::Point;

const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: false,
    triangulate: true,
    ignore_points: true,
    ignore_lines: true,
};

pub(super) fn read(bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
    let missing = RefCell::new(Vec::new());
    let load_materials = |name: &Path| {
        let path = soup.beside(&name.to_string_lossy());
        load(&path)
            .map_err(|_| tobj::LoadError::OpenFileFailed)
            .and_then(|bytes| tobj::load_mtl_buf(&mut Cursor::new(bytes)))
            .inspect_err(|_| missing.borrow_mut().push(path))
    };
    let (models, materials) = tobj::load_obj_buf(&mut Cursor::new(bytes), &OPTIONS, load_materials)
        .map_err(|e| soup.malformed(e.to_string()))?;
    soup.warnings
        .extend(missing.into_inner().into_iter().map(MeshWarning::MissingFile));
    let looks = looks(&materials.unwrap_or_default(), soup);
    for model in &models {
        let look = model.mesh.material_id.and_then(|k| looks.get(k));
        push_model(&model.mesh, look.unwrap_or(&Look::Plain(GREY)), soup)?;
    }
    Ok(())
}

/// What a material shows.
enum Look {
    Plain([u8; 3]),
    Image(u32),
}

/// The look of each material; textures that cannot be used give way to the colour.
fn looks(materials: &[tobj::Material], soup: &mut Soup) -> Vec<Look> {
    materials
        .iter()
        .map(|material| {
            let plain = material.diffuse.map_or(GREY, |c| c.map(byte));
            let Some(name) = &material.diffuse_texture else {
                return Look::Plain(plain);
            };
            let path = soup.beside(&name.replace('\\', "/"));
            match load(&path).ok().and_then(|bytes| image::decode(&bytes).ok()) {
                Some(texture) => {
                    soup.textures.push(texture);
                    Look::Image(soup.textures.len() as u32 - 1)
                }
                None => {
                    soup.warnings.push(MeshWarning::MissingFile(path));
                    Look::Plain(plain)
                }
            }
        })
        .collect()
}

fn push_model(mesh: &tobj::Mesh, look: &Look, soup: &mut Soup) -> Result<(), MeshError> {
    let point = |i: u32| {
        let k = 3 * i as usize;
        let p = mesh.positions.get(k..k + 3)?;
        Some(Point::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])))
    };
    for (face, ids) in mesh.indices.chunks_exact(3).enumerate() {
        let corners = (point(ids[0]), point(ids[1]), point(ids[2]));
        let (Some(a), Some(b), Some(c)) = corners else {
            return Err(soup.malformed(format!("face {} names a corner that is not there", face + 1)));
        };
        let paint = paint(mesh, face, [ids[0], ids[1], ids[2]], look);
        soup.push([a, b, c], paint)?;
    }
    Ok(())
}

fn paint(mesh: &tobj::Mesh, face: usize, ids: [u32; 3], look: &Look) -> Paint {
    if let Look::Image(texture) = *look
        && let Some(uv) = image_coordinates(mesh, face)
    {
        return Paint::Image {
            texture,
            uv,
            tint: [255; 3],
        };
    }
    let colour = |i: u32| {
        let k = 3 * i as usize;
        mesh.vertex_color
            .get(k..k + 3)
            .map(|c| [byte(c[0]), byte(c[1]), byte(c[2])])
    };
    match (ids.map(colour), look) {
        ([Some(a), Some(b), Some(c)], _) => Paint::Corners([a, b, c]),
        (_, Look::Plain(plain)) => Paint::Flat(*plain),
        (_, Look::Image(_)) => Paint::Flat(GREY),
    }
}

/// Image coordinates of a face; in OBJ v grows upwards.
fn image_coordinates(mesh: &tobj::Mesh, face: usize) -> Option<[[f64; 2]; 3]> {
    let ids = mesh.texcoord_indices.get(3 * face..3 * face + 3)?;
    let at = |k: usize| {
        let i = 2 * ids[k] as usize;
        let uv = mesh.texcoords.get(i..i + 2)?;
        Some([f64::from(uv[0]), 1.0 - f64::from(uv[1])])
    };
    Some([at(0)?, at(1)?, at(2)?])
}

fn byte(x: impl Into<f64>) -> u8 {
    (x.into().clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
