//! The states of a motion at given times, and where a coordinate crosses a position.

use super::event::{EventKind, Limits, Start};
use super::motion::Motion;
use super::sample::Sample;
use super::stretches::Stretches;
use crate::machine::{Machine, MachineError};

/// The states of the motion of a machine from a start at these times, which must not fall; `None` where nothing is known. At the
/// time of an event the state is that after it. While a chatter that is summed lasts, the structure is at rest on its stop.
///
/// # Errors
/// As [`Motion::new`].
///
/// ```
/// use vibroimpact::events::{Start, states_at};
/// use vibroimpact::machine::{Machine, MachineParts};
/// // a ball of mass 1 under gravity 1, dropped from height 1/2 on a floor
/// let parts = MachineParts::new(["height"]).with_mass(0, 1.0).with_constant(0, -1.0);
/// let ball = Machine::new(parts.with_rigid_stop("floor", &[-1.0], 0.0, 0.5))?;
/// let start = Start { q: vec![0.5], ..Start::default() };
/// let states = states_at(&ball, &start, &[0.5, 1.0, 1.5]).map(|states| states.into_iter().flatten().collect::<Vec<_>>())?;
/// assert_eq!([states[0].q[0], states[1].qdot[0], states[2].q[0]], [0.375, 0.5, 0.125]);
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
pub fn states_at(machine: &Machine, start: &Start, times: &[f64]) -> Result<Vec<Option<Sample>>, MachineError> {
    let mut stretches = Stretches::new(machine, start, limits(times.last().copied().unwrap_or(0.0)))?;
    let mut goes_on = stretches.advance();
    let mut state = |time: f64| {
        if time.is_nan() || time < 0.0 {
            return None;
        }
        while goes_on && time >= stretches.end() {
            goes_on = stretches.advance();
        }
        if !goes_on && time > stretches.end() {
            return None;
        }
        let s = stretches.since_begin(time);
        stretches.at(s).map(|sample| Sample { time, even: true, ..sample })
    };
    Ok(times.iter().map(|time| state(*time)).collect())
}

/// Where a coordinate of the motion of a machine crosses a position up to the time `until`, in order: upwards where its
/// velocity is positive. Between two events they are found as the first contacts with an imaginary stop there, so that none is missed.
///
/// # Errors
/// As [`Motion::new`], and [`MachineError`] for a position on a rigid stop or beyond it, or one that is not finite.
///
/// ```
/// use vibroimpact::events::{Start, crossings};
/// use vibroimpact::machine::{Machine, MachineParts};
/// let parts = MachineParts::new(["height"]).with_mass(0, 1.0).with_constant(0, -1.0);
/// let ball = Machine::new(parts.with_rigid_stop("floor", &[-1.0], 0.0, 0.5))?;
/// let start = Start { q: vec![0.5], ..Start::default() };
/// // falling, and after the impact at time 1 with speed 1/2 upwards and downwards
/// let found = crossings(&ball, &start, (0, 0.105), 2.0)?;
/// let velocities: Vec<f64> = found.iter().map(|state| (state.qdot[0] * 1e9).round() / 1e9).collect();
/// assert_eq!(velocities, [-0.888819442, 0.2, -0.2]);
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
pub fn crossings(
    machine: &Machine,
    start: &Start,
    (coordinate, position): (usize, f64),
    until: f64,
) -> Result<Vec<Sample>, MachineError> {
    let wall = |sign: f64| {
        let direction: Vec<f64> = (0..machine.n()).map(|k| if k == coordinate { sign } else { 0.0 }).collect();
        Machine::new(machine.parts().clone().with_rigid_stop("position", &direction, sign * position, 1.0))
    };
    // an imaginary stop above, which is met from below, and one below
    let walls = [wall(1.0)?, wall(-1.0)?];
    let mut stretches = Stretches::new(machine, start, limits(until))?;
    let mut found = Vec::new();
    while stretches.advance() && stretches.begin() <= until {
        let duration = stretches.duration().min(until - stretches.begin());
        let (mut s, mut touches) = (0.0, 0);
        let mut above = None;
        while let Some(here) = stretches.at(s) {
            let from_above = *above.get_or_insert_with(|| {
                let away = here.q[coordinate] - position;
                if away == 0.0 { here.qdot[coordinate] > 0.0 } else { away > 0.0 }
            });
            let mut start = here.start();
            // after a crossing within rounding on the right side
            let q = &mut start.q[coordinate];
            *q = if from_above { q.max(position) } else { q.min(position) };
            let contact = first_contact(&walls[usize::from(from_above)], machine, start, duration - s)?;
            let Some((time, crosses)) = contact.filter(|(time, _)| s + time <= duration) else { break };
            s += time;
            touches = if crosses && time > 0.0 { 0 } else { touches + 1 };
            if touches > MOST_TOUCHES {
                break;
            }
            if crosses {
                above = Some(!from_above);
                found.extend(stretches.at(s));
            }
        }
    }
    Ok(found)
}

/// After this number of touches of the position without a crossing, a flight counts as one that stays there.
const MOST_TOUCHES: u32 = 8;

/// The time of the first contact with the imaginary stop, the last one of `walled`, and whether it is one with speed; `None` if
/// something else happens before.
fn first_contact(
    walled: &Machine,
    machine: &Machine,
    mut start: Start,
    time: f64,
) -> Result<Option<(f64, bool)>, MachineError> {
    let place = machine.stops().len();
    // the joints come after the stops
    start.contacts.iter_mut().filter(|contact| contact.place >= place).for_each(|contact| contact.place += 1);
    let event = Motion::new(walled, &start, limits(time))?.next();
    let contact = event.filter(|event| event.place == place || event.with.contains(&place));
    Ok(contact.map(|event| (event.time, event.kind != EventKind::Graze)))
}

/// As long as there are times, every flight is searched to the last of them.
fn limits(until: f64) -> Limits {
    let limits = Limits::default();
    Limits { time: limits.time.max(until), ..limits }
}
