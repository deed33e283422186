//! Where a flight of a cycle comes closest to a guard: to a stop, to the velocity of a belt, or to the limit of a reaction.

use crate::arc::{MachineFlight, Modes};
use crate::events::Place;
use crate::math::root;
use crate::math::sort_by;
use crate::orbit::{MachineFrame, MachineRing};
use crate::regime::GuardKind;
use core::cell::RefCell;

/// The number of equal parts of a flight, in each of which one minimum of the guard is looked for: so many for a radian of
/// the fastest mode, within limits. The first part is divided further, each shorter than the next, because after an impact of a
/// chatter the stop is close by soon.
const PARTS: f64 = 4.0;
const LIMITS: (f64, f64) = (16.0, 400.0);
const EARLY: usize = 40;
const SHORTER: f64 = 1.4;

/// A flight of a cycle, with the rates of all its guards at the times between which minima are looked for: the modes are the same for
/// all.
pub(crate) struct Leg<'a> {
    frame: &'a MachineFrame<'a>,
    ring: &'a MachineRing,
    leg: usize,
    from: Place,
    flight: MachineFlight,
    time: f64,
    times: Vec<f64>,
    /// Of each guard at all times.
    rates: Vec<Vec<f64>>,
}

impl<'a> Leg<'a> {
    /// The flight after event `leg`; `None` if it takes no time.
    pub(crate) fn new(frame: &'a MachineFrame<'a>, ring: &'a MachineRing, leg: usize) -> Option<Self> {
        let mut from = Place { known: Vec::new(), ..ring.place(leg) };
        frame.constrain(&mut from)?;
        let structure = frame.structure(&from.states)?;
        let time = ring.time(leg, frame.machine);
        if time <= 0.0 {
            return None;
        }
        let parts = (PARTS * time * structure.fastest()).clamp(LIMITS.0, LIMITS.1).ceil();
        let part = time / parts;
        let mut early: Vec<f64> = core::iter::successors(Some(part), |s| Some(s / SHORTER)).take(EARLY).collect();
        early.reverse();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // within the limits
        let later = (2..=parts as u32).map(|k| part * f64::from(k));
        let flight = from.flight(&frame.normal, structure);
        let times: Vec<f64> = core::iter::once(0.0).chain(early).chain(later).collect();
        let mut rates = vec![Vec::with_capacity(times.len()); flight.structure.guards.len()];
        let mut modes = Modes::default();
        for s in &times {
            flight.at(*s, &mut modes);
            for (guard, rates) in rates.iter_mut().enumerate() {
                rates.push(flight.guard(guard, &modes).1);
            }
        }
        Some(Self { frame, ring, leg, from, flight, time, times, rates })
    }

    /// The smallest of the minima of a guard on the flight, and the state there, with a phase that continues those of the ring. The gap
    /// of a stop whose surface stands back is that of the surface. `None` if the guard has no minimum, or belongs to another regime.
    pub(crate) fn closest(&self, kind: GuardKind) -> Option<(f64, Place)> {
        let Self { frame, ring, leg, from, flight, time, times, rates } = self;
        let guard = flight.structure.guards.iter().position(|guard| guard.kind == kind)?;
        let modes = RefCell::new(Modes::default());
        let at = |s: f64| {
            let modes = &mut *modes.borrow_mut();
            flight.at(s, modes);
            let (value, rate, _) = flight.guard(guard, modes);
            (value, rate)
        };
        let mut steps: Vec<(f64, f64)> = times.iter().copied().zip(rates[guard].iter().copied()).collect();
        // a guard that falls, rises for a short time and falls on turns twice between two of these times
        let rate = |s: f64| at(s).1;
        let risen: Vec<(f64, f64)> = steps.windows(3).filter_map(|three| rise(three, rate)).collect();
        if !risen.is_empty() {
            steps.extend(risen);
            sort_by(&mut steps, |a, b| a.0.total_cmp(&b.0));
        }
        // at an event of the same contact, or in contact with a surface that stands back, the guard begins at zero
        let stops = frame.machine.stops().len();
        let own = kind.place(stops);
        let standing = own < stops && from.surfaces[own].is_some();
        let begun = usize::from(standing || ring.events[*leg].guard.place(stops) == own);
        // a guard that begins at zero and falls at once ends the flight before, and one that rises to zero does not end this one:
        // there the guard does not turn
        let from_zero = begun > 0 && matches!(kind, GuardKind::Gap(_) | GuardKind::Depth(_) | GuardKind::Sliding(_));
        let falls = steps.iter().skip(begun).take_while(|step| from_zero && step.1 < 0.0).count();
        let ends = ring.events[(leg + 1) % ring.len()].guard == kind;
        let rises = steps.iter().rev().take_while(|step| ends && step.1 >= 0.0).count();
        let inner = steps.get(begun + falls..steps.len() - rises).unwrap_or_default();
        let turning = inner.windows(2).filter(|pair| pair[0].1 < 0.0 && pair[1].1 >= 0.0);
        let minima = turning.filter_map(|pair| root::between(|s| Some(at(s).1), pair[0], pair[1], f64::EPSILON * time));
        let lowest = minima.map(|s| (at(s).0, s)).min_by(|a, b| a.0.total_cmp(&b.0));
        let (value, s) = lowest?;
        let mut place = frame.moved(from, &flight.structure, s);
        place.phase = ring.theta(*leg) + ring.frequency(frame.machine) * s;
        Some((value, place))
    }
}

/// The same of the flight after event `leg`.
pub(crate) fn closest(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (leg, kind): (usize, GuardKind),
) -> Option<(f64, Place)> {
    Leg::new(frame, ring, leg)?.closest(kind)
}

/// The largest rate of a falling guard is looked for where a parabola through three of its rates comes closer to zero than this part
/// of the middle one, in so many steps.
const CLOSE: f64 = 0.3;
const STEPS: u32 = 30;

/// A time between three times at which a guard rises, with its rate there, if it falls at all three.
fn rise(three: &[(f64, f64)], rate: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    let &[(mut low, a), (_, b), (mut high, c)] = three else { return None };
    let peak = b + (c - a) * (c - a) / (8.0 * (2.0 * b - a - c));
    // a steady rate has no peak
    if a >= 0.0 || b >= 0.0 || c >= 0.0 || b < a || b < c || peak.is_nan() || peak < CLOSE * b {
        return None;
    }
    for _ in 0..STEPS {
        let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (at_one, at_two) = (rate(one), rate(two));
        if at_one >= 0.0 || at_two >= 0.0 {
            return Some(if at_one >= 0.0 { (one, at_one) } else { (two, at_two) });
        }
        if at_one < at_two { low = one } else { high = two }
    }
    None
}
