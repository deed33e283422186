//! Balls on equal springs that touch, as in a cradle: the first ones are drawn back and strike the others.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=6);
    let equal = draw.chance(0.7);
    let gap = draw.pick(&[0.0, 0.0, 0.0, 1e-9, 0.01]);
    let law = if draw.chance(0.8) { draw.rigid() } else { draw.compliant() };
    let damping = draw.pick(&[0.0, 0.0, 0.05]);
    let mut parts = bodies('b', n);
    for i in 0..n {
        let mass = if equal { 1.0 } else { draw.number(0.5, 2.0) };
        // equal frequencies, so that all balls meet again at the lowest point
        parts = parts.with_mass(i, mass).with_link(&along(n, i, 1.0), mass, damping * mass);
    }
    parts = touching(parts, n, gap, law);
    let raised = draw.count(1..=n - 1);
    let height = draw.number(0.2, 1.0);
    let q = (0..n).map(|i| if i < raised { -height } else { 0.0 }).collect();
    parts.impacts = draw.impacts();
    Drawn::new(parts, Start { q, ..Start::default() })
}
