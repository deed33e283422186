//! Plates and bars on 2 to 4 supports, dropped on them or driven: heave, pitch and, for plates, roll.

use super::*;

/// Places of supports, as parts of half the length and half the width, and the place of each in the mirror across the
/// length.
fn supports(draw: &mut Draw) -> (bool, Vec<(f64, f64)>, Vec<usize>) {
    match draw.count(0..=4) {
        0 | 1 => (false, vec![(-1.0, 0.0), (1.0, 0.0)], vec![1, 0]),
        2 => (false, vec![(-1.0, 0.0), (0.0, 0.0), (1.0, 0.0)], vec![2, 1, 0]),
        3 => (true, vec![(-1.0, -0.5), (1.0, -0.5), (0.0, 1.0)], vec![1, 0, 2]),
        _ => (true, vec![(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)], vec![1, 0, 3, 2]),
    }
}

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let (plate, supports, places) = supports(draw);
    let names: &[&str] = if plate { &["heave", "pitch", "roll"] } else { &["heave", "pitch"] };
    let n = names.len();
    let (law, gap) = (draw.law(), draw.pick(&[0.0, 0.05, 0.2]));
    let mut parts = MachineParts::new(names.iter().copied()).with_mass(0, 1.0);
    for i in 1..n {
        parts = parts.with_mass(i, draw.pick(&[1.0 / 3.0, 0.25, 0.3, 1.0, 2.0]));
    }
    let driven = draw.chance(0.5);
    if driven {
        let damping = draw.number(0.01, 0.1);
        parts = parts.with_frequency(draw.number(0.4, 1.5)).with_force(0, 1, 0.0, draw.number(0.3, 1.5));
        for i in 0..n {
            let stiffness = draw.number(0.3, 1.5);
            let direction = parts.along(i);
            parts = parts.with_link(&direction, stiffness, damping);
        }
    } else {
        parts = parts.with_constant(0, draw.pick(&[-1.0, -9.81]));
    }
    let (length, width) = (draw.pick(&[1.0, 0.7]), draw.pick(&[1.0, 0.4]));
    for (k, (x, y)) in supports.iter().enumerate() {
        let direction = [-1.0, -x * length, -y * width];
        parts = parts.with_stop(&format!("s{}", k + 1), &direction[..n], gap, law);
    }
    let height = if driven { 0.0 } else { draw.number(0.1, 1.0) };
    let mut q = vec![0.0; n];
    q[0] = height;
    let mut qdot = vec![0.0; n];
    let flat = draw.chance(0.7);
    if !flat {
        qdot[1] = draw.number(-0.5, 0.5);
    }
    let drawn = Drawn::new(parts, Start { q, qdot, ..Start::default() });
    if !flat {
        return drawn;
    }
    let sign = |i: usize| if i == 1 { -1.0 } else { 1.0 };
    let drawn = drawn.symmetric(Symmetry::mirrored(n, sign, places));
    if supports.len() < 4 {
        return drawn;
    }
    // the other mirror of four supports
    let sign = |i: usize| if i == 2 { -1.0 } else { 1.0 };
    drawn.symmetric(Symmetry::mirrored(n, sign, vec![3, 2, 1, 0]))
}
