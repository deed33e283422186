//! Simulation just below and just above an event: which of the orbits that meet there it follows, and where it ends.

use super::branches::{Event, Guess, Kind, at};
use crate::Error;
use vibroimpact::motion::{EventKind, ImpactState, Motion};
use vibroimpact::orbit::{Cycle, refine};
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Label, Oscillator, Start};

/// An orbit in simulation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) label: Label,
    /// Whether the simulation from its first impact makes exactly the impacts of the orbit and returns to the start.
    pub(super) repeats: bool,
    /// Whether a motion that begins near the orbit settles into it.
    pub(super) attracts: bool,
    /// The label of the motion into which that motion settles.
    pub(super) ends: String,
    /// Whether the equations and multipliers give the same result.
    agrees: bool,
}

/// Both sides of an event.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sides {
    /// Distance of the gap from the event.
    pub(super) off: f64,
    pub(super) below: Vec<Seen>,
    pub(super) above: Vec<Seen>,
    /// Whether simulation shows the expected change.
    pub(super) confirmed: bool,
}

/// Distance from an event of this kind at which simulation is compared, if no other event is near. Closer to the event,
/// a multiplier is closer to the unit circle, and motions take longer to settle.
fn off(kind: Kind) -> f64 {
    match kind {
        Kind::Flip | Kind::LossOfContact => 1e-2,
        Kind::Fold | Kind::Grazing => 1e-4,
    }
}

/// Both sides of an event. `room` is the distance to the next event.
pub(super) fn sides(event: &Event, room: f64) -> Result<Sides, Error> {
    let h = off(event.kind).min(0.3 * room);
    // near a flip, the doubled orbit grows with the square root of the distance and sets the scale
    let aside = if event.kind == Kind::Flip { 0.03 * h.sqrt() } else { 1e-3 * h };
    let look = |gap: f64| event.orbits.iter().map(|orbit| seen(gap, orbit, (h, aside))).collect::<Result<Vec<_>, _>>();
    let (below, above) = (look(event.gap - h)?, look(event.gap + h)?);
    let once = |k: usize| below[k].repeats != above[k].repeats;
    let all = 0..below.len();
    let happens = match event.kind {
        // at a flip the orbit loses its stability, and the doubled orbit exists on one side only
        Kind::Flip => {
            below[0].repeats
                && above[0].repeats
                && below[0].attracts != above[0].attracts
                && all.clone().skip(1).all(once)
        }
        // at a fold both orbits exist on the same side
        Kind::Fold => all.clone().all(once) && below.iter().all(|seen| seen.repeats == below[0].repeats),
        Kind::Grazing => all.clone().all(once),
        Kind::LossOfContact => below.iter().all(|seen| seen.repeats) && free(&at(event.gap + h)?),
    };
    let agrees = below.iter().chain(&above).all(|seen| seen.agrees);
    Ok(Sides { off: h, below, above, confirmed: happens && agrees })
}

/// Whether the motion without impacts clears the stop.
fn free(osc: &Oscillator) -> bool {
    Start::free_motion(osc).is_some_and(|start| Motion::new(osc, start).next().is_none())
}

fn seen(gap: f64, guess: &Guess, (h, aside): (f64, f64)) -> Result<Seen, Error> {
    let osc = at(gap)?;
    let near = guess.near(h);
    let found = refine(&osc, &near).filter(|orbit| is_one(&orbit.cycle));
    let (possible, stable) = found.as_ref().map_or((false, false), |o| (o.physical, o.physical && o.cycle.stable()));
    // if there is no such orbit, the motion from the guess is used
    let cycle = found.map_or(near, |orbit| orbit.cycle);
    let repeats = is_one(&cycle) && flown(&osc, &cycle, (1e-2 * h).max(1e-9));
    let on = cycle.points.iter().map(|p| p.state).find(|state| state.velocity > 0.0);
    // an orbit that has lost its only impact has become the motion without impacts
    let start = on.map_or_else(
        || Start::free_motion(&osc).unwrap_or_else(|| Start::at_rest(&osc)),
        |on| ImpactState { velocity: on.velocity * (1.0 + aside), ..on }.rebound(&osc),
    );
    let verdict = settle(&osc, start, &SettleOptions::default()).verdict;
    let attracts = repeats && matches!(&verdict, Verdict::Periodic(end) if end.same_as(&cycle, 1e-6));
    let agrees = repeats == possible && attracts == stable;
    Ok(Seen { label: guess.label(), repeats, attracts, ends: verdict.label().into_owned(), agrees })
}

/// Whether the cycle is not an orbit of half its period counted twice, which is found beyond a flip too.
fn is_one(cycle: &Cycle) -> bool {
    let half = cycle.points.len() / 2;
    let alike = |k: usize| (cycle.points[k].state.velocity - cycle.points[k + half].state.velocity).abs() < 1e-9;
    !(cycle.points.len().is_multiple_of(2) && cycle.label.periods.is_multiple_of(2) && (0..half).all(alike))
}

/// Whether the simulation from the first impact makes the impacts of the cycle at their times, over one period of it.
fn flown(osc: &Oscillator, cycle: &Cycle, tolerance: f64) -> bool {
    if cycle.points.iter().any(|point| point.state.velocity <= 0.0) {
        return false;
    }
    let mut motion = Motion::after(osc, &cycle.points[0].state, Default::default());
    let mut time = 0.0;
    cycle.points.iter().all(|point| {
        time += point.interval;
        // a grazing contact has no effect and is ignored
        let hit = motion.by_ref().find(|e| !matches!(e.kind, EventKind::Graze { .. }));
        matches!(hit, Some(e) if matches!(e.kind, EventKind::Impact { .. }) && (e.time - time).abs() < tolerance)
    })
}
