//! Colours, opacity, hatches and gradients.

use pdf_writer::types::{ColorSpaceOperand, FunctionShadingType, PaintType, TilingType};
use pdf_writer::{Content, Filter, Name, Rect};
use resvg::tiny_skia::Transform;
use resvg::usvg::{Color, LinearGradient, Paint, Pattern};

use super::writer::{RESOURCES, Writer, matrix, packed, unknown};
use crate::error::PlotError;

impl Writer {
    /// The opacity of what follows.
    pub(super) fn opacity(&mut self, opacity: f32, out: &mut Content) {
        if opacity < 1.0 {
            let name = format!("opacity-{opacity}");
            if let Some(id) = self.add("ExtGState", &name) {
                self.pdf.ext_graphics(id).non_stroking_alpha(opacity).stroking_alpha(opacity);
            }
            out.set_parameters(Name(name.as_bytes()));
        }
    }

    /// The paint of the inside of a path, in a drawing moved by `at`.
    pub(super) fn fill_paint(&mut self, paint: &Paint, at: Transform, out: &mut Content) -> Result<(), PlotError> {
        let name = match paint {
            Paint::Color(colour) => {
                let [r, g, b] = shares(*colour);
                out.set_fill_rgb(r, g, b);
                return Ok(());
            }
            _ if !at.is_identity() => return Err(unknown("a hatch in a moved group")),
            Paint::Pattern(pattern) => self.tile(pattern)?,
            Paint::LinearGradient(gradient) => self.gradient(gradient)?,
            Paint::RadialGradient(_) => return Err(unknown("a radial gradient")),
        };
        out.set_fill_color_space(ColorSpaceOperand::Pattern).set_fill_pattern([], Name(name.as_bytes()));
        Ok(())
    }

    /// The paint of a line.
    pub(super) fn stroke_paint(&mut self, paint: &Paint, out: &mut Content) -> Result<(), PlotError> {
        let Paint::Color(colour) = paint else { return Err(unknown("a line in several colours")) };
        let [r, g, b] = shares(*colour);
        out.set_stroke_rgb(r, g, b);
        Ok(())
    }

    /// The name of a hatch.
    fn tile<'a>(&mut self, pattern: &'a Pattern) -> Result<&'a str, PlotError> {
        if let Some(id) = self.add("Pattern", pattern.id()) {
            let mut content = Content::new();
            self.group(pattern.root(), &mut content)?;
            let (bytes, rect) = (packed(&content.finish()), pattern.rect());
            let mut tile = self.pdf.tiling_pattern(id, &bytes);
            tile.paint_type(PaintType::Colored)
                .tiling_type(TilingType::ConstantSpacing)
                .bbox(Rect::new(rect.left(), rect.top(), rect.right(), rect.bottom()))
                .x_step(rect.width())
                .y_step(rect.height())
                .matrix(matrix(self.to_page.pre_concat(pattern.transform())));
            tile.filter(Filter::FlateDecode).pair(RESOURCES, self.shared);
        }
        Ok(pattern.id())
    }

    /// The name of a gradient with stops at equal distances.
    fn gradient<'a>(&mut self, gradient: &'a LinearGradient) -> Result<&'a str, PlotError> {
        let stops = gradient.stops();
        let steps = i32::try_from(stops.len()).map_err(|_| unknown("a gradient of so many colours"))?;
        let even = |(k, place): (usize, f32)| (f64::from(place) * f64::from(steps - 1) - k as f64).abs() < 1e-3;
        if steps < 2 || !stops.iter().map(|stop| stop.offset().get()).enumerate().all(even) {
            return Err(unknown("a gradient with stops at different distances"));
        }
        if let Some(id) = self.add("Pattern", gradient.id()) {
            let colours: Vec<u8> =
                stops.iter().flat_map(|s| [s.color().red, s.color().green, s.color().blue]).collect();
            let function = self.next.bump();
            let mut sampled = self.pdf.sampled_function(function, &colours);
            sampled.domain([0.0, 1.0]).range([0.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
            sampled.size([steps]).bits_per_sample(8);
            drop(sampled);
            let mut pattern = self.pdf.shading_pattern(id);
            pattern.matrix(matrix(self.to_page.pre_concat(gradient.transform())));
            let mut shading = pattern.function_shading();
            shading.shading_type(FunctionShadingType::Axial).color_space().device_rgb();
            shading.coords([gradient.x1(), gradient.y1(), gradient.x2(), gradient.y2()]);
            shading.function(function).extend([true, true]);
        }
        Ok(gradient.id())
    }
}

/// The shares of red, green and blue, from 0 to 1.
fn shares(colour: Color) -> [f32; 3] {
    [colour.red, colour.green, colour.blue].map(|share| f32::from(share) / 255.0)
}
