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

#[cfg(test)]
mod tests {
    use super::*;

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
