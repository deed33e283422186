//! The panels over which a flight is integrated.
//!
//! In a regime all motions are sums of terms $`e^{\lambda t}`$, of the modes and of the forcing, and of low powers of the
//! time. Over a panel of length $`h`$ the polynomial through the 16 points of the Gauss-Legendre rule differs from such a
//! term by about $`(|\lambda|h/4)^{16}/16!`$ of its size, and the rule for a product of two of them by
//! $`(2|\lambda|h)^{32}\,(16!)^4/(33\,(32!)^3)`$. For $`|\lambda|h \le 2.5`$ these are below $`3\cdot 10^{-17}`$ and
//! $`10^{-32}`$. So integrals and extremes are right to rounding.
//!
//! A term that decays as $`e^{-\gamma t}`$ allows panels that grow as $`e^{\gamma t/16}`$: the error of the polynomial stays
//! that at the beginning, relative to the size of the term there, and the error of a product with a slow term grows to
//! $`10^{-16}`$. After $`e^{-40}`$ nothing is left of it. So a stiff mode with damping costs little in a long flight.

use super::structure::Structure;
use crate::math::exp;

/// The longest panel, in units of the time in which a term changes.
const PANEL: f64 = 2.5;
/// A term is nothing after it has decayed by this power of e.
const GONE: f64 = 40.0;

/// The rates of the terms of a flight, each with the rate at which it decays.
pub(crate) fn rates(structure: &Structure) -> Vec<(f64, f64)> {
    if structure.dense.is_some() {
        return vec![(structure.fastest(), 0.0)];
    }
    let mut rates: Vec<(f64, f64)> = vec![(structure.forcing(), 0.0)];
    for mode in &structure.modes {
        if mode.k == 0.0 {
            // a free body: its velocity decays at the rate 2d
            rates.push((2.0 * mode.d, 2.0 * mode.d));
        } else if mode.d < mode.omega {
            rates.push((mode.omega, mode.d));
        } else {
            // far from critical damping both rates in the form in which nothing cancels
            let fast = mode.d + ((mode.d - mode.omega) * (mode.d + mode.omega)).sqrt();
            rates.extend([(fast, fast), (mode.k / fast, mode.k / fast)]);
        }
    }
    rates.retain(|(rate, _)| *rate > 0.0);
    rates
}

/// The panels of a flight of this length: beginning and length of each; at most `most` of them, and then `None`.
pub(crate) fn panels(rates: &[(f64, f64)], duration: f64, most: usize) -> Option<Vec<(f64, f64)>> {
    let mut all = Vec::new();
    let mut begin = 0.0;
    while begin < duration {
        if all.len() >= most {
            return None;
        }
        let allowed = |(rate, decay): &(f64, f64)| {
            let gone = decay * begin;
            if gone > GONE { f64::INFINITY } else { PANEL / rate * exp(gone / 16.0) }
        };
        let longest = rates.iter().map(allowed).fold(f64::INFINITY, f64::min);
        // the rest is divided into equal panels, rather than into long ones and a very short one
        let rest = duration - begin;
        let length = if rest <= longest { rest } else { longest.min(0.5 * rest) };
        all.push((begin, length));
        begin = if rest <= longest { duration } else { begin + length };
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_fill_a_flight() {
        // a stiff mode with a damping ratio of 1 %, and a forcing
        let rates = [(1e4, 100.0), (1.0, 0.0)];
        let all = panels(&rates, 50.0, 100_000).unwrap();
        let end = all.iter().fold(0.0, |end: f64, (begin, length)| {
            assert!((begin - end).abs() < 1e-12 && *length <= PANEL * (1.0 + 1e-12));
            begin + length
        });
        assert!((end - 50.0).abs() < 1e-12 && all[0].1 == PANEL / 1e4);
        assert!(all.len() < 1500, "{}", all.len());
        assert_eq!(panels(&[], 3.0, 10).unwrap(), [(0.0, 3.0)]);
        assert_eq!(panels(&rates, 50.0, 10), None);
        assert_eq!(panels(&[(2.0, 0.0)], 1.5, 10).unwrap(), [(0.0, 0.75), (0.75, 0.75)]);
    }
}
