//! The resolution of a PNG image, as the chunk `pHYs` of the PNG specification (W3C, third edition, 11.3.4.3).

/// Length of the signature and the chunk `IHDR`, after which the chunk may stand.
const HEAD: usize = 8 + 4 + 4 + 13 + 4;

/// The image with its resolution in pixels in an inch.
pub(crate) fn with(png: &[u8], dpi: f64) -> Vec<u8> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast limits to 32 bits")]
    let per_metre = (dpi / 0.0254).round() as u32;
    let mut chunk = b"pHYs".to_vec();
    chunk.extend(per_metre.to_be_bytes());
    chunk.extend(per_metre.to_be_bytes());
    // the unit is the metre
    chunk.push(1);
    let Some((head, rest)) = png.split_at_checked(HEAD) else { return png.to_vec() };
    let mut out = head.to_vec();
    out.extend(9_u32.to_be_bytes());
    out.extend(&chunk);
    out.extend(crc32fast::hash(&chunk).to_be_bytes());
    out.extend(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use resvg::tiny_skia::Pixmap;

    #[test]
    fn the_image_stays_readable() {
        let png = Pixmap::new(3, 2).and_then(|image| image.encode_png().ok()).unwrap_or_default();
        let print = with(&png, 300.0);
        let at = HEAD + 8;
        assert_eq!(print[at..at + 4], 11_811_u32.to_be_bytes());
        assert!(Pixmap::decode_png(&print).is_ok_and(|image| image.width() == 3));
        assert_eq!(with(b"short", 300.0), b"short");
    }
}
