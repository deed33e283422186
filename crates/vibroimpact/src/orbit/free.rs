//! The steady motion without impacts, as a cycle with no impact.
//!
//! With damping every motion that stays clear of the stops tends to $`x = S\sin\theta + C\cos\theta`$,
//! $`S = (1-\beta^2)f^2`$, $`C = -2\zeta\beta f^2`$. This motion is admissible while $`|f|`$ exceeds no gap. Its
//! multipliers are those of the free oscillator over one forcing period,
//! $`e^{-2\pi\zeta/\beta}e^{\pm 2\pi i\sqrt{1-\zeta^2}/\beta}`$.

use super::cycle::Cycle;
use super::label::Label;
use crate::math::{Multiplier, asin, atan2, exp, sin_cos, sort_by};
use crate::system::{Oscillator, Side, phase};
use core::f64::consts::{FRAC_PI_2, PI};

/// The steady motion of `osc` without impacts: a cycle with the label 0 and no points. `None` without damping, where it
/// is one of many motions without impacts and attracts none of them.
///
/// [`earlier_contact`](super::earlier_contact) decides whether it is admissible.
///
/// ```
/// use vibroimpact::{Oscillator, orbit};
/// let osc = Oscillator::new(1.0, 12.0, 0.8)?.with_damping(0.05)?;
/// let cycle = orbit::without_impacts(&osc).expect("it is damped");
/// assert!(cycle.points.is_empty() && cycle.stable());
/// assert!(orbit::earlier_contact(&osc, &cycle).is_none());
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn without_impacts(osc: &Oscillator) -> Option<Cycle> {
    (osc.damping() > 0.0).then(|| Cycle {
        label: Label::new(0, 1),
        points: Vec::new(),
        rests: Vec::new(),
        multipliers: multipliers(osc),
        residual: 0.0,
    })
}

/// Its multipliers, the larger first.
pub(super) fn multipliers(osc: &Oscillator) -> [Multiplier; 2] {
    let (zeta, period) = (osc.damping(), osc.period());
    let real = |rate: f64| Multiplier { re: exp(rate * period), im: 0.0 };
    if zeta >= 1.0 {
        // the slow rate as a quotient, because the difference would lose digits
        let fast = zeta + ((zeta - 1.0) * (zeta + 1.0)).sqrt();
        return [real(-1.0 / fast), real(-fast)];
    }
    let size = exp(-zeta * period);
    let (sin, cos) = sin_cos(((1.0 - zeta) * (1.0 + zeta)).sqrt() * period);
    [1.0, -1.0].map(|sign| Multiplier { re: size * cos, im: sign * size * sin })
}

/// Its distance from the stop on `side`; negative if it passes the stop, infinite if there is no such stop.
pub(crate) fn room(osc: &Oscillator, side: Side) -> f64 {
    osc.stop(side).map_or(f64::INFINITY, |stop| stop.gap - osc.free_amplitude())
}

/// $`\delta^2/f^2 - 1`$ for the stop on `side`: negative if the motion passes the stop, and 0 if it grazes it.
///
/// Where $`\delta|f|^{-1} = 1`$ exactly, this is 0. It is also 0 if the gap differs from the amplitude by no more than
/// the rounding error of the amplitude, which is a few operations of half a unit in the last place each.
pub(super) fn excess(osc: &Oscillator, side: Side) -> f64 {
    let Some(stop) = osc.stop(side) else { return f64::INFINITY };
    let (gap, amplitude) = (stop.gap.abs(), osc.free_amplitude());
    let off = gap - amplitude;
    if amplitude == f64::INFINITY {
        return -1.0;
    }
    if off.abs() <= ROUNDING * amplitude { 0.0 } else { (off / amplitude) * (gap / amplitude + 1.0) }
}

/// The phase at which it is closest to the stop on `side`.
pub(crate) fn crest(osc: &Oscillator, side: Side) -> f64 {
    let beta = osc.beta();
    let upper = atan2((1.0 - beta) * (1.0 + beta), -2.0 * osc.damping() * beta);
    phase::wrap(if side == Side::Upper { upper } else { upper + PI })
}

/// If it is inadmissible, the first stop that it reaches from phase 0 on, and the time; grazing to rounding does not
/// count.
pub(super) fn met(osc: &Oscillator) -> Option<(Side, f64)> {
    let beyond = |side: &Side| room(osc, *side) < -ROUNDING * osc.free_amplitude();
    let mut met: Vec<(Side, f64)> = osc
        .stops()
        .map(|(side, _)| side)
        .filter(beyond)
        .map(|side| {
            let gap = osc.stop(side).map_or(0.0, |stop| stop.gap);
            // f cos(theta - crest) rises through the gap this long before the crest
            let ahead = FRAC_PI_2 - asin((gap / osc.free_amplitude()).clamp(-1.0, 1.0));
            (side, phase::wrap(crest(osc, side) - ahead) / osc.beta())
        })
        .collect();
    sort_by(&mut met, |a, b| a.1.total_cmp(&b.1));
    met.first().copied()
}

/// The rounding error of the amplitude, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::eigenvalues;
    use crate::orbit::{EarlierContact, earlier_contact};
    use crate::system::Start;

    fn at(beta: f64, gap: f64, zeta: f64) -> Oscillator {
        Oscillator::new(beta, gap, 0.5).unwrap().with_damping(zeta).unwrap()
    }

    /// Against the free response over a period, from its trace.
    #[test]
    fn multipliers_are_those_of_the_free_oscillator() {
        for (beta, zeta) in [(0.3, 0.01), (1.0, 0.05), (2.7, 0.6), (1.3, 1.0), (1.3, 1.4), (6.0, 3.0)] {
            let osc = at(beta, 1.0, zeta);
            let p = osc.response().at(osc.period());
            let expected = eigenvalues(p.c + p.s_rate, exp(-2.0 * zeta * osc.period()));
            for (a, b) in multipliers(&osc).iter().zip(expected) {
                // a double multiplier is accurate only to the square root of rounding
                let tolerance = if zeta == 1.0 { 1e-7 } else { 1e-13 };
                assert!((a.re - b.re).abs() < tolerance && (a.im.abs() - b.im.abs()).abs() < tolerance, "{a:?} {b:?}");
            }
        }
        assert_eq!(without_impacts(&at(0.5, 2.0, 0.0)), None);
    }

    #[test]
    fn it_meets_a_stop_where_its_curve_does() {
        for (beta, gap, zeta) in [(0.8, 1.5, 0.1), (1.0, 3.0, 0.05), (1.6, 0.2, 0.3), (1.2, -0.4, 0.2)] {
            let osc = at(beta, gap, zeta).with_second_stop(gap.abs() + 0.1, 0.5).unwrap();
            let cycle = without_impacts(&osc).unwrap();
            let Some(EarlierContact { side, time, .. }) = earlier_contact(&osc, &cycle) else { panic!("{osc:?}") };
            // along the motion itself, from far stops
            let far = at(beta, 100.0, zeta);
            let flight = crate::flight::Flight::new(&far, Start::free_motion(&far).unwrap());
            let stop = side.sign() * osc.stop(side).unwrap().gap;
            let point = flight.state(time);
            assert!((point.0 - stop).abs() < 1e-13 && side.sign() * point.1 > 0.0, "{point:?} {stop}");
            assert!((flight.state(crest(&osc, side) / beta).0 - side.sign() * osc.free_amplitude()).abs() < 1e-13);
        }
        let wide = at(1.0, 10.0, 0.05);
        assert_eq!(earlier_contact(&wide, &without_impacts(&wide).unwrap()), None);
    }
}
