//! glTF 2.0, text and binary: triangles of the scene's nodes at rest, base
//! colours and textures. Buffers are the binary chunk, data URIs or files.
//! Skins and animations are not applied: nodes stay where their transforms put
//! them.

use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, buffer, image};
use nalgebra::Matrix4;

use super::base64::{data_uri, percent_decoded};
use super::read::{MOST_TRIANGLES, Soup, load};
use super::{MeshError, Paint, Texture, image as pixels};
use crate::geometry::Point;

/// Deepest nesting of nodes.
const DEEPEST: usize = 256;

pub(super) fn read(bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
    let Gltf { document, blob } = Gltf::from_slice(bytes).map_err(|e| soup.malformed(e.to_string().to_lowercase()))?;
    let buffers = document
        .buffers()
        .map(|b| buffer_bytes(&b, blob.as_deref(), soup))
        .collect::<Result<Vec<_>, _>>()?;
    soup.textures = document
        .images()
        .map(|image| texture(&image, &buffers, soup))
        .collect::<Result<_, _>>()?;
    let mut scene = Scene {
        visited: vec![false; document.nodes().count()],
        buffers,
    };
    for node in roots(&document) {
        scene.push_node(&node, &Matrix4::identity(), 0, soup)?;
    }
    Ok(())
}

/// Nodes of the default scene, or of the first.
fn roots(document: &Document) -> Vec<Node<'_>> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    scene.map_or_else(|| document.nodes().collect(), |s| s.nodes().collect())
}

fn buffer_bytes(buffer: &buffer::Buffer, blob: Option<&[u8]>, soup: &Soup) -> Result<Vec<u8>, MeshError> {
    let bytes = match buffer.source() {
        buffer::Source::Bin => blob
            .map(<[u8]>::to_vec)
            .ok_or_else(|| soup.malformed("it has no binary chunk and refers to one"))?,
        buffer::Source::Uri(uri) => resolve(uri, soup)?,
    };
    if bytes.len() < buffer.length() {
        let what = format!(
            "buffer {} states {} bytes and has {}",
            buffer.index(),
            buffer.length(),
            bytes.len()
        );
        return Err(soup.malformed(what));
    }
    Ok(bytes)
}

/// The bytes of a data URI or of a file beside this one.
fn resolve(uri: &str, soup: &Soup) -> Result<Vec<u8>, MeshError> {
    if uri.starts_with("data:") {
        data_uri(uri).ok_or_else(|| soup.malformed("a data URI that is not base64"))
    } else {
        load(&soup.beside(&percent_decoded(uri)))
    }
}

fn texture(image: &image::Image, buffers: &[Vec<u8>], soup: &Soup) -> Result<Texture, MeshError> {
    let bytes = match image.source() {
        image::Source::Uri { uri, .. } => resolve(uri, soup)?,
        image::Source::View { view, .. } => buffers
            .get(view.buffer().index())
            .and_then(|b| b.get(view.offset()..view.offset().checked_add(view.length())?))
            .ok_or_else(|| soup.malformed(format!("image {} lies outside its buffer", image.index())))?
            .to_vec(),
    };
    pixels::decode(&bytes).map_err(|what| soup.malformed(format!("image {}: {what}", image.index())))
}

struct Scene {
    buffers: Vec<Vec<u8>>,
    /// Nodes form a tree (glTF 3.5.2): none is entered twice.
    visited: Vec<bool>,
}

impl Scene {
    fn push_node(
        &mut self,
        node: &Node,
        world_from_parent: &Matrix4<f64>,
        depth: usize,
        soup: &mut Soup,
    ) -> Result<(), MeshError> {
        if depth == DEEPEST {
            return Err(soup.malformed(format!("its nodes are nested more than {DEEPEST} deep")));
        }
        if std::mem::replace(&mut self.visited[node.index()], true) {
            return Err(soup.malformed(format!("node {} has two parents", node.index())));
        }
        let columns = node.transform().matrix();
        let local = Matrix4::from_fn(|row, column| f64::from(columns[column][row]));
        let world_from_node = world_from_parent * local;
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                self.push_primitive(&primitive, &world_from_node, soup)?;
            }
        }
        for child in node.children() {
            self.push_node(&child, &world_from_node, depth + 1, soup)?;
        }
        Ok(())
    }

    fn push_primitive(&self, primitive: &Primitive, world: &Matrix4<f64>, soup: &mut Soup) -> Result<(), MeshError> {
        check_counts(primitive, soup)?;
        let reader = primitive.reader(|b| self.buffers.get(b.index()).map(Vec::as_slice));
        let Some(positions) = reader.read_positions() else {
            return Err(soup.malformed("a primitive without positions, or with positions outside their buffer"));
        };
        let corners: Vec<Point> = positions
            .map(|p| world.transform_point(&Point::from(p.map(f64::from))))
            .collect();
        let order: Vec<u32> = match (primitive.indices(), reader.read_indices()) {
            (None, _) => (0..corners.len() as u32).collect(),
            (Some(_), Some(indices)) => indices.into_u32().collect(),
            (Some(_), None) => return Err(soup.malformed("a primitive with indices outside their buffer")),
        };
        let look = Look::of(primitive, &self.buffers);
        let mirrored = world.fixed_view::<3, 3>(0, 0).determinant() < 0.0;
        for ids in faces(primitive.mode(), &order) {
            let ids = if mirrored { [ids[0], ids[2], ids[1]] } else { ids };
            let at = ids.map(|i| corners.get(i as usize).copied());
            let [Some(a), Some(b), Some(c)] = at else {
                return Err(soup.malformed(format!(
                    "a face names corner {} of {}",
                    ids.iter().max().unwrap_or(&0),
                    corners.len()
                )));
            };
            soup.push([a, b, c], look.paint(ids))?;
        }
        Ok(())
    }
}

/// Accessors that are empty or state more than could be loaded.
fn check_counts(primitive: &Primitive, soup: &Soup) -> Result<(), MeshError> {
    let accessors = primitive.attributes().map(|(_, a)| a).chain(primitive.indices());
    for count in accessors.map(|a| a.count()) {
        if count == 0 {
            return Err(soup.malformed("an accessor of no elements"));
        }
        if count > 3 * MOST_TRIANGLES {
            return Err(soup.too_many(count / 3));
        }
    }
    Ok(())
}

/// Triangles of an index list; none for points and lines.
fn faces(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::Triangles => order.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        Mode::TriangleStrip => order
            .windows(3)
            .enumerate()
            .map(|(k, t)| {
                if k % 2 == 0 {
                    [t[0], t[1], t[2]]
                } else {
                    [t[1], t[0], t[2]]
                }
            })
            .collect(),
        Mode::TriangleFan => (2..order.len()).map(|k| [order[0], order[k - 1], order[k]]).collect(),
        _ => Vec::new(),
    }
}

/// Colour and texture of a primitive's material.
struct Look {
    /// sRGB, 255 = 1.
    base: [u8; 3],
    image: Option<u32>,
    uv: Vec<[f64; 2]>,
    colours: Vec<[u8; 3]>,
}

impl Look {
    fn of(primitive: &Primitive, buffers: &[Vec<u8>]) -> Self {
        let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
        let material = primitive.material().pbr_metallic_roughness();
        let [r, g, b, _] = material.base_color_factor();
        let info = material.base_color_texture();
        let transform = info.as_ref().and_then(|i| i.texture_transform());
        let set = info.as_ref().map_or(0, |i| {
            transform.as_ref().and_then(|t| t.tex_coord()).unwrap_or(i.tex_coord())
        });
        let place = |uv: [f32; 2]| {
            let uv = uv.map(f64::from);
            transform.as_ref().map_or(uv, |t| transformed(uv, t))
        };
        let colours = reader.read_colors(0).map(|c| c.into_rgb_f32().collect::<Vec<_>>());
        Self {
            base: [r, g, b].map(srgb),
            image: info.map(|i| i.texture().source().index() as u32),
            uv: reader
                .read_tex_coords(set)
                .map(|t| t.into_f32().map(place).collect())
                .unwrap_or_default(),
            colours: colours
                .unwrap_or_default()
                .into_iter()
                .map(|c| [c[0] * r, c[1] * g, c[2] * b].map(srgb))
                .collect(),
        }
    }

    fn paint(&self, ids: [u32; 3]) -> Paint {
        let uv = ids.map(|i| self.uv.get(i as usize).copied());
        let colours = ids.map(|i| self.colours.get(i as usize).copied());
        match (self.image, uv, colours) {
            (Some(texture), [Some(a), Some(b), Some(c)], _) => Paint::Image {
                texture,
                uv: [a, b, c],
                tint: self.base,
            },
            (_, _, [Some(a), Some(b), Some(c)]) => Paint::Corners([a, b, c]),
            _ => Paint::Flat(self.base),
        }
    }
}

/// Image coordinates under KHR_texture_transform: scale, turn, shift.
fn transformed([u, v]: [f64; 2], by: &gltf::texture::TextureTransform) -> [f64; 2] {
    let [su, sv] = by.scale().map(f64::from);
    let [ou, ov] = by.offset().map(f64::from);
    let (sine, cosine) = f64::from(by.rotation()).sin_cos();
    let (u, v) = (u * su, v * sv);
    [u * cosine + v * sine + ou, v * cosine - u * sine + ov]
}

/// An 8-bit sRGB value of a linear one (IEC 61966-2-1).
fn srgb(linear: f32) -> u8 {
    let x = linear.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + 0.5) as u8
}
