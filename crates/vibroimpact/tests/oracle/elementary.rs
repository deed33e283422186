//! Sine, cosine and the decaying exponential with 256 binary places, by tables and Taylor series.
//!
//! An angle is reduced by whole quarter turns, then by the nearest 128th; what is left, at most 1/256, needs eleven
//! terms of each series. The tables are filled by the series themselves, run to their end.

use super::fixed::Fixed;
use std::sync::LazyLock;

/// Table entries per unit.
const FINE: u16 = 128;
/// Beyond this $e^{-a}$ is below $2^{-256}$.
const LAST: usize = 180;
const TERMS: usize = 26;

struct Tables {
    /// $1/n!$.
    inverse_factorial: Vec<Fixed>,
    /// Sine and cosine of $j/128$.
    circle: Vec<(Fixed, Fixed)>,
    /// $e^{-n}$ and $e^{-j/128}$.
    decay: Vec<Fixed>,
    fine_decay: Vec<Fixed>,
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let mut inverse_factorial = vec![Fixed::ONE];
    for n in 1..=TERMS {
        inverse_factorial.push(inverse_factorial[n - 1].over(n as u64));
    }
    let circle = (0..=FINE).map(|j| long_series(Fixed::from_f64(f64::from(j) / f64::from(FINE)))).collect();
    let powers = |of: Fixed, count: usize| {
        core::iter::successors(Some(Fixed::ONE), move |&last| Some(last * of)).take(count).collect()
    };
    let decay = powers(long_decay(Fixed::ONE), LAST);
    let fine_decay = powers(long_decay(Fixed::ONE.over(u64::from(FINE))), usize::from(FINE));
    Tables { inverse_factorial, circle, decay, fine_decay }
});

/// Sine and cosine by the whole series, for $|x| \le 1$.
fn long_series(x: Fixed) -> (Fixed, Fixed) {
    let (mut sine, mut cosine, mut term) = (Fixed::ZERO, Fixed::ZERO, Fixed::ONE);
    for n in 0..80_u64 {
        match n % 4 {
            0 => cosine = cosine + term,
            1 => sine = sine + term,
            2 => cosine = cosine - term,
            _ => sine = sine - term,
        }
        term = (term * x).over(n + 1);
    }
    (sine, cosine)
}

fn long_decay(x: Fixed) -> Fixed {
    let (mut sum, mut term) = (Fixed::ZERO, Fixed::ONE);
    for n in 0..80_u64 {
        sum = sum + term;
        term = -(term * x).over(n + 1);
    }
    sum
}

/// Sine and cosine of an angle below about $10^{15}$.
pub(crate) fn sin_cos(angle: Fixed) -> (Fixed, Fixed) {
    let turns = (angle.to_f64() * core::f64::consts::FRAC_2_PI).round();
    #[allow(clippy::cast_possible_truncation)] // a whole number below 1e15
    let quarters = turns as i64;
    let rest = angle - Fixed::HALF_PI.times(quarters);
    let (sine, cosine) = within_an_eighth(rest.abs());
    let sine = if rest.is_negative() { -sine } else { sine };
    match quarters.rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// For $0 \le x \le 1$.
fn within_an_eighth(x: Fixed) -> (Fixed, Fixed) {
    let tables = &*TABLES;
    let j = whole(x.to_f64() * f64::from(FINE) + 0.5);
    let (table_sine, table_cosine) = tables.circle[j];
    let t = x - Fixed::from_int(j as i64).over(u64::from(FINE));
    let square = t * t;
    let (mut sine, mut cosine) = (Fixed::ZERO, Fixed::ZERO);
    for n in (0..=11).rev() {
        sine = tables.inverse_factorial[2 * n + 1] - sine * square;
        cosine = tables.inverse_factorial[2 * n] - cosine * square;
    }
    sine = sine * t;
    (table_sine * cosine + table_cosine * sine, table_cosine * cosine - table_sine * sine)
}

/// $e^{-a}$ for $a \ge 0$.
pub(crate) fn decay(a: Fixed) -> Fixed {
    let tables = &*TABLES;
    let n = whole(a.to_f64());
    if n + 1 >= LAST {
        return Fixed::ZERO;
    }
    let rest = a - Fixed::from_int(n as i64);
    // rounding of `a` to a double may leave a rest of -1e-16: the series does not mind
    let j = whole((rest.to_f64() * f64::from(FINE)).max(0.0)).min(usize::from(FINE) - 1);
    let t = rest - Fixed::from_int(j as i64).over(u64::from(FINE));
    let mut sum = Fixed::ZERO;
    for n in (0..TERMS).rev() {
        sum = tables.inverse_factorial[n] - sum * t;
    }
    // Horner with alternating signs: 1 - t (1 - t (1/2 - ...)), where term n carries 1/n!
    tables.decay[n] * tables.fine_decay[j] * sum
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small number, not negative
fn whole(x: f64) -> usize {
    x as usize
}
