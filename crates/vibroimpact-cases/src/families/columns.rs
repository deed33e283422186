//! Bodies with equal gaps, one above the other, that fall on a floor.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=6);
    let law = if draw.chance(0.8) { draw.rigid() } else { draw.compliant() };
    let gap = draw.number(0.01, 0.3);
    let mass = draw.pick(&[1.0, 1.0, 0.3]);
    let mut parts = bodies('b', n);
    for i in 0..n {
        parts = parts.with_mass(i, mass).with_constant(i, -mass * 9.81);
    }
    parts = parts.with_stop("floor", &along(n, 0, -1.0), draw.number(0.1, 1.0), law);
    parts = touching(parts, n, gap, law);
    parts.impacts = draw.impacts();
    Drawn::new(parts, Start::default())
}
