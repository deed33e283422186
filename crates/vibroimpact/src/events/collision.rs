//! What impacts do to the velocities, by the law of several impacts of the machine.
//!
//! | | together | in turn |
//! |---|---|---|
//! | 3 equal balls in contact, e = 1, the first one at speed 1 | -1/3, 2/3, 2/3 | 0, 0, 1 |
//! | 5 of them | -3/5, 2/5, 2/5, 2/5, 2/5 | 0, 0, 0, 0, 1 |
//! | bar on two feet, dropped flat | both feet rebound by e | the same |
//! | bar that rests on a foot and strikes with the other one | the foot at rest pushes so that it does not close | the foot at rest is struck next if the first impact makes it close, and rebounds by e |
//!
//! In turn, the impacts of one round are those of all stops that close, together; so a symmetric structure stays symmetric.
//! Each round is an impact by Moreau's law, which gains no energy, and the speeds of rounds fall unless the collision ends.
//! A ball that strikes one at rest on a wall pushes it into the wall, is struck again, and so on: infinitely many impacts whose
//! speeds fall as a geometric series. They act along the directions of their stops and leave all of these closed, so their sum is one
//! round without restitution.

use super::impulses::impulses;
use crate::machine::ImpactLaw;
use crate::math::add_scaled;

/// The largest number of rounds; what closes after them stays closed.
const ROUNDS: usize = 1000;
/// Closing speeds below this number of roundings of their terms are none.
const ROUNDINGS: f64 = 16.0;
/// Velocities that differ by more than this part of the largest one lead elsewhere.
const ANOTHER: f64 = 1e-9;

/// A stop that has been struck more often, at last more slowly than this part of the fastest, is struck without end.
const OFTEN: usize = 3;
const FADED: f64 = 1e-10;

/// Stops and the structure before their impacts: the velocities of the structure and of the gaps, and the restitutions.
#[derive(Clone, Copy)]
struct Struck<'a> {
    directions: &'a [&'a [f64]],
    v: &'a [f64],
    rates: &'a [f64],
    restitutions: &'a [f64],
}

/// The outcome of impacts.
pub(super) struct Collision {
    /// The velocities after them.
    pub(super) v: Vec<f64>,
    /// The impulse of each stop.
    pub(super) impulses: Vec<f64>,
    /// The energy that is lost at each stop.
    pub(super) losses: Vec<f64>,
    /// The stops that push in each round.
    pub(super) rounds: Vec<Vec<usize>>,
    /// Whether the last round is the sum of impacts without end, after which its stops stay closed.
    pub(super) ends_still: bool,
}

impl Collision {
    fn new(v: &[f64], stops: usize) -> Self {
        let still = vec![0.0; stops];
        Self { v: v.to_vec(), impulses: still.clone(), losses: still, rounds: Vec::new(), ends_still: false }
    }
}

/// The impacts on stops with these directions and restitutions, whose gaps have these velocities; `v` are the velocities of
/// the structure. `None` if stops close on it from two sides.
pub(super) fn collide(
    law: ImpactLaw,
    directions: &[&[f64]],
    v: &[f64],
    rates: &[f64],
    restitutions: &[f64],
) -> Option<Collision> {
    let mut collision = Collision::new(v, rates.len());
    let all: Vec<usize> = (0..rates.len()).collect();
    if law == ImpactLaw::Together {
        collision.round(directions, rates, restitutions, &all)?;
        return Some(collision);
    }
    collision.in_turn(Struck { directions, v, rates, restitutions }, None)?;
    Some(collision)
}

/// Whether the outcome of impacts on several stops at one time would be another one if one of the stops `struck` were struck
/// before the others, by however little.
pub(super) fn depends_on_order(
    outcome: &Collision,
    directions: &[&[f64]],
    v: &[f64],
    rates: &[f64],
    restitutions: &[f64],
    struck: usize,
) -> bool {
    let size = outcome.v.iter().chain(v).fold(0.0_f64, |most, v| most.max(v.abs()));
    (0..if struck > 1 { struck } else { 0 }).any(|first| {
        let mut other = Collision::new(v, rates.len());
        other.in_turn(Struck { directions, v, rates, restitutions }, Some(first)).is_none()
            || other.v.iter().zip(&outcome.v).any(|(one, other)| (one - other).abs() > ANOTHER * size)
    })
}

impl Collision {
    /// Impacts in turn, of all stops that close or of one stop first, until none closes.
    fn in_turn(&mut self, struck: Struck<'_>, first: Option<usize>) -> Option<()> {
        let Struck { directions, v, rates, .. } = struck;
        let mut speeds = vec![Vec::new(); rates.len()];
        let still = vec![0.0; rates.len()];
        let now = self.follow(struck, first, ROUNDS, &mut speeds)?;
        let size = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let fades = |k: &usize| speeds[*k].len() >= OFTEN && speeds[*k].last().is_some_and(|last| *last < FADED * size);
        let fading: Vec<usize> = (0..rates.len()).filter(fades).collect();
        if !fading.is_empty() {
            let ended = |round: &Vec<usize>| round.iter().any(|k| !fading.contains(k));
            let before = self.rounds.iter().rposition(ended).map_or(0, |last| last + 1);
            *self = Self::new(v, rates.len());
            let now = self.follow(struck, first, before, &mut speeds)?;
            self.round(directions, &now, &still, &fading)?;
            self.ends_still = true;
        } else if self.rounds.len() == ROUNDS {
            // the rest of the collision without restitution, so that it ends
            let all: Vec<usize> = (0..rates.len()).collect();
            self.round(directions, &now, &still, &all)?;
            self.ends_still = true;
        }
        Some(())
    }

    /// So many rounds at most, until no stop closes. Adds the speed of each impact to those of its stop; returns the velocities of the gaps
    /// after them.
    fn follow(
        &mut self,
        Struck { directions, v, rates, restitutions }: Struck<'_>,
        first: Option<usize>,
        most: usize,
        speeds: &mut [Vec<f64>],
    ) -> Option<Vec<f64>> {
        let size = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let mut now = rates.to_vec();
        for round in 0..most {
            let closes = |k: &usize| {
                // rounding errors of the rate: those of its terms, and of the rates before
                let terms = directions[*k].iter().zip(&self.v).map(|(w, v)| (w * v).abs()).sum::<f64>();
                now[*k] < -ROUNDINGS * f64::EPSILON * (size + terms)
            };
            let mut closing: Vec<usize> = (0..rates.len()).filter(closes).collect();
            if closing.is_empty() {
                break;
            }
            if round == 0
                && let Some(first) = first
            {
                closing.retain(|k| *k == first);
            }
            closing.iter().for_each(|k| speeds[*k].push(-now[*k]));
            self.round(directions, &now, restitutions, &closing)?;
            // from the change of velocities since the beginning, so that no rounding errors add up from round to round
            for (now, (w, rate)) in now.iter_mut().zip(directions.iter().zip(rates)) {
                let gained = self.v.iter().zip(v).map(|(after, before)| after - before);
                *now = rate - w.iter().zip(gained).map(|(w, gained)| w * gained).sum::<f64>();
            }
        }
        Some(now)
    }

    /// The impacts on some of the stops, together.
    fn round(&mut self, directions: &[&[f64]], rates: &[f64], restitutions: &[f64], stops: &[usize]) -> Option<()> {
        let of = |all: &[f64]| stops.iter().map(|k| all[*k]).collect::<Vec<f64>>();
        let along: Vec<&[f64]> = stops.iter().map(|k| directions[*k]).collect();
        let found = impulses(&along, &of(rates), &of(restitutions))?;
        let before = self.v.clone();
        // a stop does not pull
        let pushing: Vec<(usize, f64)> =
            stops.iter().copied().zip(found).filter(|(_, impulse)| *impulse > 0.0).collect();
        for (k, impulse) in &pushing {
            add_scaled(&mut self.v, -impulse, directions[*k]);
            self.impulses[*k] += impulse;
        }
        for (k, impulse) in &pushing {
            let gained: f64 =
                directions[*k].iter().zip(self.v.iter().zip(&before)).map(|(w, (v, before))| w * (v - before)).sum();
            // the mean of the velocities of the gap before and after
            self.losses[*k] -= impulse * (rates[*k] - 0.5 * gained);
        }
        self.rounds.push(pushing.into_iter().map(|(k, _)| k).collect());
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::dot;

    /// A row of equal balls in contact, the first one at speed 1: the velocities after, for both laws.
    fn row(count: usize, e: f64, law: ImpactLaw) -> Vec<f64> {
        let unit = |i: usize, sign: f64| {
            (0..count).map(move |k| {
                if k == i {
                    sign
                } else if k == i + 1 {
                    -sign
                } else {
                    0.0
                }
            })
        };
        let contacts: Vec<Vec<f64>> = (0..count - 1).map(|i| unit(i, 1.0).collect()).collect();
        let directions: Vec<&[f64]> = contacts.iter().map(Vec::as_slice).collect();
        let mut v = vec![0.0; count];
        v[0] = 1.0;
        let mut rates = vec![0.0; count - 1];
        rates[0] = -1.0;
        let after = collide(law, &directions, &v, &rates, &vec![e; count - 1]).unwrap();
        let sum = |v: &[f64]| (v.iter().sum::<f64>(), dot(v, v));
        assert!((sum(&after.v).0 - 1.0).abs() < 1e-14, "momentum");
        assert!(sum(&after.v).1 <= 1.0 + 1e-14 && (e < 1.0 || sum(&after.v).1 > 1.0 - 1e-14), "energy");
        after.v
    }

    #[test]
    fn rows_of_balls() {
        let close = |found: Vec<f64>, want: &[f64]| {
            assert!(found.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?} {want:?}");
        };
        close(row(3, 1.0, ImpactLaw::Together), &[-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]);
        close(row(5, 1.0, ImpactLaw::Together), &[-0.6, 0.4, 0.4, 0.4, 0.4]);
        close(row(3, 1.0, ImpactLaw::InTurn), &[0.0, 0.0, 1.0]);
        close(row(5, 1.0, ImpactLaw::InTurn), &[0.0, 0.0, 0.0, 0.0, 1.0]);
        // a ball at rest on a wall, which is the last contact, has it pushed into the wall by the first ones for ever
        let wall: [&[f64]; 2] = [&[1.0, -1.0], &[0.0, 1.0]];
        let found = collide(ImpactLaw::InTurn, &wall, &[1.0, 0.0], &[-1.0, 0.0], &[0.0, 0.5]).unwrap();
        assert!(found.v == [0.0, 0.0] && found.rounds == [[0, 1]] && found.ends_still, "{:?}", found.v);
        // restitution 1/2: binary impacts 1/4, 3/4, and again, until none closes
        let found = row(3, 0.5, ImpactLaw::InTurn);
        close(found, &[0.203_125, 0.234_375, 0.562_5]);
    }

    /// A bar on two feet: dropped flat it rebounds flat by both laws; with one foot at rest the laws differ.
    #[test]
    fn bar_on_two_feet() {
        let feet: [&[f64]; 2] = [&[-1.0, 1.0], &[-1.0, -1.0]];
        for law in [ImpactLaw::Together, ImpactLaw::InTurn] {
            let flat = collide(law, &feet, &[-1.0, 0.0], &[-1.0, -1.0], &[0.5, 0.5]).unwrap();
            assert_eq!(flat.v, [0.5, 0.0]);
            // these feet are centres of percussion of each other: an impact on one does not move the other
            assert!(!depends_on_order(&flat, &feet, &[-1.0, 0.0], &[-1.0, -1.0], &[0.5, 0.5], 2));
            // others make it turn, if they are struck one after the other
            let near: [&[f64]; 2] = [&[-1.0, 0.8], &[-1.0, -0.8]];
            let flat = collide(law, &near, &[-1.0, 0.0], &[-1.0, -1.0], &[0.5, 0.5]).unwrap();
            assert!(depends_on_order(&flat, &near, &[-1.0, 0.0], &[-1.0, -1.0], &[0.5, 0.5], 2));
        }
        // it turns about the left foot, and the right one strikes; slim bars have a moment of inertia below one
        let inertia = 0.6_f64.sqrt();
        let feet: [&[f64]; 2] = [&[-1.0, 1.0 / inertia], &[-1.0, -1.0 / inertia]];
        let v = [-0.5, -0.5 * inertia];
        let rates: Vec<f64> = feet.iter().map(|w| -dot(w, &v)).collect();
        let of = |law| collide(law, &feet, &v, &rates, &[0.5, 0.5]).unwrap();
        let (together, turn) = (of(ImpactLaw::Together), of(ImpactLaw::InTurn));
        for found in [&together, &turn] {
            assert!(feet.iter().all(|w| -dot(w, &found.v) > -1e-15) && dot(&found.v, &found.v) <= dot(&v, &v));
        }
    }
}
