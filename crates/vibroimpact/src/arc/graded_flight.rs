//! How a flight changes differences of states, with the digits of those that decay by many powers of ten.
//!
//! The derivative of a flight is $`B\,\mathrm{diag}(e^{s_i})\,A`$, where $`A`$ takes a difference of states to the modes and
//! $`B`$ takes it back. A mode whose damping separates its two rates of decay, $`\lambda_{1,2} = -d \pm \sqrt{d^2 - k}`$, has a
//! row for each; of others both rows decay at the rate $`d`$ and turn. As one matrix of numbers the derivative would lose all
//! that has decayed by more than the rounding errors of the rest.

use crate::math::{Graded, add_scaled, dot, exp, sin_cos, sort_by};
use crate::regime::{Mode, Normal, Structure};

/// Two rates of decay whose difference exceeds this in the time of the flight are told apart.
const APART: f64 = 2.0;

/// One mode over a time, as two rows.
enum Pair {
    /// Two amplitudes, which decay at two rates.
    Decays { fast: f64, slow: f64 },
    /// Displacement and velocity, which turn into each other as they decay.
    Turns { turn: [[f64; 2]; 2], decay: f64 },
}

impl Pair {
    fn of(mode: &Mode, s: f64) -> Self {
        let square = mode.d * mode.d - mode.k;
        let root = square.abs().sqrt();
        if square > 0.0 && root * s > APART {
            // the slow rate from the product of both, k: as a difference it would lose its digits
            let sum = mode.d + root;
            return Self::Decays { fast: -sum, slow: -mode.k / sum };
        }
        // cosine and sine of the angle, or the hyperbolic ones; the sine over the rate
        let angle = root * s;
        let (c, unit) = if square <= 0.0 {
            let (sin, cos) = sin_cos(angle);
            (cos, if angle > 0.0 { sin / root } else { s })
        } else {
            let (up, down) = (exp(angle), exp(-angle));
            // its Taylor series, which loses no digits
            let mut term = s;
            let (mut sum, mut k) = (0.0, 1.0);
            while k < 40.0 {
                sum += term;
                term *= square * s * s / ((k + 1.0) * (k + 2.0));
                k += 2.0;
            }
            (0.5 * (up + down), sum)
        };
        // without the factor e^{-ds}, which is the scale of the rows
        let turn = [[c + mode.d * unit, unit], [-mode.k * unit, c - mode.d * unit]];
        Self::Turns { turn, decay: -mode.d * s }
    }
}

impl Structure {
    /// The fastest rate at which a difference of states decays.
    pub(crate) fn contraction(&self) -> f64 {
        // `modes` of a structure without modes are bounds
        let of = |mode: &Mode| {
            mode.d + if self.dense.is_some() { mode.d } else { (mode.d * mode.d - mode.k).max(0.0).sqrt() }
        };
        self.modes.iter().map(of).fold(0.0, f64::max)
    }

    /// The rates of growth of all differences of states while the structure stays as it is, as many as coordinates and
    /// velocities, the largest first: minus infinity for those that its constraints do not allow. `None` if they cannot be
    /// computed.
    pub(crate) fn growth(&self, n: usize) -> Option<Vec<f64>> {
        let mut rates: Vec<f64> = Vec::with_capacity(2 * n);
        if let Some((stiffness, damping)) = &self.dense {
            let m = stiffness.rows();
            let mut companion = crate::math::Matrix::zeros(2 * m, 2 * m);
            for i in 0..m {
                companion[(i, m + i)] = 1.0;
                for j in 0..m {
                    (companion[(m + i, j)], companion[(m + i, m + j)]) = (-stiffness[(i, j)], -damping[(i, j)]);
                }
            }
            // damping lets nothing grow; more is rounding
            rates.extend(crate::math::general_eigenvalues(&companion)?.iter().map(|value| value.re.min(0.0)));
        } else {
            for mode in &self.modes {
                let root = (mode.d * mode.d - mode.k).max(0.0).sqrt();
                let fast = mode.d + root;
                rates.extend([if root > 0.0 { -mode.k / fast } else { -mode.d }, -fast]);
            }
        }
        // where a joint holds stays as it is
        let stops = self.stops();
        rates.extend(self.held.iter().filter(|place| **place >= stops).map(|_| 0.0));
        rates.resize(2 * n, f64::NEG_INFINITY);
        sort_by(&mut rates, |a, b| b.total_cmp(a));
        Some(rates)
    }

    /// Differences of states after a time `s`: those in the modes as the columns of a graded matrix, and what one unit of each of
    /// its rows is as a difference of states. `None` for a structure without modes.
    pub(crate) fn graded(&self, normal: &Normal, s: f64, columns: &[Vec<f64>]) -> Option<(Graded, Vec<Vec<f64>>)> {
        if self.dense.is_some() {
            return None;
        }
        let n = normal.n;
        let stops = self.stops();
        let changes: Vec<_> =
            columns.iter().map(|column| self.modal_change(normal, &column[..n], &column[n..2 * n])).collect();
        let (mut graded, mut back) = (Graded::default(), Vec::new());
        // a difference of states from displacement, velocity of a mode
        let state = |i: usize, (y, v): (f64, f64)| -> Vec<f64> {
            let of = |of: &crate::regime::Observable| y * of.position[i] + v * of.velocity[i];
            self.x.iter().chain(&self.v).map(of).collect()
        };
        for (i, mode) in self.modes.iter().enumerate() {
            // displacements from where the set points of joints hold the mode
            let shift = |push: f64| if mode.k > 0.0 { push / mode.k } else { 0.0 };
            let own = changes.iter().map(|change| (change.y[i] - shift(change.push[i]), change.v[i]));
            let (y, v): (Vec<f64>, Vec<f64>) = own.unzip();
            let mixed = |a: f64, b: f64| y.iter().zip(&v).map(|(y, v)| a * y + b * v).collect::<Vec<f64>>();
            match Pair::of(mode, s) {
                Pair::Decays { fast, slow } => {
                    // the amplitudes of both decays: y is their sum, v that of each times its rate
                    let over = 1.0 / (slow - fast);
                    graded.push(mixed(-fast * over, over), slow * s);
                    graded.push(mixed(slow * over, -over), fast * s);
                    back.extend([state(i, (1.0, slow)), state(i, (1.0, fast))]);
                }
                Pair::Turns { turn: [[a, b], [c, d]], decay } => {
                    graded.push(mixed(a, b), decay);
                    graded.push(mixed(c, d), decay);
                    back.extend([state(i, (1.0, 0.0)), state(i, (0.0, 1.0))]);
                }
            }
        }
        for joint in self.held.iter().filter(|place| **place >= stops).map(|place| place - stops) {
            graded.push(changes.iter().map(|change| change.set[joint]).collect(), 0.0);
            let of = |of: &crate::regime::Observable| {
                let held = self
                    .modes
                    .iter()
                    .zip(&self.drive)
                    .map(|(mode, drive)| if mode.k > 0.0 { drive.set[joint] / mode.k } else { 0.0 });
                let held: Vec<f64> = held.collect();
                of.signal.set[joint] + dot(&of.position, &held)
            };
            back.push(self.x.iter().chain(&self.v).map(of).collect());
        }
        Some((graded, back))
    }
}

/// A combination of columns.
pub(crate) fn combined(columns: &[Vec<f64>], factors: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; columns.first().map_or(0, Vec::len)];
    for (column, factor) in columns.iter().zip(factors).filter(|(_, factor)| **factor != 0.0) {
        add_scaled(&mut sum, *factor, column);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Machine, MachineParts};
    use crate::math::Lu;
    use crate::regime::ContactState;

    /// The product is the derivative of the flight, whether modes turn, creep or drift, and with a joint that holds.
    #[test]
    fn the_same_as_the_transition() {
        for (ground, between, joint) in [(0.1, 0.05, false), (9.0, 0.4, false), (0.7, 30.0, true), (0.0, 2.0, true)] {
            let mut parts = MachineParts::new(["a", "b", "c"])
                .with_mass(0, 1.0)
                .with_mass(1, 0.7)
                .with_mass(2, 1.3)
                .with_link(&[1.0, 0.0, 0.0], if ground > 0.0 { 1.0 } else { 0.0 }, ground)
                .with_link(&[1.0, -1.0, 0.0], 1.4, between)
                .with_link(&[0.0, 1.0, -1.0], 0.8, 0.3);
            if joint {
                parts = parts.with_joint("floor", &[0.0, 0.0, 1.0], 1.0, 1.0, 0.0);
            }
            let machine = Machine::new(parts).unwrap();
            let normal = Normal::new(&machine);
            let states = vec![ContactState::Holding; usize::from(joint)];
            let structure = Structure::new(&machine, &normal, &states).unwrap();
            assert!(structure.dense.is_none());
            let unit = |j: usize| (0..6).map(|i| if i == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
            let columns: Vec<Vec<f64>> = (0..6).map(unit).collect();
            for s in [0.01, 0.6, 3.0, 9.0] {
                let (graded, back) = structure.graded(&normal, s, &columns).unwrap();
                let whole = structure.transition(&normal, s);
                for j in 0..6 {
                    let rows = graded.rows.iter().zip(&graded.scales);
                    let factors: Vec<f64> = rows.map(|(row, scale)| row[j] * scale.exp()).collect();
                    for (i, value) in combined(&back, &factors).iter().enumerate() {
                        assert!(
                            (value - whole[(i, j)]).abs() < 1e-12,
                            "{ground} {s} {i} {j}: {value} {}",
                            whole[(i, j)]
                        );
                    }
                }
                // the determinant is that of all damping, as long as numbers can tell it
                let trace: f64 = (0..3).map(|i| normal.damping[(i, i)]).sum();
                if !joint && trace * s < 20.0 {
                    let determinant = Lu::new(whole.values().to_vec(), 6).unwrap().determinant();
                    assert!((determinant * (trace * s).exp() - 1.0).abs() < 1e-6, "{ground} {s}");
                }
            }
        }
    }
}
