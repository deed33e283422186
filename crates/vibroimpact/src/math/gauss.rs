//! The Gauss-Legendre rule with 16 points, and the polynomials through its points.
//!
//! A polynomial of degree 15 on [-1, 1] is determined by its values at the points. Its Legendre coefficients
//! $`c_k = \frac{2k+1}{2}\sum_i w_i P_k(x_i) f_i`$ are exact, because the rule is exact up to degree 31.

/// The number of points.
pub(crate) const POINTS: usize = 16;

/// Points and weights of the rule on [-1, 1], for the points on both sides of the middle.
pub(crate) const RULE: [(f64, f64); POINTS / 2] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_64),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_64),
    (0.458_016_777_657_227_37, 0.169_156_519_395_002_65),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_77),
    (0.755_404_408_355_003, 0.124_628_971_255_534_07),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_6),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_456),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_176),
];

/// A smaller Legendre coefficient, relative to the largest one, is rounding.
const NEGLIGIBLE: f64 = 2.0 * f64::EPSILON;

/// The rule with its points in ascending order, and the polynomials through them.
#[derive(Clone, Debug)]
pub(crate) struct Gauss {
    /// Points and weights on [-1, 1].
    pub(crate) points: [(f64, f64); POINTS],
    /// Row `k` gives the Legendre coefficient of degree `k` from the values at the points.
    to_series: [[f64; POINTS]; POINTS],
    /// Row `k` has the coefficients of $`P_k`$ by powers.
    powers: [[f64; POINTS]; POINTS],
}

impl Gauss {
    pub(crate) fn new() -> Self {
        let mut points = [(0.0, 0.0); POINTS];
        for (k, (place, weight)) in RULE.into_iter().enumerate() {
            points[POINTS / 2 + k] = (place, weight);
            points[POINTS / 2 - 1 - k] = (-place, weight);
        }
        let mut powers = [[0.0; POINTS]; POINTS];
        (powers[0][0], powers[1][1]) = (1.0, 1.0);
        let mut to_series = [[0.0; POINTS]; POINTS];
        for (i, (x, weight)) in points.into_iter().enumerate() {
            let (mut one, mut two, mut degree) = (1.0, x, 0.0);
            for row in &mut to_series {
                row[i] = (degree + 0.5) * weight * one;
                // (k + 2) P_{k+2} = (2k + 3) x P_{k+1} - (k + 1) P_k
                (one, two) = (two, ((2.0 * degree + 3.0) * x * two - (degree + 1.0) * one) / (degree + 2.0));
                degree += 1.0;
            }
        }
        let mut degree = 2.0;
        for k in 2..POINTS {
            for j in 0..POINTS {
                // k P_k = (2k - 1) x P_{k-1} - (k - 1) P_{k-2}
                let before = if j > 0 { powers[k - 1][j - 1] } else { 0.0 };
                powers[k][j] = ((2.0 * degree - 1.0) * before - (degree - 1.0) * powers[k - 2][j]) / degree;
            }
            degree += 1.0;
        }
        Self { points, to_series, powers }
    }

    /// Widens a range to that of the polynomial with these values at the points, and these at the ends, which the polynomial
    /// has to a few roundings. What cannot exceed the range is not
    /// searched. Between two places at a distance $`d`$ a polynomial exceeds its values there by at most
    /// $`\tfrac18 d^2\max|p''|`$, so no extreme is missed.
    pub(crate) fn widen(&self, values: &[f64; POINTS], ends: [f64; 2], range: &mut (f64, f64)) {
        for value in values.iter().chain(&ends) {
            *range = (range.0.min(*value), range.1.max(*value));
        }
        let mut series = [0.0; POINTS];
        for (to, row) in series.iter_mut().zip(&self.to_series) {
            *to = row.iter().zip(values).fold(0.0, |sum, (factor, value)| sum + factor * value);
        }
        // every Legendre polynomial lies between -1 and 1, and its derivatives are largest at the ends
        let (mut reach, mut curve, mut twist, mut degree) = (0.0, 0.0, 0.0, 1.0);
        for c in series[1..].iter().map(|c| c.abs()) {
            // the second derivative of the Legendre polynomial at 1; the third follows from it
            let second = (degree - 1.0) * degree * (degree + 1.0) * (degree + 2.0) / 8.0;
            reach += c;
            curve += c * second;
            twist += c * second * (degree - 2.0) * (degree + 3.0) / 6.0;
            degree += 1.0;
        }
        if series[0] + reach <= range.1 && series[0] - reach >= range.0 || !reach.is_finite() {
            return;
        }
        let largest = series.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        let degree = series.iter().rposition(|c| c.abs() > NEGLIGIBLE * largest).unwrap_or(0);
        let mut p = [0.0; POINTS];
        for (c, row) in series[..=degree].iter().zip(&self.powers) {
            for (to, power) in p.iter_mut().zip(row) {
                *to += c * power;
            }
        }
        let polynomial = Polynomial { p: &p[..=degree], curve, twist };
        let mut before = (-1.0, ends[0]);
        let places = self.points.iter().zip(values).map(|((x, _), value)| (*x, *value));
        for next in places.chain([(1.0, ends[1])]) {
            polynomial.highest(1.0, before, next, &mut range.1);
            let mut least = -range.0;
            polynomial.highest(-1.0, (before.0, -before.1), (next.0, -next.1), &mut least);
            range.0 = -least;
            before = next;
        }
    }
}

/// A polynomial by powers, with bounds of its second and third derivative on [-1, 1].
struct Polynomial<'a> {
    p: &'a [f64],
    curve: f64,
    twist: f64,
}

impl Polynomial<'_> {
    /// Its value, slope and second derivative.
    fn at(&self, x: f64) -> (f64, f64, f64) {
        let (mut value, mut slope, mut half) = (0.0, 0.0, 0.0);
        for c in self.p.iter().rev() {
            half = half * x + slope;
            slope = slope * x + value;
            value = value * x + c;
        }
        (value, slope, 2.0 * half)
    }

    /// Raises `most` to the largest value between two places, of the polynomial with this sign; its values at both are
    /// given and known.
    fn highest(&self, sign: f64, from: (f64, f64), to: (f64, f64), most: &mut f64) {
        let (length, half) = (to.0 - from.0, 0.5 * (to.0 - from.0));
        let bump = 0.125 * length * length * self.curve;
        let top = from.1.max(to.1);
        if top + bump <= *most || bump <= f64::EPSILON * top.abs() || length < 1e-9 {
            return;
        }
        let middle = from.0 + half;
        let (value, slope, bend) = self.at(middle);
        let (value, slope, bend) = (sign * value, sign * slope, sign * bend);
        if slope.abs() > half * self.curve || bend - half * self.twist > 0.0 {
            // it rises or falls all the way, or has a minimum
            return;
        }
        if bend + half * self.twist < 0.0 {
            // one maximum at most
            let mut x = middle;
            for _ in 0..8 {
                let (value, slope, bend) = self.at(x);
                *most = most.max(sign * value);
                let next = (x - slope / bend).clamp(from.0, to.0);
                let moved = next - x;
                x = next;
                // a maximum is flat: half the digits of its place give all of its digits
                if moved.abs() < 1e-9 {
                    break;
                }
            }
            return;
        }
        *most = most.max(value);
        self.highest(sign, from, (middle, value), most);
        self.highest(sign, (middle, value), to, most);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sin_cos;

    fn values(gauss: &Gauss, f: impl Fn(f64) -> f64) -> [f64; POINTS] {
        gauss.points.map(|(x, _)| f(x))
    }

    /// The range of harmonics of up to 2.5 radians over the interval, against that of many points, and known maxima.
    #[test]
    fn ranges_of_harmonics() {
        let gauss = Gauss::new();
        assert!((gauss.points.iter().map(|(_, weight)| weight).sum::<f64>() - 2.0).abs() < 1e-15);
        for case in 0..200_u32 {
            let real = f64::from(case);
            let (rate, phase) = (1.25 * (real * 0.37 % 1.0), real * 0.71);
            let f = |x: f64| sin_cos(rate * x + phase).0 + 0.3 * sin_cos(0.4 * rate * x - 2.0 * phase).1;
            let mut range = (f64::INFINITY, f64::NEG_INFINITY);
            gauss.widen(&values(&gauss, f), [f(-1.0), f(1.0)], &mut range);
            let dense = (0..=4000_u32).map(|k| f(f64::from(k) / 2000.0 - 1.0));
            let (low, high) = dense.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (y.min(a), y.max(b)));
            assert!(range.0 <= low + 2e-15 && range.0 > low - 1e-6, "{rate} {phase}: {range:?} {low}");
            assert!(range.1 >= high - 2e-15 && range.1 < high + 1e-6, "{rate} {phase}: {range:?} {high}");
        }
        let mut range = (0.0, 0.0);
        let f = |x: f64| 3.0 * sin_cos(1.25 * x + 1.5).0;
        gauss.widen(&values(&gauss, f), [f(-1.0), f(1.0)], &mut range);
        assert!((range.1 - 3.0).abs() < 2e-15 * 3.0, "{range:?}");
        // two maxima between points of the rule, and a range that is wide enough already
        let p = |x: f64| x * x * (0.01 - x * x);
        let mut range = (0.0, 0.0);
        gauss.widen(&values(&gauss, p), [p(-1.0), p(1.0)], &mut range);
        assert!((range.1 - 2.5e-5).abs() < 1e-15, "{range:?}");
        let mut range = (-10.0, 10.0);
        gauss.widen(&values(&gauss, p), [p(-1.0), p(1.0)], &mut range);
        assert_eq!(range, (-10.0, 10.0));
    }
}
