//! First zeros of polynomials on [0, 1], by their coefficients in Bernstein's form.
//!
//! A polynomial lies within the hull of its Bernstein coefficients: if all are positive, it has no zero. Halving the
//! interval by de Casteljau's scheme brings them closer to the polynomial.

use crate::regime::{TERMS, bernstein};

const ORDER: usize = TERMS - 1;
/// The interval is halved this many times at most.
const DEPTH: u32 = 48;
/// The length of the last interval.
#[allow(clippy::cast_precision_loss)] // a power of two
pub(super) const RESOLUTION: f64 = 1.0 / (1_u64 << DEPTH) as f64;

/// A step of Newton's method of this length is followed by one below the resolution.
const NEAR: f64 = 1e-9;

/// A point of [0, 1] before which `p`, given by its coefficients in powers, is positive and near which it is not; `None`
/// if it is positive on the whole interval.
pub(super) fn first_zero(p: &[f64; TERMS]) -> Option<f64> {
    first_zero_near(p, f64::NAN)
}

/// The same, with a point near which a zero is expected.
pub(super) fn first_zero_near(p: &[f64; TERMS], guess: f64) -> Option<f64> {
    if p[0] <= 0.0 {
        return Some(0.0);
    }
    // all falling terms together cannot reach zero
    if p[0] + p[1..].iter().map(|c| c.min(0.0)).sum::<f64>() > 0.0 {
        return None;
    }
    search(p, &bernstein(p), (0.0, 1.0), DEPTH, guess)
}

/// Whether the Bernstein coefficients change from positive to negative once: then there is one zero, and it is a crossing.
fn crosses_once(b: &[f64; TERMS]) -> bool {
    let first = b.iter().position(|value| *value <= 0.0).unwrap_or(TERMS);
    b[first..].iter().all(|value| *value < 0.0)
}

/// The crossing of a polynomial that is positive at one point and negative at another, by Newton's method, from below.
fn crossing(p: &[f64; TERMS], from: f64, width: f64, b: &[f64; TERMS], guess: f64) -> f64 {
    let (mut low, mut high) = (from, from + width);
    // the zero of the line between the ends, if there is no better guess
    let mut t = if guess > low && guess < high { guess } else { from + width * (b[0] / (b[0] - b[ORDER])) };
    for round in 0..64 {
        let (height, slope) = value(p, t);
        if height > 0.0 {
            low = low.max(t);
        } else {
            high = high.min(t);
        }
        if high - low <= 2.0 * RESOLUTION {
            break;
        }
        let mut next = t - height / slope;
        // halving ends where Newton's method goes to and fro
        if !(next > low && next < high) || round > 12 {
            next = 0.5 * (low + high);
        }
        // near the zero: points on both sides of it, if the next step would be below the resolution
        if (next - t).abs() <= NEAR {
            let (before, behind) = (next - RESOLUTION, next + RESOLUTION);
            if before > low && value(p, before).0 > 0.0 {
                low = before;
            }
            if behind < high && value(p, behind).0 <= 0.0 {
                high = behind;
            }
        }
        t = next;
    }
    low
}

/// Whether the polynomial is positive on [0, 1]; not decided by halving, so `false` may be wrong.
pub(super) fn is_positive(p: &[f64; TERMS]) -> bool {
    // all falling terms together cannot reach zero, or the hull is positive
    p[0] > 0.0
        && (p[0] + p[1..].iter().map(|c| c.min(0.0)).sum::<f64>() > 0.0
            || bernstein(p).iter().all(|value| *value > 0.0))
}

/// The same between two points, from the Bernstein coefficients there.
fn search(p: &[f64; TERMS], b: &[f64; TERMS], (from, width): (f64, f64), depth: u32, guess: f64) -> Option<f64> {
    if b.iter().all(|value| *value > 0.0) {
        return None;
    }
    // an interval that cannot be halved further counts as a zero
    if b[0] <= 0.0 || depth == 0 {
        return Some(from);
    }
    if crosses_once(b) {
        return Some(crossing(p, from, width, b, guess));
    }
    // the left half first: the first zero is asked for
    let (left, right) = halves(b);
    search(p, &left, (from, 0.5 * width), depth - 1, guess)
        .or_else(|| search(p, &right, (from + 0.5 * width, 0.5 * width), depth - 1, guess))
}

/// The Bernstein coefficients on both halves.
fn halves(b: &[f64; TERMS]) -> ([f64; TERMS], [f64; TERMS]) {
    let (mut left, mut right) = (*b, *b);
    for k in 1..TERMS {
        // from the end, so that each value is still that of the round before
        for j in (k..TERMS).rev() {
            left[j] = 0.5 * (left[j - 1] + left[j]);
        }
        for j in 0..TERMS - k {
            right[j] = 0.5 * (right[j] + right[j + 1]);
        }
    }
    (left, right)
}

/// The value and the derivative at `t`.
pub(super) fn value(p: &[f64; TERMS], t: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for c in p.iter().rev() {
        slope = slope * t + value;
        value = value * t + c;
    }
    (value, slope)
}

/// Whether the derivative is negative between two points.
pub(super) fn falls(p: &[f64; TERMS], from: f64, to: f64) -> bool {
    // the coefficients of the derivative, shifted to `from` and scaled
    let mut d = [0.0; TERMS];
    let mut k = 1.0;
    for j in 1..TERMS {
        d[j - 1] = k * p[j];
        k += 1.0;
    }
    // the shift by Horner's scheme, one power after another
    for i in 0..TERMS {
        for j in (i..TERMS - 1).rev() {
            d[j] += from * d[j + 1];
        }
    }
    let (width, mut power) = (to - from, 1.0);
    for c in &mut d {
        // the negative slope, which must be positive between both points
        *c *= -power;
        power *= width;
    }
    d[0] > 0.0 && first_zero(&d).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(roots: &[f64]) -> [f64; TERMS] {
        let mut p = [0.0; TERMS];
        p[0] = 1.0;
        for (n, root) in roots.iter().enumerate() {
            for j in (0..=n + 1).rev() {
                p[j] = root * p[j] - if j > 0 { p[j - 1] } else { 0.0 };
            }
        }
        p
    }

    #[test]
    fn the_first_zero_is_found_and_none_is_missed() {
        for roots in [&[0.3, 0.7][..], &[0.9, 0.31, 0.32], &[0.5, 0.5000001, 3.0], &[1e-9, 0.4], &[0.999_999]] {
            let p = polynomial(roots);
            let first = roots.iter().copied().fold(1.0, f64::min);
            let found = first_zero(&p).unwrap();
            assert!(found <= first * (1.0 + 1e-9) && found > first - 1e-6, "{roots:?}: {found}");
            assert!(value(&p, found).0 >= -1e-12);
        }
        assert_eq!(first_zero(&polynomial(&[1.5, 2.0])), None);
        let mut near = polynomial(&[0.5, 0.5]);
        near[0] += 1e-13;
        assert_eq!(first_zero(&near), None);
        near[0] -= 1e-12;
        assert!(first_zero(&near).is_some());
    }

    #[test]
    fn falling_polynomials() {
        let p = polynomial(&[0.3, 0.9]);
        assert!(falls(&p, 0.2, 0.5) && !falls(&p, 0.2, 0.7));
        assert!((value(&p, 0.5).0 + 0.08).abs() < 1e-15 && (value(&p, 0.6).1).abs() < 1e-15);
    }
}
