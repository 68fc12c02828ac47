//! PLY: ASCII and binary of both byte orders, polygons of any number of
//! corners, colours of vertices or faces. Other elements and properties are
//! read over.

use std::io::Cursor;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Header, Property, PropertyAccess, PropertyAccessResult};

use super::read::{GREY, MOST_TRIANGLES, Soup};
use super::{MeshError, Paint};
use crate::geometry::Point;

/// A vertex, a face or anything else.
struct Item {
    at: [f64; 3],
    colour: [Option<u8>; 3],
    corners: Vec<i64>,
}

impl PropertyAccess for Item {
    fn new() -> Self {
        Self {
            at: [f64::NAN; 3],
            colour: [None; 3],
            corners: Vec::new(),
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        match name {
            "x" => self.at[0] = scalar(&value),
            "y" => self.at[1] = scalar(&value),
            "z" => self.at[2] = scalar(&value),
            "red" | "diffuse_red" | "r" => self.colour[0] = value.to_u8_color_lossy(),
            "green" | "diffuse_green" | "g" => self.colour[1] = value.to_u8_color_lossy(),
            "blue" | "diffuse_blue" | "b" => self.colour[2] = value.to_u8_color_lossy(),
            "vertex_indices" | "vertex_index" => self.corners = indices(value),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl Item {
    fn colour(&self) -> Option<[u8; 3]> {
        Some([self.colour[0]?, self.colour[1]?, self.colour[2]?])
    }
}

pub(super) fn read(bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
    let parser = Parser::<Item>::new();
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = parser
        .read_header(&mut reader)
        .map_err(|e| soup.malformed(e.to_string().to_lowercase()))?;
    check_counts(&header, bytes.len(), soup)?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (name, element) in &header.elements {
        let items = parser
            .read_payload_for_element(&mut reader, element, &header)
            .map_err(|e| soup.malformed(format!("in element `{name}`: {}", first_line(&e.to_string()))))?;
        match name.as_str() {
            "vertex" => vertices = items,
            "face" => faces = items,
            _ => {}
        }
    }
    for (k, face) in faces.iter().enumerate() {
        push_face(&vertices, face, k, soup)?;
    }
    Ok(())
}

/// Every item takes a byte or more, so a header cannot ask for more than the file holds.
fn check_counts(header: &Header, bytes: usize, soup: &Soup) -> Result<(), MeshError> {
    for (name, element) in &header.elements {
        if element.count > bytes {
            let what = format!("it states {} of element `{name}` and has {bytes} bytes", element.count);
            return Err(soup.malformed(what));
        }
        if name == "face" && element.count > MOST_TRIANGLES {
            return Err(soup.too_many(element.count));
        }
    }
    Ok(())
}

/// Adds a polygon as a fan about its first corner.
fn push_face(vertices: &[Item], face: &Item, number: usize, soup: &mut Soup) -> Result<(), MeshError> {
    let corner = |i: i64| {
        usize::try_from(i)
            .ok()
            .and_then(|i| vertices.get(i))
            .ok_or_else(|| soup.malformed(format!("face {} names vertex {i}, of {}", number + 1, vertices.len())))
    };
    let corners = face.corners.iter().map(|&i| corner(i)).collect::<Result<Vec<_>, _>>()?;
    for k in 1..corners.len().saturating_sub(1) {
        let triangle = [corners[0], corners[k], corners[k + 1]];
        let paint = match triangle.map(Item::colour) {
            [Some(a), Some(b), Some(c)] => Paint::Corners([a, b, c]),
            _ => Paint::Flat(face.colour().unwrap_or(GREY)),
        };
        soup.push(triangle.map(|v| Point::from(v.at)), paint)?;
    }
    Ok(())
}

fn scalar(value: &Property) -> f64 {
    match *value {
        Property::Char(x) => f64::from(x),
        Property::UChar(x) => f64::from(x),
        Property::Short(x) => f64::from(x),
        Property::UShort(x) => f64::from(x),
        Property::Int(x) => f64::from(x),
        Property::UInt(x) => f64::from(x),
        Property::Float(x) => f64::from(x),
        Property::Double(x) => x,
        _ => f64::NAN,
    }
}

fn indices(value: Property) -> Vec<i64> {
    match value {
        Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
        Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
        Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
        Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
        Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
        Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
        _ => Vec::new(),
    }
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().to_lowercase()
}
