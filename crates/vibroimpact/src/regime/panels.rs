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
//!
//! Where only products are integrated, $`|\lambda|h \le 6`$ suffices: the error of the rule is then below $`2\cdot 10^{-20}`$.
//! Such panels grow as $`e^{\gamma t/32}`$, so that the error of a product with a slow term stays that at the beginning.

use super::structure::Structure;
use crate::math::exp;

/// How long panels are for what is computed over them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panels {
    /// The longest panel, in units of the time in which a term changes.
    longest: f64,
    /// The times of decay in which panels become longer by the factor e.
    growth: f64,
}

/// Panels for the polynomials through the points of the rule.
pub(crate) const POLYNOMIALS: Panels = Panels { longest: 2.5, growth: 16.0 };
/// Panels for integrals of products of two terms.
pub(crate) const PRODUCTS: Panels = Panels { longest: 6.0, growth: 32.0 };

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

impl Panels {
    /// The panels of a flight of this length: beginning and length of each; at most `most` of them, and then `None`.
    pub(crate) fn of(self, rates: &[(f64, f64)], duration: f64, most: usize) -> Option<Vec<(f64, f64)>> {
        let mut all = Vec::new();
        let mut begin = 0.0;
        while begin < duration {
            if all.len() >= most {
                return None;
            }
            let longest = self.longest_from(rates, begin);
            // the rest is divided into equal panels, rather than into long ones and a very short one
            let rest = duration - begin;
            let length = if rest <= longest { rest } else { longest.min(0.5 * rest) };
            all.push((begin, length));
            begin = if rest <= longest { duration } else { begin + length };
        }
        Some(all)
    }

    /// The panels of an integral whose terms decay from the beginning on, or from the end backwards, as in [`Panels::of`].
    pub(crate) fn between_ends(self, rates: &[(f64, f64)], duration: f64, most: usize) -> Option<Vec<(f64, f64)>> {
        if duration <= self.longest_from(rates, 0.0) {
            return self.of(rates, duration, most);
        }
        let mut all = self.of(rates, 0.5 * duration, most)?;
        let mirrored = |(begin, length): &(f64, f64)| (duration - begin - length, *length);
        all.extend(all.iter().map(mirrored).collect::<Vec<_>>());
        Some(all)
    }

    /// The longest panel that begins at a time.
    fn longest_from(self, rates: &[(f64, f64)], begin: f64) -> f64 {
        let allowed = |(rate, decay): &(f64, f64)| {
            let gone = decay * begin;
            if gone > GONE { f64::INFINITY } else { self.longest / rate * exp(gone / self.growth) }
        };
        rates.iter().map(allowed).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::RULE;

    #[test]
    fn panels_fill_a_flight() {
        // a stiff mode with a damping ratio of 1 %, and a forcing
        let rates = [(1e4, 100.0), (1.0, 0.0)];
        let all = POLYNOMIALS.of(&rates, 50.0, 100_000).unwrap();
        let end = all.iter().fold(0.0, |end: f64, (begin, length)| {
            assert!((begin - end).abs() < 1e-12 && *length <= 2.5 * (1.0 + 1e-12));
            begin + length
        });
        assert!((end - 50.0).abs() < 1e-12 && all[0].1 == 2.5 / 1e4);
        assert!(all.len() < 1500, "{}", all.len());
        assert_eq!(POLYNOMIALS.of(&[], 3.0, 10).unwrap(), [(0.0, 3.0)]);
        assert_eq!(POLYNOMIALS.of(&rates, 50.0, 10), None);
        assert_eq!(POLYNOMIALS.of(&[(2.0, 0.0)], 1.5, 10).unwrap(), [(0.0, 0.75), (0.75, 0.75)]);
    }

    /// The integral of $`e^{-\gamma t}\cos(\omega t)\,e^{-\kappa(T-t)}\cos(\nu(T-t))`$: a motion, and what carries its change to the end.
    fn product([gamma, omega, kappa, nu]: [f64; 4], all: &[(f64, f64)], duration: f64) -> f64 {
        let at = |t: f64| {
            let back = duration - t;
            libm::exp(-gamma * t - kappa * back) * libm::cos(omega * t) * libm::cos(nu * back)
        };
        let points = |(begin, length): &(f64, f64)| {
            let (begin, half) = (*begin, 0.5 * length);
            let both = RULE.iter().map(move |(point, weight)| {
                half * weight * (at(begin + half * (1.0 + point)) + at(begin + half * (1.0 - point)))
            });
            both.sum::<f64>()
        };
        all.iter().map(points).sum()
    }

    #[test]
    fn products_are_integrated_to_rounding() {
        let mut fewer = 0;
        for duration in [0.01, 0.5, 3.0, 40.0] {
            for numbers in [[0.0, 1.0, 0.0, 1.0], [0.1, 5.0, 0.02, 4.0], [50.0, 0.0, 0.1, 3.0], [0.3, 2.0, 200.0, 30.0]]
            {
                let [gamma, omega, kappa, nu]: [f64; 4] = numbers;
                let rates = [(gamma.hypot(omega), gamma), (kappa.hypot(nu), kappa)];
                let all = PRODUCTS.between_ends(&rates, duration, 100_000).unwrap();
                let even = rates.map(|(rate, _)| (rate, 0.0));
                let fine = Panels { longest: 0.5, growth: 1.0 }.of(&even, duration, 100_000).unwrap();
                let (own, reference) = (product(numbers, &all, duration), product(numbers, &fine, duration));
                // of the size of the terms, which cancel where they swing; times and so exponents are rounded
                let size = duration.min(1.0 / gamma.max(kappa).max(1e-300));
                assert!(
                    (own - reference).abs()
                        < 1e-16 * (10.0 + duration * rates[0].0.max(rates[1].0)) * size.max(reference.abs()),
                    "{numbers:?} {duration}: {own} {reference}"
                );
                fewer += usize::from(all.len() < POLYNOMIALS.between_ends(&rates, duration, 100_000).unwrap().len());
            }
        }
        assert!(fewer > 8, "{fewer}");
    }
}
