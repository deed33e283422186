//! Places where the equations of a sheet are singular, and the distance that a trace keeps from them.

use super::seed::Seed;
use crate::continuation::curves::Frame;
use crate::continuation::equations::plane_equations::Condition;
use crate::system::{Oscillator, Side};

/// The cycle obtained when a cycle is shifted by half its period, and mirrored if the two halves are on opposite stops.
pub(crate) enum Partner {
    /// The same cycle: it is symmetric.
    Itself,
    /// Another cycle, with which it may merge; the two impacts whose speeds differ most, the faster one first.
    Other(usize, usize),
}

/// The partner of a seed; `None` if it cannot have one, or if it is about to merge with it.
pub(crate) fn partner(frame: &Frame, seed: &Seed) -> Option<Partner> {
    let (ring, m) = (&seed.ring, seed.ring.len());
    if !m.is_multiple_of(2) {
        return None;
    }
    let half = m / 2;
    let shifted = ring.periods.is_multiple_of(2) && (0..m).all(|k| ring.side(k) == ring.side(k + half));
    let alike = |osc: &Oscillator| osc.stop(Side::Lower).is_some_and(|lower| Some(lower) == osc.stop(Side::Upper));
    let alike = alike(&seed.osc) && frame.everywhere(&seed.osc, alike);
    let mirrored = alike && !ring.periods.is_multiple_of(2) && (0..m).all(|k| ring.side(k) != ring.side(k + half));
    if !(shifted || mirrored) {
        return None;
    }
    let more = |k: usize| ring.speed(k) - ring.speed(k + half);
    let k = (0..m).max_by(|&a, &b| more(a).total_cmp(&more(b)))?;
    if more(k) < 1e-6 {
        return Some(Partner::Itself);
    }
    // a cycle closer to merging than the bound has no side of it
    (more(k) > ASIDE).then_some(Partner::Other(k, (k + half) % m))
}

/// The least difference of speeds from a cycle with which it merges; the error of the parameters is about its square.
pub(crate) const ASIDE: f64 = 1e-3;

/// The frequencies that the trace of a cycle does not pass, as functions that are positive on the side of a seed at
/// `at`.
///
/// They exist without damping, where the n forcing periods of the cycle are a whole number of natural periods. There
/// the free response returns unchanged after one cycle, so the equations are singular where speeds vanish. With one
/// impact, the mass returns to the stop whatever its speed was, and the force does net work only at resonance. As such
/// a frequency is approached, the speed of every orbit vanishes at all gaps. With several impacts, their effects must
/// cancel: two impacts are equal and half a natural period apart, which is possible only at some gaps, and next to
/// these gaps the speeds vanish too.
pub(crate) fn walls(frame: &Frame, seed: &Seed, at: (f64, f64)) -> Vec<Condition> {
    use crate::system::Parameter::{Beta, InverseBeta};
    if seed.osc.damping() != 0.0 || !frame.everywhere(&seed.osc, |osc| osc.damping() == 0.0) {
        return Vec::new();
    }
    let n = f64::from(seed.ring.periods);
    let turns = n / seed.osc.beta();
    let whole = |step: f64, from: f64| {
        let k = if from == n { from + step } else { from };
        (k >= 1.0).then_some(k)
    };
    let near = [whole(-1.0, turns.floor()), whole(1.0, turns.floor() + 1.0)];
    let Some((first, second)) = frame.plane.parameters() else {
        // the frequency ratio is a function of both numbers, or of none
        let beta = seed.osc.beta();
        let wall = |k: f64| Condition::Frequency { side: (beta - n / k).signum(), beta: n / k, by: INWARDS * beta };
        return near.into_iter().flatten().map(wall).collect();
    };
    let mut walls = Vec::new();
    for (is_first, parameter, value, scale) in
        [(true, first, at.0, frame.scales().0), (false, second, at.1, frame.scales().1)]
    {
        for k in near.into_iter().flatten() {
            let wall = match parameter {
                InverseBeta => k / n,
                Beta => n / k,
                _ => continue,
            };
            let side = (value - wall).signum();
            let edge = side * wall + INWARDS * scale;
            walls.push(if is_first { Condition::Line(side, 0.0, edge) } else { Condition::Line(0.0, side, edge) });
        }
    }
    walls
}

/// The fraction of its ranges by which a frame is shortened if a trace along its edge fails, and the distance that is
/// kept from singular frequencies, in units of the scales.
pub(crate) const INWARDS: f64 = 1e-5;
