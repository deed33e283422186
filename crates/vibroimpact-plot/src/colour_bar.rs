//! The colour bar: the values of the colours of a continuous quantity, to the right of the panels.

use crate::axis::{FigureAxis, Mapping};
use crate::canvas::Canvas;
use crate::colour::Colour;
use crate::colour_map::{COLOUR_STEPS, colour_at};
use crate::label::{Anchor, Placed};
use crate::markup;
use crate::number::N;
use crate::stroke::Stroke;
use crate::theme;
use crate::ticks::Tick;
use serde::Serialize;

/// A colour bar beside the panels, as high as the panels.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourBar {
    /// Its label, range, scale and ticks. A range that is not given, or empty, is widened as for other axes.
    pub axis: FigureAxis,
}

/// Width of the bar itself.
const WIDTH: f64 = 24.0;
/// Distance between the lines of a label.
const LINE: f64 = 1.25;

impl ColourBar {
    /// A bar with this axis.
    #[must_use]
    pub const fn new(axis: FigureAxis) -> Self {
        Self { axis }
    }

    /// The number of the colour of a value, from 0 to [`COLOUR_STEPS`] - 1. Values outside the range have the colours of
    /// its ends.
    #[must_use]
    pub fn step(&self, value: f64) -> usize {
        let mapping = Mapping { scale: self.axis.scale, range: self.axis.resolve(None), page: (0.0, 1.0) };
        let place = mapping.at(value);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and the number of colours"
        )]
        let step = (place.clamp(0.0, 1.0) * COLOUR_STEPS as f64) as usize;
        step.min(COLOUR_STEPS - 1)
    }

    /// The colours, for the numbers of [`Self::step`].
    #[must_use]
    pub fn palette() -> Vec<Colour> {
        (0..COLOUR_STEPS).map(|k| colour_at(k as f64 / (COLOUR_STEPS - 1) as f64)).collect()
    }

    /// Ticks and label for panels of approximately this height.
    pub(crate) fn prepare(&self, height: f64) -> PreparedBar {
        let range = self.axis.resolve(None);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 2 and 10")]
        let ticks = self.axis.resolve_ticks(range, (height / 48.0).clamp(2.0, 10.0) as usize);
        let numbers = ticks.iter().map(|tick| markup::width(&tick.label, theme::TICK_TEXT)).fold(0.0, f64::max);
        let lines = lines(&self.axis.label, height);
        let label = theme::LABEL_TEXT * (LINE * lines.len() as f64 + 0.4);
        let width = WIDTH + theme::TICK + theme::TICK_GAP + numbers + if lines.is_empty() { 0.0 } else { label };
        PreparedBar { range, ticks, numbers, lines, width }
    }

    /// Draws the bar between two heights of the page.
    pub(crate) fn draw(&self, canvas: &mut Canvas, left: f64, (top, bottom): (f64, f64), prepared: &PreparedBar) {
        let (x, y, width, height) = (N(left), N(top), N(WIDTH), N(bottom - top));
        let fill = canvas.gradient();
        let edge = Stroke::new(Colour::BLACK).width(theme::FRAME).attributes();
        canvas.push(&format!(
            "<g>\n<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"/>\n\
             <rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"none\"{edge}/>\n"
        ));
        let mapping = Mapping { scale: self.axis.scale, range: prepared.range, page: (bottom, top) };
        let (right, size) = (left + WIDTH, theme::TICK_TEXT);
        let (mut d, mut numbers) = (String::new(), String::new());
        for tick in &prepared.ticks {
            let y = mapping.at(tick.value);
            let length = if tick.label.is_empty() { theme::TICK * 0.55 } else { theme::TICK };
            d.push_str(&format!("M{} {}h{}", N(right), N(y), N(length)));
            let x = right + theme::TICK + theme::TICK_GAP;
            numbers.push_str(&Placed::new(&tick.label, x, y + 0.365 * size, size).svg());
        }
        canvas.push(&format!("<path d=\"{d}\" fill=\"none\"{edge}/>\n{numbers}"));
        let (mut x, size) = (right + theme::TICK + theme::TICK_GAP + prepared.numbers, theme::LABEL_TEXT);
        for line in &prepared.lines {
            x += LINE * size;
            let placed = Placed::new(line, x, f64::midpoint(top, bottom), size).anchor(Anchor::Middle);
            canvas.push(&Placed { upright: true, ..placed }.svg());
        }
        canvas.push("</g>\n");
    }
}

/// A label in as few lines as are needed to be no longer than the bar, of similar lengths.
fn lines(label: &str, height: f64) -> Vec<String> {
    let fewest = wrapped(label, height);
    let shorter = (10..20).map(|k| wrapped(label, height * f64::from(k) / 20.0));
    shorter.into_iter().find(|lines| lines.len() <= fewest.len()).unwrap_or(fewest)
}

/// A label in lines that are not longer than a length, unless a word is.
fn wrapped(label: &str, height: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in label.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if markup::width(&format!("{line} {word}"), theme::LABEL_TEXT) <= height => {
                *line = format!("{line} {word}");
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The ticks, the lines of the label, and the total width of a colour bar.
#[derive(Clone, Debug)]
pub(crate) struct PreparedBar {
    range: (f64, f64),
    ticks: Vec<Tick>,
    numbers: f64,
    lines: Vec<String>,
    pub(crate) width: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_colours_of_their_places() {
        let bar = ColourBar::new(FigureAxis::new("").range(2.0, 4.0));
        assert_eq!([2.0, 3.0, 4.0, -9.0, 99.0].map(|v| bar.step(v)), [0, 128, 255, 0, 255]);
        assert_eq!(ColourBar::palette().len(), COLOUR_STEPS);
        let one = ColourBar::new(FigureAxis::new("").range(0.3, 0.3));
        assert_eq!(one.step(0.3), 128, "a single value is in the middle");
        let log = ColourBar::new(FigureAxis::new("").range(0.01, 1.0).log10());
        assert_eq!([0.1, 0.0].map(|v| log.step(v)), [128, 0]);
    }

    #[test]
    fn long_labels_have_several_lines() {
        let bar = ColourBar::new(FigureAxis::new("energy lost in the damper per forcing period (J)").range(0.0, 1.0));
        let (wide, narrow) = (bar.prepare(700.0), bar.prepare(400.0));
        assert_eq!((wide.lines.len(), narrow.lines.len()), (1, 2));
        assert_eq!(narrow.lines[0], "energy lost in the damper");
        assert!(narrow.width > wide.width + 20.0);
        assert_eq!(ColourBar::new(FigureAxis::new("")).prepare(400.0).lines.len(), 0);
    }
}
