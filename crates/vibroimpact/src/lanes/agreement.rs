//! Compares every operation of every lane type with the same operation on one number, to the bit, including ties, zeros
//! of both signs, infinities and NaN.

use super::pack::Pack;
use crate::math::{Lane, Mask, Numbers, Single};

/// Special and ordinary numbers.
const NUMBERS: [f64; 12] = [0.0, -0.0, 1.0, -1.0, 1.5, 2.5, -2.5, 0.1, 1e-300, 7.25e5, f64::INFINITY, f64::NAN];

/// All pairs of these numbers, `width` at a time.
fn pairs(width: usize) -> impl Iterator<Item = (Vec<f64>, Vec<f64>)> {
    let all: Vec<(f64, f64)> = NUMBERS.iter().flat_map(|a| NUMBERS.iter().map(move |b| (*a, *b))).collect();
    (0..all.len()).map(move |first| (0..width).map(|k| all[(first + k) % all.len()]).unzip())
}

fn numbers<L: Lane>(lanes: L) -> Vec<f64> {
    let mut all = vec![0.0; L::WIDTH];
    lanes.store(&mut all);
    all
}

fn roughly<N: Single>(lanes: N) -> Vec<f32> {
    let mut all = vec![0.0; N::WIDTH];
    lanes.store(&mut all);
    all
}

/// Whether the bits are equal; all NaN are equal.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Whether the lanes have what one number has for each pair.
fn compare(name: &str, lanes: &[f64], (a, b): (&[f64], &[f64]), one: fn(f64, f64) -> f64) {
    for (k, got) in lanes.iter().enumerate() {
        assert!(same(*got, one(a[k], b[k])), "{name} of {} and {}: {got}", a[k], b[k]);
    }
}

fn check<L: Lane>() {
    for (a, b) in pairs(L::WIDTH) {
        let (x, y) = (L::load(&a), L::load(&b));
        let each = |name: &str, lanes: L, one: fn(f64, f64) -> f64| compare(name, &numbers(lanes), (&a, &b), one);
        each("sum", x + y, |a, b| a + b);
        each("difference", x - y, |a, b| a - b);
        each("product", x * y, |a, b| a * b);
        each("quotient", x / y, |a, b| a / b);
        each("negative", -x, |a, _| -a);
        each("magnitude", x.abs(), |a, _| a.abs());
        each("greater", x.max(y), <f64 as Numbers>::max);
        each("lesser", x.min(y), <f64 as Numbers>::min);
        each("root", Numbers::sqrt(x), |a, _| a.sqrt());
        each("floor", Lane::floor(x), |a, _| a.floor());
        each("choice", L::choose(x.less(y), x, y), |a, b| if a < b { a } else { b });
        each("width and back", L::widened(x.rounded()), |a, _| f64::widened(a.rounded()));
        let less = |k: usize| a[k] < b[k];
        let bits = |truth: &dyn Fn(usize) -> bool| (0..L::WIDTH).fold(0, |bits, k| bits | u32::from(truth(k)) << k);
        assert_eq!(x.less(y).bits(), bits(&less), "{a:?} < {b:?}");
        assert_eq!(x.less(y).and(y.less(x)).bits(), 0);
        assert_eq!(x.less(y).or(y.less(x)).bits(), bits(&|k| a[k] < b[k] || b[k] < a[k]));
        // the numbers that are less, moved to the front
        let some = bits(&less);
        let mut front = vec![0.0_f32; L::WIDTH + 16];
        x.rounded().store_some(some, &mut front);
        let want: Vec<f32> = (0..L::WIDTH).filter(|k| some >> k & 1 == 1).map(|k| a[k].rounded()).collect();
        assert!(want.iter().zip(&front).all(|(want, got)| same(f64::from(*want), f64::from(*got))), "{some:b} {a:?}");
        let rough = roughly(x.rounded() * y.rounded());
        assert!((0..L::WIDTH).all(|k| same(f64::from(rough[k]), f64::from(a[k].rounded() * b[k].rounded()))));
    }
    for quarter in -9..9 {
        let angles: Vec<f64> = (0..L::WIDTH).map(|k| f64::from(quarter) * 1.5 + 0.3 * k as f64).collect();
        let (sin, cos) = L::load(&angles).sine_and_cosine();
        let (sin, cos) = (numbers(sin), numbers(cos));
        assert!(angles.iter().zip(sin.iter().zip(&cos)).all(|(x, (s, c))| (*s, *c) == crate::math::sin_cos(*x)));
    }
}

#[test]
fn every_lane_type_does_what_one_number_does() {
    check::<f64>();
    check::<Pack<f64, 4>>();
    #[cfg(target_arch = "x86_64")]
    {
        use super::{Width, avx2::Four, avx512::Eight, pair::Pair};
        if Width::Avx2.available() {
            check::<Four>();
            check::<Pair<Four>>();
            check::<Pair<Pair<Four>>>();
        }
        if Width::Avx512.available() {
            check::<Eight>();
            check::<Pair<Eight>>();
        }
    }
}
