//! The time of impacts that accumulate on several stops without a round that repeats itself.
//!
//! The gaps are followed by themselves: they are known to all their digits then, however small they become, and under accelerations
//! that do not change in so short a time each next impact has a closed form.

use super::collapse::SOON;
use super::instants::BELOW;
use super::motion::Motion;
use crate::machine::StopLaw;
use crate::math::dot;
use crate::regime::Orthonormal;
use std::collections::VecDeque;

/// The most impacts of a collapse that are followed by gaps alone, and for how many on each stop no time may pass at the end.
const STEPS: usize = 20_000;
const LAST: usize = 16;

impl Motion<'_> {
    /// The time after which impacts on these stops have accumulated, one after another, if they do so soon. Their gaps are
    /// followed by themselves under the accelerations here: so they have all digits, however small they become.
    pub(super) fn collapse_time(&mut self, stops: &[usize]) -> Option<f64> {
        let free = self.structures.get(self.machine, &self.normal, &self.place.states)?;
        let flight = self.place.flight(&self.normal, free.clone());
        let turns = self.place.turns(&self.normal);
        let directions = &self.normal.directions;
        // what rests and holds stays so: impulses act beside it
        let kept = Orthonormal::spanning(free.held.iter().map(|at| &directions[*at]));
        let along: Vec<Vec<f64>> = stops.iter().map(|j| kept.beside(&directions[*j])).collect::<Option<_>>()?;
        let gaps = stops.iter().map(|j| {
            let StopLaw::Rigid { restitution } = self.machine.stops()[*j].law else { return None };
            let (gap, rate) = self.place.gap_and_rate(&self.normal, &turns, *j);
            let gap = self.exact_gap(*j).unwrap_or(gap).max(0.0);
            let acceleration = flight.first(&free.gap(&self.normal, *j).1).1;
            Some(FreeGap { gap, rate, acceleration, restitution })
        });
        let mut gaps: Vec<FreeGap> = gaps.collect::<Option<_>>()?;
        let limit = if free.fastest() > 0.0 { SOON / free.fastest() } else { f64::INFINITY };
        let rounding = BELOW * f64::EPSILON * self.instants.longest();
        let last = LAST * stops.len();
        let (mut time, mut recent) = (0.0, VecDeque::from(vec![0.0; last]));
        for step in 0..STEPS {
            // the stop that is struck next
            let (k, s) = gaps
                .iter()
                .enumerate()
                .filter_map(|(k, own)| Some((k, own.closes_after()?)))
                .min_by(|one, other| one.1.total_cmp(&other.1))?;
            time += s;
            gaps.iter_mut().for_each(|own| own.advance(s));
            let own = &mut gaps[k];
            own.gap = 0.0;
            // by restitution, and the other gaps by their share of the same impulse
            let change = -(1.0 + own.restitution) * own.rate;
            let square = dot(&along[k], &along[k]);
            for (own, w) in gaps.iter_mut().zip(&along) {
                own.rate += dot(w, &along[k]) / square * change;
            }
            // the time so many impacts ago: when none passes between, the impacts have accumulated
            recent.push_back(time);
            let before = recent.pop_front()?;
            // too late for accelerations that do not change
            if time > limit {
                return None;
            }
            if step > last && time - before <= rounding.max(BELOW * f64::EPSILON * time) {
                return Some(time);
            }
        }
        None
    }
}

/// A gap that moves freely under a constant acceleration.
#[derive(Clone, Copy, Debug)]
struct FreeGap {
    gap: f64,
    rate: f64,
    acceleration: f64,
    restitution: f64,
}

impl FreeGap {
    /// The time after which it closes.
    fn closes_after(&self) -> Option<f64> {
        let Self { gap, rate, acceleration: a, .. } = *self;
        // the form in which nothing cancels, for a gap that opens and for one that closes
        let root = (rate * rate - 2.0 * a * gap).sqrt();
        let time = if rate > 0.0 { (rate + root) / -a } else { 2.0 * gap / (root - rate) };
        (time >= 0.0 && time.is_finite()).then_some(time)
    }

    fn advance(&mut self, s: f64) {
        // rounding errors do not take it beyond
        self.gap = (self.gap + s * (self.rate + 0.5 * self.acceleration * s)).max(0.0);
        self.rate += self.acceleration * s;
    }
}
