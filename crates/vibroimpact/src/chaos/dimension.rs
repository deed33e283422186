//! The Kaplan-Yorke dimension of an attractor, computed from its exponents.
//!
//! For the stroboscopic section, a map of the plane with exponents $`\lambda_1 > 0 > \lambda_1 + \lambda_2`$,
//!
//! $$`D = 1 + \frac{\lambda_1}{|\lambda_2|}`$$
//!
//! (J. L. Kaplan and J. A. Yorke, Lect. Notes Math. 730 (1979) 204-227, doi:10.1007/BFb0064319). If both exponents are
//! negative, it is 0: the section is a finite number of points. If area is preserved (restitution 1, no damping) it is
//! 2, although there is no attractor. The flow in the extended phase space of position, velocity and phase has a third
//! exponent 0, along itself, and the dimension $`D + 1`$. This is the dimension of the measure on the attractor if the
//! conjecture of its authors holds; it is not a box-counting dimension.

use crate::lyapunov::Measured;
use crate::lyapunov::blocks::{Block, MEASURE, quotient};

/// The dimension of the section, from the exponents and the blocks over which they were measured; `None` if the larger
/// exponent is not known to differ from 0.
pub(super) fn of_section(exponents: &[Measured; 2], blocks: &[Block]) -> Option<Measured> {
    let [one, two] = exponents;
    if one.value < -one.error {
        return Some(Measured::default());
    }
    // NaN does not exceed its error either
    if !(one.value > one.error && two.value < 0.0) {
        return None;
    }
    if blocks.iter().map(|block| block.area).sum::<f64>() >= 0.0 {
        return Some(Measured { value: 2.0, error: 0.0 });
    }
    let part = quotient(blocks, MEASURE, |block| block.stretch[0], |block| -block.stretch[1]);
    Some(Measured { value: 1.0 + part.value, error: part.error })
}

/// The dimension from all exponents, the largest first: with the largest j for which
/// $`\lambda_1 + \dots + \lambda_j \ge 0`$ it is $`j + (\lambda_1 + \dots + \lambda_j)/|\lambda_{j+1}|`$, and the number of exponents if the
/// sum of all is not negative. The error is a bound to first order. `None` if the largest exponent is not known to differ from 0.
pub(super) fn of_exponents(exponents: &[Measured]) -> Option<Measured> {
    let largest = exponents.first()?;
    if largest.value < -largest.error {
        return Some(Measured::default());
    }
    if largest.value.is_nan() || largest.value <= largest.error {
        return None;
    }
    let (mut whole, mut sum, mut error) = (0.0, 0.0, 0.0);
    for of in exponents {
        if sum + of.value < 0.0 {
            // minus infinity adds nothing
            let part = -sum / of.value;
            let error = if of.value.is_finite() { (error + part * of.error) / -of.value } else { 0.0 };
            return Some(Measured { value: whole + part, error });
        }
        (whole, sum, error) = (whole + 1.0, sum + of.value, error + of.error);
    }
    Some(Measured { value: whole, error: 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_exponents() {
        let of = |values: &[f64]| {
            let all: Vec<Measured> = values.iter().map(|value| Measured { value: *value, error: 0.01 }).collect();
            of_exponents(&all).map(|found| (found.value, found.error))
        };
        assert_eq!(of(&[-0.1, -0.2]), Some((0.0, 0.0)));
        assert_eq!(of(&[0.005, -0.2]), None);
        assert_eq!(of(&[f64::NAN, -0.2]), None);
        assert_eq!(of(&[0.25, -0.25]), Some((2.0, 0.0)));
        assert_eq!(of(&[0.25, f64::NEG_INFINITY]), Some((1.0, 0.0)));
        // the largest j is 3: 0.5 + 0.25 - 0.5 = 0.25
        let (value, error) = of(&[0.5, 0.25, -0.5, -1.0]).unwrap();
        assert!((value - 3.25).abs() < 1e-15 && (error - (0.03 + 0.25 * 0.01)).abs() < 1e-15);
        // that of two exponents is the same
        assert!((of(&[0.25, -0.5]).unwrap().0 - 1.5).abs() < 1e-15);
    }

    #[test]
    fn by_the_signs_of_the_exponents() {
        let exact = |value| Measured { value, error: 0.0 };
        let of = |one: Measured, two: f64| {
            let block = Block { stretch: [one.value, two], area: one.value + two, time: 1.0, impacts: 1.0 };
            of_section(&[one, exact(two)], &[block; 64]).map(|d| d.value)
        };
        assert_eq!(of(exact(0.25), -0.5), Some(1.5));
        assert_eq!(of(exact(0.25), f64::NEG_INFINITY), Some(1.0));
        assert_eq!(of(exact(0.25), -0.25), Some(2.0));
        assert_eq!(of(exact(-0.25), -0.5), Some(0.0));
        assert_eq!(of(exact(f64::NEG_INFINITY), f64::NEG_INFINITY), Some(0.0));
        assert_eq!(of(exact(0.0), 0.0), None);
        assert_eq!(of(Measured { value: 0.1, error: 0.2 }, -0.5), None);
        assert_eq!(of(exact(f64::NAN), f64::NAN), None);
    }
}
