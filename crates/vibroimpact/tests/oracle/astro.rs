//! The oracle's own arithmetic against astro-float: an arbitrary-precision library that shares nothing with it.

use super::elementary::{decay, sin_cos};
use super::fixed::Fixed;
use super::random::Random;
use super::textbook::{Data, Solution};
use astro_float_num::{BigFloat, Consts, RoundingMode};

/// Bits of the reference.
const BITS: usize = 640;
const TO_EVEN: RoundingMode = RoundingMode::ToEven;

struct Reference {
    consts: Consts,
}

impl Reference {
    fn new() -> Self {
        Self { consts: Consts::new().expect("room for the constants") }
    }
    fn real(x: f64) -> BigFloat {
        BigFloat::from_f64(x, BITS)
    }
    fn add(a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.add(b, BITS, TO_EVEN)
    }
    fn sub(a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.sub(b, BITS, TO_EVEN)
    }
    fn mul(a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.mul(b, BITS, TO_EVEN)
    }
    fn sin(&mut self, a: &BigFloat) -> BigFloat {
        a.sin(BITS, TO_EVEN, &mut self.consts)
    }
    fn cos(&mut self, a: &BigFloat) -> BigFloat {
        a.cos(BITS, TO_EVEN, &mut self.consts)
    }
    fn exp(&mut self, a: &BigFloat) -> BigFloat {
        a.exp(BITS, TO_EVEN, &mut self.consts)
    }

    /// How far a fixed-point number is from the reference, in steps of $2^{-256}$.
    fn off(fixed: Fixed, reference: &BigFloat) -> f64 {
        // peel the fixed-point number off in doubles, exactly
        let (mut rest, mut left) = (fixed, reference.clone());
        for _ in 0..8 {
            let head = rest.to_f64();
            rest = rest - Fixed::from_f64(head);
            left = Self::sub(&left, &Self::real(head));
        }
        assert_eq!(rest, Fixed::ZERO, "eight doubles hold any fixed-point number");
        let scaled = Self::mul(&left.abs(), &Self::real(2_f64.powi(256)));
        double(&scaled)
    }
}

/// Near enough for a comparison.
fn double(x: &BigFloat) -> f64 {
    if x.is_zero() {
        return 0.0;
    }
    let digits = x.mantissa_digits().and_then(|words| words.last().copied()).expect("a finite number");
    #[allow(clippy::cast_precision_loss)]
    let mantissa = digits as f64 * 2_f64.powi(-64);
    mantissa * 2_f64.powi(x.exponent().expect("a finite number"))
}

#[test]
fn elementary_functions() {
    let mut reference = Reference::new();
    let mut random = Random::new(11, 0);
    let two_over = Reference::real(2.0);
    let pi = reference.consts.pi(BITS, TO_EVEN);
    assert!(Reference::off(Fixed::HALF_PI, &pi.div(&two_over, BITS, TO_EVEN)) <= 0.5);
    for _ in 0..400 {
        let x = random.sign() * random.decade(-9.0, 4.5);
        let (big, fixed) = (Reference::real(x), Fixed::from_f64(x));
        let (sine, cosine) = sin_cos(fixed);
        let allowed = 100.0 + 4.0 * x.abs();
        let (es, ec) = (Reference::off(sine, &reference.sin(&big)), Reference::off(cosine, &reference.cos(&big)));
        assert!(es < allowed && ec < allowed, "sin, cos {x}: {es} {ec}");
        let e = Reference::off(decay(fixed.abs()), &reference.exp(&big.abs().neg()));
        assert!(e < 400.0, "exp {x}: {e}");
        let e = Reference::off(fixed.inverse(), &Reference::real(1.0).div(&big, BITS, TO_EVEN));
        assert!(e < 4.0 * (1.0 + x.powi(-2)), "1/{x}: {e}");
        let root = fixed.abs() * fixed.abs().inverse_sqrt();
        let e = Reference::off(root, &big.abs().sqrt(BITS, TO_EVEN));
        assert!(e < 8.0 * (1.0 + x.abs()) * (1.0 + x.abs().recip()), "sqrt {x}: {e}");
    }
}

/// The flight through the propagator of its first-order system, $e^{Mt}$ by scaling and squaring: no formula of the
/// textbook's in it. The state is $(x, v, \sin\theta, \cos\theta)$.
fn by_matrix(beta: f64, zeta: f64, start: [BigFloat; 4], s: f64) -> [BigFloat; 4] {
    let zero = Reference::real(0.0);
    let one = Reference::real(1.0);
    let (b, z2) = (Reference::real(beta), Reference::real(2.0 * zeta));
    let m = [
        [zero.clone(), one.clone(), zero.clone(), zero.clone()],
        [one.neg(), z2.neg(), one.clone(), zero.clone()],
        [zero.clone(), zero.clone(), zero.clone(), b.clone()],
        [zero.clone(), zero.clone(), b.neg(), zero.clone()],
    ];
    // series steps of 1/(4 (1 + beta + 2 zeta)) at most: 90 terms leave nothing of 640 bits to be seen in 256
    let steps = (s * 4.0 * (1.0 + beta + 2.0 * zeta)).ceil().max(1.0);
    let h = Reference::real(s).div(&Reference::real(steps), BITS, TO_EVEN);
    let mut state = start;
    let mut k = 0.0;
    while k < steps {
        let (mut term, mut sum) = (state.clone(), state.clone());
        for n in 1..60_u32 {
            let scale = h.div(&Reference::real(f64::from(n)), BITS, TO_EVEN);
            let next: Vec<BigFloat> = m
                .iter()
                .map(|row| {
                    let product = row.iter().zip(&term).fold(zero.clone(), |sum, (a, b)| {
                        if a.is_zero() { sum } else { Reference::add(&sum, &Reference::mul(a, b)) }
                    });
                    Reference::mul(&product, &scale)
                })
                .collect();
            term = next.try_into().expect("four components");
            for (total, part) in sum.iter_mut().zip(&term) {
                *total = Reference::add(total, part);
            }
        }
        state = sum;
        k += 1.0;
    }
    state
}

#[test]
fn whole_flights() {
    let mut reference = Reference::new();
    let mut random = Random::new(12, 0);
    for _ in 0..150 {
        let (beta, zeta) = (random.beta().min(20.0), random.damping());
        let (x, v, phase) = (random.gap(), random.sign() * random.decade(-9.0, 1.0), random.phase());
        let s = random.decade(-9.0, 0.6);
        let real = Reference::real;
        let start = [real(x), real(v), reference.sin(&real(phase)), reference.cos(&real(phase))];
        let want = by_matrix(beta, zeta, start, s);
        let exact = Fixed::from_f64;
        let force = sin_cos(exact(phase));
        let data = Data { beta: exact(beta), zeta: exact(zeta), x: exact(x), v: exact(v), force };
        let node = Solution::new(data).at(exact(s));
        // 2^-256 = 1e-77; the textbook form may lose 24 digits, and more than 1e-18 * 1e-30 must be left
        let (ex, ev) = (Reference::off(node.d + exact(x), &want[0]), Reference::off(node.v, &want[1]));
        assert!(ex < 1e26 && ev < 1e26, "beta {beta} zeta {zeta} x {x} v {v} phase {phase} s {s}: {ex:e} {ev:e}");
        let a = reference_acceleration(&want, zeta);
        assert!((node.a - a).abs() < 1e-13 * (1.0 + x.abs() + (1.0 + zeta) * v.abs()) * (1.0 + zeta) * 10.0);
    }
}

fn reference_acceleration(state: &[BigFloat; 4], zeta: f64) -> f64 {
    let a =
        Reference::sub(&Reference::sub(&state[2], &state[0]), &Reference::mul(&Reference::real(2.0 * zeta), &state[1]));
    if a.is_negative() { -double(&a.abs()) } else { double(&a) }
}
