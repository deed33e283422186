//! Bodies at rest on stops that carry nothing, beside others that move, with or without a spring between them.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let idle = draw.count(1..=3);
    let n = idle + draw.count(1..=2);
    let mut parts = bodies('b', n);
    if draw.chance(0.5) {
        parts = parts.with_frequency(draw.number(0.5, 2.0)).with_force(n - 1, 1, draw.number(0.2, 1.0), 0.0);
    }
    for i in 0..n {
        parts = parts.with_mass(i, draw.pick(&[1.0, 1.0, 2.0]));
        // idle bodies have a spring at its length of rest, or none
        if i >= idle || draw.chance(0.5) {
            parts = parts.with_link(&along(n, i, 1.0), draw.number(0.5, 2.0), draw.pick(&[0.0, 0.1]));
        }
    }
    let law = draw.law();
    for i in 0..idle {
        parts = parts.with_stop(&format!("s{}", i + 1), &along(n, i, draw.pick(&[1.0, -1.0])), 0.0, law);
    }
    for i in idle..n {
        parts = parts.with_stop(&format!("w{}", i + 1), &along(n, i, 1.0), draw.number(0.1, 0.5), draw.rigid());
    }
    // one that moves can strike one that rests
    if draw.chance(0.4) {
        parts = parts.with_stop("c", &between(n, n - 1, 0), draw.number(0.05, 0.4), draw.rigid());
    }
    let qdot = (0..n).map(|i| if i < idle { 0.0 } else { draw.number(0.2, 1.0) }).collect();
    Drawn::new(parts, Start { qdot, ..Start::default() })
}
