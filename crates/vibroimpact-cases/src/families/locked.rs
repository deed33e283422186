//! Bodies without any room between two walls, so that none of them can move, beside others that do.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let held = draw.count(2..=4);
    let n = held + 1;
    let law = StopLaw::Rigid { restitution: draw.restitution() };
    let mut parts = bodies('b', n).with_frequency(draw.number(0.4, 1.5));
    for i in 0..n {
        parts = parts.with_mass(i, 1.0).with_link(&along(n, i, 1.0), draw.number(0.5, 2.0), 0.05);
    }
    parts = parts.with_stop("left", &along(n, 0, -1.0), 0.0, law);
    parts = touching(parts, held, 0.0, law);
    parts = parts.with_stop("right", &along(n, held - 1, 1.0), 0.0, law);
    if draw.chance(0.5) {
        parts = parts.with_force(0, 1, 0.0, draw.number(0.2, 1.0));
    }
    // the one that moves pulls at them, or strikes a wall of its own
    parts = parts.with_force(held, 1, draw.number(0.3, 1.0), 0.0);
    if draw.chance(0.5) {
        parts = parts.with_link(&between(n, held, held - 1), draw.number(0.2, 1.0), 0.0);
    }
    parts = parts.with_stop("wall", &along(n, held, 1.0), draw.number(0.1, 0.5), law);
    Drawn::new(parts, Start::default())
}
