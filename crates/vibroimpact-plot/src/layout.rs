//! The positions of all parts of a figure.

use crate::axis::Mapping;
use crate::canvas::Frame;
use crate::colour_bar::PreparedBar;
use crate::figure::Figure;
use crate::legend::Arranged;
use crate::panel::{Margins, Prepared};
use crate::theme;

/// The positions of all parts of a figure.
pub(crate) struct Layout {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) panels: Vec<(Frame, Prepared)>,
    /// Left, top, and the columns of the legend.
    pub(crate) legend: Option<(f64, f64, Arranged)>,
    /// Left, top and bottom of the colour bar, and its ticks.
    pub(crate) colour_bar: Option<(f64, (f64, f64), PreparedBar)>,
}

/// Approximate room below a frame, for the numbers and the label of its axis.
const AXIS: f64 = 80.0;
/// Minimum size of a frame.
const SMALLEST: f64 = 20.0;

impl Layout {
    pub(crate) fn of(figure: &Figure) -> Self {
        let size = |v: f64, usual: f64| {
            if v.is_finite() { v.clamp(50.0, 1e5) } else { usual }
        };
        let (width, height) = (size(figure.width, theme::COLUMN), size(figure.height, 480.0));
        let edge = theme::MARGIN;
        let head = edge + if figure.title.is_some() { 1.5 * theme::TITLE_TEXT } else { 0.0 };
        let legend = figure.legend.as_ref().filter(|l| !l.entries.is_empty() || l.title.is_some());
        let arranged = legend.map(|l| l.arrange(width - 2.0 * edge));
        let bar = figure.colour_bar.as_ref().map(|bar| bar.prepare((height - head - AXIS).max(SMALLEST)));
        let barred = bar.as_ref().map_or(0.0, |bar| bar.width + theme::GAP / 2.0);
        let inner = (width - 2.0 * edge - barred, height - head - edge);
        let panels = frames(figure, (edge, head), inner);
        let (mut outer, mut spot) = (height, None);
        if let Some(a) = arranged {
            outer += a.height + theme::GAP / 2.0;
            spot = Some((((width - a.width) / 2.0).max(edge), height + theme::GAP / 2.0 - edge, a));
        }
        let top = panels.iter().map(|(frame, _)| frame.top).fold(f64::INFINITY, f64::min);
        let bottom = panels.iter().map(|(frame, _)| frame.bottom()).fold(f64::NEG_INFINITY, f64::max);
        let bar = bar.filter(|_| top < bottom);
        let colour_bar = bar.map(|bar| (width - edge - bar.width, (top, bottom), bar));
        Self { width, height: outer, panels, legend: spot, colour_bar }
    }
}

/// Frames of equal size in a grid. Rows and columns have common margins, so that axes are aligned.
fn frames(figure: &Figure, (left, top): (f64, f64), (width, height): (f64, f64)) -> Vec<(Frame, Prepared)> {
    let columns = figure.columns.clamp(1, figure.panels.len().max(1));
    let rows = figure.panels.len().div_ceil(columns);
    let (nx, ny) = (columns as f64, rows as f64);
    // ticks depend on the frame, and the frame on the numbers at the ticks: two rounds are enough
    let mut each = (width / nx - 90.0, height / ny - 70.0);
    let mut prepared = Vec::new();
    let mut across = vec![Margins::default(); columns];
    let mut down = vec![Margins::default(); rows];
    for _ in 0..2 {
        prepared =
            figure.panels.iter().map(|p| p.prepare(each.0.max(SMALLEST), each.1.max(SMALLEST))).collect::<Vec<_>>();
        across.fill(Margins::default());
        down.fill(Margins::default());
        for (i, (panel, ready)) in figure.panels.iter().zip(&prepared).enumerate() {
            let (m, a) = (panel.margins(ready), &mut across[i % columns]);
            (a.left, a.right) = (a.left.max(m.left), a.right.max(m.right));
            let d = &mut down[i / columns];
            (d.top, d.bottom) = (d.top.max(m.top), d.bottom.max(m.bottom));
        }
        let taken_x: f64 = across.iter().map(|m| m.left + m.right).sum::<f64>() + theme::GAP * (nx - 1.0);
        let taken_y: f64 = down.iter().map(|m| m.top + m.bottom).sum::<f64>() + theme::GAP / 2.0 * (ny - 1.0);
        each = (((width - taken_x) / nx).max(SMALLEST), ((height - taken_y) / ny).max(SMALLEST));
    }
    let mut out = Vec::with_capacity(prepared.len());
    for (i, (panel, ready)) in figure.panels.iter().zip(prepared).enumerate() {
        let (column, row) = (i % columns, i / columns);
        let x = left
            + across[..column].iter().map(|m| m.left + m.right + each.0 + theme::GAP).sum::<f64>()
            + across[column].left;
        let y =
            top + down[..row].iter().map(|m| m.top + m.bottom + each.1 + theme::GAP / 2.0).sum::<f64>() + down[row].top;
        let frame = Frame {
            left: x,
            top: y,
            width: each.0,
            height: each.1,
            x: Mapping { scale: panel.x.scale, range: ready.x_range, page: (x, x + each.0) },
            y: Mapping { scale: panel.y.scale, range: ready.y_range, page: (y + each.1, y) },
            clip: format!("clip{i}"),
        };
        out.push((frame, ready));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FigureAxis, Key, Legend, Panel, class_style};

    fn legend(text: &str) -> Legend {
        Legend::below().entry(Key::Patch(class_style("1/1")), text)
    }

    fn panel() -> Panel {
        Panel::new(FigureAxis::new("x"), FigureAxis::new("y"))
    }

    #[test]
    fn a_legend_below_leaves_the_panels_alone() {
        let (without, with) = (Figure::new(panel()), Figure::new(panel()).legend(legend("1/1")));
        assert!(with.outer_size().1 > without.outer_size().1);
        let height = |f: &Figure| Layout::of(f).panels[0].0.height;
        assert_eq!(height(&without), height(&with));
    }

    #[test]
    fn a_legend_may_be_one_line_of_text() {
        let sentence = Legend { title: Some("a sentence".to_owned()), ..Legend::below() };
        let (bare, said) = (Figure::new(panel()), Figure::new(panel()).legend(sentence));
        assert!(said.outer_size().1 > bare.outer_size().1 && said.to_svg().contains("a sentence"));
        assert_eq!(Figure::new(panel()).legend(Legend::below()).outer_size(), bare.outer_size());
    }

    #[test]
    fn a_colour_bar_is_as_high_as_the_frame_and_beside_it() {
        let bar = crate::ColourBar::new(FigureAxis::new("speed (m/s)").range(0.0, 1000.0));
        let layout = Layout::of(&Figure::new(panel()).legend(legend("undecided")).colour_bar(bar));
        let (frame, (left, (top, bottom), bar)) = (&layout.panels[0].0, layout.colour_bar.expect("a bar"));
        assert!(left > frame.right() && left + bar.width <= layout.width);
        assert_eq!((top, bottom), (frame.top, frame.bottom()));
        assert!(layout.legend.is_some_and(|(_, top, _)| top > bottom));
    }

    #[test]
    fn frames_of_a_grid_line_up() {
        let figure = Figure::grid(2, vec![panel(), panel().caption("(b)"), panel()]);
        let frames: Vec<_> = Layout::of(&figure).panels.into_iter().map(|(f, _)| f).collect();
        assert_eq!(frames[0].top, frames[1].top);
        assert_eq!(frames[0].left, frames[2].left);
        assert!(frames.iter().all(|f| f.width == frames[0].width && f.height == frames[0].height));
    }
}
