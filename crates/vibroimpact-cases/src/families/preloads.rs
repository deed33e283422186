//! Compliant stops with a preload that touch: loads below the preload leave them at rest, larger ones push them in.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(1..=4);
    let preload = draw.number(0.1, 1.0);
    let law = StopLaw::Compliant {
        stiffness: draw.number(5.0, 100.0),
        damping: draw.pick(&[0.0, 0.5, 2.0]),
        preload,
        opening: draw.pick(&[Opening::Force, Opening::Position]),
    };
    let mut parts = bodies('b', n).with_frequency(draw.number(0.4, 1.5));
    // from below the preload to above it; at the preload exactly now and then
    let share = draw.pick(&[0.5, 0.9, 1.0, 1.5, 3.0]);
    let equal = draw.chance(0.5);
    for i in 0..n {
        let force = if equal { share * preload } else { draw.number(0.2, 2.0) * preload };
        parts = parts.with_mass(i, 1.0).with_link(&along(n, i, 1.0), 1.0, 0.1).with_force(i, 1, 0.0, force);
        parts = parts.with_stop(&format!("s{}", i + 1), &along(n, i, 1.0), 0.0, law);
    }
    let touching = n > 1 && draw.chance(0.3);
    if touching {
        for i in 1..n {
            parts = parts.with_stop(&format!("c{i}"), &between(n, i - 1, i), 0.0, draw.rigid());
        }
    }
    let drawn = Drawn::new(parts, Start::default());
    if equal { drawn.together() } else { drawn }
}
