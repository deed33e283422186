//! Constraints that depend on each other: the same stop twice, a rigid and a compliant one at one gap, a stop whose
//! direction is scaled, two joints on one coordinate. The machine without the second one moves in the same way.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(1..=3);
    let mut parts = bodies('b', n).with_frequency(draw.number(0.4, 2.0));
    for i in 0..n {
        parts = parts.with_mass(i, 1.0).with_link(&along(n, i, 1.0), draw.number(0.5, 2.0), draw.number(0.02, 0.2));
    }
    for i in 1..n {
        parts = parts.with_link(&between(n, i - 1, i), draw.number(0.2, 1.0), 0.02);
    }
    parts = parts.with_force(0, 1, 0.0, draw.number(0.5, 1.5));
    let (gap, rigid) = (draw.pick(&[0.0, 0.2, 0.5]), draw.rigid());
    let wall = along(n, n - 1, 1.0);
    let doubled: Vec<f64> = wall.iter().map(|w| 2.0 * w).collect();
    let (plain, parts) = match draw.count(0..=5) {
        0 => once_and_twice(parts, ("wall", &wall, gap, rigid), (&wall, gap)),
        1 => once_and_twice(parts, ("wall", &wall, gap, rigid), (&doubled, 2.0 * gap)),
        // a rigid stop lets nothing reach a compliant one at its gap
        2 => {
            let plain = parts.with_stop("wall", &wall, gap, rigid);
            (plain.clone(), plain.with_stop("soft", &wall, gap, draw.compliant()))
        }
        // two springs side by side
        3 => {
            let StopLaw::Compliant { stiffness, damping, opening, .. } = draw.compliant() else { unreachable!() };
            let law = |part: f64| StopLaw::Compliant {
                stiffness: part * stiffness,
                damping: part * damping,
                preload: 0.0,
                opening,
            };
            let plain = parts.clone().with_stop("wall", &wall, gap, law(1.0));
            (plain, parts.with_stop("wall", &wall, gap, law(0.5)).with_stop("again", &wall, gap, law(0.5)))
        }
        // three stops in a plane of two directions
        4 if n >= 2 => {
            let sum: Vec<f64> = (0..n).map(|i| if i + 2 >= n { 1.0 } else { 0.0 }).collect();
            let before = along(n, n - 2, 1.0);
            let plain = parts.with_stop("wall", &wall, gap, rigid).with_stop("before", &before, gap, rigid);
            (plain.clone(), plain.with_stop("both", &sum, 2.0 * gap, rigid))
        }
        _ => {
            let (force, limit) = (draw.number(0.02, 0.3), draw.pick(&[1.0, 1.0, 1.5]));
            let (half, stop) = (0.5 * force, draw.chance(0.5));
            let parts = if stop { parts.with_stop("wall", &wall, gap, rigid) } else { parts };
            let plain = parts.clone().with_joint("joint", &wall, force, limit * force, 0.0);
            let parts = parts.with_joint("one", &wall, half, limit * half, 0.0);
            (plain, parts.with_joint("two", &wall, half, limit * half, 0.0))
        }
    };
    let start = Start { qdot: draw.numbers(n, -0.5, 0.0), ..Start::default() };
    Drawn { same_as: Some(plain), ..Drawn::new(parts, start) }
}

fn once_and_twice(
    parts: MachineParts,
    (name, direction, gap, law): (&str, &[f64], f64, StopLaw),
    (again, room): (&[f64], f64),
) -> (MachineParts, MachineParts) {
    let plain = parts.with_stop(name, direction, gap, law);
    let twice = plain.clone().with_stop("again", again, room, law);
    (plain, twice)
}
