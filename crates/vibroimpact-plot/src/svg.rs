//! The layout of a figure, and its output as SVG, PNG or PDF.

use crate::canvas::Canvas;
use crate::error::PlotError;
use crate::figure::Figure;
use crate::label::{Anchor, Placed};
use crate::layout::Layout;
use crate::markup;
use crate::number::N;
use crate::theme::UNITS_PER_MM;
use crate::{grey, render, resolution, theme};

impl Figure {
    /// Width and height including the legend, in figure units: the number of PNG pixels at scale 1.
    pub(crate) fn outer_size(&self) -> (f64, f64) {
        let layout = Layout::of(self);
        (layout.width, layout.height)
    }

    /// Width and height of the smallest frame, in figure units; `None` without panels.
    pub(crate) fn smallest_frame(&self) -> Option<(f64, f64)> {
        let layout = Layout::of(self);
        let frames = layout.panels.iter().map(|(frame, _)| (frame.width, frame.height));
        frames.reduce(|a, b| (a.0.min(b.0), a.1.min(b.1)))
    }

    /// The figure as SVG text. Values that cannot be shown are left out, so this never fails.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let layout = Layout::of(self);
        let prefix: String = self.id.chars().filter(|c| c.is_ascii_alphanumeric() || "-_".contains(*c)).collect();
        let mut canvas = Canvas::new(&prefix);
        canvas.grey = self.grey;
        if let Some(title) = &self.title {
            let y = theme::MARGIN + theme::TITLE_TEXT;
            let placed = Placed::new(title, layout.width / 2.0, y, theme::TITLE_TEXT);
            canvas.push(&placed.anchor(Anchor::Middle).svg());
        }
        for (panel, (frame, prepared)) in self.panels.iter().zip(&layout.panels) {
            panel.draw(&mut canvas, frame, prepared);
        }
        if let (Some(legend), Some((left, top, arranged))) = (&self.legend, &layout.legend) {
            legend.draw(&mut canvas, *left, *top, arranged);
        }
        if let (Some(bar), Some((left, ends, prepared))) = (&self.colour_bar, &layout.colour_bar) {
            bar.draw(&mut canvas, *left, *ends, prepared);
        }
        let (w, h) = (N(layout.width), N(layout.height));
        let size = |units: f64| match (self.millimetres, N(units / UNITS_PER_MM)) {
            (true, millimetres) => format!("{millimetres}mm"),
            (false, _) => N(units).to_string(),
        };
        let (width, height) = (size(layout.width), size(layout.height));
        let title = self
            .title
            .as_ref()
            .map_or(String::new(), |t| format!("<title>{}</title>\n", markup::escape(&markup::strip(t))));
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"'DejaVu Sans', Verdana, sans-serif\">\n{title}<defs>\n{}</defs>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            canvas.definitions(),
            canvas.body
        );
        if self.grey { grey::greyed(&svg) } else { svg }
    }

    /// The figure as a PNG image with `scale` pixels per figure unit; [`DPI_300`](crate::DPI_300) is suitable for
    /// print.
    ///
    /// # Errors
    /// If the image would have no pixels, or more than 16384 on a side.
    pub fn to_png(&self, scale: f64) -> Result<Vec<u8>, PlotError> {
        let pixels = Self { millimetres: false, ..self.clone() };
        render::png(&pixels.to_svg(), scale)
    }

    /// The figure as a PDF page of its size on paper, with curves as curves and letters as their outlines.
    ///
    /// # Errors
    /// [`PlotError::PageSize`] for a size that no page can have.
    pub fn to_pdf(&self) -> Result<Vec<u8>, PlotError> {
        let units = Self { millimetres: false, ..self.clone() };
        let (width, height) = self.outer_size();
        render::pdf(&units.to_svg(), (width / UNITS_PER_MM, height / UNITS_PER_MM))
    }

    /// The figure as a PNG image for paper, with its resolution in pixels in an inch written into the file, so that programs
    /// place it at its size.
    ///
    /// # Errors
    /// As [`Self::to_png`].
    pub fn to_print(&self, dpi: f64) -> Result<Vec<u8>, PlotError> {
        Ok(resolution::with(&self.to_png(dpi / 25.4 / UNITS_PER_MM)?, dpi))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legend::Legend;
    use crate::mark::guide::{HLine, TextSide, Wall};
    use crate::panel::Panel;
    use crate::{Colour, FigureAxis, FilledRegion, Key, Line, Points, Raster, Rects, Stroke, Text, class_style};

    fn every_mark(xs: &[f64], ys: &[f64]) -> Panel {
        let (a, b) = (xs.first().copied().unwrap_or(0.0), ys.last().copied().unwrap_or(1.0));
        let mut cells = Rects::new([class_style("undecided")]);
        cells.cell((a, b), (b, a), &[0]);
        let ring: Vec<_> = xs.iter().copied().zip(ys.iter().copied()).collect();
        let mut panel = Panel::new(FigureAxis::new("1/*β* <&>"), FigureAxis::new("*ξ*_0"))
            .caption("(a)")
            .with(cells)
            .with(FilledRegion::polygon(ring).fill(Colour::BLACK.alpha(0.3)))
            .with(Line::new(xs, ys, Colour::BLACK))
            .with(Points::new(xs, ys, Colour::BLACK))
            .with(Text::new(a, b, "here"))
            .with(HLine::new(b, Stroke::new(Colour::BLACK)))
            .with(Wall::new(a, TextSide::Right));
        let raster = Raster::new((a, b), (a, b), (2, 2), [0, 1, 2, 3], [Colour::BLACK; 2]);
        if let Ok(raster) = raster {
            panel.add(raster);
        }
        panel
    }

    #[test]
    fn the_same_figure_is_the_same_bytes() -> Result<(), PlotError> {
        let make = || Figure::new(every_mark(&[0.0, 1.0, 0.5], &[0.0, 0.3, 1.0])).title("T");
        assert_eq!(make().to_svg(), make().to_svg());
        assert_eq!(make().to_png(0.5)?, make().to_png(0.5)?);
        assert_eq!(make().to_pdf()?, make().to_pdf()?);
        Ok(())
    }

    #[test]
    fn a_png_has_its_size_and_is_not_blank() -> Result<(), PlotError> {
        let legend = Legend::below().entry(Key::Patch(class_style("inf/1")), "∞");
        let figure = Figure::new(every_mark(&[0.0, 1.0, 0.5], &[0.0, 0.3, 1.0])).legend(legend);
        let png = figure.to_png(1.0)?;
        let picture = resvg::tiny_skia::Pixmap::decode_png(&png).map_err(|e| PlotError::Png(e.to_string()))?;
        let (w, h) = figure.outer_size();
        assert_eq!((f64::from(picture.width()), f64::from(picture.height())), (w.round(), h.round()));
        let dark = picture.pixels().iter().filter(|p| p.red() < 64).count();
        assert!(dark > 1000 && dark < picture.pixels().len() / 2, "{dark} dark pixels");
        Ok(())
    }

    #[test]
    fn whatever_is_given_becomes_a_picture() -> Result<(), PlotError> {
        let strange: [&[f64]; 6] =
            [&[], &[1.0], &[f64::NAN; 3], &[0.0; 4], &[-1e308, 1e308, f64::INFINITY], &[5e-324, -3.0, 2.0]];
        for xs in strange {
            for ys in strange {
                let plain = every_mark(xs, ys);
                let mut log = plain.clone();
                (log.x, log.y) = (log.x.log10(), log.y.log10());
                let figure = Figure::grid(2, vec![plain, log]).size(300.0, f64::NAN);
                let svg = figure.to_svg();
                assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{svg}");
                figure.to_png(0.3)?;
            }
        }
        Figure::grid(3, vec![]).to_png(0.1)?;
        Ok(())
    }

    #[test]
    fn impossible_sizes_are_refused() {
        let figure = Figure::new(every_mark(&[], &[]));
        for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
            assert!(matches!(figure.to_png(scale), Err(PlotError::ImageSize { .. })), "{scale}");
        }
    }

    #[test]
    fn text_is_escaped_and_ids_are_prefixed() {
        let figure = Figure::new(every_mark(&[0.0, 1.0], &[0.0, 1.0])).title("a < b");
        let figure = Figure { id: "fig7-\"><x".to_owned(), ..figure };
        let svg = figure.to_svg();
        assert!(svg.contains("<title>a &lt; b</title>") && svg.contains(" &lt;&amp;&gt;"));
        assert!(svg.contains("id=\"fig7-x") && !svg.contains("id=\"clip") && !svg.contains("<x"));
    }
}
