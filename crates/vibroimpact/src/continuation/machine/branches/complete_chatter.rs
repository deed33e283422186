//! Where a chatter on a rigid stop is complete exactly at the release: the value at which the number of its impacts becomes
//! infinite.
//!
//! Close to a release the stop is pressed with the acceleration $`k s`$, where s is the time left. The gap that opens at
//! s with the speed v closes again after the time $`x s`$ with
//!
//! $$`v = k s^2\Bigl(\frac{x}{2} - \frac{x^2}{6}\Bigr), \qquad v_- = k s^2\Bigl(\frac{x}{2} - \frac{x^2}{3}\Bigr)`$$
//!
//! and opens with the speed $`\varepsilon v_-`$ at $`\lambda s`$, where $`\lambda = 1 - x`$. All flights take the same part x
//! of the time left if
//!
//! $$`(2 + \lambda)\lambda^2 = \varepsilon(1 + 2\lambda).`$$
//!
//! Such a chatter is complete at the release. After shorter flights it is complete before, and a rest follows; after longer ones
//! it is never complete. The ratio $`v k/(ks)^2`$ tells one from the other: from impact to impact its distance to
//! $`x/2 - x^2/6`$ grows by a factor. The terms that are left out change it by a power series in the times left, which
//! decrease by the factor $`\lambda`$; the first powers are eliminated.

use super::at_rest::zero_near;
use super::equations::MachineEquations;
use super::problem::MachineSolution;
use crate::continuation::trace::tracer::last;
use crate::machine::{Machine, StopLaw};
use crate::orbit::{Chatter, MachineFrame, MachineRing, Rebound};
use crate::regime::GuardKind;

/// The most powers of the time left that are eliminated.
const POWERS: usize = 3;
/// The rest begins in the signature where the powers that are left out matter less than rounding (see [`error`]), and along a curve
/// between these factors of that.
const ROUNDING: f64 = 1e-16;
const SLACK: (f64, f64) = (10.0, 1e3);
/// The largest relative distance of a ratio from its limit, and the most time left, in a chatter that is nearly complete at its
/// release.
const NEAR: f64 = 0.5;
const SOON: f64 = 0.3;
/// The largest distance from the solution at which the search for the limit begins.
const MOST: f64 = 2e-2;
/// A chatter whose function is smaller is complete at its release, too.
const TOGETHER: f64 = 1e-4;
/// The value is known where one impact more changes it by less than this part of what the impact before it did.
const SETTLED: f64 = 1e-2;
/// The most impacts that are added to a signature.
const ADDED: usize = 500;
/// The most impacts of a chatter by which a signature changes at once.
pub(crate) const ADAPTED: usize = 200;

/// The factor by which the time left decreases from impact to impact of a chatter that is complete at its release.
fn decrease(restitution: f64) -> f64 {
    // convex and positive at 1: Newton's method decreases towards the zero
    let mut l = 1.0;
    for _ in 0..60 {
        let next =
            l - ((2.0 + l) * l * l - restitution * (1.0 + 2.0 * l)) / (4.0 * l + 3.0 * l * l - 2.0 * restitution);
        if next.is_nan() || next >= l {
            break;
        }
        l = next;
    }
    l
}

/// The ratio of all impacts of such a chatter.
fn limit(decrease: f64) -> f64 {
    let x = 1.0 - decrease;
    0.5 * x - x * x / 6.0
}

/// The restitution of a stop on which a chatter is possible.
fn restitution(machine: &Machine, stop: usize) -> Option<f64> {
    match machine.stops()[stop].law {
        StopLaw::Rigid { restitution } if restitution > 0.0 && restitution < 1.0 => Some(restitution),
        _ => None,
    }
}

/// The ratio at a rebound.
fn ratio(rebound: Rebound) -> f64 {
    rebound.speed * rebound.jerk / (rebound.a * rebound.a)
}

/// The time left at the rebound at impact `k`, in the fastest rate of the machine.
fn left(frame: &MachineFrame<'_>, ring: &MachineRing, (rebound, k): (Rebound, usize)) -> Option<f64> {
    let fastest = frame.structure(&ring.events[k].after)?.fastest().max(ring.frequency(frame.machine));
    Some(fastest * rebound.a / rebound.jerk)
}

/// The times left at the impacts of a chatter.
fn lefts(frame: &MachineFrame<'_>, ring: &MachineRing, chatter: Chatter) -> Option<Vec<f64>> {
    let at = |k: usize| left(frame, ring, (chatter.rebound(frame, ring, k)?, k));
    chatter.impacts(ring).into_iter().map(at).collect()
}

/// The last impact, of those of a chatter that is nearly complete at its release, after which the rest may begin in the signature,
/// and the times left until then. `None` if the chatter is not nearly complete.
fn nearly(frame: &MachineFrame<'_>, ring: &MachineRing, chatter: Chatter) -> Option<(usize, Vec<f64>)> {
    let decrease = decrease(restitution(frame.machine, chatter.stop)?);
    let limit = limit(decrease);
    let lefts = lefts(frame, ring, chatter)?;
    let impacts = chatter.impacts(ring);
    let near = |i: &usize| {
        let ratio = chatter.rebound(frame, ring, impacts[*i]).map(ratio);
        ratio.is_some_and(|ratio| (ratio / limit - 1.0).abs() < NEAR) && (0.0..SOON).contains(&lefts[*i])
    };
    let nearly: Vec<usize> = (0..impacts.len()).filter(near).collect();
    let last = *nearly.iter().find(|i| error(&lefts[..=**i], decrease) < ROUNDING).or(nearly.last())?;
    Some((impacts[last], lefts[..=last].to_vec()))
}

/// The error by the powers left out times the size of the gaps, for the times left at the last impacts of a chatter with this
/// decrease. The first power left out is the product of these times, and the gaps are as the cube of the last one and the square of
/// a flight.
fn error(lefts: &[f64], decrease: f64) -> f64 {
    let lefts = &lefts[lefts.len().saturating_sub(POWERS + 1)..];
    let flight = lefts.last().map_or(1.0, |left| left * left * left) * (1.0 - decrease) * (1.0 - decrease);
    (lefts.iter().product::<f64>() * flight).abs()
}

/// A chatter that is complete at its release.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CompleteChatter {
    chatter: Chatter,
    /// How many powers of the time left are eliminated.
    powers: usize,
}

impl CompleteChatter {
    /// The chatter on a stop that is most nearly complete at its release. In `ring` all such chatters, on any stop, lose the
    /// impacts that have little time left. `None` if there is none on this stop.
    pub(crate) fn shortened(frame: &MachineFrame<'_>, ring: &mut MachineRing, stop: usize) -> Option<Self> {
        let too_long = |ring: &MachineRing, chatter: Chatter| {
            let (k, _) = nearly(frame, ring, chatter)?;
            let next = (k + 1) % ring.len();
            (next != chatter.rest).then_some((chatter, next))
        };
        let mut other = ring.clone();
        while let Some((chatter, next)) = Chatter::all(&other).into_iter().find_map(|chatter| too_long(&other, chatter))
        {
            chatter.cut(frame, &mut other, next)?;
        }
        let own = Chatter::all(&other).into_iter().filter(|chatter| chatter.stop == stop);
        let nearly = own.filter_map(|chatter| Some((*nearly(frame, &other, chatter)?.1.last()?, chatter)));
        let (_, chatter) = nearly.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let own = Self::of(frame, &other, chatter)?;
        *ring = other;
        Some(own)
    }

    /// With as many powers as there are impacts with little time left.
    fn of(frame: &MachineFrame<'_>, ring: &MachineRing, chatter: Chatter) -> Option<Self> {
        let lefts = lefts(frame, ring, chatter)?;
        let soon = lefts.iter().rev().take_while(|left| (0.0..SOON).contains(*left)).count();
        Some(Self { chatter, powers: soon.checked_sub(1)?.min(POWERS) })
    }

    /// The last impacts with a rebound, one more than powers are eliminated.
    pub(crate) fn last(&self, ring: &MachineRing) -> Option<Vec<usize>> {
        let impacts = self.chatter.impacts(ring);
        Some(impacts.get(impacts.len().checked_sub(self.powers + 1)?..)?.to_vec())
    }

    /// What tells whether the chatter is complete at its release: the decrease, and speed, acceleration and jerk at its last rebounds.
    pub(crate) fn terms(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<Vec<f64>> {
        let mut terms = vec![decrease(restitution(frame.machine, self.chatter.stop)?)];
        for k in self.last(ring)? {
            let Rebound { speed, a, jerk } = self.chatter.rebound(frame, ring, k)?;
            terms.extend([speed, a, jerk]);
        }
        Some(terms)
    }

    /// A function of these terms that is zero where the chatter is complete at its release.
    pub(crate) fn of_terms(terms: &[f64]) -> f64 {
        let decrease = terms[0];
        let rebounds = terms[1..].chunks_exact(3).map(|own| Rebound { speed: own[0], a: own[1], jerk: own[2] });
        let mut apart: Vec<f64> = rebounds.map(|rebound| ratio(rebound) - limit(decrease)).collect();
        let mut power = 1.0;
        while apart.len() > 1 {
            power *= decrease;
            apart = apart.windows(2).map(|pair| pair[1] - power * pair[0]).collect();
        }
        apart[0]
    }

    /// The function.
    pub(crate) fn value(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<f64> {
        Some(Self::of_terms(&self.terms(frame, ring)?))
    }

    /// The rate by which the stop is pressed less at the last impact, as the jerk of the gap.
    pub(crate) fn jerk(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<f64> {
        Some(self.chatter.rebound(frame, ring, *self.last(ring)?.last()?)?.jerk)
    }

    /// This chatter and others that are complete at their releases where it is, as that in the other half of a symmetric cycle, in
    /// the order of the ring.
    fn together(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Vec<Self> {
        let all = Chatter::all(ring).into_iter();
        let all =
            all.filter_map(
                |chatter| if chatter == self.chatter { Some(self.clone()) } else { Self::of(frame, ring, chatter) },
            );
        all.filter(|other| other == self || other.value(frame, ring).is_some_and(|value| value.abs() < TOGETHER))
            .collect()
    }

    /// The first event that rounding can change, and the release: of all chatters that are complete at their releases.
    pub(crate) fn ends(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Vec<(usize, usize)> {
        let m = ring.len();
        let ends = |Self { chatter: Chatter { stop, rest }, .. }: &Self, first: Option<&usize>| {
            let of_stop = |k: &usize| ring.events[*k].guard == GuardKind::Reaction(*stop);
            Some((*first?, (1..m).map(|i| (rest + i) % m).find(of_stop)?))
        };
        self.together(frame, ring).iter().filter_map(|own| ends(own, own.last(ring)?.first())).collect()
    }

    /// The same where a chatter has one impact more or less, if the time left after the last one has become too long or too short
    /// along a curve. `None` if it fits, or if there is no other signature.
    pub(crate) fn adapted(&self, frame: &MachineFrame<'_>, ring: &mut MachineRing) -> Option<Self> {
        let phase = ring.places[self.chatter.rest].phase;
        for own in self.together(frame, ring) {
            let lefts = lefts(frame, ring, own.chatter)?;
            let decrease = decrease(restitution(frame.machine, own.chatter.stop)?);
            let error = |but: usize| error(&lefts[..lefts.len() - but], decrease);
            let other = if error(0) > ROUNDING * SLACK.1 {
                own.chatter.longer(frame, ring)?
            } else if lefts.len() > 1 && error(1) < ROUNDING * SLACK.0 {
                own.chatter.cut(frame, ring, *own.chatter.impacts(ring).last()?)?
            } else {
                continue;
            };
            let place = |chatter: &Chatter| ring.places[chatter.rest].phase == phase;
            let chatter = if own == *self { Some(other) } else { Chatter::all(ring).into_iter().find(place) };
            return Self::of(frame, ring, chatter?);
        }
        None
    }

    /// The value, near that of a solution with a rest after the chatter, at which a chatter on a stop is complete at its release.
    /// `None` if there is none close by.
    pub(super) fn value_of_number(old: &MachineEquations, at: &MachineSolution, stop: usize) -> Option<f64> {
        let (mut machine, mut ring) = old.split(&at.w)?;
        let sizes = at.known.cycle.as_ref()?.sizes;
        let (mut number, mut changes) = (last(&at.w), (0.0, 0.0));
        let mut own = Self::shortened(&MachineFrame::new(&machine), &mut ring, stop)?;
        for _ in 0..ADDED {
            let guess = MachineEquations::join(&machine, &ring, [number]);
            let equations = MachineEquations::new((&machine, old.family.clone()), ring, sizes, old.scales);
            let found = zero_near(&equations, &guess, MOST, |frame, ring| own.value(frame, ring));
            let Some(w) = found else { break };
            changes = (changes.1, (last(&w) - number).abs());
            number = last(&w);
            (machine, ring) = equations.split(&w)?;
            let frame = MachineFrame::new(&machine);
            let decrease = decrease(restitution(&machine, stop)?);
            if error(&lefts(&frame, &ring, own.chatter)?, decrease) < ROUNDING {
                return Some(number);
            }
            let longer = own.chatter.longer(&frame, &mut ring);
            let Some(longer) = longer.and_then(|chatter| Self::of(&frame, &ring, chatter)) else { break };
            own = longer;
        }
        // further impacts are so slow that rounding decides about them
        (changes.1 < SETTLED * changes.0).then_some(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of self-similar chatters the impacts of the cubic force.
    #[test]
    fn the_decrease_of_the_time_left() {
        assert!(decrease(1.0) == 1.0 && decrease(1e-30) < 1e-14);
        for e in [1e-6, 0.1, 0.5, 0.9, 0.999] {
            let l = decrease(e);
            let x = 1.0 - l;
            // the speeds of an impact before the rebound, and of the next one after it
            let (before, after) = (0.5 * x - x * x / 3.0, l * l * limit(l));
            assert!((e * before - after).abs() < 1e-15, "{e} {l}");
        }
    }
}
