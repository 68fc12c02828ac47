//! Pictures of a recording: 16-bit depth and 8-bit colour, in PNG, PNM or JPEG.

use std::io::Cursor;
use std::path::Path;

use zune_jpeg::JpegDecoder;
use zune_ppm::PPMDecoder;
use zune_ppm::zune_core::bytestream::ZCursor;
use zune_ppm::zune_core::options::DecoderOptions;
use zune_ppm::zune_core::result::DecodingResult;

use super::error::FrameError;
use super::files;
use crate::sense::mesh::decode_image;
use crate::sense::{ColourImage, DepthImage};

/// Longest side, pixels.
pub(super) const MOST_SIDE: u32 = 8192;

/// Raw depth, row by row.
pub(super) struct Raw {
    pub size: [u32; 2],
    pub values: Vec<u16>,
}

impl Raw {
    /// Depth in metres at `scale` raw units a metre; 0 and 65535 are no reading.
    pub fn metres(&self, scale: f64) -> DepthImage {
        let metre = |&raw: &u16| {
            if matches!(raw, 0 | u16::MAX) {
                0.0
            } else {
                (f64::from(raw) / scale) as f32
            }
        };
        DepthImage {
            width: self.size[0],
            height: self.size[1],
            metres: self.values.iter().map(metre).collect(),
        }
    }
}

/// Reads 16-bit depth from a PNG or PGM file.
pub(super) fn depth(path: &Path) -> Result<Raw, FrameError> {
    let bytes = files::bytes(path)?;
    let raw = if bytes.starts_with(b"\x89PNG") {
        depth_png(&bytes)
    } else if bytes.starts_with(b"P5") {
        depth_pgm(&bytes)
    } else {
        Err("it is neither a PNG nor a binary PGM (P5) image".to_owned())
    };
    whole(raw).map_err(|what| FrameError::malformed(path, what))
}

fn whole(raw: Result<Raw, String>) -> Result<Raw, String> {
    let raw = raw?;
    let pixels = raw.size[0] as usize * raw.size[1] as usize;
    if pixels == 0 || raw.values.len() != pixels {
        return Err(format!("an image of {pixels} pixels with {} values", raw.values.len()));
    }
    Ok(raw)
}

fn depth_png(bytes: &[u8]) -> Result<Raw, String> {
    let mut reader = png::Decoder::new(Cursor::new(bytes))
        .read_info()
        .map_err(|e| e.to_string())?;
    let info = reader.info();
    let size = [info.width, info.height];
    fits(size)?;
    if (info.color_type, info.bit_depth) != (png::ColorType::Grayscale, png::BitDepth::Sixteen) {
        let kind = format!("{:?}, {} bits a channel", info.color_type, info.bit_depth as u8);
        return Err(not_depth(&kind.to_lowercase()));
    }
    let length = reader.output_buffer_size().ok_or("an image that is too large")?;
    let mut data = vec![0; length];
    reader.next_frame(&mut data).map_err(|e| e.to_string())?;
    let values = data.chunks_exact(2).map(|b| u16::from_be_bytes([b[0], b[1]])).collect();
    Ok(Raw { size, values })
}

fn depth_pgm(bytes: &[u8]) -> Result<Raw, String> {
    match pnm(bytes)? {
        (size, DecodingResult::U16(values)) => Ok(Raw { size, values }),
        _ => Err(not_depth("8 bits")),
    }
}

fn not_depth(kind: &str) -> String {
    format!("its pixels are {kind}; depth needs one channel of 16 bits (a preview or a disparity image is no depth)")
}

/// Reads an 8-bit colour or grey picture.
pub(super) fn colour(path: &Path) -> Result<ColourImage, FrameError> {
    colour_of(&files::bytes(path)?).map_err(|what| FrameError::malformed(path, what))
}

/// Columns and rows of a picture, by its header alone.
pub(super) fn size(path: &Path) -> Result<[u32; 2], FrameError> {
    let bytes = files::bytes(path)?;
    let size = if bytes.starts_with(b"\x89PNG") {
        png_size(&bytes)
    } else if bytes.starts_with(b"P5") || bytes.starts_with(b"P6") {
        pnm_header(&bytes).map(|(size, _)| size)
    } else {
        jpeg_size(&bytes)
    };
    size.map_err(|what| FrameError::malformed(path, what))
}

fn png_size(bytes: &[u8]) -> Result<[u32; 2], String> {
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info();
    let reader = reader.map_err(|e| e.to_string())?;
    Ok([reader.info().width, reader.info().height])
}

fn jpeg_size(bytes: &[u8]) -> Result<[u32; 2], String> {
    let mut decoder = JpegDecoder::new(ZCursor::new(bytes));
    decoder.decode_headers().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("a JPEG image without a size")?;
    Ok([width as u32, height as u32])
}

/// The colour picture in some bytes.
pub(super) fn colour_of(bytes: &[u8]) -> Result<ColourImage, String> {
    if !bytes.starts_with(b"P5") && !bytes.starts_with(b"P6") {
        let texture = decode_image(bytes)?;
        return Ok(ColourImage {
            width: texture.width,
            height: texture.height,
            pixels: texture.pixels,
        });
    }
    let channels = if bytes.starts_with(b"P5") { 1 } else { 3 };
    let (size, DecodingResult::U8(values)) = pnm(bytes)? else {
        return Err("16 bits a channel; expected 8".to_owned());
    };
    coloured(size, channels, &values)
}

/// Grey or RGB bytes as a picture.
pub(super) fn coloured([width, height]: [u32; 2], channels: usize, values: &[u8]) -> Result<ColourImage, String> {
    let pixels: Vec<[u8; 3]> = match channels {
        1 => values.iter().map(|&v| [v; 3]).collect(),
        _ => values.chunks_exact(channels).map(|p| [p[0], p[1], p[2]]).collect(),
    };
    if pixels.len() != width as usize * height as usize {
        return Err("an image without all of its pixels".to_owned());
    }
    Ok(ColourImage { width, height, pixels })
}

fn pnm(bytes: &[u8]) -> Result<([u32; 2], DecodingResult), String> {
    let (size, mut decoder) = pnm_header(bytes)?;
    Ok((size, decoder.decode().map_err(pnm_failed)?))
}

type Pnm<'a> = PPMDecoder<ZCursor<&'a [u8]>>;

fn pnm_header(bytes: &[u8]) -> Result<([u32; 2], Pnm<'_>), String> {
    let side = MOST_SIDE as usize;
    let options = DecoderOptions::default().set_max_width(side).set_max_height(side);
    let mut decoder = PPMDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(pnm_failed)?;
    let (width, height) = decoder.dimensions().ok_or("an image without a size")?;
    let size = [width as u32, height as u32];
    fits(size)?;
    Ok((size, decoder))
}

fn pnm_failed(error: zune_ppm::PPMDecodeErrors) -> String {
    format!("{error:?}").to_lowercase()
}

/// Refuses images without pixels and of absurd size.
pub(super) fn fits([width, height]: [u32; 2]) -> Result<(), String> {
    let sides = 1..=MOST_SIDE;
    let inside = sides.contains(&width) && sides.contains(&height);
    inside
        .then_some(())
        .ok_or_else(|| format!("an image of {width} by {height} pixels; the limit is {MOST_SIDE}"))
}
