//! Mirror-symmetric chains of equal bodies along a line: springs and gaps between neighbours, walls at both ends.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=8);
    let (stiffness, damping) = (draw.number(0.5, 4.0), draw.pick(&[0.0, 0.05, 0.2]));
    let (wall, contact) = (draw.law(), draw.law());
    let (room, gap) = (draw.number(0.05, 0.6), draw.pick(&[0.0, 0.0, 0.1, 0.3]));
    // bodies at equal places from the ends are equal
    let masses: Vec<f64> = (0..n.div_ceil(2)).map(|_| draw.pick(&[1.0, 1.0, 0.5])).collect();
    let forces: Vec<f64> = (0..n / 2).map(|_| draw.number(-1.0, 1.0)).collect();
    let shifts: Vec<f64> = (0..n / 2).map(|_| if gap > 0.0 { draw.number(-0.02, 0.02) } else { 0.0 }).collect();
    let speeds: Vec<f64> = (0..n / 2).map(|_| draw.number(-0.5, 0.5)).collect();
    // a vector that changes its sign in the mirror
    let odd = |half: &[f64], i: usize| {
        if 2 * i + 1 < n {
            half[i]
        } else if 2 * i + 1 == n {
            0.0
        } else {
            -half[n - 1 - i]
        }
    };
    let mut parts = bodies('b', n);
    if draw.chance(0.7) {
        parts = parts.with_frequency(draw.number(0.4, 2.5));
        for i in 0..n {
            parts = parts.with_force(i, 1, 0.0, odd(&forces, i));
        }
    }
    for i in 0..n {
        parts = parts.with_mass(i, masses[i.min(n - 1 - i)]);
    }
    parts = chained(parts, stiffness, damping).with_stop("left", &along(n, 0, -1.0), room, wall);
    parts = touching(parts, n, gap, contact).with_stop("right", &along(n, n - 1, 1.0), room, wall);
    let start = Start {
        q: (0..n).map(|i| odd(&shifts, i)).collect(),
        qdot: (0..n).map(|i| odd(&speeds, i)).collect(),
        ..Start::default()
    };
    Drawn::new(parts, start).symmetric(Symmetry::reversed(n, -1.0, (0..=n).rev().collect()))
}
