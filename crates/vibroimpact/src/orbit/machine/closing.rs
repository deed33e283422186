//! Closing a cycle of a machine by Newton's method, on the state between two events. Without forcing the period is unknown
//! too, and the state is determined across the motion only.

use super::cycle::Cycle;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use super::rounding::rounding_decides;
use crate::events::Place;
use crate::math::{Lu, Matrix, Multiplier, change_along, dot};
use core::f64::consts::TAU;

/// The largest number of steps of Newton's method; from a good guess four or five are needed.
const MAX_STEPS: u32 = 30;
/// After each run of this number of steps the iteration is ended if the residual exceeds [`HOPELESS`], or has not fallen to
/// [`SLOW`] of what it was before them: even near a double solution it halves in each step. A neutral motion comes close to earlier
/// states again and again without a cycle, and steps towards none would take most of the time of its verdict.
const PATIENCE: u32 = 8;
const HOPELESS: f64 = 1e-2;
const SLOW: f64 = 0.25;
/// A residual up to this is accepted; the rounding error is usually 1e-14.
const CLOSED: f64 = 1e-10;
/// A multiplier besides that along the motion that is this near to 1 is 1 to rounding: the cycle is one of a family, as those
/// of machines that lose no energy.
const FAMILY: f64 = 1e-9;
/// Newton's equations are singular to rounding if they ask for a step that is longer than the miss by this factor.
const SINGULAR: f64 = 1e8;
/// A period that differs by more, relative to it, is another one.
const OTHER: f64 = 0.25;
/// States that differ by less, relative to the motion, are the same.
const SAME: f64 = 1e-8;

impl Cycle {
    /// The cycle of `n` forcing periods near the motion from `from`, by Newton's method on the state between two events,
    /// which a free translation leaves as it is; `None` if it does not converge, if it rests and rounding errors decide its period,
    /// or without forcing.
    pub(crate) fn near(frame: &MachineFrame<'_>, from: &Place, n: u32) -> Option<Self> {
        let period = frame.machine.period()?;
        let time = period * f64::from(n);
        let (mut begin, mut lap, mut residual) = closed(frame, from, time)?;
        // without events it is the same motion wherever it begins
        if let ([], [(_, _, passage)]) = (&lap.events[..], &lap.steps[..]) {
            let structure = passage.structure.clone();
            begin = frame.moved(&begin, &structure, (1.0 - begin.phase / TAU) * period);
            begin.phase = 0.0;
            lap = MachineLap::fly(frame, &begin, time)?;
            residual = frame.distance(&begin, &lap.end, lap.sizes);
        }
        Self::shortest(frame, (&begin, n), &lap, residual)
    }

    /// The cycle near the motion from `from` that returns after about this time; `None` if there is none that is isolated.
    /// With forcing the time is rounded to whole periods of it.
    pub(crate) fn returning(frame: &MachineFrame<'_>, from: &Place, time: f64) -> Option<Self> {
        if let Some(period) = frame.machine.period() {
            let periods = (time / period).round();
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // checked to be small
            return (1.0..1e6).contains(&periods).then(|| Self::near(frame, from, periods as u32)).flatten();
        }
        // one that loses energy does not return, and one that loses none has others of more and of less energy beside it
        if frame.gains_no_energy() {
            return None;
        }
        let (begin, lap, residual) = closed(frame, from, time)?;
        // without events nothing says that the motion is not one of many
        let alone = |begin: &Place, lap: &MachineLap, residual| {
            if rounding_decides(frame, lap) {
                return None;
            }
            let cycle = Self::of(frame, (begin, 0), lap, residual, vec![begin.clone()]);
            let near_one = |m: &&Multiplier| crate::math::hypot(m.re - 1.0, m.im) <= FAMILY;
            let family = cycle.multipliers.iter().filter(near_one).count() > lap.holding().len();
            (!cycle.events.is_empty() && !family).then_some(cycle)
        };
        // the smallest period has a whole part of the events
        let count = lap.events.len();
        let parts = (2..=count).rev().filter(|parts| count.is_multiple_of(*parts));
        #[allow(clippy::cast_precision_loss)] // a small count
        let parts = parts.map(|parts| lap.time / parts as f64);
        for time in parts {
            let short = MachineLap::replay(frame, &begin, time)?;
            if frame.distance(&begin, &short.end, lap.sizes) <= SAME {
                let (begin, lap, residual) = closed(frame, &begin, time)?;
                return alone(&begin, &lap, residual);
            }
        }
        alone(&begin, &lap, residual)
    }

    /// The cycle near the motion from `from` whose smallest period is this number of forcing periods, or without forcing
    /// close to this time; `None` if there is none.
    pub(crate) fn lasting(frame: &MachineFrame<'_>, from: &Place, (periods, time): (u32, f64)) -> Option<Self> {
        let cycle = Self::returning(frame, from, frame.time(periods, time))?;
        let alike = !frame.unforced() || (cycle.period / time - 1.0).abs() < OTHER;
        (cycle.label.periods == periods && alike).then_some(cycle)
    }

    /// The cycle whose motion over `n` periods is `lap`, over its smallest period.
    fn shortest(frame: &MachineFrame<'_>, (begin, n): (&Place, u32), lap: &MachineLap, residual: f64) -> Option<Self> {
        let one = frame.machine.period()?;
        let known = |lap: &MachineLap| !rounding_decides(frame, lap);
        let mut strobes = vec![begin.clone()];
        for k in 1..n {
            let last = strobes.last()?;
            let next = MachineLap::replay(frame, last, one)?.end;
            if n.is_multiple_of(k) && frame.distance(begin, &next, lap.sizes) <= SAME {
                let lap = MachineLap::fly(frame, begin, one * f64::from(k))?;
                let residual = frame.distance(begin, &lap.end, lap.sizes);
                return known(&lap).then(|| Self::of(frame, (begin, k), &lap, residual, strobes));
            }
            strobes.push(next);
        }
        known(lap).then(|| Self::of(frame, (begin, n), lap, residual, strobes))
    }
}

/// The state, the motion and the residual of a cycle near the motion from `from` over a time, which is the period with
/// forcing, and a guess of it without.
fn closed(frame: &MachineFrame<'_>, from: &Place, mut time: f64) -> Option<(Place, MachineLap, f64)> {
    // begin in the middle of the longest flight, far from all events
    let first = MachineLap::replay(frame, from, time)?;
    let (_, place, passage) = first.steps.iter().max_by(|a, b| a.2.duration.total_cmp(&b.2.duration))?;
    let mut begin = frame.moved(place, &passage.structure, 0.5 * passage.duration.min(time));
    frame.centre(&mut begin);
    let mut best: Option<(f64, Place, MachineLap)> = None;
    let mut before = f64::INFINITY;
    for step in 0..MAX_STEPS {
        // what ends the iteration leaves the best lap so far: of a family of cycles the equations are singular, and a step can lead
        // anywhere
        let Some(lap) = MachineLap::fly(frame, &begin, time).filter(|lap| lap.end.states == begin.states) else {
            break;
        };
        let residual = frame.distance(&begin, &lap.end, lap.sizes);
        let (end, derivative, sizes) = (lap.end.clone(), lap.derivative.clone(), lap.sizes);
        let holding = lap.holding();
        let improves = best.as_ref().is_none_or(|(so_far, ..)| residual < *so_far);
        if improves {
            best = Some((residual, begin.clone(), lap));
        } else if best.as_ref().is_some_and(|(so_far, ..)| *so_far <= CLOSED) {
            break;
        }
        if residual == 0.0 {
            break;
        }
        if !residual.is_finite() || step >= PATIENCE && residual > HOPELESS {
            break;
        }
        if step.is_multiple_of(PATIENCE) {
            let least = best.as_ref().map_or(residual, |(least, ..)| *least);
            if least > CLOSED && least > SLOW * before {
                break;
            }
            before = least;
        }
        let change = derivative.and_then(|derivative| newton(frame, (&begin, &end), (derivative, &holding), sizes));
        let Some((change, longer)) = change else { break };
        let next: Vec<f64> = frame.shape.values(&begin).iter().zip(&change).map(|(from, by)| from + by).collect();
        begin = frame.shape.with_values(&begin, &next);
        time += longer;
        if !(time > 0.0 && time.is_finite()) {
            break;
        }
    }
    let (residual, begin, lap) = best?;
    (residual <= CLOSED).then_some((begin, lap, residual))
}

/// The changes of the state at the beginning and of the time that close a lap to first order:
/// $`(I - J)\,\Delta z - f_1\,\Delta T = z_1 - z_0`$ but for a translation. Without forcing $`f_0\cdot\Delta z = 0`$, else
/// $`\Delta T = 0`$. Joints that hold all the time stay where they are.
fn newton(
    frame: &MachineFrame<'_>,
    (begin, end): (&Place, &Place),
    (mut derivative, holding): (Matrix, &[usize]),
    (size, speed): (f64, f64),
) -> Option<(Vec<f64>, f64)> {
    let mut change = frame.apart(end, begin);
    frame.normal.translations.remove_from_columns(&mut derivative, 0);
    let (states, n) = (change.len(), frame.shape.n);
    let unknowns = if frame.unforced() { states + 1 } else { states };
    let mut system = Matrix::identity(unknowns);
    for i in 0..states {
        for j in 0..states {
            system[(i, j)] -= derivative[(i, j)];
        }
    }
    // the gap of such a joint is the same after the lap, so a row of I - J for it is 0
    for joint in holding {
        let direction = &frame.normal.directions[*joint];
        let square = dot(direction, direction);
        for i in 0..n {
            for j in 0..n {
                system[(i, j)] += direction[i] * direction[j] / square;
            }
        }
    }
    if unknowns > states {
        // rates relative to the sizes of coordinates and velocities
        let (before, after) = (frame.flow(begin)?, frame.flow(end)?);
        let scale = |i: usize| if (n..2 * n).contains(&i) { speed } else { size };
        let scaled: Vec<f64> = (0..states).map(|i| before[i] / scale(i)).collect();
        let length = dot(&scaled, &scaled).sqrt();
        for i in 0..states {
            system[(i, states)] = -after[i];
            system[(states, i)] = scaled[i] / (scale(i) * length);
        }
        system[(states, states)] = 0.0;
        change.push(0.0);
    }
    let missed = change.clone();
    let solved = Lu::new(system.values().to_vec(), unknowns).map(|lu| lu.solve(&mut change));
    let far = |of: &[f64]| of.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    // of a family of cycles the nearest one: the equations do not say which
    let is_regular = solved.is_some() && far(&change) <= SINGULAR * far(&missed);
    if !is_regular {
        change.fill(0.0);
        let rows: Vec<(&[f64], f64)> = (0..unknowns).map(|i| (system.row(i), missed[i])).collect();
        change_along(&rows, &mut change);
    }
    let longer = if unknowns > states { change.pop()? } else { 0.0 };
    Some((change, longer))
}
