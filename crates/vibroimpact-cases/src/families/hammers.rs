//! Bodies between two stops at equal gaps: one driven body, or a ball in a frame that is driven, from rest in the middle.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let law = draw.law();
    let gap = draw.number(0.05, 0.5);
    let driven = |parts: MachineParts, draw: &mut Draw| {
        let n = parts.n();
        let spring = (draw.number(0.5, 2.0), draw.number(0.01, 0.1));
        let parts = parts.with_frequency(draw.number(0.4, 2.0)).with_force(0, 1, 0.0, draw.number(0.3, 1.5));
        parts.with_link(&along(n, 0, 1.0), spring.0, spring.1)
    };
    let parts = match draw.count(0..=2) {
        0 => {
            let parts = driven(bodies('b', 1).with_mass(0, 1.0), draw);
            parts.with_stop("left", &[-1.0], gap, law).with_stop("right", &[1.0], gap, law)
        }
        // a free ball in a frame
        1 => {
            let parts = driven(bodies('b', 2).with_mass(0, 1.0).with_mass(1, draw.number(0.05, 0.5)), draw);
            parts.with_stop("left", &between(2, 0, 1), gap, law).with_stop("right", &between(2, 1, 0), gap, law)
        }
        // two equal balls in a frame, side by side
        _ => {
            let mut parts = driven(bodies('b', 3).with_mass(0, 1.0), draw).with_mass(1, 0.2).with_mass(2, 0.2);
            for ball in [1, 2] {
                parts = parts.with_stop(&format!("left{ball}"), &between(3, 0, ball), gap, law).with_stop(
                    &format!("right{ball}"),
                    &between(3, ball, 0),
                    gap,
                    law,
                );
            }
            let drawn = Drawn::new(parts, Start::default());
            return Drawn { equal: vec![(1, 2)], ..drawn };
        }
    };
    Drawn::new(parts, Start::default())
}
