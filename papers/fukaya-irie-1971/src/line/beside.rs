//! Simulation just below and just above an event: which of the orbits that meet there it flies, and where it ends.

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
    /// Flown from its first impact it makes its impacts, and no other, and comes back.
    pub(super) repeats: bool,
    /// A motion that begins beside it settles into it.
    pub(super) attracts: bool,
    /// What that motion settles into.
    pub(super) ends: String,
    /// Whether its equations and multipliers say the same.
    agrees: bool,
}

/// An event and both its sides.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sides {
    /// How far from the event.
    pub(super) off: f64,
    pub(super) below: Vec<Seen>,
    pub(super) above: Vec<Seen>,
    /// Whether simulation shows what is claimed to happen.
    pub(super) confirmed: bool,
}

/// How far from an event of that kind, where no other event is near: a motion takes the longer to settle the nearer a
/// multiplier is to the unit circle.
fn off(kind: Kind) -> f64 {
    match kind {
        Kind::Flip | Kind::LossOfContact => 1e-2,
        Kind::Fold | Kind::Grazing => 1e-4,
    }
}

/// Both sides of an event; `room` is the distance to the next event.
pub(super) fn sides(event: &Event, room: f64) -> Result<Sides, Error> {
    let h = off(event.kind).min(0.3 * room);
    // at a flip the doubled orbit, which grows like a root, decides what is near and what is far
    let aside = if event.kind == Kind::Flip { 0.03 * h.sqrt() } else { 1e-3 * h };
    let look = |gap: f64| event.orbits.iter().map(|orbit| seen(gap, orbit, (h, aside))).collect::<Result<Vec<_>, _>>();
    let (below, above) = (look(event.gap - h)?, look(event.gap + h)?);
    let once = |k: usize| below[k].repeats != above[k].repeats;
    let all = 0..below.len();
    let happens = match event.kind {
        // the orbit loses its stability, and the doubled one is on one side only
        Kind::Flip => {
            below[0].repeats
                && above[0].repeats
                && below[0].attracts != above[0].attracts
                && all.clone().skip(1).all(once)
        }
        // both are on the same side
        Kind::Fold => all.clone().all(once) && below.iter().all(|seen| seen.repeats == below[0].repeats),
        Kind::Grazing => all.clone().all(once),
        Kind::LossOfContact => below.iter().all(|seen| seen.repeats) && free(&at(event.gap + h)?),
    };
    let agrees = below.iter().chain(&above).all(|seen| seen.agrees);
    Ok(Sides { off: h, below, above, confirmed: happens && agrees })
}

/// Whether the free motion never strikes.
fn free(osc: &Oscillator) -> bool {
    Start::free_motion(osc).is_some_and(|start| Motion::new(osc, start).next().is_none())
}

fn seen(gap: f64, guess: &Guess, (h, aside): (f64, f64)) -> Result<Seen, Error> {
    let osc = at(gap)?;
    let near = guess.near(h);
    let found = refine(&osc, &near).filter(|orbit| is_one(&orbit.cycle));
    let (possible, stable) = found.as_ref().map_or((false, false), |o| (o.physical, o.physical && o.cycle.stable()));
    // where there is no such orbit, the motion that begins like it
    let cycle = found.map_or(near, |orbit| orbit.cycle);
    let repeats = is_one(&cycle) && flown(&osc, &cycle, (1e-2 * h).max(1e-9));
    let on = cycle.points.iter().map(|p| p.state).find(|state| state.velocity > 0.0);
    // an orbit that has lost its only impact has become the free motion
    let start = on.map_or_else(
        || Start::free_motion(&osc).unwrap_or_else(|| Start::at_rest(&osc)),
        |on| ImpactState { velocity: on.velocity * (1.0 + aside), ..on }.rebound(&osc),
    );
    let verdict = settle(&osc, start, &SettleOptions::default()).verdict;
    let attracts = repeats && matches!(&verdict, Verdict::Periodic(end) if end.same_as(&cycle, 1e-6));
    let agrees = repeats == possible && attracts == stable;
    Ok(Seen { label: guess.label(), repeats, attracts, ends: verdict.label().into_owned(), agrees })
}

/// Whether it is not one of half its period gone round twice, as a doubled orbit is found beyond its flip.
fn is_one(cycle: &Cycle) -> bool {
    let half = cycle.points.len() / 2;
    let alike = |k: usize| (cycle.points[k].state.velocity - cycle.points[k + half].state.velocity).abs() < 1e-9;
    !(cycle.points.len().is_multiple_of(2) && cycle.label.periods.is_multiple_of(2) && (0..half).all(alike))
}

/// Whether the simulation from the first impact makes the impacts of the cycle, at their times, over one period of it.
fn flown(osc: &Oscillator, cycle: &Cycle, tolerance: f64) -> bool {
    if cycle.points.iter().any(|point| point.state.velocity <= 0.0) {
        return false;
    }
    let mut motion = Motion::after(osc, &cycle.points[0].state, Default::default());
    let mut time = 0.0;
    cycle.points.iter().all(|point| {
        time += point.interval;
        // a touch without effect is none
        let hit = motion.by_ref().find(|e| !matches!(e.kind, EventKind::Graze { .. }));
        matches!(hit, Some(e) if matches!(e.kind, EventKind::Impact { .. }) && (e.time - time).abs() < tolerance)
    })
}
