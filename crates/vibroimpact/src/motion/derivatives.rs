//! The derivatives of the impact map at successive impacts, side by side, with the same bits as one by one.

use super::ImpactState;
use super::impact_map::{Passage, derivative};
use crate::lanes::{Task, Width};
use crate::math::{Lane, Matrix2};
use crate::system::{Oscillator, decay};

/// The largest number of impacts side by side.
pub(crate) const ABREAST: usize = 16;
/// Fewer impacts than this are faster one by one.
const FEW: usize = 3;
/// The longest time, and the largest angle of the force, for the sine and cosine in lanes.
const LONGEST: f64 = 1e5;

/// Numbers of each impact.
type Column = [f64; ABREAST];

/// The derivatives from each impact to the next: from `first` to the first of the others, and so on. Those beyond the
/// last impact have no meaning. `others` are at most [`ABREAST`], each with the time since the impact before.
pub(crate) fn derivatives(osc: &Oscillator, first: &ImpactState, others: &[(ImpactState, f64)]) -> [Matrix2; ABREAST] {
    if others.len() < FEW {
        let (mut all, mut before) = ([Matrix2::IDENTITY; ABREAST], first);
        for (one, (next, interval)) in all.iter_mut().zip(others) {
            *one = derivative(osc, before, next, *interval);
            before = next;
        }
        return all;
    }
    with(Width::best(), osc, first, others)
}

fn with(width: Width, osc: &Oscillator, first: &ImpactState, others: &[(ImpactState, f64)]) -> [Matrix2; ABREAST] {
    let mut columns = Columns {
        osc,
        at: [[0.0; ABREAST]; 7],
        times: [0.0; ABREAST],
        by: Responses::Undamped,
        known: [[0.0; ABREAST]; 4],
    };
    let mut before = first;
    for (k, (next, interval)) in others.iter().enumerate().take(ABREAST) {
        let restitution = osc.stop(before.side).map_or(0.0, |stop| stop.restitution);
        let gap = osc.stop(next.side).map_or(0.0, |stop| stop.gap);
        let numbers = [before.phase, before.side.sign(), restitution, next.phase, next.side.sign(), gap, next.velocity];
        columns.at.iter_mut().zip(numbers).for_each(|(column, number)| column[k] = number);
        columns.times[k] = *interval;
        before = next;
    }
    let (count, times) = (others.len().min(ABREAST), columns.times);
    // in lanes sines are exact up to this angle only, and there is no free motion without oscillation
    let long = times.iter().any(|time| time * osc.beta().max(1.0) > LONGEST);
    if long || osc.damping() >= 1.0 {
        columns.by = Responses::Alone;
        for (k, time) in times.into_iter().enumerate().take(count) {
            let p = osc.response().at(time);
            columns.know(k, [p.kc, p.ks, p.s, p.s_rate]);
        }
    } else if osc.damping() > 0.0 {
        columns.by = Responses::Damped;
        // the exponential has no lanes: it is computed one by one
        for (k, time) in times.into_iter().enumerate().take(count) {
            let (kept, loss) = decay(osc.damping() * time);
            columns.know(k, [kept, loss, 0.0, 0.0]);
        }
    }
    let elements = width.run(columns);
    core::array::from_fn(|k| {
        let [[a, b], [c, d]] = elements;
        Matrix2([[a[k], b[k]], [c[k], d[k]]])
    })
}

/// The impacts as columns.
struct Columns<'a> {
    osc: &'a Oscillator,
    /// The numbers of [`Passage`].
    at: [Column; 7],
    times: Column,
    by: Responses,
    /// What is computed one by one of the responses.
    known: [Column; 4],
}

/// How the responses after each time are computed.
#[derive(Clone, Copy)]
enum Responses {
    /// In lanes, without damping.
    Undamped,
    /// In lanes, from the decay: $`e^{-\zeta s}`$ and $`1 - e^{-\zeta s}`$ are known.
    Damped,
    /// One by one: $`K_c`$, $`K_s`$, $`S`$ and $`S'`$ are known.
    Alone,
}

impl Columns<'_> {
    /// Keeps numbers of impact `k`.
    fn know(&mut self, k: usize, numbers: [f64; 4]) {
        self.known.iter_mut().zip(numbers).for_each(|(column, number)| column[k] = number);
    }
}

impl Task for Columns<'_> {
    /// The elements of the derivatives.
    type Output = [[Column; 2]; 2];

    #[inline(always)]
    fn run<L: Lane>(self) -> Self::Output {
        let mut all = Self::Output::default();
        let mut k = 0;
        // loops, because a closure is not always compiled for the processor's instructions
        while k < ABREAST {
            let [phase, side, restitution, next_phase, next_side, next_gap, speed] = &self.at;
            let at = Passage {
                phase: L::load(&phase[k..]),
                side: L::load(&side[k..]),
                restitution: L::load(&restitution[k..]),
                next_phase: L::load(&next_phase[k..]),
                next_side: L::load(&next_side[k..]),
                next_gap: L::load(&next_gap[k..]),
                speed: L::load(&speed[k..]),
            };
            let (times, response) = (L::load(&self.times[k..]), self.osc.response());
            let [a, b, c, d] = &self.known;
            let known = [L::load(&a[k..]), L::load(&b[k..]), L::load(&c[k..]), L::load(&d[k..])];
            let response = match self.by {
                Responses::Undamped => {
                    let p = response.undamped(times);
                    [p.kc, p.ks, p.s, p.c]
                }
                Responses::Damped => {
                    let p = response.damped(times, (known[0], known[1]));
                    [p.kc, p.ks, p.free.s, p.free.s_rate]
                }
                Responses::Alone => known,
            };
            let elements = Passage::elements(self.osc, &at, response);
            let mut row = 0;
            while row < 2 {
                elements[row][0].store(&mut all[row][0][k..]);
                elements[row][1].store(&mut all[row][1][k..]);
                row += 1;
            }
            k += L::WIDTH;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::SearchLimits;
    use crate::motion::{Mapped, impact_map};
    use crate::system::Side;

    #[test]
    fn side_by_side_as_one_by_one() {
        for (beta, gap, eps, zeta, lower) in [
            (0.9, 2.0, 0.5, 0.0, None),
            (0.3, 0.3, 0.8, 0.0, None),
            (2.7, 0.3, 0.8, 0.0, Some(0.7)),
            (1.0, 1.0, 0.4, 0.0, None),
            (0.7, 0.6, 0.7, 0.1, Some(0.8)),
            (2.7, 0.1, 0.8, 0.05, Some(0.1)),
            (0.3, 0.1, 0.8, 0.01, Some(0.2)),
            (0.9, 0.1, 0.9, 0.7, None),
            (1.3, 0.2, 0.9, 1.2, Some(0.1)),
            (1e-6, 0.2, 0.9, 0.0, None),
        ] {
            let mut osc = Oscillator::new(beta, gap, eps).unwrap().with_damping(zeta).unwrap();
            if let Some(gap) = lower {
                osc = osc.with_second_stop(gap, 0.6).unwrap();
            }
            let first = ImpactState { phase: 1.2, velocity: 1.9, side: Side::Upper };
            let (mut last, mut others) = (first, Vec::new());
            while others.len() < ABREAST {
                let Mapped::Impact { state, interval } = impact_map(&osc, &last, SearchLimits::default()) else {
                    break;
                };
                others.push((state, interval));
                last = state;
            }
            assert!(!others.is_empty(), "{osc:?}");
            for width in Width::ALL.into_iter().filter(|width| width.available()) {
                let mut before = first;
                let together = with(width, &osc, &first, &others);
                for ((next, interval), got) in others.iter().zip(together) {
                    assert_eq!(got, derivative(&osc, &before, next, *interval), "{width:?} {osc:?}");
                    before = *next;
                }
            }
        }
    }
}
