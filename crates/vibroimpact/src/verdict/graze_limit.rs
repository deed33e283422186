//! Ever gentler impacts: the limit without impacts, for motions without damping.
//!
//! Without damping an impact with speed $`u > 0`$ is always followed by another ($`0 < \varepsilon`$). If
//! $`\beta = p/q`$ and there were none within the common period $`T = 2\pi q`$, the state would return to
//! $`x = \delta`$ with velocity $`-\varepsilon u`$, so the mass would have been beyond the stop just before. Instead
//! there can be a limit. Let the impact at phase $`\theta`$ have the rebound speed $`w = \varepsilon u`$, and let the
//! force pull the mass away, $`\ddot x = -a`$ with $`a = \delta - \sin\theta > 0`$. Let $`j = \beta\cos\theta + w`$ be
//! the third derivative. A flight without contact on the way returns after $`T`$ to the state at its beginning, so it
//! crosses $`\delta`$ a little earlier on the same arc:
//!
//! $$`s = T - \frac{2w}{a}\Bigl(1 - \frac{2jw}{3a^2} + \dots\Bigr), \qquad
//!    u_1 = w\Bigl(1 + \frac{2jw}{3a^2} + \dots\Bigr), \qquad w_1 = \varepsilon u_1.`$$
//!
//! So the speeds decrease geometrically for ever, in infinite time. The limit is a motion that grazes the stop and has
//! no impacts: label `0`. That this continues *for ever* is shown from one impact by two conditions:
//!
//! 1. $`w\,|j|/a^2 \le \tfrac1{10}(1-\varepsilon)`$. Then each speed is below $`\varepsilon\,(1 + (1-\varepsilon)/15)`$
//!    times the one before, the sum of all rebound speeds is below $`1.2\,w/(1-\varepsilon)`$, and the phase of the
//!    impacts changes by at most $`D = 2.5\,\beta w/(a(1-\varepsilon))`$ in total. Over this change $`a`$ changes by
//!    less than a quarter, so the estimate holds for all impacts.
//! 2. The later flights differ from this one by a phase of at most $`D`$ and a speed of at most $`w`$. Since
//!    $`|\partial x/\partial\varphi| \le |f|(2+\beta)`$ and $`|\partial x/\partial v_0| \le 1`$, they clear the stops
//!    if this one does so by more than $`|f|(2+\beta)D + w =: \eta`$. Within $`s_0 = 4w/a + 2\sqrt{\eta/a}`$ of its
//!    ends it does so, because its arcs bend away from the stop with at least $`a/2`$, if
//!    $`s_0(\beta + w + 2as_0) \le a/2`$. Between them the flight is computed with the stops nearer by $`\eta`$.
//!
//! With restitution 0 no sum is needed: $`w = D = 0`$, and one tangential return decides. When the speeds are small,
//! the arc rises above the stop by less than its rounding error. A computed speed has no correct digits below
//! $`\sqrt{2a\rho}`$, where $`\rho`$ is the rounding error of the position after $`T`$; smaller speeds are replaced by
//! this value.
//!
//! $`\beta`$ must be a fraction in the sense of [`Oscillator::fraction`]. If it is only close to a fraction, the
//! flights miss the return by the drift of the phase over $`T`$, and the speeds level off at about this drift, so no
//! limit is claimed.

use crate::flight::{Contact, Flight, SearchLimits, first_contact};
use crate::motion::ImpactState;
use crate::system::{Oscillator, Side, Start};
use core::f64::consts::TAU;

/// Motions with faster impacts are not tested; the conditions need speeds far below 1 in any case.
const SLOW: f64 = 1e-2;
/// The fraction in the first condition of the module documentation.
const SHARE: f64 = 0.1;

/// Whether a motion has reached the graze limit, so that its impacts fade away for ever. The motion has an impact
/// `before` and, after `interval`, an impact `after` or a grazing contact there, with speed 0. `false` means that this
/// was not shown.
#[must_use]
pub fn recognised(osc: &Oscillator, before: &ImpactState, after: &ImpactState, interval: f64) -> bool {
    if after.velocity > SLOW || osc.damping() > 0.0 || before.side != after.side {
        return false;
    }
    let (Some(stop), Some((_, q))) = (osc.stop(after.side), osc.common_period()) else { return false };
    let (eps, common) = (stop.restitution, TAU * f64::from(q));
    let pull = -crate::contact::sticking::pressure(osc, after.side, after.phase);
    if eps >= 1.0 || pull <= 0.0 {
        return false;
    }
    let flight = Flight::new(osc, after.rebound(osc));
    // the rounding error of a speed after a common period
    let noise = 2.0 * (2.0 * pull * flight.at(common).rounding).sqrt();
    let speed = after.velocity.max(noise);
    // the return after a common period, up to twice the time by which the arc is crossed early
    let early = 4.0 * (eps * before.velocity + speed) / pull;
    if (common - interval).abs() > early || early > 0.1 {
        return false;
    }
    let rebound = eps * speed;
    let jerk = (osc.beta() * crate::math::sin_cos(after.phase).1).abs() + rebound;
    if rebound * jerk > SHARE * (1.0 - eps) * pull * pull {
        return false;
    }
    let drift = 2.5 * osc.beta() * rebound / (pull * (1.0 - eps));
    let perturbed = osc.free_amplitude() * (2.0 + osc.beta()) * drift + rebound;
    // the arcs on which it leaves the stop and returns to it must bend away from the stop
    let arc = early.max(4.0 * speed / pull) + 2.0 * (perturbed / pull).sqrt();
    let bends = arc * (osc.beta() + rebound + 2.0 * pull * arc) <= 0.5 * pull && arc < 1.0;
    bends && clears(osc, &flight, (arc, common - arc), perturbed)
}

/// Whether a flight stays further than `by` from the stops between two times; it is tested for contacts with stops that
/// are nearer by `by`.
fn clears(osc: &Oscillator, flight: &Flight, (from, until): (f64, f64), by: f64) -> bool {
    let upper = Oscillator::new(osc.beta(), osc.gap() - by, osc.restitution());
    let nearer = upper.and_then(|upper| match osc.stop(Side::Lower) {
        Some(stop) => upper.with_second_stop(stop.gap - by, stop.restitution),
        None => Ok(upper),
    });
    let (x, v) = flight.state(from);
    let Ok((nearer, start)) = nearer.and_then(|osc| Ok((osc, Start::new(&osc, x, v, flight.phase_at(from))?))) else {
        return false;
    };
    let limits = SearchLimits { periods: (until - from) / osc.period().max(TAU), ..SearchLimits::default() };
    match first_contact(&nearer, &Flight::new(&nearer, start), limits) {
        Contact::Impact { time, .. } | Contact::Grazing { time, .. } | Contact::NoneUntil(time) => time >= until - from,
        Contact::Never(_) => true,
        Contact::Contact { .. } => false,
    }
}

/// The last impact of a motion, for comparison with the next one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fading {
    last: Option<ImpactState>,
    /// Time since this impact.
    since: f64,
}

impl Fading {
    /// Records an impact, or a grazing contact with speed 0, a time `interval` after the last event; returns whether
    /// the graze limit is reached.
    pub fn strikes(&mut self, osc: &Oscillator, state: ImpactState, interval: f64) -> bool {
        let since = self.since + interval;
        let fades = self.last.is_some_and(|last| recognised(osc, &last, &state, since));
        if state.velocity > 0.0 {
            (self.last, self.since) = (Some(state), 0.0);
        } else {
            self.since = since;
        }
        fades
    }

    /// Records that the mass sticks: the motion afterwards does not depend on the impacts before.
    pub fn rests(&mut self) {
        *self = Self::default();
    }
}
