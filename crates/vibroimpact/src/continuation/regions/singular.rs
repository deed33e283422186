//! Where the equations of a sheet are singular, and what keeps a walk off.

use super::seed::Seed;
use crate::continuation::curves::Frame;
use crate::continuation::equations::plane_equations::Condition;
use crate::system::Side;

/// What a cycle becomes when half of it is shifted onto the other half, on the same stops or mirrored.
pub(crate) enum Partner {
    /// The same: it is symmetric.
    Itself,
    /// Another, which it may merge with; the impacts that differ most in speed, the faster one first.
    Other(usize, usize),
}

/// The partner of a seed, if it can have one.
pub(crate) fn partner(frame: &Frame, seed: &Seed) -> Option<Partner> {
    use crate::system::Parameter::{Gap, Restitution, SecondGap, SecondRestitution};
    let (ring, m) = (&seed.ring, seed.ring.len());
    if !m.is_multiple_of(2) {
        return None;
    }
    let half = m / 2;
    let shifted = ring.periods.is_multiple_of(2) && (0..m).all(|k| ring.side(k) == ring.side(k + half));
    let unequal = |p| matches!(p, Gap | Restitution | SecondGap | SecondRestitution);
    let alike = seed.osc.stop(Side::Lower).is_some_and(|lower| Some(lower) == seed.osc.stop(Side::Upper))
        && !unequal(frame.parameters.0)
        && !unequal(frame.parameters.1);
    let mirrored = alike && !ring.periods.is_multiple_of(2) && (0..m).all(|k| ring.side(k) != ring.side(k + half));
    if !(shifted || mirrored) {
        return None;
    }
    let more = |k: usize| ring.speed(k) - ring.speed(k + half);
    let k = (0..m).max_by(|&a, &b| more(a).total_cmp(&more(b)))?;
    if more(k) < 1e-6 {
        return Some(Partner::Itself);
    }
    // one that is nearer to merging than the bound lies on no side of it
    (more(k) > ASIDE).then_some(Partner::Other(k, (k + half) % m))
}

/// How far from merging, in speed, a walk stays; the parameters are off by about its square.
pub(crate) const ASIDE: f64 = 1e-3;

/// Frequencies beyond which a cycle does not go, each positive on the side of a seed at `at`.
///
/// Where, without damping, whole natural periods go into the n of the cycle, a blow is felt in full when the cycle is over. One
/// impact is back on the stop whatever its speed was, and at resonance only has the force done work: as such a frequency
/// is approached every orbit loses its speed, at all gaps at once. Several impacts must cancel each other: two are alike and
/// half a natural period apart, which only some gaps allow, and beside these they lose their speed as well. Either way the
/// equations are singular where speeds vanish.
pub(crate) fn walls(frame: &Frame, seed: &Seed, at: (f64, f64)) -> Vec<Condition> {
    use crate::system::Parameter::{Beta, Damping, InverseBeta};
    let (first, second) = frame.parameters;
    if seed.osc.damping() != 0.0 || first == Damping || second == Damping {
        return Vec::new();
    }
    let n = f64::from(seed.ring.periods);
    let turns = n / seed.osc.beta();
    let whole = |step: f64, from: f64| {
        let k = if from == n { from + step } else { from };
        (k >= 1.0).then_some(k)
    };
    let near = [whole(-1.0, turns.floor()), whole(1.0, turns.floor() + 1.0)];
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

/// Share of its ranges by which a frame is shrunk where a walk along its edge is lost, and by which singular frequencies are
/// kept off.
pub(crate) const INWARDS: f64 = 1e-5;
