//! Friction joints beside stops: on the body that strikes, on its neighbour, or between both.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(1..=3);
    let mut parts = bodies('b', n).with_frequency(draw.number(0.4, 1.5));
    for i in 0..n {
        parts = parts.with_mass(i, draw.pick(&[1.0, 1.0, 0.5]));
        parts = parts.with_link(&along(n, i, 1.0), draw.number(0.5, 2.0), draw.number(0.0, 0.1));
    }
    parts = parts.with_force(0, 1, 0.0, draw.number(0.6, 2.0));
    for i in 1..n {
        parts = parts.with_link(&between(n, i - 1, i), draw.number(0.3, 1.0), 0.02);
    }
    let law = draw.law();
    parts = parts.with_stop("wall", &along(n, draw.count(0..=n - 1), 1.0), draw.pick(&[0.0, 0.2, 0.5]), law);
    if n > 1 && draw.chance(0.5) {
        parts = parts.with_stop("c", &between(n, 0, 1), draw.pick(&[0.0, 0.1]), law);
    }
    for k in 0..draw.count(1..=2) {
        let direction = if n > 1 && draw.chance(0.3) { between(n, 0, 1) } else { along(n, draw.count(0..=n - 1), 1.0) };
        let (sliding, more) = (draw.number(0.05, 0.4), draw.pick(&[1.0, 1.0, 1.3]));
        let belt = draw.pick(&[0.0, 0.0, 0.2]);
        parts = parts.with_joint(&format!("j{}", k + 1), &direction, sliding, more * sliding, belt);
    }
    Drawn::new(parts, Start::default())
}
