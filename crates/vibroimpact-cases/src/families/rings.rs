//! Equal bodies in a ring, coupled to the next: each above a stop of its own, or each beside the next.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(3..=8);
    let (ground, coupling, damping) = (draw.number(0.5, 2.0), draw.number(0.1, 2.0), draw.pick(&[0.0, 0.05, 0.2]));
    let law = draw.law();
    let beside = draw.chance(0.4);
    let mut parts = bodies('b', n).with_frequency(draw.number(0.4, 2.5));
    for i in 0..n {
        parts = parts.with_mass(i, 1.0).with_link(&along(n, i, 1.0), ground, damping);
        parts = parts.with_link(&between(n, i, (i + 1) % n), coupling, 0.0);
    }
    // beside each other, without any gap, they move only together
    let gap = if beside { draw.pick(&[0.0, 0.05, 0.1]) } else { draw.pick(&[0.0, 0.1, 0.4]) };
    for i in 0..n {
        let direction = if beside { between(n, i, (i + 1) % n) } else { along(n, i, 1.0) };
        parts = parts.with_stop(&format!("s{}", i + 1), &direction, gap, law);
    }
    // a pattern of waves around the ring: 1 repeats at each body, 2 at every other one
    let step = if n.is_multiple_of(2) && draw.chance(0.5) { 2 } else { 1 };
    let (forces, speeds) = (draw.numbers(step, -1.0, 1.0), draw.numbers(step, -0.4, 0.0));
    for i in 0..n {
        parts = parts.with_force(i, 1, 0.0, forces[i % step]);
    }
    // bodies beside each other start together
    let qdot = (0..n).map(|i| if beside { speeds[0] } else { speeds[i % step] }).collect();
    let turned: Vec<usize> = (0..n).map(|i| (i + step) % n).collect();
    // what a stop does, that of the body before it does in the image
    let places = (0..n).map(|j| (j + n - step) % n).collect();
    let start = Start { qdot, ..Start::default() };
    Drawn::new(parts, start).symmetric(Symmetry { from: turned, signs: vec![1.0; n], places })
}
