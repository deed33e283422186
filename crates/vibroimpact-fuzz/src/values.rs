//! Numbers, ranges, labels and names as text, with many difficult values.

use proptest::prelude::*;

/// A strategy for texts.
pub type ProptestText = BoxedStrategy<String>;

/// One of these words.
pub(crate) fn word(texts: &'static [&'static str]) -> ProptestText {
    prop::sample::select(texts).prop_map(str::to_owned).boxed()
}

/// A number as a user types it.
pub(crate) fn typed(x: f64) -> String {
    format!("{x}")
}

/// A text that is no valid number, or an extreme number.
pub(crate) fn odd() -> ProptestText {
    word(&[
        "nan",
        "NaN",
        "inf",
        "-inf",
        "infinity",
        "1e308",
        "-1e308",
        "1e400",
        "-0",
        "0",
        "",
        " ",
        "1e-320",
        "5e-324",
        "x",
        "0x10",
        "--",
        "∞",
        "１",
        "1e300",
        "-1e300",
        "1e-300",
        "-1e-300",
        "1,5",
        "1_000",
        "+1",
        ".5",
        "1.",
        "1e",
        "1e+",
        "1.0.0",
        "0.1:0.2",
        "'1'",
        "\u{202e}1",
        "1\n2",
        "true",
        "null",
        "-",
        "=",
        "1e9999999999",
        "é",
    ])
}

/// A number of ordinary size.
pub(crate) fn plain() -> ProptestText {
    prop_oneof![
        5 => (-4.0..4.0_f64).prop_map(typed),
        3 => (0.0..2.0_f64).prop_map(typed),
        2 => (-12.0..12.0_f64, any::<bool>()).prop_map(|(x, minus)| {
            let size = 10_f64.powf(x);
            typed(if minus { -size } else { size })
        }),
        2 => word(&["0", "-0", "1", "-1", "0.5", "1e-9", "1e-12", "-1e-12", "1e-300", "1e300", "1e140", "-1e-200", "1e6"]),
    ]
    .boxed()
}

/// Any number, sometimes an invalid one.
pub(crate) fn number() -> ProptestText {
    prop_oneof![12 => plain(), 1 => odd()].boxed()
}

/// A frequency ratio or its inverse: near 1, near fractions, very small, very large.
pub(crate) fn ratio() -> ProptestText {
    let near = |x: f64, decades: f64, minus: bool| {
        let away = 10_f64.powf(decades);
        if minus { x * (1.0 - away) } else { x * (1.0 + away) }
    };
    prop_oneof![
        8 => (0.2..3.0_f64).prop_map(typed),
        3 => (-16.0..-1.0_f64, any::<bool>()).prop_map(move |(d, minus)| typed(near(1.0, d, minus))),
        5 => (1..9_u32, 1..9_u32, -17.0..-8.0_f64, any::<bool>())
            .prop_map(move |(p, q, d, minus)| typed(near(f64::from(p) / f64::from(q), d, minus))),
        2 => (1..9_u32, 1..9_u32).prop_map(|(p, q)| typed(f64::from(p) / f64::from(q))),
        1 => (-3.0..2.0_f64).prop_map(|d| typed(10_f64.powf(d))),
        1 => word(&["1", "2", "0.5", "3", "1e-300", "1e300", "1e-9", "1e9", "0", "-1"]),
    ]
    .boxed()
}

/// A gap for a frequency ratio, in some cases near the amplitude of the motion without impacts.
pub(crate) fn gap(beta: f64) -> ProptestText {
    let amplitude = 1.0 / (1.0 - beta * beta).abs();
    let amplitude = if amplitude.is_finite() { amplitude } else { 1.0 };
    prop_oneof![
        8 => (-1.5..4.0_f64).prop_map(typed),
        4 => (-16.0..-1.0_f64, -1..=1_i8, any::<bool>()).prop_map(move |(d, side, minus)| {
            let size = amplitude * (1.0 + f64::from(side) * 10_f64.powf(d));
            typed(if minus { -size } else { size })
        }),
        3 => (-16.0..-1.0_f64, prop::sample::select(vec![-1.0, 0.0, 1.0]), any::<bool>()).prop_map(|(d, at, minus): (f64, f64, bool)| {
            let away = 10_f64.powf(d);
            typed(if minus { at - away } else { at + away })
        }),
        3 => word(&["-1", "0", "1", "-0", "2", "-0.5", "1e-300", "-1e-300", "1e300", "-1e300", "1e9"]),
    ]
    .boxed()
}

/// A restitution, in some cases near the ends of its range.
pub(crate) fn restitution() -> ProptestText {
    prop_oneof![
        8 => (0.0..=1.0_f64).prop_map(typed),
        2 => (-16.0..-1.0_f64, any::<bool>()).prop_map(|(d, top)| {
            let small = 10_f64.powf(d);
            typed(if top { 1.0 - small } else { small })
        }),
        3 => word(&["0", "1", "0.5", "0.999999", "1e-12", "0.999999999999", "1e-300", "-0"]),
    ]
    .boxed()
}

/// A damping ratio from 0 to above critical damping.
pub(crate) fn damping() -> ProptestText {
    prop_oneof![
        4 => (0.0..2.0_f64).prop_map(typed),
        4 => (-16.0..0.0_f64).prop_map(|d| typed(10_f64.powf(d))),
        2 => word(&["0", "1", "0.999999999", "1.000000001", "2", "1e-300", "1e300", "100"]),
    ]
    .boxed()
}

/// A small count, or an invalid one.
pub(crate) fn count() -> ProptestText {
    prop_oneof![
        12 => (1..6_u32).prop_map(|n| n.to_string()),
        1 => word(&["0", "-1", "1e3", "1000000000000000000", "99999999999999999999", "2.5", "", "one", "-0", "+3", "٣"]),
    ]
    .boxed()
}

/// `A:B:N`, in most cases between the given ends.
pub(crate) fn range(low: f64, high: f64) -> ProptestText {
    prop_oneof![
        9 => (0.0..1.0_f64, 0.0..1.0_f64, 2..5_u32).prop_map(move |(a, b, n)| {
            let at = |t: f64| low + (high - low) * t;
            format!("{}:{}:{n}", typed(at(a)), typed(at(b)))
        }),
        2 => (number(), number(), count()).prop_map(|(a, b, n)| format!("{a}:{b}:{n}")),
        1 => (0.1..1.0_f64, 1.0..9.0_f64).prop_map(|(a, b)| format!("{}:{}:3:log", typed(a), typed(b))),
        1 => word(&["", ":", "::", ":::", "1:2", "1:2:3:4", "a:b:c", "0:1:1", "1:1:1", "1:1:5", "0:1:3:log", "0:1:3:lin",
            "-1e308:1e308:3", "0:1:1000001", "0:5e-324:3", "1:1.0000000000000002:3"]),
    ]
    .boxed()
}

/// `A:B`, in most cases between the given ends.
pub(crate) fn interval(low: f64, high: f64) -> ProptestText {
    prop_oneof![
        12 => (0.0..0.9_f64, 0.02..1.0_f64).prop_map(move |(a, w)| {
            let at = |t: f64| low + (high - low) * t;
            format!("{}:{}", typed(at(a)), typed(at(a + (1.0 - a) * w)))
        }),
        1 => (number(), number()).prop_map(|(a, b)| format!("{a}:{b}")),
        1 => word(&["", ":", "1:1", "2:1", "1:2:3", "a:b", "0:1e-300", "1e-9:1", "0:1e-12", "-1:1"]),
    ]
    .boxed()
}

/// `m/n`, or an invalid label.
pub(crate) fn label() -> ProptestText {
    prop_oneof![
        10 => (1..5_u32, 1..4_u32).prop_map(|(m, n)| format!("{m}/{n}")),
        2 => word(&["0", "inf/1", "inf/2", "1/1", "2/2", "12/7"]),
        1 => word(&["3/0", "0/1", "1", "", "-1/1", "nan", "1/1/1", "∞/1", "10001/1", "99999999999/1", " 1/1", "1 / 1", "inf", "chaotic"]),
    ]
    .boxed()
}

/// The name of a file in the current folder, or an impossible one.
pub(crate) fn file(ends: &'static [&'static str]) -> ProptestText {
    prop_oneof![
        8 => prop::sample::select(ends).prop_map(|end| format!("out{end}")),
        1 => prop::sample::select(ends).prop_map(|end| format!("ünï cødé{end}")),
        1 => word(&["", ".", "none/out.csv", "none/out.svg", "out", "out.pdf", ".svg", "-", "/proc/vibroimpact.png", "a\u{202e}b.svg"]),
    ]
    .boxed()
}
