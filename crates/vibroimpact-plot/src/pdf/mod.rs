//! A figure as a page of PDF (ISO 32000-1): curves stay curves, letters become outlines, so the file needs no fonts.
//!
//! The page is written from the tree that `usvg` makes of the SVG text. It has what figures have: paths, clips at the
//! axes, hatches, the gradient of a colour bar, images and text. Anything else is an error. The file has no dates, so
//! equal figures are equal bytes.

mod content;
mod image;
mod paint;
mod writer;

use std::collections::BTreeMap;

use pdf_writer::{Content, Filter, Name, Pdf, Rect, Ref};
use resvg::tiny_skia::Transform;
use resvg::usvg::Tree;

use self::writer::{RESOURCES, Writer, matrix, packed};
use crate::error::PlotError;

/// The page of a tree, with this width and height in points.
pub(crate) fn page(tree: &Tree, (width, height): (f32, f32)) -> Result<Vec<u8>, PlotError> {
    let [catalog, pages, page, drawing, shared, next] = [1, 2, 3, 4, 5, 6].map(Ref::new);
    let (x, y) = (width / tree.size().width(), height / tree.size().height());
    // the origin of a page is its lower left corner
    let to_page = Transform::from_row(x, 0.0, 0.0, -y, 0.0, height);
    let mut writer = Writer { pdf: Pdf::new(), next, shared, to_page, resources: BTreeMap::new() };
    let mut content = Content::new();
    content.transform(matrix(to_page));
    writer.group(tree.root(), &mut content)?;
    let Writer { mut pdf, resources, .. } = writer;
    pdf.stream(drawing, &packed(&content.finish())).filter(Filter::FlateDecode);
    let mut dictionary = pdf.indirect(shared).dict();
    for (kind, members) in &resources {
        let members = members.iter().map(|(name, id)| (Name(name.as_bytes()), *id));
        dictionary.insert(Name(kind.as_bytes())).dict().pairs(members);
    }
    drop(dictionary);
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut sheet = pdf.page(page);
    sheet.parent(pages).media_box(Rect::new(0.0, 0.0, width, height)).contents(drawing);
    sheet.pair(RESOURCES, shared);
    drop(sheet);
    Ok(pdf.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page of a drawing of 80 by 40 units. Its objects are text, their contents are compressed.
    fn drawn(body: &str) -> Result<String, PlotError> {
        let svg = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"80\" height=\"40\">{body}</svg>");
        let tree = Tree::from_str(&svg, &resvg::usvg::Options::default()).map_err(|e| PlotError::Svg(e.to_string()))?;
        Ok(String::from_utf8_lossy(&page(&tree, (40.0, 20.0))?).into_owned())
    }

    #[test]
    fn what_figures_have_is_in_the_file() -> Result<(), PlotError> {
        let rect = "<rect width=\"9\" height=\"9\" fill";
        // two pixels, of which one is transparent
        let image = "<image width=\"9\" height=\"9\" href=\"data:image/png;base64,\
                     iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAADklEQVR42mP4z8AAQg0AD3oDfmqBMeEAAAAASUVORK5CYII=\"/>";
        for (body, parts) in [
            (format!("{rect}-opacity=\"0.5\"/>"), ["/MediaBox [0 0 40 20]", "/ca 0.5"]),
            (
                format!(
                    "<pattern id=\"p\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\">{rect}=\"red\"/></pattern>\
                     {rect}=\"url(#p)\"/>"
                ),
                ["/PatternType 1", "/XStep 8"],
            ),
            (
                format!(
                    "<linearGradient id=\"g\"><stop stop-color=\"red\"/><stop offset=\"1\"/></linearGradient>\
                     {rect}=\"url(#g)\"/>"
                ),
                ["/PatternType 2", "/Size [2]"],
            ),
            (image.to_owned(), ["/Width 2", "/SMask"]),
        ] {
            let file = drawn(&body)?;
            assert!(parts.iter().all(|part| file.contains(part)), "{parts:?}: {file}");
        }
        Ok(())
    }

    #[test]
    fn what_no_figure_has_is_refused() {
        let group = drawn("<g opacity=\"0.5\"><rect width=\"9\" height=\"9\"/></g>");
        assert!(matches!(group, Err(PlotError::Pdf(_))), "{group:?}");
    }
}
