//! The impact map, from one arrival at a stop to the next, and its exact derivative.
//!
//! The state is the phase $`\theta`$, the arrival speed $`U`$ and the stop. The flight after the impact begins with
//! $`v_0 = -\sigma_0\varepsilon U_0`$ and ends at $`\sigma_1 x = \delta_{\sigma_1}`$ after a time $`s`$ that depends on
//! both. With the propagator of the flight,
//!
//! $$`\partial_\varphi x = \cos\varphi\,K_c - \sin\varphi\,K_s,\quad \partial_{v_0} x = S,\quad
//!   \partial_\varphi v = \cos\varphi\,(S - \beta K_s) - \sin\varphi\,\beta K_c,\quad \partial_{v_0} v = C - 2\zeta S,`$$
//!
//! the contact condition gives $`ds = -(\partial_\varphi x\,d\varphi + \partial_{v_0}x\,dv_0)/v_1`$, and then
//!
//! $$`d\theta_1 = d\varphi + \beta\,ds, \qquad
//!   dU_1 = \sigma_1(\partial_\varphi v\,d\varphi + \partial_{v_0}v\,dv_0 + a_1\,ds).`$$
//!
//! The determinant is $`\varepsilon^2 e^{-2\zeta s}\,U_0/U_1`$; the factor $`U_0/U_1`$ would be absent in position and
//! velocity.

use super::{End, Event, EventKind, ImpactState, Motion};
use crate::flight::SearchLimits;
use crate::lanes::PropagatorCache;
use crate::math::{Lane, Matrix2};
use crate::system::{Oscillator, Side};

/// The result of the impact map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mapped {
    /// The next impact; grazing contacts before it are not counted.
    Impact {
        /// The next arrival.
        state: ImpactState,
        /// Time between the two impacts.
        interval: f64,
    },
    /// The mass sticks: the event at which it begins.
    Stick(Event),
    /// No further impact.
    End(End),
}

/// After this number of successive contacts without an impact, a motion counts as one that only grazes.
pub const MAX_TOUCHES: u32 = 8;

/// The event after the impact `state`: the next impact, the beginning of sticking, or the end of the motion.
///
/// ```
/// use vibroimpact::{Oscillator, Side, motion::{ImpactState, Mapped, impact_map}, flight::SearchLimits};
/// // eps = 0.5, 1/beta = 1.3, delta = 0.75: the fundamental motion returns to itself
/// let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5)?;
/// let state = ImpactState { phase: 1.1905096137878885, velocity: 2.7973491519537674, side: Side::Upper };
/// let Mapped::Impact { state: next, interval } = impact_map(&osc, &state, SearchLimits::default()) else { panic!() };
/// assert!((next.velocity - state.velocity).abs() < 1e-14 && (interval - osc.period()).abs() < 1e-14);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn impact_map(osc: &Oscillator, state: &ImpactState, limits: SearchLimits) -> Mapped {
    ImpactMap::new(osc, limits).after(state)
}

/// The impact map of one oscillator, for many impacts: propagators are computed once.
pub(crate) struct ImpactMap<'a>(Motion<'a>, PropagatorCache);

impl<'a> ImpactMap<'a> {
    /// With these limits of the search for each contact.
    pub(crate) fn new(osc: &'a Oscillator, limits: SearchLimits) -> Self {
        // any state: `after` begins with its own
        let motion = Motion::after(osc, &ImpactState { phase: 0.0, velocity: 0.0, side: Side::Upper }, limits);
        Self(motion, PropagatorCache::new())
    }

    /// The event after an impact, as [`impact_map`] returns it.
    pub(crate) fn after(&mut self, state: &ImpactState) -> Mapped {
        // a chatter is completed as in a motion; without this, iterating the map would go through all its impacts
        let Self(motion, cache) = self;
        motion.restart(state);
        let mut passed = 0;
        loop {
            match motion.advance(Some(cache)) {
                // contacts without an impact may repeat for ever
                Some(event) if passed > MAX_TOUCHES => return Mapped::End(End::NoneFor(event.time)),
                Some(event) => match event.kind {
                    EventKind::Impact { velocity_before, .. } => {
                        let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                        return Mapped::Impact { state, interval: event.time };
                    }
                    EventKind::Stick { .. } => return Mapped::Stick(event),
                    EventKind::Graze { .. } | EventKind::Release => passed += 1,
                },
                None => return Mapped::End(motion.end().unwrap_or(End::NoneFor(0.0))),
            }
        }
    }
}

/// The derivative of `(phase, velocity)` at the next impact with respect to those at `state`, where the next impact is
/// `next`, a time `interval` later. It is not finite if `next` has velocity zero.
#[must_use]
pub fn derivative(osc: &Oscillator, state: &ImpactState, next: &ImpactState, interval: f64) -> Matrix2 {
    let of = |side: Side| osc.stop(side).map_or((0.0, 0.0), |stop| (stop.restitution, stop.gap));
    let p = osc.response().at(interval);
    Matrix2(Passage::elements(
        osc,
        &Passage {
            phase: state.phase,
            side: state.side.sign(),
            restitution: of(state.side).0,
            next_phase: next.phase,
            next_side: next.side.sign(),
            next_gap: of(next.side).1,
            speed: next.velocity,
        },
        [p.kc, p.ks, p.s, p.s_rate],
    ))
}

/// The way from an impact to the next one, or several side by side.
pub(super) struct Passage<L> {
    pub(super) phase: L,
    pub(super) side: L,
    /// Of the stop of the first impact.
    pub(super) restitution: L,
    pub(super) next_phase: L,
    pub(super) next_side: L,
    /// Of the stop of the next impact.
    pub(super) next_gap: L,
    /// Of the next arrival.
    pub(super) speed: L,
}

impl<L: Lane> Passage<L> {
    /// The elements of the derivative, from $`K_c, K_s, S, S'`$ after the time between the impacts.
    #[inline(always)]
    pub(super) fn elements(osc: &Oscillator, at: &Self, [kc, ks, s, s_rate]: [L; 4]) -> [[L; 2]; 2] {
        let (beta, drag) = (L::splat(osc.beta()), L::splat(2.0 * osc.damping()));
        let (sin, cos) = at.phase.sine_and_cosine();
        let (x_phase, x_v) = (cos * kc - sin * ks, s);
        let (v_phase, v_v) = (cos * (s - beta * ks) - sin * beta * kc, s_rate);
        let v1 = at.next_side * at.speed;
        // the acceleration at the next impact, from the equation of motion
        let a1 = at.next_phase.sine_and_cosine().0 - at.next_side * at.next_gap - drag * v1;
        // one column for the phase, one for the arrival speed (dv0 = -sigma eps dU)
        let dv0 = -at.side * at.restitution;
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let columns = [(one, zero), (zero, dv0)];
        let mut elements = [[zero; 2]; 2];
        let mut k = 0;
        while k < 2 {
            let (dphi, dv) = columns[k];
            let ds = -(x_phase * dphi + x_v * dv) / v1;
            elements[0][k] = dphi + beta * ds;
            elements[1][k] = at.next_side * (v_phase * dphi + v_v * dv + a1 * ds);
            k += 1;
        }
        elements
    }
}
