//! Mirror-symmetric chains of bodies that move across the line of the chain, as beads on a string above a floor.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=8);
    let (stiffness, damping) = (draw.number(0.5, 4.0), draw.pick(&[0.0, 0.05, 0.2]));
    let (floor, gap) = (draw.law(), draw.pick(&[0.0, 0.1, 0.3]));
    let ceiling = draw.chance(0.3).then(|| (draw.law(), draw.number(0.1, 0.5)));
    let forces: Vec<f64> = draw.numbers(n.div_ceil(2), 0.0, 1.0);
    let uniform = draw.chance(0.4);
    // a vector that is equal to its image in the mirror
    let even = |half: &[f64], i: usize| half[if uniform { 0 } else { i.min(n - 1 - i) }];
    let mut parts = bodies('b', n);
    if draw.chance(0.8) {
        parts = parts.with_frequency(draw.number(0.4, 2.5));
        for i in 0..n {
            parts = parts.with_force(i, 1, even(&forces, i), 0.0);
        }
    }
    let weight = draw.pick(&[0.0, 0.0, 0.5]);
    for i in 0..n {
        parts = parts.with_mass(i, 1.0).with_constant(i, -weight);
    }
    parts = chained(parts, stiffness, damping);
    for i in 0..n {
        parts = parts.with_stop(&format!("f{}", i + 1), &along(n, i, -1.0), gap, floor);
    }
    let mut places: Vec<usize> = (0..n).rev().collect();
    if let Some((law, height)) = ceiling {
        for i in 0..n {
            parts = parts.with_stop(&format!("t{}", i + 1), &along(n, i, 1.0), height, law);
        }
        places.extend((n..2 * n).rev());
    }
    let speeds: Vec<f64> = draw.numbers(n.div_ceil(2), 0.0, 0.5);
    let start = Start { qdot: (0..n).map(|i| even(&speeds, i)).collect(), ..Start::default() };
    Drawn::new(parts, start).symmetric(Symmetry::reversed(n, 1.0, places))
}
