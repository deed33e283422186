//! One frequency in all directions: a body on equal springs, with stops at angles to the coordinates, in pairs that are
//! mirrored.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=3);
    let (stiffness, damping) = (draw.number(0.5, 2.0), draw.pick(&[0.0, 0.05, 0.1]));
    let mut parts = MachineParts::new(["x", "y", "z"].into_iter().take(n));
    for i in 0..n {
        let direction = parts.along(i);
        parts = parts.with_mass(i, 1.0).with_link(&direction, stiffness, damping);
    }
    parts = parts.with_frequency(draw.number(0.5, 1.8)).with_force(0, 1, draw.number(-1.0, 1.0), draw.number(0.3, 1.0));
    let (law, gap) = (draw.law(), draw.pick(&[0.0, 0.1, 0.4]));
    let mut places = Vec::new();
    let pairs = draw.count(1..=2);
    // two pairs are a cage, which needs room
    let gap = if pairs == 2 { f64::max(gap, 0.05) } else { gap };
    for pair in 0..pairs {
        let (sin, cos) = sin_cos(draw.number(0.1, 1.4) + if pair == 0 { 0.0 } else { 1.6 });
        for (end, sign) in [("a", 1.0), ("b", -1.0)] {
            parts = parts.with_stop(&format!("s{pair}{end}"), &[cos, sign * sin, 0.0][..n], gap, law);
            places.push(parts.stops.len() - 1 + usize::from(end == "a") - usize::from(end == "b"));
        }
    }
    if draw.chance(0.5) {
        parts = parts.with_stop("ahead", &[1.0, 0.0, 0.0][..n], gap, law);
        places.push(parts.stops.len() - 1);
    }
    let mut qdot = vec![0.0; n];
    qdot[0] = draw.number(-0.5, 0.0);
    let sign = |i: usize| if i == 1 { -1.0 } else { 1.0 };
    let start = Start { qdot, ..Start::default() };
    Drawn::new(parts, start).symmetric(Symmetry::mirrored(n, sign, places))
}
