//! The Floquet multipliers of a cycle from its equations, and test functions that are zero where one is +1 or -1.
//!
//! The derivative over one period of the cycle is $`J = \prod(-B_i^{-1}A_i)`$. It is infinite where an impact grazes,
//! because $`\det B_i = 0`$ there. But $`\tilde M = \prod(-\operatorname{adj}B_i\,A_i) = J\,P`$ with
//! $`P = \prod\det B_i`$ is smooth, and $`\det J = \prod\varepsilon_i^2\;e^{-4\pi\zeta n/\beta}`$ is known exactly. So
//! the functions
//!
//! $$`\psi_{+1} = (1+\det J)\,P - \operatorname{tr}\tilde M, \qquad \psi_{-1} = (1+\det J)\,P + \operatorname{tr}\tilde M`$$
//!
//! are zero where a multiplier is +1 (fold, branch point) or -1 (flip), and are smooth through grazing.

use super::cyclic::Block;
use super::ring::Ring;
use crate::math::{Matrix2, Multiplier, eigenvalues, exp};
use crate::system::Oscillator;
use core::f64::consts::TAU;

/// The derivative over one period of a cycle, up to a common positive factor that avoids overflow and underflow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Floquet {
    /// $`\tilde M`$, for a period that begins at the first impact.
    pub(crate) turn: Matrix2,
    /// $`P`$.
    pub(crate) product: f64,
    /// $`\det J`$, from its exact formula.
    pub(crate) determinant: f64,
}

/// The sum of the squares of the elements.
fn square(matrix: &Matrix2) -> f64 {
    matrix.0.iter().flatten().map(|x| x * x).sum()
}

/// Limits the factor by which small numbers are multiplied at one impact.
const LEAST: f64 = 0.1;

impl Floquet {
    /// The product over all flights of a cycle.
    pub(crate) fn new(osc: &Oscillator, ring: &Ring, blocks: &[Block]) -> Self {
        let (mut turn, mut product) = (Matrix2::IDENTITY, 1.0);
        let mut determinant = exp(-2.0 * osc.damping() * TAU * f64::from(ring.periods) / osc.beta());
        for (k, block) in blocks.iter().enumerate() {
            let [[a, b], [c, d]] = block.right.0;
            // turn and product may vanish together (resonant grazing), so they are not divided by their own size alone
            let scale = 1.0 / (square(&block.left) * square(&block.right)).sqrt().max(f64::MIN_POSITIVE);
            turn = Matrix2([[-d, b], [c, -a]].map(|row| row.map(|x| x * scale))).times(block.left).times(turn);
            product *= (a * d - b * c) * scale;
            let scale = 1.0 / (square(&turn) + product * product + LEAST * LEAST).sqrt();
            turn = Matrix2(turn.0.map(|row| row.map(|x| x * scale)));
            product *= scale;
            let eps = osc.stop(ring.side(k)).map_or(0.0, |stop| stop.restitution);
            determinant *= eps * eps;
        }
        Self { turn, product, determinant }
    }

    /// The test function of a multiplier +1.
    pub(crate) fn plus_one(&self) -> f64 {
        (1.0 + self.determinant) * self.product - self.turn.trace()
    }

    /// The test function of a multiplier -1.
    pub(crate) fn minus_one(&self) -> f64 {
        (1.0 + self.determinant) * self.product + self.turn.trace()
    }

    /// The multipliers, the larger first; infinite at a grazing impact.
    pub(crate) fn multipliers(&self) -> [Multiplier; 2] {
        let trace = self.turn.trace();
        eigenvalues(if trace == 0.0 { 0.0 } else { trace / self.product }, self.determinant)
    }

    /// The direction at the first impact that one period of the cycle multiplies by `multiplier` (+1 or -1), to first
    /// order.
    pub(crate) fn direction(&self, multiplier: f64) -> [f64; 2] {
        let [[a, b], [c, d]] = self.turn.0;
        let (a, d) = (a - multiplier * self.product, d - multiplier * self.product);
        // perpendicular to the larger row
        let (p, q) = if a * a + b * b >= c * c + d * d { (-b, a) } else { (-d, c) };
        let size = crate::math::hypot(p, q).max(f64::MIN_POSITIVE);
        [p / size, q / size]
    }
}
