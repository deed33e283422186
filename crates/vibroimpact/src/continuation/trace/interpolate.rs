//! Cubic interpolation through values at -2, -1, 1 and 2.

/// The abscissas of the four values.
const AT: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];

/// The value of the cubic at `x`.
pub(crate) fn at(x: f64, values: &[f64]) -> f64 {
    let weight = |k: usize| -> f64 {
        let others = AT.iter().enumerate().filter(|(j, _)| *j != k);
        others.map(|(_, other)| (x - other) / (AT[k] - other)).product()
    };
    values.iter().enumerate().map(|(k, value)| value * weight(k)).sum()
}

/// The zero of the cubic near 0, for values that pass through zero there with nearly constant slope. Newton's method
/// with the mean slope, limited to the interval from -2 to 2.
pub(crate) fn zero(values: &[f64]) -> f64 {
    // the slope over the whole range serves all steps of Newton's method
    let slope = (values[3] - values[0]) / 4.0;
    let mut x = 0.0;
    for _ in 0..20 {
        let step = at(x, values) / slope;
        if !step.is_finite() {
            break;
        }
        x = (x - step).clamp(-2.0, 2.0);
        if step.abs() < 1e-14 {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_itself() {
        let f = |x: f64| (x - 0.3) * (1.0 + 0.1 * x + 0.05 * x * x);
        let values = AT.map(f);
        assert!((at(0.7, &values) - f(0.7)).abs() < 1e-15);
        assert!((zero(&values) - 0.3).abs() < 1e-14);
    }
}
