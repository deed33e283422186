//! Beams and strings by their modes, with supports at symmetric places and a force that is symmetric too: the modes that
//! are odd about the middle never move.

use super::*;

#[allow(clippy::cast_precision_loss, reason = "orders of modes are small")]
pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=10);
    let beam = draw.chance(0.5);
    let (first, ratio, damping) = (draw.number(0.5, 2.0), draw.number(0.3, 3.0), draw.number(0.005, 0.05));
    let shape = |k: usize, x: f64| sin_cos(PI * (k + 1) as f64 * x).0;
    let mut parts = MachineParts::new((1..=n).map(|k| format!("mode{k}"))).with_frequency(first * ratio);
    let force = draw.number(0.5, 3.0);
    for k in 0..n {
        let order = (k + 1) as f64;
        let frequency = first * if beam { order * order } else { order };
        let direction = parts.along(k);
        parts = parts
            .with_mass(k, 0.5)
            .with_link(&direction, 0.5 * frequency * frequency, damping * frequency)
            // at the middle; the even orders have a node there
            .with_force(k, 1, 0.0, if k.is_multiple_of(2) { force * shape(k, 0.5) } else { 0.0 });
    }
    let law = draw.law();
    let (gap, above): (f64, bool) = (draw.pick(&[0.0, 0.05, 0.2]), draw.chance(0.4));
    let mut places = Vec::new();
    // the shapes at the place in the mirror are those of the place to the last bit, or computed on their own
    let exact = draw.chance(0.5);
    for pair in 0..draw.count(1..=2) {
        let x = draw.pick(&[0.2, 0.25, 0.3, 0.4, 1.0 / 3.0]) * if pair == 0 { 1.0 } else { 0.5 };
        let here: Vec<f64> = (0..n).map(|k| shape(k, x)).collect();
        let mirrored = |k: usize| if k.is_multiple_of(2) { here[k] } else { -here[k] };
        let there: Vec<f64> = (0..n).map(|k| if exact { mirrored(k) } else { shape(k, 1.0 - x) }).collect();
        for (side, name) in [(-1.0, "below"), (1.0, "above")].into_iter().take(if above { 2 } else { 1 }) {
            for (direction, end) in [(&here, "a"), (&there, "b")] {
                let direction: Vec<f64> = direction.iter().map(|w| side * w).collect();
                // stops at both sides of a beam have a gap
                let gap = if above { gap.max(0.02) } else { gap };
                parts = parts.with_stop(&format!("{name}{pair}{end}"), &direction, gap, law);
                places.push(parts.stops.len() - 1 + usize::from(end == "a") - usize::from(end == "b"));
            }
        }
    }
    let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    Drawn::new(parts, Start::default()).symmetric(Symmetry::mirrored(n, sign, places))
}
