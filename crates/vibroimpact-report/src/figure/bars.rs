//! Figures of bars: the shares of the starts that lead to each motion, and the change of each number to the nearest events.

use crate::figure::label;
use crate::figure::styles::EVENT_COLOURS;
use crate::json::event::Stops;
use crate::number::short;
use crate::task::margins::ParameterObject;
use crate::varied::Varied;
use crate::{ReportError, Units};
use vibroimpact::verdict::System;
use vibroimpact_plot::{
    Anchor, ClassStyle, Colour, Dash, Figure, FigureAxis, Hatch, Legend, Panel, Pattern, Rect, Rects, SERIES, Stroke,
    Text, Tick, VLine, class_style,
};
use vibroimpact_study::{MotionMargins, Solution};

/// Half the thickness of a bar.
const HALF: f64 = 0.3;
/// Height of a row, and of all else.
const ROW: f64 = 34.0;
const FRAME: f64 = 150.0;
/// The first colour of events without one of their own: those before are of the most frequent events.
const OTHERS: usize = 3;
/// The look of a range without an event.
const NONE: ClassStyle =
    ClassStyle { colour: Colour::hex(0xee_eeee), hatch: Some(Hatch::new(Pattern::Rising, Colour::hex(0x99_9999))) };

/// The vertical axis of rows with these names, the first on top.
fn rows(names: impl ExactSizeIterator<Item = String>) -> (FigureAxis, f64) {
    let count = names.len() as f64;
    let ticks = names.enumerate().map(|(k, name)| Tick::new(k as f64, name));
    (FigureAxis::new("").range(count - 0.5, -0.5).ticks(ticks), FRAME + ROW * count)
}

/// The shares, from 0 to 1, of the starts that lead to motions with these labels.
#[must_use]
pub fn shares(found: &[(String, f64)], title: String) -> Figure {
    let (axis, height) = rows(found.iter().map(|(name, _)| label(name)));
    let mut bars = Rects::new(found.iter().map(|(name, _)| class_style(name)).collect::<Vec<_>>());
    for (class, (_, share)) in found.iter().enumerate() {
        let y = class as f64;
        bars.rects.push(Rect { x: (0.0, 100.0 * share), y: (y - HALF, y + HALF), class });
    }
    let panel = Panel::new(FigureAxis::new("share of starts (%)").range(0.0, 100.0), axis).with(bars);
    Figure::new(panel).size(620.0, height).title(title)
}

/// The change of each number to its nearest events, in units of its scale, and the size of the box in which the motion was found.
pub(crate) fn margins<S: System + Stops, V: Varied, P: Solution<System = S>>(
    found: &MotionMargins<S, V, P>,
    (system, units): (&S, &Units),
    title: String,
) -> Result<Figure, ReportError> {
    if found.parameters.is_empty() {
        return Err(ReportError::NoMargins(label(&found.motion.label())));
    }
    let all = found.parameters.iter();
    let parameters: Vec<(String, ParameterObject<'_>)> =
        all.map(|of| (of.scope.parameter.axis(units), ParameterObject::new(of, system, units))).collect();
    let found_box = found.motion_box.as_ref().map(|found| found.size);
    let (axis, height) = rows(parameters.iter().map(|(name, of)| format!("{name} = {}", short(of.value))));
    let mut kinds: Vec<&str> = Vec::new();
    let mut bars = Rects::new(Vec::new());
    let mut texts = Vec::new();
    for (k, (_, of)) in parameters.iter().enumerate() {
        for end in [&of.down, &of.up] {
            let kind = end.event.as_ref().map_or("no event", |event| event.kind);
            let class = kinds.iter().position(|known| *known == kind).unwrap_or_else(|| {
                kinds.push(kind);
                kinds.len() - 1
            });
            let (y, change) = (k as f64, (end.at.unwrap_or(end.limit) - of.value) / of.scale);
            bars.rects.push(Rect { x: (change.min(0.0), change.max(0.0)), y: (y - HALF, y + HALF), class });
            if let Some(at) = end.at {
                let (anchor, dx) = if change < 0.0 { (Anchor::End, -4.0) } else { (Anchor::Start, 4.0) };
                texts.push(Text::new(change, y, short(at)).anchor(anchor).shift(dx, 4.0));
            }
        }
    }
    let known = |kind: &str| EVENT_COLOURS.iter().find(|(event, _)| event.name() == kind).map(|(_, colour)| *colour);
    // other events have colours that no event in the figure has
    let taken: Vec<Colour> = kinds.iter().filter_map(|kind| known(kind)).collect();
    let mut others = SERIES[OTHERS..].iter().filter(|colour| !taken.contains(colour)).cycle();
    let style = |kind: &&str| match *kind {
        "no event" => NONE,
        kind => {
            let colour = known(kind).or_else(|| others.next().copied()).unwrap_or(Colour::BLACK);
            ClassStyle { colour, hatch: None }
        }
    };
    bars.styles = kinds.iter().map(style).collect();
    let mut legend = Legend::below();
    for (kind, style) in kinds.iter().zip(&bars.styles) {
        legend = legend.patch(*style, *kind);
    }
    // room for the values at the ends of bars
    let widest = bars.rects.iter().fold(1e-3_f64, |most, bar| most.max(bar.x.1).max(-bar.x.0)) * 1.5;
    let usual = parameters.iter().all(|(_, of)| of.scale == of.value.abs());
    let name = if usual { "change relative to the value" } else { "change in units of the scale" };
    let mut panel = Panel::new(FigureAxis::new(name).range(-widest, widest), axis).with(bars);
    panel.add(VLine { x: 0.0, stroke: Stroke::new(Colour::BLACK) });
    if let Some(size) = found_box {
        let stroke = Stroke::new(Colour::BLACK).dash(Dash::Dashed);
        for x in [-size, size] {
            panel.add(VLine { x, stroke });
        }
        legend = legend.line(stroke, "box");
    }
    texts.into_iter().for_each(|text| panel.add(text));
    Ok(Figure::new(panel).size(680.0, height).title(title).legend(legend))
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_plot::Mark;

    #[test]
    fn bars_have_the_lengths_of_their_shares() {
        let figure = shares(&[("2/1".to_owned(), 0.75), ("chaotic".to_owned(), 0.25)], String::new());
        let Mark::Rects(bars) = &figure.panels[0].marks[0] else { panic!("bars") };
        assert_eq!(bars.rects.iter().map(|bar| bar.x).collect::<Vec<_>>(), [(0.0, 75.0), (0.0, 25.0)]);
        assert_eq!(bars.styles, [class_style("2/1"), class_style("chaotic")]);
    }
}
