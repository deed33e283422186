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

/// The dimension from all exponents, the largest first: with the largest j for which
/// $`\lambda_1 + \dots + \lambda_j \ge 0`$ it is $`j + (\lambda_1 + \dots + \lambda_j)/|\lambda_{j+1}|`$, and the number of exponents if
/// the sum of all, known exactly or NaN, is not negative. `blocks` are those of the measurement, from which the error comes; exact
/// exponents have none. `None` if the largest exponent is not known to differ from 0.
pub(super) fn kaplan_yorke(exponents: &[Measured], exact_sum: f64, blocks: &[Block]) -> Option<Measured> {
    let largest = exponents.first()?;
    if largest.value < -largest.error {
        return Some(Measured::default());
    }
    // NaN does not exceed its error either
    if largest.value.is_nan() || largest.value <= largest.error {
        return None;
    }
    let (mut whole, mut sum) = (0.0, 0.0);
    // as many directions as a volume in them does not shrink, and a part of the next one
    for (j, of) in exponents.iter().enumerate() {
        if sum + of.value < 0.0 && (exact_sum.is_nan() || exact_sum < 0.0) {
            let part = if blocks.is_empty() {
                Measured::exact(-sum / of.value)
            } else {
                // minus infinity adds nothing
                quotient(blocks, MEASURE, |block| block.stretch[..j].iter().sum(), |block| -block.stretch[j])
            };
            return Some(Measured { value: whole + part.value, error: part.error });
        }
        (whole, sum) = (whole + 1.0, sum + of.value);
    }
    Some(Measured::exact(whole))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The dimension from exponents of a run without scatter, each with this error.
    fn dimension(values: &[f64], error: f64) -> Option<f64> {
        let exponents: Vec<Measured> = values.iter().map(|value| Measured { value: *value, error }).collect();
        let volume: f64 = values.iter().sum();
        let blocks = vec![Block { stretch: values.to_vec(), volume, time: 1.0, impacts: 1.0 }; 64];
        let measured = kaplan_yorke(&exponents, volume, &blocks).map(|of| of.value);
        assert_eq!(kaplan_yorke(&exponents, volume, &[]).map(|of| of.value), measured);
        measured
    }

    #[test]
    fn of_many_exponents() {
        assert_eq!(dimension(&[-0.1, -0.2], 0.01), Some(0.0));
        assert_eq!(dimension(&[0.005, -0.2], 0.01), None);
        assert_eq!(dimension(&[f64::NAN, -0.2], 0.01), None);
        assert_eq!(dimension(&[0.25, -0.25], 0.01), Some(2.0));
        assert_eq!(dimension(&[0.25, f64::NEG_INFINITY], 0.01), Some(1.0));
        // the largest j is 3: 0.5 + 0.25 - 0.5 = 0.25
        assert_eq!(dimension(&[0.5, 0.25, -0.5, -1.0], 0.01), Some(3.25));
    }

    #[test]
    fn by_the_signs_of_the_exponents() {
        assert_eq!(dimension(&[0.25, -0.5], 0.0), Some(1.5));
        assert_eq!(dimension(&[-0.25, -0.5], 0.0), Some(0.0));
        assert_eq!(dimension(&[f64::NEG_INFINITY; 2], 0.0), Some(0.0));
        assert_eq!(dimension(&[0.0, 0.0], 0.0), None);
        assert_eq!(dimension(&[0.1, -0.5], 0.2), None);
        assert_eq!(dimension(&[f64::NAN; 2], 0.0), None);
    }
}
