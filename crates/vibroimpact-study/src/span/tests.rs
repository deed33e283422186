//! Tests ranges against long division: exact ends, nearest doubles in between, and values that never step back.

use super::*;

/// A sequence of pseudorandom numbers that is the same on every machine.
struct Chance(u64);

impl Chance {
    /// The next number, less than `most`.
    fn next(&mut self, most: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) % most
    }

    fn count(&mut self, most: u32) -> u32 {
        u32::try_from(self.next(u64::from(most))).unwrap()
    }
}

/// The double nearest to a quotient of integers: seventy decimal places by long division, parsed by the standard
/// library.
fn quotient(above: i128, below: i128) -> f64 {
    let (size, mut rest) = (above.unsigned_abs() / below.unsigned_abs(), above.unsigned_abs() % below.unsigned_abs());
    let mut text = format!("{}{size}.", if above < 0 { "-" } else { "" });
    for _ in 0..70 {
        rest *= 10;
        text.push_str(&(rest / below.unsigned_abs()).to_string());
        rest %= below.unsigned_abs();
    }
    text.parse().unwrap()
}

fn check_order(span: &Span) {
    let (first, last) = span.ends();
    let values: Vec<f64> = span.values().collect();
    assert_eq!((values[0].to_bits(), values[values.len() - 1].to_bits()), (first.to_bits(), last.to_bits()), "{span}");
    let rises = first < last;
    assert!(values.windows(2).all(|pair| if rises { pair[0] <= pair[1] } else { pair[0] >= pair[1] }), "{span}");
    // the same values counted from the other end
    let (low, high, count) = (last, first, span.count());
    let back =
        if span.is_logarithmic() { Span::logarithmic(low, high, count) } else { Span::new(low, high, count) }.unwrap();
    if !span.is_logarithmic() {
        assert!(back.values().zip(values.iter().rev()).all(|(a, b)| a == *b), "{span}");
    }
    assert_eq!(span.to_string().parse::<Span>().unwrap().values().collect::<Vec<_>>(), values, "{span}");
}

#[test]
fn f07_ends_of_decimals_are_exact_and_values_the_nearest() {
    let mut chance = Chance(15);
    for _ in 0..500 {
        let places = chance.count(10);
        let unit = 10_i128.pow(places);
        let mut end = || (chance.next(20_000_001) as i128 - 10_000_000) * if places > 6 { 37 } else { 1 };
        let (a, b) = (end(), end());
        let count = 2 + chance.count(400);
        if a == b {
            continue;
        }
        let text = |whole: i128| format!("{whole}e-{places}");
        let span: Span = format!("{}:{}:{count}", text(a), text(b)).parse().unwrap();
        check_order(&span);
        let steps = i128::from(count - 1);
        for k in 0..count {
            let want = quotient((steps - i128::from(k)) * a + i128::from(k) * b, steps * unit);
            assert_eq!(span.at(k), want, "{span} at {k}");
        }
    }
}

#[test]
fn f07b_any_ends_are_exact_and_values_the_nearest() {
    let mut chance = Chance(7);
    for _ in 0..100 {
        // all bits at random, between 1 and 2
        let mut end = || (1_i128 << 52) + chance.next(1 << 52) as i128;
        let (a, b) = (end(), end());
        let count = 2 + chance.count(3000);
        let of = |whole: i128| whole as f64 / (1_u64 << 52) as f64;
        let span = Span::new(of(a), of(b), count).unwrap();
        let steps = i128::from(count - 1);
        for k in (0..count).step_by(7) {
            let want = quotient((steps - i128::from(k)) * a + i128::from(k) * b, steps) / (1_u64 << 52) as f64;
            // the decimal ends differ from their doubles by at most half a unit in the last place
            let off = (span.at(k) - want).abs();
            assert!(off <= f64::EPSILON, "{span} at {k}: {off:e}");
        }
        check_order(&span);
    }
    for (first, last, count) in [
        (1.0, 1.0 + f64::EPSILON, 1_000_000),
        (-1.7e308, 1.7e308, 1001),
        (5e-324, 2e-323, 9),
        (-0.0, 1e-320, 77),
        (1e300, 1e-300, 50),
        (-1e-9, 1e9, 997),
        (0.1 + 0.2, 3.3, 12),
    ] {
        check_order(&Span::new(first, last, count).unwrap());
    }
    assert_eq!(Span::new(-1.7e308, 1.7e308, 1001).unwrap().at(500), 0.0);
}

#[test]
fn f07c_the_examples() {
    let all = |text: &str| text.parse::<Span>().unwrap().values().collect::<Vec<_>>();
    assert_eq!(all("-0.4:0.7:13")[0], -0.4);
    let inverse = all("0.4:2:13");
    assert_eq!((inverse[0], inverse[6], inverse[12]), (0.4, 1.2, 2.0));
    assert_eq!(all("1.5:1.5:1"), [1.5]);
    assert_eq!(all("-0.1:0.3:5"), [-0.1, 0.0, 0.1, 0.2, 0.3]);
    assert_eq!(all("0.1:0.7:7"), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
    assert_eq!(all("1e-5:5e-5:5"), [1e-5, 2e-5, 3e-5, 4e-5, 5e-5]);
    assert_eq!(all("1e25:3e25:3"), [1e25, 2e25, 3e25]);
}

#[test]
fn f07d_equal_ratios() {
    let all = |text: &str| text.parse::<Span>().unwrap().values().collect::<Vec<_>>();
    assert_eq!(all("1e3:1e-3:7:log"), [1e3, 1e2, 1e1, 1.0, 0.1, 0.01, 0.001]);
    assert_eq!(all("0.01:100:5:log"), [0.01, 0.1, 1.0, 10.0, 100.0]);
    let mut power = 1.0;
    for value in all("1:3486784401:21:log") {
        assert_eq!(value, power);
        power *= 3.0;
    }
    let mut chance = Chance(3);
    for _ in 0..300 {
        let mut end = || libm::pow(10.0, (chance.next(300_000) as f64 - 150_000.0) / 1000.0);
        let (a, b) = (end(), end());
        if a != b {
            let span = Span::logarithmic(a, b, 2 + chance.count(300)).unwrap();
            check_order(&span);
            let ratios: Vec<f64> = span.values().collect::<Vec<_>>().windows(2).map(|p| p[1] / p[0]).collect();
            assert!(ratios.iter().all(|r| (r / ratios[0] - 1.0).abs() < 1e-15), "{span}");
        }
    }
    check_order(&Span::logarithmic(1.0, 1.0 + f64::EPSILON, 1000).unwrap());
    check_order(&Span::logarithmic(5e-324, 1.7e308, 100).unwrap());
}

#[test]
fn bad_ranges_are_named() {
    for bad in ["", "1", "1:2", "1:2:3:4", "a:2:3", "nan:1:3", "0:inf:3", "0:1:-3", "0:1:2.5"] {
        let message = bad.parse::<Span>().unwrap_err().to_string();
        assert!(message.contains("is not A:B:N") && message.contains("\nhint: "), "{bad}: {message}");
    }
    for bad in ["0:1:3:log", "-1:-2:3:log"] {
        let message = bad.parse::<Span>().unwrap_err().to_string();
        assert!(message.contains("positive"), "{bad}: {message}");
    }
    for bad in ["0:1:0", "0:1:1", "1:1:5", "0:1:99999999999"] {
        let message = bad.parse::<Span>().unwrap_err().to_string();
        assert!(message.contains("allowed is 1 to 1000000"), "{bad}: {message}");
    }
}

#[test]
fn the_minus_sign_of_typeset_text_is_a_minus_sign() {
    assert_eq!("\u{2212}3:\u{2212}1:3".parse(), Span::new(-3.0, -1.0, 3));
}
