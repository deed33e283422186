//! The smallest change of a vector that changes its components along some directions by given amounts.

use super::{add_scaled, dot};

/// The part of the amounts below which the rest is a rounding error.
const DONE: f64 = 1e-30;

/// Changes `x` by the smallest vector whose components along the directions are the amounts: `x += d` with `w_i d = a_i`,
/// and with the least squares of the errors if directions depend on each other.
///
/// It is the method of conjugate gradients for least squares (CGLS; Björck, Elfving and Strakoš, 1998,
/// doi:10.1137/S089547989631202X). It treats all directions alike: amounts that are equal for mirrored directions change nothing
/// that is asymmetric, to the last bit. An elimination, which takes one direction after another, would leave rounding errors
/// there, which grow in a motion that is unstable against them.
pub(crate) fn change_along(directions: &[(&[f64], f64)], x: &mut [f64]) {
    let largest = directions.iter().fold(0.0_f64, |so_far, (_, amount)| so_far.max(amount.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return;
    }
    if let [(w, amount)] = directions {
        add_scaled(x, amount / dot(w, w), w);
        return;
    }
    // of unit vectors, so that directions of all lengths are met to the same number of digits
    let lengths: Vec<f64> = directions.iter().map(|(w, _)| dot(w, w).sqrt()).collect();
    let mut left: Vec<f64> =
        directions.iter().zip(&lengths).map(|((_, amount), length)| amount / largest / length).collect();
    let gradient = |left: &[f64]| {
        let mut sum = vec![0.0; x.len()];
        directions
            .iter()
            .zip(left)
            .zip(&lengths)
            .for_each(|(((w, _), left), length)| add_scaled(&mut sum, left / length, w));
        sum
    };
    let mut along = gradient(&left);
    let mut square = dot(&along, &along);
    let (first, mut change) = (square, vec![0.0; x.len()]);
    // exact arithmetic needs as many steps as there are directions; the rest is for rounding
    for _ in 0..2 * directions.len() {
        let seen: Vec<f64> = directions.iter().zip(&lengths).map(|((w, _), length)| dot(w, &along) / length).collect();
        let step = square / dot(&seen, &seen);
        if !step.is_finite() {
            break;
        }
        add_scaled(&mut change, step, &along);
        add_scaled(&mut left, -step, &seen);
        let next = gradient(&left);
        let before = core::mem::replace(&mut square, dot(&next, &next));
        if square <= DONE * first {
            break;
        }
        // conjugate to the one before
        along = next.iter().zip(&along).map(|(next, along)| next + square / before * along).collect();
    }
    add_scaled(x, largest, &change);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_component_changes_by_its_amount() {
        let rows = [[1.0, 2.0, 0.0, 0.5], [0.0, 1.0, -1.0, 0.0], [3.0, 0.0, 1.0, 1.0]];
        let amounts = [1e-17, -3e-16, 2e-16];
        let mut x = [0.0; 4];
        let directions: Vec<(&[f64], f64)> = rows.iter().zip(amounts).map(|(w, amount)| (&w[..], amount)).collect();
        change_along(&directions, &mut x);
        for (w, amount) in &directions {
            assert!((dot(w, &x) - amount).abs() < 1e-13 * 3e-16, "{x:?}");
        }
    }

    /// The two ends of a bar move it without turning it, whatever its inertia; so do stops that are there twice.
    #[test]
    fn mirrored_amounts_turn_nothing() {
        for arm in [0.1, 0.7, 1.0, 1.826, 31.0] {
            let (left, right) = ([0.3, -arm], [0.3, arm]);
            let mut x = [0.0; 2];
            let directions: [(&[f64], f64); 4] = [(&left, 1e-7), (&right, 1e-7), (&left, 1e-7), (&right, 1e-7)];
            change_along(&directions, &mut x);
            assert!(x[1] == 0.0 && (x[0] * 0.3 / 1e-7 - 1.0).abs() < 1e-15, "{arm}: {x:?}");
        }
    }
}
