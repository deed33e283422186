//! The nearest events of a motion of any system in each number that varies.

use super::Event;
use crate::figure::named;
use crate::{Units, Varied as _};
use vibroimpact::machine::Machine;
use vibroimpact_plot::plain;
use vibroimpact_study::{MachineMargins, MarginEnd, MotionMargins, NumberEvent, NumberMargin, ParameterMargin};

/// A number, and its nearest events in both directions.
#[derive(Clone, Debug)]
pub struct MarginView<'a> {
    /// Its name in JSON, in tables, in sentences and in figures.
    pub field: &'a str,
    /// See above.
    pub column: &'a str,
    /// See above.
    pub words: String,
    /// See above.
    pub axis: String,
    /// Its value.
    pub value: f64,
    /// The change that counts as 1.
    pub scale: f64,
    /// The nearest event at a smaller value, and at a larger one.
    pub ends: [MarginEndView<'a>; 2],
}

/// One direction.
#[derive(Clone, Debug)]
pub struct MarginEndView<'a> {
    /// `down` or `up`.
    pub direction: &'static str,
    /// The end of the range in which events are looked for.
    pub limit: f64,
    /// The nearest event; `None` if there is none up to the limit.
    pub nearest: Option<NearestView<'a>>,
}

/// The nearest event in one direction.
#[derive(Clone, Debug)]
pub struct NearestView<'a> {
    /// The value of the number at the event.
    pub at: f64,
    /// The change of the number.
    pub distance: f64,
    /// The same relative to the size of the value; `None` for a value 0.
    pub relative: Option<f64>,
    /// The size of the change in units of the scale.
    pub scaled: f64,
    /// The event.
    pub event: Event<'a>,
}

/// The margins of a motion of an oscillator.
#[must_use]
pub fn margins<'a>(found: &'a MotionMargins, units: &Units) -> Vec<MarginView<'a>> {
    found.parameters.iter().map(|margin| MarginView::of_oscillator(margin, units)).collect()
}

/// The margins of a motion of a machine.
#[must_use]
pub fn machine_margins<'a>(found: &'a MachineMargins, machine: &'a Machine) -> Vec<MarginView<'a>> {
    found.numbers.iter().map(|number| MarginView::of_machine(number, machine)).collect()
}

/// The number and the event with the smallest change in units of the scale of its number.
#[must_use]
pub fn nearest<'v, 'a>(
    all: &'v [MarginView<'a>],
) -> Option<(&'v MarginView<'a>, &'v MarginEndView<'a>, &'v NearestView<'a>)> {
    let ends = all.iter().flat_map(|of| of.ends.iter().map(move |end| (of, end)));
    let events = ends.filter_map(|(of, end)| Some((of, end, end.nearest.as_ref()?)));
    events.min_by(|a, b| a.2.scaled.total_cmp(&b.2.scaled))
}

impl<'a> MarginView<'a> {
    fn of_oscillator(margin: &'a ParameterMargin, units: &Units) -> Self {
        let scope = &margin.scope;
        let (parameter, unit) = (scope.parameter, units.of(scope.parameter));
        let nearest = |end: &'a MarginEnd| {
            let point = end.point.as_ref()?;
            let distance = end.distance(scope);
            Some(NearestView {
                at: end.value * unit,
                distance: distance * unit,
                relative: end.relative(scope),
                scaled: distance.abs() / scope.scale,
                event: Event::Oscillator { point, event: point.event? },
            })
        };
        let end = |direction, limit: f64, end| MarginEndView { direction, limit: limit * unit, nearest: nearest(end) };
        Self {
            field: units.name_of(parameter),
            column: units.column_of(parameter),
            words: parameter.words(units),
            axis: named(parameter, units),
            value: scope.value * unit,
            scale: scope.scale * unit,
            ends: [end("down", scope.low, &margin.down), end("up", scope.high, &margin.up)],
        }
    }

    fn of_machine(number: &'a NumberMargin, machine: &'a Machine) -> Self {
        let NumberMargin { path, value, .. } = number;
        let nearest = |NumberEvent { point, after }: &'a NumberEvent| {
            let distance = point.value - value;
            Some(NearestView {
                at: point.value,
                distance,
                relative: (*value != 0.0).then(|| distance / value.abs()),
                scaled: distance.abs() / number.scale(),
                event: Event::Machine { event: point.event?, labels: (point.cycle.label, after.clone()), machine },
            })
        };
        Self {
            field: path,
            column: path,
            words: path.clone(),
            axis: plain(path),
            value: *value,
            scale: number.scale(),
            ends: number.ends().map(|(direction, limit, event)| MarginEndView {
                direction,
                limit,
                nearest: event.and_then(nearest),
            }),
        }
    }
}
