//! The quantities of a verdict, and those of the way from a start to the motion it settles into.

use super::cycle::{add_cycle, after_release};
use super::segment::follow;
use super::{Quantities, Quantity, Segment, Tally};
use crate::flight::{Flight, SearchLimits};
use crate::lyapunov::Tail;
use crate::motion::{EventKind, ImpactState, Motion, Path};
use crate::orbit;
use crate::system::{Oscillator, Side, Start};
use crate::verdict::{NoImpact, Verdict};

/// Events for each impact, at most: impacts, grazing contacts, beginnings and ends of sticking. And impacts that are
/// always granted.
pub(super) const EVENTS: u64 = 4;
const LEAST: u64 = 100;
/// The number of forcing periods of a last flight without end that count as part of the way.
const LAST_PERIODS: f64 = 100.0;

/// The quantities of the motion with this verdict. Those of a chaotic motion are means and extremes over its
/// [tail](crate::chaos::Tail): the last [`MEASURED_IMPACTS`](super::MEASURED_IMPACTS) impacts before the verdict.
///
/// `None` for an undecided motion. Without damping, motions without impacts depend on the start: their positions and
/// velocities are NaN.
#[must_use]
pub fn of_verdict(osc: &Oscillator, verdict: &Verdict) -> Option<Quantities> {
    of_verdict_only(osc, verdict, &Quantity::ALL)
}

/// The same for the quantities that are asked for; others may be NaN. Sums over impacts alone need less time than
/// integrals and extremes ([`Quantity::of_impacts`]).
#[must_use]
pub fn of_verdict_only(osc: &Oscillator, verdict: &Verdict, asked: &[Quantity]) -> Option<Quantities> {
    let tally = Tally::of_only(osc, asked);
    match verdict {
        Verdict::Periodic(cycle) => add_cycle(tally, osc, cycle),
        Verdict::NoImpact(NoImpact::Landing { side, periods }) => {
            let mut tally = tally;
            // its flights have no impact, so no cycle of impacts describes them: they are flown again from the release
            after_release(osc, *side, *periods)?.iter().for_each(|part| tally.add(part));
            Some(tally.over(f64::from(*periods)))
        }
        // with damping all of them become the steady response
        Verdict::NoImpact(_) => match orbit::without_impacts(osc) {
            Some(cycle) => add_cycle(tally, osc, &cycle),
            None => Some(Quantities::from_fn(quiet)),
        },
        Verdict::Stuck(side) => Some(stuck(osc, *side)),
        Verdict::Chaotic(chaos) => measured(tally, osc, &chaos.tail),
        Verdict::Undecided(_) => None,
    }
}

/// The same for a motion of which a [`Settlement`](crate::verdict::Settlement) holds the impacts of the tail. They are
/// not searched for again, which saves most of the time if it is chaotic. The result has the same bits.
#[must_use]
pub fn of_arrivals(
    osc: &Oscillator,
    verdict: &Verdict,
    arrivals: &[(ImpactState, f64)],
    asked: &[Quantity],
) -> Option<Quantities> {
    let Verdict::Chaotic(chaos) = verdict else { return of_verdict_only(osc, verdict, asked) };
    // the tail was not kept: it is flown again
    if arrivals.is_empty() {
        return of_verdict_only(osc, verdict, asked);
    }
    let mut tally = Tally::of_only(osc, asked).between_stops();
    let mut from = chaos.tail.from;
    for (state, duration) in arrivals {
        if tally.flights() {
            tally.add(&Segment::Flight { flight: Flight::new(osc, from.rebound(osc)), duration: *duration });
        } else {
            // sums over impacts alone need the times between them only
            tally.pass(*duration);
        }
        tally.add(&Segment::Impact { side: state.side, speed: state.velocity });
        from = *state;
    }
    Some(tally.over_all())
}

/// What is known of all motions without impacts and without damping.
fn quiet(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::ImpactSpeedMean
        | Quantity::DisplacementMin
        | Quantity::DisplacementMax
        | Quantity::DisplacementAmplitude
        | Quantity::DisplacementMean
        | Quantity::DisplacementRms
        | Quantity::VelocityMax
        | Quantity::VelocityRms
        | Quantity::AccelerationMax => f64::NAN,
        _ => 0.0,
    }
}

fn stuck(osc: &Oscillator, side: Side) -> Quantities {
    let mut tally = Tally::new(osc);
    // one forcing period is enough: the mass does not move, and the force on the stop is periodic
    tally.add(&Segment::Rest { side, phase: 0.0, duration: osc.period() });
    tally.over(1.0)
}

/// The quantities of a motion over its tail. `None` for a tail without impacts, and if a flight of it is longer than the
/// default limits allow.
fn measured(tally: Tally<'_>, osc: &Oscillator, tail: &Tail) -> Option<Quantities> {
    let mut tally = tally.between_stops();
    let mut motion = Motion::after(osc, &tail.from, SearchLimits::default());
    let count = add_impacts(&mut tally, &mut motion, tail.impacts, EVENTS.saturating_mul(tail.impacts));
    // fewer impacts than the verdict counted: a mean over them would be another motion's
    (count == tail.impacts && count > 0).then(|| tally.over_all())
}

/// Adds a motion up to its impact number `impacts`, or its end; returns the number of impacts. At most `most` events are
/// added, because a motion that ends in grazing contacts without impacts has no end of events.
fn add_impacts(tally: &mut Tally<'_>, motion: &mut Motion<'_>, impacts: u64, most: u64) -> u64 {
    let (mut count, mut events) = (0, 0);
    follow(
        motion,
        |part| tally.add(&part),
        |event| {
            count += u64::from(matches!(event.kind, EventKind::Impact { .. }));
            events += 1;
            count < impacts && events < most
        },
    );
    count
}

/// The quantities of the way from `start` over its first `impacts` impacts: the largest values on the way, and means
/// over it. If no stop is reached again, the first hundred forcing periods of the last flight belong to it.
#[must_use]
pub fn of_transient(osc: &Oscillator, start: Start, impacts: u64) -> Quantities {
    let mut motion = Motion::new(osc, start);
    let mut tally = Tally::new(osc);
    add_impacts(&mut tally, &mut motion, impacts, EVENTS.saturating_mul(impacts.saturating_add(LEAST)));
    // the tally has no last flight yet, because a flight is added at the event that ends it
    if let Some(leg) = motion.leg().filter(|leg| leg.duration.is_infinite()) {
        let duration = LAST_PERIODS * osc.period();
        tally.add(&match leg.path {
            Path::Flight(flight) => Segment::Flight { flight, duration },
            Path::Rest(side) => Segment::Rest { side, phase: leg.phase, duration },
        });
    }
    tally.over_all()
}
