//! The equations of all impacts of a cycle together, and their derivatives.
//!
//! The unknowns are the phase $`\theta_i`$ and the arrival speed $`U_i`$ of each impact. The *signature* prescribes the
//! stops $`\sigma_i`$ and the number n of forcing periods. Flight i leaves its stop with $`-\sigma_i\varepsilon_iU_i`$
//! and takes $`T_i = (\theta_{i+1}-\theta_i)/\beta`$; the flight after the last impact takes
//! $`(\theta_1 + 2\pi n - \theta_m)/\beta`$. It must arrive at the next impact:
//!
//! $$`F_i = \begin{pmatrix} (\sigma_{i+1}\,x(T_i) - \delta_{i+1})/w_i \\ \sigma_{i+1}\,v(T_i) - U_{i+1} \end{pmatrix} = 0,`$$
//!
//! where $`w_i = T_i`$ for a flight that ends on the stop that it left, which removes the solution $`T_i = 0`$, and 1
//! otherwise. The times are unknowns, and no first contact is searched for. So the equations are analytic in the
//! unknowns, through a grazing impact, $`U_i = 0`$, and beyond it, where the impact map and its derivative do not
//! exist. Therefore Newton's method on these equations converges near grazing, where it fails on the map (I. Ghosh & D.
//! J. W. Simpson, arXiv:2510.16218, treat this difficulty in another way). A solution can be inadmissible;
//! [`earlier_contact`](super::earlier_contact) decides.
//!
//! With $`A_i = \partial F_i/\partial z_i`$, $`B_i = \partial F_i/\partial z_{i+1}`$ the impact map has the derivative
//! $`-B_i^{-1}A_i`$, and $`\det B_i = -U_{i+1}/(\beta w_i)`$.

use super::ring::Ring;
use crate::flight::Flight;
use crate::math::{Matrix2, sin_cos};
use crate::system::{Oscillator, Parameter, Side, Start};

/// One flight of a cycle, linearised: its residuals and their derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// $`F_i`$.
    pub(crate) miss: [f64; 2],
    /// $`A_i`$, the derivative with respect to the impact that it leaves.
    pub(crate) left: Matrix2,
    /// $`B_i`$, the derivative with respect to the impact at which it arrives.
    pub(crate) right: Matrix2,
    /// $`w_i`$, by which the distance was divided.
    pub(crate) divisor: f64,
}

/// The flight from impact `k` of `ring` to the next one; `None` if its time is not positive.
pub(crate) fn block(osc: &Oscillator, ring: &Ring, k: usize) -> Option<Block> {
    let beta = osc.beta();
    let (sign, next) = (ring.side(k).sign(), ring.side(k + 1));
    let time = ring.turn(k) / beta;
    if !(time > 0.0 && time.is_finite()) {
        return None;
    }
    let flight = leaving(osc, ring, k);
    let restitution = osc.stop(ring.side(k)).map_or(0.0, |stop| stop.restitution);
    let point = flight.at(time);
    let p = osc.response().at(time);
    let (sin, cos) = sin_cos(flight.phase);
    let to = next.sign();
    let same = next == ring.side(k);
    // back on the stop that it left, the displacement itself is the miss
    let room = if same { 0.0 } else { osc.stop(next).map_or(0.0, |stop| stop.gap) - to * flight.x };
    let divisor = if same { time } else { 1.0 };
    let over = to * point.displacement - room;
    let (speed, push) = (to * point.v, to * point.a);
    // derivatives with respect to the phase and arrival speed at the beginning, and to the time of flight
    let rebound = -sign * restitution;
    let by_theta = [to * (cos * p.kc - sin * p.ks), to * (cos * (p.s - beta * p.ks) - sin * beta * p.kc)];
    let by_speed = [to * p.s * rebound, to * p.s_rate * rebound];
    // the quotient rule, where the miss is divided by the time
    let by_time = if same { (speed - over / time) / time } else { speed };
    Some(Block {
        miss: [over / divisor, speed - ring.speed(k + 1)],
        left: Matrix2([
            [by_theta[0] / divisor - by_time / beta, by_speed[0] / divisor],
            [by_theta[1] - push / beta, by_speed[1]],
        ]),
        right: Matrix2([[by_time / beta, 0.0], [push / beta, -1.0]]),
        divisor,
    })
}

/// The flight that leaves impact `k`.
pub(crate) fn leaving(osc: &Oscillator, ring: &Ring, k: usize) -> Flight {
    let sign = ring.side(k).sign();
    let (gap, speed) = osc.stop(ring.side(k)).map_or((0.0, 0.0), |stop| (stop.gap, stop.rebound(ring.speed(k))));
    Flight::new(osc, Start { x: sign * gap, v: -sign * speed, phase: ring.theta(k) })
}

/// All flights of `ring`, linearised; `None` if the time of one is not positive.
pub(crate) fn blocks(osc: &Oscillator, ring: &Ring) -> Option<Vec<Block>> {
    (0..ring.len()).map(|k| block(osc, ring, k)).collect()
}

/// The largest residual of distance or speed, divided by the largest speed of the cycle if that exceeds 1.
pub(crate) fn residual(ring: &Ring, blocks: &[Block]) -> f64 {
    let fastest = (0..ring.len()).map(|k| ring.speed(k).abs()).fold(1.0, f64::max);
    blocks.iter().map(|b| (b.miss[0] * b.divisor).abs().max(b.miss[1].abs())).fold(0.0, f64::max) / fastest
}

/// Writes the Jacobian of all residuals with respect to all unknowns into `rows`, which must be zero and has `width`
/// numbers in a row.
pub(crate) fn fill(rows: &mut [f64], width: usize, blocks: &[Block]) {
    let m = blocks.len();
    for (k, block) in blocks.iter().enumerate() {
        for row in 0..2 {
            let base = (2 * k + row) * width;
            for column in 0..2 {
                // of a single impact both blocks have the same columns
                rows[base + 2 * k + column] += block.left.0[row][column];
                rows[base + 2 * ((k + 1) % m) + column] += block.right.0[row][column];
            }
        }
    }
}

/// The derivative of all residuals with respect to a parameter. For a gap or a restitution it is exact. For $`\beta`$
/// and $`\zeta`$ it is a difference of fourth order, accurate to about 1e-10; Newton's method converges with it too.
/// `None` if the parameter belongs to a stop that does not exist.
pub(crate) fn by_parameter(osc: &Oscillator, ring: &Ring, parameter: Parameter) -> Option<Vec<f64>> {
    match parameter {
        Parameter::Gap => Some(by_stop(osc, ring, Side::Upper, true)),
        Parameter::SecondGap => Some(by_stop(osc, ring, Side::Lower, true)),
        Parameter::Restitution => Some(by_stop(osc, ring, Side::Upper, false)),
        Parameter::SecondRestitution => Some(by_stop(osc, ring, Side::Lower, false)),
        Parameter::Beta | Parameter::InverseBeta | Parameter::Damping => by_difference(osc, ring, parameter),
    }
}

/// The derivative of all residuals with respect to the gap or the restitution of one stop.
fn by_stop(osc: &Oscillator, ring: &Ring, side: Side, gap: bool) -> Vec<f64> {
    let mut column = Vec::with_capacity(2 * ring.len());
    for k in 0..ring.len() {
        let (from, next) = (ring.side(k), ring.side(k + 1));
        let time = ring.turn(k) / osc.beta();
        let (to, same) = (next.sign(), next == from);
        let divisor = if same { time } else { 1.0 };
        let p = osc.response().at(time);
        let (mut distance, mut speed) = (0.0, 0.0);
        if from == side {
            if gap {
                // the beginning of the flight moves outwards with the stop
                let shift = from.sign();
                distance += if same { -p.one_minus_c } else { to * p.c * shift };
                speed -= to * p.s * shift;
            } else {
                let rebound = -from.sign() * ring.speed(k);
                distance += to * p.s * rebound;
                speed += to * p.s_rate * rebound;
            }
        }
        if gap && next == side && !same {
            distance -= 1.0;
        }
        column.extend([distance / divisor, speed]);
    }
    column
}

/// Half the width of the difference, at which the truncation error of fourth order about equals the rounding error.
const DIFFERENCE: f64 = 1e-3;

/// The derivative of all residuals by a difference of fourth order; `None` if a value of the stencil is invalid.
fn by_difference(osc: &Oscillator, ring: &Ring, parameter: Parameter) -> Option<Vec<f64>> {
    let value = parameter.get(osc)?;
    let h = if parameter == Parameter::Damping { DIFFERENCE } else { DIFFERENCE * value };
    let misses = |step: f64| -> Option<Vec<f64>> {
        let changed = parameter.set(osc, value + step * h).ok()?;
        Some(blocks(&changed, ring)?.iter().flat_map(|b| b.miss).collect())
    };
    // differences of fourth order, one-sided if damping would become negative
    let stencil: &[(f64, f64)] = if parameter == Parameter::Damping && value < 2.0 * h {
        &[(0.0, -25.0 / 12.0), (1.0, 4.0), (2.0, -3.0), (3.0, 4.0 / 3.0), (4.0, -0.25)]
    } else {
        &[(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)]
    };
    let mut column = vec![0.0; 2 * ring.len()];
    for &(step, weight) in stencil {
        for (sum, miss) in column.iter_mut().zip(misses(step)?) {
            *sum += weight / h * miss;
        }
    }
    Some(column)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::ImpactState;
    use crate::orbit::shoot;

    fn examples() -> Vec<(Oscillator, Ring)> {
        let two =
            Oscillator::new(0.7, 0.6, 0.7).unwrap().with_damping(0.1).unwrap().with_second_stop(0.8, 0.6).unwrap();
        let sides = vec![Side::Upper, Side::Lower, Side::Lower];
        let one = Oscillator::new(0.9, 2.0, 0.5).unwrap();
        vec![
            (two, Ring { sides, unknowns: vec![1.2, 1.9, 4.0, 0.3, 5.5, 0.9], periods: 1 }),
            (one, Ring { sides: vec![Side::Upper; 2], unknowns: vec![1.2, 1.9, 1.3, 0.01], periods: 2 }),
            // beyond grazing
            (one, Ring { sides: vec![Side::Upper; 2], unknowns: vec![0.2, -0.4, 4.0, 0.0], periods: 1 }),
        ]
    }

    #[test]
    fn derivatives_by_differences() {
        for (osc, ring) in examples() {
            let m = ring.len();
            let mut rows = vec![0.0; 4 * m * m];
            fill(&mut rows, 2 * m, &blocks(&osc, &ring).unwrap());
            let miss = |osc: &Oscillator, ring: &Ring| -> Vec<f64> {
                blocks(osc, ring).unwrap().iter().flat_map(|b| b.miss).collect()
            };
            let close = |a: f64, b: f64| assert!((a - b).abs() < 2e-6 * (1.0 + a.abs()), "{a} {b}");
            let h = 1e-6;
            for j in 0..2 * m {
                let shifted = |h: f64| {
                    let mut ring = ring.clone();
                    ring.unknowns[j] += h;
                    miss(&osc, &ring)
                };
                let (up, down) = (shifted(h), shifted(-h));
                for i in 0..2 * m {
                    close(rows[i * 2 * m + j], (up[i] - down[i]) / (2.0 * h));
                }
            }
            for parameter in Parameter::ALL {
                let Some(value) = parameter.get(&osc) else { continue };
                let exact = by_parameter(&osc, &ring, parameter).unwrap();
                let at = |value: f64| miss(&parameter.set(&osc, value).unwrap(), &ring);
                // damping cannot be negative: a parabola through three values instead
                let one_sided = value < h;
                let (a, b, c) = if one_sided { (0.0, 1.0, 2.0) } else { (-1.0, 0.0, 1.0) };
                let (a, b, c) = (at(value + a * h), at(value + b * h), at(value + c * h));
                for i in 0..2 * m {
                    let slope = if one_sided { 4.0 * b[i] - 3.0 * a[i] - c[i] } else { c[i] - a[i] };
                    close(exact[i], slope / (2.0 * h));
                }
            }
        }
    }

    #[test]
    fn a_cycle_solves_the_equations_and_its_map_is_theirs() {
        let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
        let guess = ImpactState { phase: 0.83, velocity: 2.64, side: Side::Upper };
        let ring = Ring::of(&osc, &shoot(&osc, guess, 2, 1).unwrap()).unwrap();
        let blocks = blocks(&osc, &ring).unwrap();
        assert!(residual(&ring, &blocks) < 1e-14);
        let mut product = Matrix2::IDENTITY;
        for (k, block) in blocks.iter().enumerate() {
            let det = block.right.determinant();
            let expected = -ring.speed(k + 1) / (osc.beta() * block.divisor);
            assert!((det / expected - 1.0).abs() < 1e-12, "{det} {expected}");
            for column in 0..2 {
                let a = [-block.left.0[0][column], -block.left.0[1][column]];
                assert!(block.right.solve(a).is_some());
            }
            let [[a, b], [c, d]] = block.right.0;
            let inverse = Matrix2([[-d / det, b / det], [c / det, -a / det]]);
            product = inverse.times(block.left).times(product);
        }
        assert!((product.trace() - 0.584_626_130_489).abs() < 1e-11, "{product:?}");
        assert!((product.determinant() - 0.062_5).abs() < 1e-13);
    }
}
