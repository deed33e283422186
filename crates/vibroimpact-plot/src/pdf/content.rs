//! Groups, paths and text as operators of a content stream.

use pdf_writer::Content;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use resvg::tiny_skia::{self, PathSegment, Point};
use resvg::usvg::{Fill, FillRule, Group, LineCap, LineJoin, Node, Path, Stroke};

use super::writer::{Writer, matrix, unknown};
use crate::error::PlotError;

impl Writer {
    /// Draws a group within its clip.
    pub(super) fn group(&mut self, group: &Group, out: &mut Content) -> Result<(), PlotError> {
        if group.mask().is_some() || !group.filters().is_empty() || group.opacity().get() < 1.0 {
            return Err(unknown("a group with a mask, filter or opacity"));
        }
        let clip = group.clip_path();
        if clip.is_some_and(|clip| !clip.root().has_children()) {
            return Ok(());
        }
        out.save_state().transform(matrix(group.transform()));
        if let Some(clip) = clip {
            for node in clip.root().children() {
                let Node::Path(path) = node else { return Err(unknown("a clip that is no path")) };
                outline(path.data(), out);
            }
            out.clip_nonzero().end_path();
        }
        for node in group.children() {
            match node {
                Node::Group(inner) => self.group(inner, out)?,
                Node::Path(path) => self.path(path, out)?,
                Node::Image(image) => self.image(image, out)?,
                Node::Text(text) => self.group(text.flattened(), out)?,
            }
        }
        out.restore_state();
        Ok(())
    }

    fn path(&mut self, path: &Path, out: &mut Content) -> Result<(), PlotError> {
        if let Some(fill) = path.fill() {
            self.fill(path, fill, out)?;
        }
        if let Some(stroke) = path.stroke() {
            self.stroke(path, stroke, out)?;
        }
        Ok(())
    }

    fn fill(&mut self, path: &Path, fill: &Fill, out: &mut Content) -> Result<(), PlotError> {
        out.save_state();
        self.opacity(fill.opacity().get(), out);
        self.fill_paint(fill.paint(), path.abs_transform(), out)?;
        outline(path.data(), out);
        match fill.rule() {
            FillRule::NonZero => out.fill_nonzero(),
            FillRule::EvenOdd => out.fill_even_odd(),
        };
        out.restore_state();
        Ok(())
    }

    fn stroke(&mut self, path: &Path, stroke: &Stroke, out: &mut Content) -> Result<(), PlotError> {
        out.save_state();
        self.opacity(stroke.opacity().get(), out);
        self.stroke_paint(stroke.paint(), out)?;
        out.set_line_width(stroke.width().get());
        out.set_line_cap(match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        out.set_line_join(match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        });
        out.set_miter_limit(stroke.miterlimit().get());
        if let Some(dashes) = stroke.dasharray() {
            out.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        }
        outline(path.data(), out);
        out.stroke().restore_state();
        Ok(())
    }
}

/// The segments of a path. Curves of letters are quadratic, those of PDF are cubic.
fn outline(path: &tiny_skia::Path, out: &mut Content) {
    let mut start = Point::zero();
    for segment in path.segments() {
        let toward = |p: Point, q: Point| Point::from_xy(p.x + (q.x - p.x) / 1.5, p.y + (q.y - p.y) / 1.5);
        let (first, second, end) = match segment {
            PathSegment::MoveTo(end) | PathSegment::LineTo(end) => (end, end, end),
            PathSegment::QuadTo(handle, end) => (toward(start, handle), toward(end, handle), end),
            PathSegment::CubicTo(first, second, end) => (first, second, end),
            PathSegment::Close => {
                out.close_path();
                continue;
            }
        };
        start = end;
        let [a, b, c, d, x, y] = [first.x, first.y, second.x, second.y, end.x, end.y].map(short);
        match segment {
            PathSegment::MoveTo(_) => out.move_to(x, y),
            PathSegment::LineTo(_) => out.line_to(x, y),
            _ => out.cubic_to(a, b, c, d, x, y),
        };
    }
}

/// A coordinate to a hundredth of a figure unit, as in SVG: fewer digits, smaller files.
fn short(coordinate: f32) -> f32 {
    (coordinate * 100.0).round() / 100.0
}
