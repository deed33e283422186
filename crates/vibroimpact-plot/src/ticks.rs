//! The positions and labels of the ticks of an axis.
//!
//! Linear axes have steps of 1, 2 or 5 times a power of ten (P. S. Heckbert, "Nice numbers for graph labels", Graphics
//! Gems, 1990). Logarithmic axes mark decades, or have linear steps if they show less than one decade.

use crate::scale::Scale;
use serde::Serialize;

/// A tick of an axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tick {
    /// Its position.
    pub value: f64,
    /// Its text, in the markup of [labels](crate::plain); a blank for a long tick without text, empty for a short one.
    pub label: String,
}

impl Tick {
    /// A tick with its text.
    pub fn new(value: f64, label: impl Into<String>) -> Self {
        Self { value, label: label.into() }
    }
}

/// A step of `mantissa` (1, 2 or 5) times ten to the `exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    mantissa: f64,
    exponent: i32,
}

impl Step {
    /// The smallest step with at most `most` intervals in `span`.
    fn finest(span: f64, most: usize) -> Self {
        let rough = span / most.max(1) as f64;
        #[expect(clippy::cast_possible_truncation, reason = "a decimal exponent of an f64 is below 400")]
        let exponent = rough.log10().floor() as i32;
        let rest = rough / 10f64.powi(exponent);
        // the tolerance keeps rounding from choosing a coarser step for a span of exactly five steps
        let mantissa = [1.0, 2.0, 5.0].into_iter().find(|m| *m >= rest - 1e-9);
        mantissa.map_or(Self { mantissa: 1.0, exponent: exponent + 1 }, |mantissa| Self { mantissa, exponent })
    }

    /// The `i`th multiple. Division by a power of ten gives exactly 0.3; multiplication by 0.1 would not.
    fn times(self, i: f64) -> f64 {
        if self.exponent < 0 {
            i * self.mantissa / 10f64.powi(-self.exponent)
        } else {
            i * self.mantissa * 10f64.powi(self.exponent)
        }
    }

    fn multiples(self, lo: f64, hi: f64) -> Vec<f64> {
        let unit = self.times(1.0);
        let (first, last) = ((lo / unit - 1e-9).ceil(), (hi / unit + 1e-9).floor());
        // above 2^53 multiples are no longer distinct numbers, so such an axis has no room for ticks
        if !(first.abs() < 9e15 && last.abs() < 9e15 && last - first < 1e4) {
            return Vec::new();
        }
        let mut i = first;
        let mut values = Vec::new();
        while i <= last {
            values.push(self.times(i) + 0.0);
            i += 1.0;
        }
        values
    }
}

/// Labelled ticks, and unlabelled ones between them, for an axis with room for `most` labels.
pub(crate) fn ticks(scale: Scale, lo: f64, hi: f64, most: usize) -> Vec<Tick> {
    let (lo, hi) = (lo.min(hi), lo.max(hi));
    if (hi - lo).is_nan() || hi <= lo || (hi - lo).is_infinite() {
        return vec![Tick::new(lo, number(lo, 3))];
    }
    match scale {
        Scale::Log10 if lo > 0.0 && (hi / lo).log10() >= 1.0 => decades(lo, hi, most),
        _ => linear(lo, hi, most),
    }
}

fn linear(lo: f64, hi: f64, most: usize) -> Vec<Tick> {
    let step = Step::finest(hi - lo, most);
    let values = step.multiples(lo, hi);
    let largest = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let ten = largest.log10().floor();
    // 12000 is legible as it is, 0.0002 is not
    let scientific = largest > 0.0 && !(-3.0..5.0).contains(&ten);
    let mut ticks: Vec<Tick> = values
        .iter()
        .map(|&v| Tick::new(v, if scientific { power(v, ten, step) } else { number(v, decimals(step.exponent)) }))
        .collect();
    // with many numbers, one short tick between two is enough
    let parts = match (values.len(), step.mantissa == 2.0) {
        (6.., _) => 2.0,
        (_, true) => 4.0,
        (_, false) => 5.0,
    };
    let fine = Step { mantissa: step.mantissa / parts, exponent: step.exponent };
    let minor = fine.multiples(lo, hi).into_iter();
    let near = |v: f64| values.iter().any(|m| (m - v).abs() < 1e-6 * step.times(1.0));
    ticks.extend(minor.filter(|&v| !near(v)).map(|v| Tick::new(v, "")));
    ticks
}

fn decimals(exponent: i32) -> usize {
    usize::try_from(-exponent).unwrap_or(0)
}

fn number(value: f64, decimals: usize) -> String {
    // the true minus sign is as wide as a plus; a hyphen is hardly visible in print
    format!("{value:.decimals$}").replace('-', "−")
}

/// The text of `value` as a mantissa times a power of ten that is common to all labels of the axis.
fn power(value: f64, ten: f64, step: Step) -> String {
    if value == 0.0 {
        return "0".into();
    }
    #[expect(clippy::cast_possible_truncation, reason = "a decimal exponent of an f64 is below 400")]
    let ten = ten as i32;
    let mantissa = value / 10f64.powi(ten);
    let mantissa = number(mantissa, decimals(step.exponent - ten));
    format!("{mantissa}×10^{{{}}}", number(f64::from(ten), 0))
}

fn decades(lo: f64, hi: f64, most: usize) -> Vec<Tick> {
    #[expect(clippy::cast_possible_truncation, reason = "a decimal exponent of an f64 is below 400")]
    let (first, last) = ((lo.log10() - 1e-9).ceil() as i32, (hi.log10() + 1e-9).floor() as i32);
    let count = usize::try_from(last - first + 1).unwrap_or(0);
    let every = i32::try_from(count.div_ceil(most.max(1))).unwrap_or(1).max(1);
    let plain = first >= -3 && last <= 3;
    let label = |k: i32| {
        if plain { number(10f64.powi(k), decimals(k)) } else { format!("10^{{{}}}", number(f64::from(k), 0)) }
    };
    let mut ticks: Vec<Tick> = (first..=last)
        // with more than 40 decades only some have a tick, because their ticks would merge
        .filter(|k| count <= 40 || k % every == 0)
        .map(|k| Tick::new(10f64.powi(k), if k % every == 0 { label(k) } else { " ".into() }))
        .collect();
    // with many decades, the ticks within them would merge into a grey band
    if count <= 8 {
        for k in first - 1..=last {
            for m in 2..10 {
                let v = f64::from(m) * 10f64.powi(k);
                if v >= lo && v <= hi {
                    // an axis with one decade or less would otherwise have only one or two numbers
                    let say = count <= 2 && matches!(m, 2 | 5) && most >= 4;
                    let text = if say && plain { number(v, decimals(k)) } else { String::new() };
                    ticks.push(Tick::new(v, text));
                }
            }
        }
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, lo: f64, hi: f64, most: usize) -> String {
        let ticks = ticks(scale, lo, hi, most);
        let labels: Vec<_> = ticks.into_iter().map(|t| t.label).filter(|l| !l.trim().is_empty()).collect();
        labels.join(" ")
    }

    #[test]
    fn linear_labels() {
        for (lo, hi, most, want) in [
            (0.4, 2.0, 9, "0.4 0.6 0.8 1.0 1.2 1.4 1.6 1.8 2.0"),
            (0.0, 5.0, 5, "0 1 2 3 4 5"),
            (-1.0, 1.0, 5, "−1.0 −0.5 0.0 0.5 1.0"),
            (5.0, 0.0, 5, "0 1 2 3 4 5"),
            (0.0, 40_000.0, 4, "0 10000 20000 30000 40000"),
            (0.0, 4e-5, 4, "0 1×10^{−5} 2×10^{−5} 3×10^{−5} 4×10^{−5}"),
            (0.0, 1e6, 2, "0 0.5×10^{6} 1.0×10^{6}"),
        ] {
            assert_eq!(labels(Scale::Linear, lo, hi, most), want);
        }
    }

    #[test]
    fn log_labels() {
        assert_eq!(labels(Scale::Log10, 1e-3, 1e3, 9), "0.001 0.01 0.1 1 10 100 1000");
        assert_eq!(labels(Scale::Log10, 1e-9, 1.0, 5), "10^{−8} 10^{−6} 10^{−4} 10^{−2} 10^{0}");
        assert_eq!(labels(Scale::Log10, 2.0, 5.0, 4), "2 3 4 5");
    }

    #[test]
    fn nice_values_are_the_decimal_numbers() {
        let nice = |lo: f64, hi: f64, most| Step::finest(hi - lo, most).multiples(lo, hi);
        assert_eq!(nice(0.0, 0.5, 5), [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]);
        for most in 1..20 {
            assert!(nice(0.3, 7.9, most).len() <= most + 1, "{most}");
        }
    }

    #[test]
    fn degenerate_ranges_end() {
        for (lo, hi) in [
            (1.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
            (-1e308, 1e308),
            (1e16, 1e16 + 2.0),
            (0.0, 5e-324),
            (1.0, 1.0 + 1e-15),
        ] {
            for scale in [Scale::Linear, Scale::Log10] {
                assert!(ticks(scale, lo, hi, 5).len() < 100, "{lo} {hi}");
            }
        }
    }
}
