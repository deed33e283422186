//! The width of a text: the advance widths of `DejaVu` Sans, read from the font.
//!
//! Kerning is ignored; it would shorten a label by one or two per cent, which the margins allow for.

use std::sync::OnceLock;
use ttf_parser::Face;

/// Width of a character that the font does not have, relative to the font size.
const MISSING: f64 = 0.6;

/// Width of a text in units of the font size.
pub(crate) fn width(text: &str, italic: bool, bold: bool) -> f64 {
    static REGULAR: OnceLock<Option<Face<'_>>> = OnceLock::new();
    static OBLIQUE: OnceLock<Option<Face<'_>>> = OnceLock::new();
    static BOLD: OnceLock<Option<Face<'_>>> = OnceLock::new();
    let parse = |data| Face::parse(data, 0).ok();
    let face = match (italic, bold) {
        (_, true) => BOLD.get_or_init(|| parse(dejavu::sans::bold())),
        (true, false) => OBLIQUE.get_or_init(|| parse(dejavu::sans::oblique())),
        (false, false) => REGULAR.get_or_init(|| parse(dejavu::sans::regular())),
    };
    text.chars().map(|c| face.as_ref().and_then(|face| advance(face, c)).unwrap_or(MISSING)).sum()
}

fn advance(face: &Face<'_>, c: char) -> Option<f64> {
    let units = face.glyph_hor_advance(face.glyph_index(c)?)?;
    Some(f64::from(units) / f64::from(face.units_per_em()))
}

#[cfg(test)]
mod tests {
    use super::width;

    #[test]
    fn known_advances() {
        // DejaVu Sans 2.37: digits are 1303 units of 2048, the space 651
        assert!((width("0123456789", false, false) - 10.0 * 1303.0 / 2048.0).abs() < 1e-12);
        assert!((width(" ", false, false) - 651.0 / 2048.0).abs() < 1e-12);
        assert!(width("N", false, true) > width("N", false, false));
    }

    #[test]
    fn greek_and_signs_exist_in_every_face() {
        for (italic, bold) in [(false, false), (true, false), (false, true)] {
            for c in ["β", "ξ", "δ", "τ", "ε", "−", "∞", "×", "≥", "…", "′"] {
                assert!(width(c, italic, bold) != super::MISSING, "{c}");
            }
        }
        assert_eq!(width("", false, false), 0.0);
        assert!(width("\u{10ffff}", false, false) > 0.0);
    }
}
