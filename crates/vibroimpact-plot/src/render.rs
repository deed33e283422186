//! Rendering of SVG text to PNG bytes by `resvg` and to PDF bytes, with `DejaVu` Sans and no other font of the machine.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::error::{MAX_SIDE, PlotError};
use crate::pdf::page;

/// The font faces of labels, loaded once. No label is bold and oblique together.
fn fonts() -> Arc<fontdb::Database> {
    static FONTS: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = fontdb::Database::new();
        for face in [dejavu::sans::regular(), dejavu::sans::oblique(), dejavu::sans::bold()] {
            fonts.load_font_source(fontdb::Source::Binary(Arc::new(face)));
        }
        fonts.set_sans_serif_family("DejaVu Sans");
        Arc::new(fonts)
    };
    Arc::clone(FONTS.get_or_init(load))
}

/// Reads SVG text.
fn tree(svg: &str) -> Result<Tree, PlotError> {
    let options = Options { fontdb: fonts(), font_family: "DejaVu Sans".into(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|e| PlotError::Svg(e.to_string()))
}

/// Draws SVG text on a page of this size in millimetres.
pub(crate) fn pdf(svg: &str, (width, height): (f64, f64)) -> Result<Vec<u8>, PlotError> {
    #[expect(clippy::cast_possible_truncation, reason = "the writer works in f32")]
    let points = |millimetres: f64| (millimetres * 72.0 / 25.4) as f32;
    let size = (points(width), points(height));
    if !(size.0.is_normal() && size.1.is_normal() && width > 0.0 && height > 0.0) {
        return Err(PlotError::PageSize { width, height });
    }
    page(&tree(svg)?, size)
}

/// Draws SVG text with `scale` pixels per unit.
pub(crate) fn png(svg: &str, scale: f64) -> Result<Vec<u8>, PlotError> {
    let tree = tree(svg)?;
    let side = |v: f32| (f64::from(v) * scale).round();
    let (width, height) = (side(tree.size().width()), side(tree.size().height()));
    let refuse = || PlotError::ImageSize { width, height };
    if !(1.0..=MAX_SIDE).contains(&width) || !(1.0..=MAX_SIDE).contains(&height) {
        return Err(refuse());
    }
    #[expect(clippy::cast_possible_truncation, reason = "between 1 and 16384")]
    let mut pixels = Pixmap::new(width as u32, height as u32).ok_or_else(refuse)?;
    // the page is stretched by a fraction of a pixel, so that it fills the last row and column
    #[expect(clippy::cast_possible_truncation, reason = "the renderer works in f32")]
    let zoom = |pixels: f64, units: f32| (pixels / f64::from(units)) as f32;
    let transform = Transform::from_scale(zoom(width, tree.size().width()), zoom(height, tree.size().height()));
    resvg::render(&tree, transform, &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| PlotError::Png(e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_face_draws_ink() -> Result<(), PlotError> {
        for style in ["", " font-style=\"italic\"", " font-weight=\"bold\""] {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"40\">\
                 <text x=\"5\" y=\"30\" font-size=\"30\" font-family=\"DejaVu Sans\"{style}>ξ</text></svg>"
            );
            let picture = Pixmap::decode_png(&png(&svg, 1.0)?).map_err(|e| PlotError::Png(e.to_string()))?;
            assert!(picture.pixels().iter().any(|p| p.alpha() > 200), "{style}");
        }
        Ok(())
    }

    #[test]
    fn a_page_has_its_size() -> Result<(), PlotError> {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"80\" height=\"40\">\
                   <text x=\"5\" y=\"30\" font-size=\"30\" font-family=\"DejaVu Sans\">ξ</text></svg>";
        let page = pdf(svg, (85.0, 42.5))?;
        assert!(page.starts_with(b"%PDF-") && page == pdf(svg, (85.0, 42.5))?);
        let text = String::from_utf8_lossy(&page);
        assert!(text.contains("/MediaBox [0 0 240.9"), "85 mm are 240.94 points");
        assert!(matches!(pdf(svg, (0.0, 1.0)), Err(PlotError::PageSize { .. })));
        Ok(())
    }

    #[test]
    fn bad_svg_is_an_error() {
        assert!(matches!(png("<svg", 1.0), Err(PlotError::Svg(_))));
    }
}
