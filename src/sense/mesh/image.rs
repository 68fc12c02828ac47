//! PNG and JPEG textures.

use std::io::Cursor;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::Texture;

/// Longest side, pixels.
const MOST: u32 = 8192;

/// The image in PNG or JPEG bytes; transparency is ignored.
///
/// # Errors
/// What is wrong with it.
pub(in crate::sense) fn decode(bytes: &[u8]) -> Result<Texture, String> {
    let texture = if bytes.starts_with(b"\x89PNG") {
        decode_png(bytes)?
    } else if bytes.starts_with(&[0xff, 0xd8]) {
        decode_jpeg(bytes)?
    } else {
        return Err("an image that is neither PNG nor JPEG".to_owned());
    };
    let whole = texture.pixels.len() == texture.width as usize * texture.height as usize;
    if whole && !texture.pixels.is_empty() {
        Ok(texture)
    } else {
        Err("an image without all of its pixels".to_owned())
    }
}

fn decode_png(bytes: &[u8]) -> Result<Texture, String> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let (width, height) = (reader.info().width, reader.info().height);
    check_size(width, height)?;
    let size = reader.output_buffer_size().ok_or("an image that is too large")?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(|e| e.to_string())?;
    let pixels = data[..frame.buffer_size()]
        .chunks_exact(frame.color_type.samples())
        .map(|p| if p.len() < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] })
        .collect();
    Ok(Texture { width, height, pixels })
}

fn decode_jpeg(bytes: &[u8]) -> Result<Texture, String> {
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        .set_max_width(MOST as usize)
        .set_max_height(MOST as usize);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let data = decoder.decode().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("a JPEG image without a size")?;
    Ok(Texture {
        width: width as u32,
        height: height as u32,
        pixels: data.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
    })
}

fn check_size(width: u32, height: u32) -> Result<(), String> {
    let fits = (1..=MOST).contains(&width) && (1..=MOST).contains(&height);
    fits.then_some(())
        .ok_or_else(|| format!("an image of {width} by {height} pixels; the limit is {MOST}"))
}
