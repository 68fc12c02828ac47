//! When a pixel's colour counts as a declared colour.
//!
//! Shading changes the value of a colour and leaves its hue: saturated colours
//! are told by hue, grey ones by how little hue they have and by value.

use crate::rules::Colour;

/// Share of chroma in value from which a declared colour has a hue.
const SATURATED: f64 = 0.25;
/// A pixel needs this share of the declared colour's saturation.
const SATURATION_KEPT: f64 = 0.45;
/// Most difference of hue, degrees.
const HUE_WITHIN: f64 = 25.0;
/// Below this value (0 to 255) a pixel's hue says nothing.
const DARK: f64 = 16.0;
/// Shading of a grey surface lies between these factors.
const SHADING: std::ops::RangeInclusive<f64> = 0.4..=1.25;

/// Hue in degrees, saturation 0 to 1, value 0 to 255.
struct Hsv {
    hue: f64,
    saturation: f64,
    value: f64,
}

fn hsv([r, g, b]: [u8; 3]) -> Hsv {
    let (r, g, b) = (f64::from(r), f64::from(g), f64::from(b));
    let value = r.max(g).max(b);
    let chroma = value - r.min(g).min(b);
    let sextant = if chroma == 0.0 {
        0.0
    } else if value == r {
        ((g - b) / chroma).rem_euclid(6.0)
    } else if value == g {
        (b - r) / chroma + 2.0
    } else {
        (r - g) / chroma + 4.0
    };
    let saturation = if value > 0.0 { chroma / value } else { 0.0 };
    Hsv {
        hue: sextant * 60.0,
        saturation,
        value,
    }
}

/// Whether a pixel can be a shaded `colour`.
pub fn matches(colour: Colour, pixel: [u8; 3]) -> bool {
    let (wanted, seen) = (hsv(colour.0), hsv(pixel));
    if wanted.saturation >= SATURATED && wanted.value >= DARK {
        let apart = (wanted.hue - seen.hue).abs();
        seen.value >= DARK
            && seen.saturation >= wanted.saturation * SATURATION_KEPT
            && apart.min(360.0 - apart) <= HUE_WITHIN
    } else {
        let flat = seen.saturation < SATURATED || seen.value < 2.0 * DARK;
        let (darkest, brightest) = (wanted.value * SHADING.start(), wanted.value * SHADING.end());
        flat && darkest - DARK <= seen.value && seen.value <= brightest + DARK
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hue_survives_shading_and_a_grey_has_none() {
        let green = Colour([30, 160, 50]);
        assert!(matches(green, [12, 64, 20]));
        assert!(!matches(green, [200, 30, 30]));
        assert!(!matches(green, [120, 130, 120]));
        let grey = Colour([200, 200, 200]);
        assert!(matches(grey, [120, 120, 122]));
        assert!(!matches(grey, [30, 160, 50]));
        assert!(!matches(grey, [20, 20, 20]));
        assert!(matches(Colour([0, 0, 0]), [10, 12, 9]));
    }

    #[test]
    fn hues_wrap_around_red() {
        assert!(matches(Colour([200, 30, 30]), [150, 20, 30]));
        assert!(matches(Colour([200, 30, 30]), [150, 32, 20]));
        assert!(!matches(Colour([200, 30, 30]), [200, 160, 20]));
    }
}
