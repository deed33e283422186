//! The width of a text: the advance widths of `DejaVu` Sans, read from the font.
//!
//! Only three tables of the TrueType file are needed (OpenType 1.9: `cmap` format 4, `hhea`, `hmtx`). Kerning is
//! ignored; it would shorten a label by one or two per cent, which the margins allow for.

use std::sync::OnceLock;

/// Width of a character that the font does not have, relative to the font size.
const MISSING: f64 = 0.6;

/// Width of a text in units of the font size.
pub(crate) fn width(text: &str, italic: bool, bold: bool) -> f64 {
    static REGULAR: OnceLock<Option<Face>> = OnceLock::new();
    static OBLIQUE: OnceLock<Option<Face>> = OnceLock::new();
    static BOLD: OnceLock<Option<Face>> = OnceLock::new();
    let face = match (italic, bold) {
        (_, true) => BOLD.get_or_init(|| Face::parse(dejavu::sans::bold())),
        (true, false) => OBLIQUE.get_or_init(|| Face::parse(dejavu::sans::oblique())),
        (false, false) => REGULAR.get_or_init(|| Face::parse(dejavu::sans::regular())),
    };
    text.chars().map(|c| face.as_ref().and_then(|f| f.advance(c)).unwrap_or(MISSING)).sum()
}

/// A font file and the positions of its tables.
struct Face {
    data: &'static [u8],
    /// Start of the format 4 subtable of `cmap`.
    map: usize,
    hmtx: usize,
    /// Number of full entries in `hmtx`; later glyphs repeat the last.
    long: usize,
    units_per_em: f64,
}

impl Face {
    fn parse(data: &'static [u8]) -> Option<Self> {
        let table = |tag: &[u8; 4]| {
            (0..u16_at(data, 4)?)
                .map(|i| 12 + 16 * i)
                .find(|&at| data.get(at..at + 4) == Some(tag.as_slice()))
                .and_then(|at| u32_at(data, at + 8))
        };
        let cmap = table(b"cmap")?;
        let map = (0..u16_at(data, cmap + 2)?)
            .filter_map(|i| Some(cmap + u32_at(data, cmap + 8 + 8 * i)?))
            .find(|&at| u16_at(data, at) == Some(4))?;
        let units = u32::try_from(u16_at(data, table(b"head")? + 18)?).ok()?;
        Some(Self {
            data,
            map,
            hmtx: table(b"hmtx")?,
            long: u16_at(data, table(b"hhea")? + 34)?,
            units_per_em: f64::from(units),
        })
    }

    fn glyph(&self, c: char) -> Option<usize> {
        let c = usize::try_from(u32::from(c)).ok()?;
        let at = |offset: usize| u16_at(self.data, self.map + offset);
        let double_count = at(6)?;
        let (ends, starts) = (14, 16 + double_count);
        let (deltas, ranges) = (starts + double_count, starts + 2 * double_count);
        let k = (0..double_count / 2).find(|k| at(ends + 2 * k).is_some_and(|end| end >= c))?;
        let start = at(starts + 2 * k)?;
        if start > c {
            return None;
        }
        let (delta, range) = (at(deltas + 2 * k)?, at(ranges + 2 * k)?);
        let glyph = if range == 0 {
            (c + delta) & 0xffff
        } else {
            match at(ranges + 2 * k + range + 2 * (c - start))? {
                0 => 0,
                glyph => (glyph + delta) & 0xffff,
            }
        };
        (glyph != 0).then_some(glyph)
    }

    fn advance(&self, c: char) -> Option<f64> {
        let entry = self.glyph(c)?.min(self.long.checked_sub(1)?);
        let units = u32::try_from(u16_at(self.data, self.hmtx + 4 * entry)?).ok()?;
        Some(f64::from(units) / self.units_per_em)
    }
}

fn u16_at(data: &[u8], at: usize) -> Option<usize> {
    let bytes = data.get(at..at + 2)?.try_into().ok()?;
    Some(usize::from(u16::from_be_bytes(bytes)))
}

fn u32_at(data: &[u8], at: usize) -> Option<usize> {
    let bytes = data.get(at..at + 4)?.try_into().ok()?;
    usize::try_from(u32::from_be_bytes(bytes)).ok()
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
