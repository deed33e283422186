//! Free bodies without any force between walls: impacts alone change their velocities.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let n = draw.count(2..=6);
    let law = draw.law();
    let (gap, room) = (draw.pick(&[0.0, 0.1, 0.5]), draw.number(0.2, 1.0));
    let mut parts = bodies('b', n);
    for i in 0..n {
        parts = parts.with_mass(i, 1.0);
    }
    parts = parts.with_stop("left", &along(n, 0, -1.0), room, law);
    parts = touching(parts, n, gap, law);
    parts = parts.with_stop("right", &along(n, n - 1, 1.0), room, law);
    // velocities towards the middle, equal or at least symmetric; with an odd number the one in the middle is at rest
    let speed = draw.number(0.3, 1.0);
    let equal = draw.chance(0.5);
    let half: Vec<f64> = (0..n / 2).map(|_| if equal { speed } else { draw.number(-1.0, 1.0) }).collect();
    let qdot: Vec<f64> = (0..n)
        .map(|i| match 2 * i + 1 {
            twice if twice < n => half[i],
            twice if twice == n => 0.0,
            _ => -half[n - 1 - i],
        })
        .collect();
    parts.impacts = draw.impacts();
    let start = Start { qdot, ..Start::default() };
    Drawn::new(parts, start).symmetric(Symmetry::reversed(n, -1.0, (0..=n).rev().collect()))
}
