//! The Floquet multipliers of a cycle in the complex plane. A cycle is stable if they lie within the unit circle, and neutral if
//! one lies on it to rounding and none outside.

use crate::number::short;
use core::f64::consts::TAU;
use vibroimpact::math::Multiplier;
use vibroimpact::verdict::Stability;
use vibroimpact_plot::{Colour, Figure, FigureAxis, HLine, Legend, Line, Panel, Points, SERIES, Stroke, Tick, VLine};

/// Number of points of the circle.
const CORNERS: u32 = 360;
/// Width, and the height with which the frame is a square.
const SIZE: (f64, f64) = (480.0, 502.0);

/// Draws the unit circle and all multipliers, each with the stability of its direction, at a scale that shows all of them.
#[must_use]
pub fn multipliers(all: &[Multiplier], each: &[Stability]) -> Figure {
    let largest = all.iter().map(|m| m.modulus()).filter(|r| r.is_finite()).fold(1.0, f64::max);
    let range = 1.2 * largest;
    let end = tick(largest);
    let ticks = || [(-end, short(-end)), (0.0, "0".to_owned()), (end, short(end))];
    let axis = |name: &str| {
        let ticks = ticks().map(|(value, text)| Tick::new(value, text.replace('-', "−")));
        FigureAxis::new(name).range(-range, range).ticks(ticks)
    };
    let thin = Stroke::new(Colour::hex(0xc8_c8c8)).width(1.2);
    let angle = |k: u32| TAU * f64::from(k) / f64::from(CORNERS);
    let (xs, ys): (Vec<f64>, Vec<f64>) = (0..=CORNERS).map(|k| (angle(k).cos(), angle(k).sin())).unzip();
    let circle = Line::new(xs, ys, Colour::GREY).width(2.2);
    let mut legend = Legend::below().line(circle.stroke, "|*μ*| = 1");
    let mut panel =
        Panel::new(axis("Re *μ*"), axis("Im *μ*")).with(HLine::new(0.0, thin)).with(VLine::new(0.0, thin)).with(circle);
    for (stability, colour) in
        [(Stability::Stable, SERIES[0]), (Stability::Neutral, SERIES[2]), (Stability::Unstable, SERIES[1])]
    {
        let some = all.iter().zip(each).filter(|(_, own)| **own == stability);
        let (xs, ys): (Vec<f64>, Vec<f64>) = some.map(|(m, _)| (m.re, m.im)).unzip();
        if !xs.is_empty() {
            let points = Points::new(xs, ys, colour).size(14.0).rim(Colour::WHITE);
            legend = legend.points(&points, stability.name());
            panel.add(points);
        }
    }
    Figure::new(panel).size(SIZE.0, SIZE.1).title(said(all)).legend(legend)
}

/// The text of the multipliers: `*μ* = −0.31, −0.013` or `*μ* = 0.2 ± 0.46 i`.
fn said(all: &[Multiplier]) -> String {
    // of a pair the one above the real axis
    let terms = all.iter().filter(|m| m.im.is_nan() || m.im >= 0.0);
    let terms = terms.map(|m| if m.im == 0.0 { short(m.re) } else { format!("{} ± {} i", short(m.re), short(m.im)) });
    format!("*μ* = {}", terms.collect::<Vec<_>>().join(", ")).replace('-', "−")
}

/// The largest of 1, 2, 5, 10, 20 ... that is at most `largest`, which is at least 1.
fn tick(largest: f64) -> f64 {
    let mut decade = 1.0;
    // the largest double is below 10^309
    for _ in 0..308 {
        if 10.0 * decade > largest {
            break;
        }
        decade *= 10.0;
    }
    [5.0, 2.0].into_iter().map(|m| m * decade).find(|value| *value <= largest).unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_they_are_there_is_a_picture() {
        let of = |re: f64, im: f64| Multiplier { re, im };
        for both in [
            [of(0.2, 0.46), of(0.2, -0.46)],
            [of(-31.0, 0.0), of(1e-20, 0.0)],
            [of(f64::INFINITY, 0.0), of(0.0, 0.0)],
            [of(f64::NAN, 0.0), of(1e300, 0.0)],
        ] {
            let svg = multipliers(&both, &[Stability::Stable, Stability::Neutral]).to_svg();
            assert!(svg.contains("Re ") && !svg.contains("NaN"), "{both:?}");
        }
        assert_eq!([1.0, 1.9, 2.0, 7.0, 31.0].map(tick), [1.0, 1.0, 2.0, 5.0, 20.0]);
        assert_eq!(said(&[of(0.2, 0.458_241), of(0.2, -0.458_241)]), "*μ* = 0.2 ± 0.458241 i");
        assert_eq!(said(&[of(-0.309_59, 0.0), of(-0.012_6, 0.0)]), "*μ* = −0.30959, −0.0126");
    }
}
