//! The motion of neighbours of an oscillator: the derivative of a flight, its jump at an impact, and two tangent vectors.
//!
//! A neighbour is described by its difference $`(\mathrm dx, \mathrm dv)`$ at the same time. In flight the force
//! cancels, and
//!
//! $$`\Phi(s) = \begin{pmatrix} C & S \\ -S & C - 2\zeta S \end{pmatrix}, \qquad \det\Phi = e^{-2\zeta s}.`$$
//!
//! At an impact on the stop at $`x = \sigma\delta`$ the neighbour is late by $`\mathrm dt = -\mathrm dx_-/v_-`$. It
//! arrives with $`v_- + \mathrm dv_- + a_-\,\mathrm dt`$ and leaves with $`-\varepsilon`$ times this velocity. It is
//! compared at the time of the impact again, $`\mathrm dt`$ back along the rebound, whose acceleration is $`a_+`$. As
//! $`a_+ + \varepsilon a_- = (1+\varepsilon)(\sin\theta - \sigma\delta)`$, the damping cancels, and the *saltation
//! matrix* is
//!
//! $$`\mathsf S = \begin{pmatrix} -\varepsilon & 0 \\ (1+\varepsilon)\,\dfrac{\sin\theta - \sigma\delta}{v_-} & -\varepsilon
//!   \end{pmatrix}, \qquad \det\mathsf S = \varepsilon^2`$$
//!
//! (P. Müller, Chaos Solitons Fractals 5 (1995) 1671-1681, doi:10.1016/0960-0779(94)00170-U). Both determinants are
//! exact from impact to impact. A gentle impact has a large stretch, but the coordinates stay regular, whereas phase and
//! arrival speed are singular at grazing. At a grazing contact there is no derivative ($`v_- \to 0`$) and no effect on the
//! motion; it is passed as a part of the flight. When the mass sticks, all neighbours become the same motion, and the
//! derivative beyond is zero.

use super::frame::{Frame, Stretch};
use crate::events::Metric;
use crate::math::{Matrix2, ln, sin_cos};
use crate::motion::ImpactState;
use crate::system::Oscillator;

/// $`\Phi(s)`$: the derivative of the state `(x, v)` after a flight of time `s` with respect to the state at its
/// beginning.
#[must_use]
pub fn flight(osc: &Oscillator, s: f64) -> Matrix2 {
    let p = osc.response().at(s);
    Matrix2([[p.c, p.s], [-p.s, p.s_rate]])
}

/// The saltation matrix: the derivative of `(x, v)` just after the impact `at` with respect to that just before.
///
/// At speed 0 the derivative does not exist, and elements are infinite or NaN.
#[must_use]
pub fn saltation(osc: &Oscillator, at: &ImpactState) -> Matrix2 {
    let (sign, stop) = (at.side.sign(), osc.stop(at.side));
    let (gap, eps) = stop.map_or((0.0, 0.0), |stop| (stop.gap, stop.restitution));
    let force = sin_cos(at.phase).0 - sign * gap;
    Matrix2([[-eps, 0.0], [(1.0 + eps) * force / (sign * at.velocity), -eps]])
}

/// The longest piece of a flight that is taken in one step. Over it the more slowly decaying of two exponentials, at
/// most $`e^{-s}`$, stays far above the smallest number.
const LONGEST: f64 = 300.0;
/// The largest number of pieces of a flight. A search ends after a thousand periods, so more are needed only if the
/// force is slower than the oscillator by a factor of a thousand.
const MOST_PIECES: f64 = 1000.0;
/// If the quotient of the two stretches is below this, the smaller one, computed from the area between nearly parallel
/// vectors, has lost ten of its digits. It is then computed from the exact change of area.
const NARROW: f64 = 1e-10;

/// The tangent vectors of an oscillator at the beginning: both unit vectors of `(x, v)`, whose lengths are those of the plane.
pub(crate) fn frame() -> Frame {
    Frame::new(2, Metric::default(), 2)
}

/// Moves the tangent vectors through a flight of time `s` and the impact `at` at its end; returns the logarithm of the exact change
/// of area. These 2 x 2 maps take a tenth of the time of the general ones of a machine, and their area has all its digits.
pub(crate) fn through(frame: &mut Frame, osc: &Oscillator, s: f64, at: &ImpactState) -> f64 {
    let pieces = (s / LONGEST).ceil().clamp(1.0, MOST_PIECES);
    let length = s / pieces;
    let (piece, decay) = (flight(osc, length), -2.0 * osc.damping() * length);
    let mut left = pieces;
    while left > 1.0 {
        frame.carry(|vectors, _| carried(vectors, piece, decay));
        left -= 1.0;
    }
    let eps = osc.stop(at.side).map_or(0.0, |stop| stop.restitution);
    // only touched: passed as a part of the flight
    let (jump, area) = if at.velocity == 0.0 {
        (Matrix2::IDENTITY, 0.0)
    } else {
        (saltation(osc, at), if eps > 0.0 { 2.0 * ln(eps) } else { f64::NEG_INFINITY })
    };
    frame.carry(|vectors, _| carried(vectors, jump.times(piece), area + decay));
    area + decay * pieces
}

/// Applies a linear map to two perpendicular vectors, whose change of area has the logarithm `area`, and makes them orthonormal
/// again; returns their stretches. Vectors that vanish are removed.
fn carried(vectors: &mut Vec<Vec<f64>>, map: Matrix2, area: f64) -> [Stretch; 2] {
    let [first, second] = [0, 1].map(|k| map.apply([vectors[k][0], vectors[k][1]]));
    let along = (first[0] * first[0] + first[1] * first[1]).sqrt();
    // the mass sticks: all neighbours become one motion
    if along == 0.0 || !along.is_finite() {
        vectors.clear();
        return [Stretch::By(0.0); 2];
    }
    let [x, v] = [first[0] / along, first[1] / along];
    vectors[0].copy_from_slice(&[x, v]);
    if area == f64::NEG_INFINITY {
        vectors.truncate(1);
        return [Stretch::By(along), Stretch::By(0.0)];
    }
    vectors[1].copy_from_slice(&[-v, x]);
    let across = (x * second[1] - v * second[0]).abs();
    // where the second vector has turned into the first, its stretch is known from the area alone
    [Stretch::By(along), if across > NARROW * along { Stretch::By(across) } else { Stretch::Log(area - ln(along)) }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Side;

    /// Under heavy damping the two vectors are parallel to all digits, and after long flights both underflow. The
    /// stretches are still those of the two real exponents.
    #[test]
    fn stretches_far_below_rounding_are_kept() {
        let osc = Oscillator::new(0.001, 0.5, 0.5).unwrap().with_damping(1.25).unwrap();
        let mut frame = frame();
        let at = ImpactState { phase: 0.3, velocity: 0.2, side: Side::Upper };
        let (mut total, s) = ([0.0, 0.0], 5000.0);
        for _ in 0..10 {
            through(&mut frame, &osc, s, &at);
            let stretch = frame.take();
            total = [total[0] + stretch[0], total[1] + stretch[1]];
        }
        // exponents -1/2 and -2; each impact adds the same bounded amount to the first
        let saltation = 2.0 * 0.5_f64.ln();
        assert!((total[0] + total[1] - 10.0 * (saltation - 2.5 * s)).abs() < 1e-6);
        assert!((total[0] / (10.0 * s) + 0.5).abs() < 1e-2 && (total[1] / (10.0 * s) + 2.0).abs() < 1e-2, "{total:?}");
    }
}
