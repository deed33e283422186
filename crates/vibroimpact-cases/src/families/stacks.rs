//! Bodies one on the other, on a table that is still or shakes; gravity is all that acts between them.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=6);
    let equal = draw.chance(0.6);
    let plastic = draw.chance(0.4);
    let restitution = if plastic { 0.0 } else { draw.restitution() };
    let law = StopLaw::Rigid { restitution };
    let mut parts = bodies('b', n);
    for i in 0..n {
        let mass = if equal { 1.0 } else { draw.number(0.3, 2.0) };
        parts = parts.with_mass(i, mass).with_constant(i, -mass);
    }
    let shakes = draw.chance(0.7);
    parts = parts.with_stop("table", &along(n, 0, -1.0), 0.0, law);
    if shakes {
        // the acceleration of the table, in units of gravity
        let gamma = draw.number(0.7, 3.0);
        parts = parts.with_frequency(1.0);
        parts.stops[0].motion = vec![HarmonicMotion { order: 1, cos: 0.0, sin: gamma }];
    }
    parts = touching(parts, n, 0.0, law);
    // on the table, or dropped as a whole
    let height = if draw.chance(0.5) { 0.0 } else { draw.number(0.1, 1.0) };
    let start = Start { q: vec![height; n], ..Start::default() };
    let drawn = Drawn::new(parts, start);
    if restitution == 0.0 { drawn.together() } else { drawn }
}
