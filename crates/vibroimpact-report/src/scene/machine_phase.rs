//! The phase portrait of a motion of a machine: the velocity of each coordinate over its displacement.

use crate::ReportError;
use crate::table::waveform::samples;
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact_plot::{COLUMN, Dash, Figure, FigureAxis, Legend, Line, Panel, SERIES, plain};

/// Number of equal steps.
const STEPS: f64 = 4000.0;
/// Maximum number of coordinates with a panel each.
const PLANES: usize = 6;
/// Maximum number of panels beside each other.
const COLUMNS: usize = 3;
/// Height of a panel.
const HEIGHT: f64 = 380.0;

/// Draws the motion from a state over a time. Jumps of a velocity at impacts are dashed.
///
/// # Errors
/// [`ReportError`] for an invalid start.
pub(crate) fn portrait(machine: &Machine, (start, time): (&Start, f64), title: String) -> Result<Figure, ReportError> {
    let wave: Vec<_> = samples(machine, start, (time, time / STEPS))?.collect();
    let names = &machine.parts().coordinates;
    let shown = names.len().min(PLANES);
    let mut jumped = false;
    let panels: Vec<Panel> = (0..shown)
        .map(|i| {
            let (mut curve, mut jumps) = ((Vec::new(), Vec::new()), (Vec::new(), Vec::new()));
            for (k, at) in wave.iter().enumerate() {
                let before = k.checked_sub(1).map(|k| &wave[k]);
                if let Some(before) = before.filter(|of| of.time == at.time && of.qdot[i] != at.qdot[i]) {
                    jumps.0.extend([at.q[i], at.q[i], f64::NAN]);
                    jumps.1.extend([before.qdot[i], at.qdot[i], f64::NAN]);
                    curve.0.push(f64::NAN);
                    curve.1.push(f64::NAN);
                }
                curve.0.push(at.q[i]);
                curve.1.push(at.qdot[i]);
            }
            let name = plain(&names[i]);
            let axes = (FigureAxis::new(format!("q.{name}")), FigureAxis::new(format!("qdot.{name}")));
            let mut panel = Panel::new(axes.0, axes.1).with(Line::new(curve.0, curve.1, SERIES[0]).width(1.6));
            if !jumps.0.is_empty() {
                jumped = true;
                panel.add(Line::new(jumps.0, jumps.1, SERIES[1]).width(1.6).dash(Dash::Dashed));
            }
            panel
        })
        .collect();
    let columns = panels.len().min(COLUMNS);
    let title =
        if names.len() > shown { format!("{title}: the first {shown} of {} coordinates", names.len()) } else { title };
    #[allow(clippy::cast_precision_loss)] // a few panels
    let (width, height) = (COLUMN * columns as f64, HEIGHT * panels.len().div_ceil(columns) as f64);
    let key = |colour| Line::new(Vec::new(), Vec::new(), colour).width(1.6);
    let legend = Legend::below().line(key(SERIES[0]).stroke, "motion");
    let jump = key(SERIES[1]).dash(Dash::Dashed);
    let legend = if jumped { legend.line(jump.stroke, "impact") } else { legend };
    Ok(Figure::grid(columns, panels).size(width, height).title(title).legend(legend))
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};
    use vibroimpact_plot::Mark;
    use vibroimpact_study::machine::MachineSource;

    /// One panel for each coordinate, and a jump for each impact in that of the head, which ends at -e times the velocity.
    #[test]
    fn impacts_are_jumps() {
        let source = MachineSource::of_catalogue("two-mass-hammer").unwrap().with("omega", 1.06).unwrap();
        let machine = source.machine().unwrap();
        let found = settle_machine(&machine, &Start::default(), &SettleOptions::default()).unwrap();
        let Verdict::Periodic(cycle) = &found.verdict else { panic!("{}", found.verdict.label()) };
        let figure = portrait(&machine, (&cycle.state, cycle.period), "hammer".into()).unwrap();
        assert_eq!(figure.panels.len(), 2);
        let lines: Vec<&Line> = figure.panels[1]
            .marks
            .iter()
            .filter_map(|mark| if let Mark::Line(line) = mark { Some(line) } else { None })
            .collect();
        assert_eq!(lines.len(), 2);
        let ends: Vec<f64> = lines[1].ys.iter().copied().filter(|y| y.is_finite()).collect();
        assert_eq!(ends.len(), 2 * cycle.events.len());
        let closed = (lines[0].xs.iter().rev().find(|x| x.is_finite()).unwrap() - lines[0].xs[0]).abs();
        assert!(closed < 1e-9, "{closed}");
    }
}
