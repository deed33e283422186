//! The parts around the data of a panel: ticks, numbers, labels, caption.

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::label::{Anchor, Placed};
use crate::markup;
use crate::number::N;
use crate::panel::{Panel, Prepared};
use crate::stroke::Stroke;
use crate::theme;
use crate::ticks::Tick;

impl Panel {
    /// Draws the ticks. They point outwards, so they neither cover data nor disappear in a raster.
    pub(crate) fn draw_ticks(&self, canvas: &mut Canvas, frame: &Frame, prepared: &Prepared) {
        let (left, bottom, size) = (frame.left, frame.bottom(), theme::TICK_TEXT);
        let length = |t: &Tick| {
            if t.label.is_empty() { theme::TICK * 0.55 } else { theme::TICK }
        };
        let (mut d, mut numbers) = (String::new(), String::new());
        for tick in &prepared.x_ticks {
            let x = frame.x.at(tick.value);
            d.push_str(&format!("M{} {}v{}", N(x), N(bottom), N(length(tick))));
            let y = bottom + theme::TICK + theme::TICK_GAP + 0.73 * size;
            if !tick.label.trim().is_empty() {
                numbers.push_str(&Placed::new(&tick.label, x, y, size).anchor(Anchor::Middle).svg());
            }
        }
        for tick in &prepared.y_ticks {
            let y = frame.y.at(tick.value);
            d.push_str(&format!("M{} {}h-{}", N(left), N(y), N(length(tick))));
            let x = left - theme::TICK - theme::TICK_GAP;
            if !tick.label.trim().is_empty() {
                let placed = Placed::new(&tick.label, x, y + 0.365 * size, size);
                numbers.push_str(&placed.anchor(Anchor::End).svg());
            }
        }
        let stroke = Stroke::new(Colour::BLACK).width(theme::FRAME).attributes();
        canvas.push(&format!("<path d=\"{d}\" fill=\"none\"{stroke}/>\n{numbers}"));
    }

    pub(crate) fn draw_labels(&self, canvas: &mut Canvas, frame: &Frame, prepared: &Prepared) {
        let size = theme::LABEL_TEXT;
        let margins = self.margins(prepared);
        let (mid_x, mid_y) = (frame.left + frame.width / 2.0, frame.top + frame.height / 2.0);
        let below = frame.bottom() + margins.bottom - 0.42 * size;
        canvas.push(&Placed::new(&self.x.label, mid_x, below, size).anchor(Anchor::Middle).svg());
        let numbers = prepared.y_ticks.iter().map(|t| markup::width(&t.label, theme::TICK_TEXT));
        let numbers = numbers.fold(0.0, f64::max);
        // a distance of 0.6 of the font size keeps subscripts of the rotated label off the numbers
        let beside = frame.left - theme::TICK - theme::TICK_GAP - numbers - 0.6 * size;
        let upright =
            Placed { upright: true, ..Placed::new(&self.y.label, beside, mid_y, size).anchor(Anchor::Middle) };
        canvas.push(&upright.svg());
        if let Some(caption) = &self.caption {
            let y = frame.top - 0.45 * theme::CAPTION_TEXT;
            canvas.push(&Placed::new(caption, frame.left, y, theme::CAPTION_TEXT).svg());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FigureAxis;
    use crate::canvas::test_frame;

    #[test]
    fn numbers_can_be_left_out_but_not_their_marks() {
        let draw = |x: FigureAxis| {
            let panel = Panel::new(x, FigureAxis::new("")).caption("(a)");
            let mut canvas = Canvas::new("");
            let frame = test_frame((0.0, 1.0), (0.0, 1.0));
            panel.draw_ticks(&mut canvas, &frame, &panel.prepare(100.0, 100.0));
            let count = |what: &str| canvas.body.matches(what).count();
            (count("v7"), count("<text"))
        };
        let (marks, texts) = draw(FigureAxis::new("x"));
        let (bare_marks, bare_texts) = draw(FigureAxis { numbers: false, ..FigureAxis::new("x") });
        assert!(marks >= 2 && texts > bare_texts);
        assert_eq!(marks, bare_marks);
    }
}
