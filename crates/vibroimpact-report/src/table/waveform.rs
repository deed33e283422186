//! A motion over time: one row for each point.

use super::Table;
use crate::figure;
use crate::json;
use crate::number::Number;
use crate::{ReportError, Units};
use serde_json::Value;
use vibroimpact::events;
use vibroimpact::events::{EventKind, Motion, Samples};
use vibroimpact::machine::{Machine, MachineError, Opening, StopLaw};
use vibroimpact::motion::sample;
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, QuantityKind, Start};
use vibroimpact_study::machine::contact_word;
use vibroimpact_study::{PlanError, motion_limits};

/// Maximum number of points at equal steps.
const MOST_POINTS: f64 = 1e7;

/// Refuses more points.
fn few_enough(until: f64, step: f64) -> Result<(), ReportError> {
    if until / step > MOST_POINTS || until.is_nan() {
        return Err(ReportError::Points { step, until, most: MOST_POINTS });
    }
    Ok(())
}

/// The table of `vibro simulate`: the motion from a start until a time, at equal steps and at its events.
pub(crate) fn table(
    osc: &Oscillator,
    start: Start,
    (until, step): (f64, f64),
    units: Units,
) -> Result<Table<'static>, ReportError> {
    few_enough(until, step)?;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 1e7
    let wave = sample(osc, start, until, step, 3 * MOST_POINTS as usize);
    let rows = wave.into_iter().map(move |point| {
        format!(
            "{},{},{},{}",
            Number(point.time * units.time()),
            Number(point.x * units.length()),
            Number(point.v * units.velocity()),
            Number(point.phase)
        )
    });
    let time = if units.si { "time_s" } else { "time" };
    let (x, v) = (units.column("x", QuantityKind::Length), units.column("v", QuantityKind::Velocity));
    Ok(Table::new(format!("{time},{x},{v},phase"), rows))
}

/// The table of `vibro settle`: the settled motion, from its last event before it was recognised, for the duration
/// shown in the figure.
pub(crate) fn steady(
    osc: &Oscillator,
    start: Start,
    settled: &Settled,
    units: Units,
) -> Result<Table<'static>, ReportError> {
    let (from, (_, shown)) = figure::waveform::steady(osc, start, settled);
    table(osc, from, (shown, osc.period() / 100.0), units)
}

/// The samples of a motion until a time, at equal steps, at its events and at the end.
pub(crate) fn samples<'a>(
    machine: &'a Machine,
    start: &events::Start,
    (until, step): (f64, f64),
) -> Result<Samples<'a>, ReportError> {
    few_enough(until, step)?;
    let step = if step > 0.0 { step } else { 1.0 };
    Samples::new(machine, start, motion_limits(machine, until), (until, step)).map_err(refused)
}

fn refused(error: MachineError) -> ReportError {
    ReportError::Plan(PlanError::Machine(error.into()))
}

/// The table of `vibro simulate --machine`: time, coordinates, velocities, gaps of the stops, forces of stops and joints, how far
/// the surfaces of damped stops stand back, what stops and joints do, and the phase of the forcing. Where a row is the state after an
/// event, the last column has the digits that the others leave out, as an object in JSON.
pub(crate) fn of_machine<'a>(
    machine: &'a Machine,
    start: &events::Start,
    span: (f64, f64),
) -> Result<Table<'a>, ReportError> {
    let (surfaces, forced) = (recovering(machine), machine.parts().frequency.is_some());
    let samples = samples(machine, start, span)?;
    let motion = Motion::with_states(machine, start, motion_limits(machine, span.0)).map_err(refused)?;
    let mut states = motion.filter(|event| event.kind != EventKind::Graze).peekable();
    let mut whole = (!start.exact.is_empty()).then(|| Box::new(start.clone()));
    let rows = samples.map(move |sample| {
        let mut row = Number(sample.time).to_string();
        for value in sample.q.iter().chain(&sample.qdot).chain(&sample.gaps).chain(&sample.forces) {
            row.push_str(&format!(",{}", Number(*value)));
        }
        for stop in &surfaces {
            row.push_str(&format!(",{}", Number(sample.surfaces[*stop])));
        }
        for state in &sample.states {
            row.push_str(&format!(",{}", contact_word(*state)));
        }
        if forced {
            row.push_str(&format!(",{}", Number(sample.phase)));
        }
        while let Some(event) = states.next_if(|event| event.time <= sample.time) {
            whole = event.state;
        }
        row.push(',');
        let here = sample.start();
        if let Some(state) = whole.take_if(|whole| events::Start { exact: Vec::new(), ..(**whole).clone() } == here) {
            // a cell in quotes, in which quotes are doubled
            let digits = Value::from(json::event::exact(&state)).to_string();
            row.push_str(&format!("\"{}\"", digits.replace('"', "\"\"")));
        }
        row
    });
    Ok(Table::new(columns_of_machine(machine).join(","), rows))
}

/// The names of the columns.
pub(crate) fn columns_of_machine(machine: &Machine) -> Vec<String> {
    let coordinates = |what: &'static str| machine.parts().coordinates.iter().map(move |name| format!("{what}.{name}"));
    let gaps = machine.stops().iter().map(|stop| format!("gap.{}", stop.name));
    let contacts = machine.stops().len() + machine.joints().len();
    let forces = (0..contacts).map(|place| format!("force.{}", machine.name_of(place)));
    let surfaces = recovering(machine);
    let surfaces = surfaces.iter().map(|stop| format!("surface.{}", machine.name_of(*stop)));
    let states = (0..contacts).map(|place| format!("state.{}", machine.name_of(place)));
    let phase = machine.parts().frequency.map(|_| "phase".to_owned());
    let time = core::iter::once("time".to_owned());
    let motion = time.chain(coordinates("q")).chain(coordinates("qdot")).chain(gaps).chain(forces);
    motion.chain(surfaces).chain(states).chain(phase).chain(["exact".to_owned()]).collect()
}

/// The stops whose surfaces can stand back.
fn recovering(machine: &Machine) -> Vec<usize> {
    let stops = machine.stops().iter().enumerate();
    let recovers =
        |law: &StopLaw| matches!(law, StopLaw::Compliant { damping, opening: Opening::Force, .. } if *damping > 0.0);
    stops.filter(|(_, stop)| recovers(&stop.law)).map(|(j, _)| j).collect()
}
