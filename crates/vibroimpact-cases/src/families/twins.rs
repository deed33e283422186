//! Equal oscillators that touch, under equal forces: they press on each other with a force that is always zero.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=8);
    let (mass, stiffness, damping) = (draw.number(0.5, 2.0), draw.number(0.5, 4.0), draw.pick(&[0.0, 0.1, 0.02]));
    let (order, cos, sin) = (draw.pick(&[1, 1, 2]), draw.number(-1.0, 1.0), draw.number(0.2, 1.0));
    let mut parts = bodies('b', n).with_frequency(draw.number(0.4, 2.5));
    for i in 0..n {
        parts =
            parts.with_mass(i, mass).with_link(&along(n, i, 1.0), stiffness, damping).with_force(i, order, cos, sin);
    }
    let contact = draw.law();
    parts = touching(parts, n, 0.0, contact);
    // a wall for one of them, or none
    let wall = draw.chance(0.6).then(|| draw.count(0..=n - 1));
    if let Some(body) = wall {
        parts = parts.with_stop("wall", &along(n, body, 1.0), draw.number(0.1, 1.0), draw.rigid());
    }
    let speed = if draw.chance(0.5) { draw.number(-0.5, 0.5) } else { 0.0 };
    let start = Start { qdot: vec![speed; n], phase: draw.pick(&[0.0, 0.3]), ..Start::default() };
    let drawn = Drawn::new(parts, start);
    if wall.is_none() { drawn.together() } else { drawn }
}
