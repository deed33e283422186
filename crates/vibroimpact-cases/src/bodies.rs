//! Bodies in a row: their coordinates and the directions of their stops.

use vibroimpact::machine::{MachineParts, StopLaw};

/// The direction of a stop between two bodies, the first of which strikes the second.
pub(crate) fn between(n: usize, first: usize, second: usize) -> Vec<f64> {
    let mut direction = along(n, first, 1.0);
    direction[second] -= 1.0;
    direction
}

/// The direction of one coordinate, times a number.
pub(crate) fn along(n: usize, coordinate: usize, sign: f64) -> Vec<f64> {
    let mut direction = vec![0.0; n];
    direction[coordinate] = sign;
    direction
}

/// Coordinates without mass, springs and stops, named by a letter.
pub(crate) fn bodies(letter: char, n: usize) -> MachineParts {
    MachineParts::new((1..=n).map(|i| format!("{letter}{i}")))
}

/// The same with a stop between each of the first `n` bodies and the next one.
pub(crate) fn touching(parts: MachineParts, n: usize, gap: f64, law: StopLaw) -> MachineParts {
    let all = parts.n();
    (1..n).fold(parts, |parts, i| parts.with_stop(&format!("c{i}"), &between(all, i - 1, i), gap, law))
}

/// The same with equal springs and dampers between neighbours, and between both ends and the ground.
pub(crate) fn chained(parts: MachineParts, stiffness: f64, damping: f64) -> MachineParts {
    let n = parts.n();
    let ends = [along(n, 0, 1.0), along(n, n - 1, 1.0)].into_iter();
    let links = ends.chain((1..n).map(|i| between(n, i - 1, i)));
    links.fold(parts, |parts, link| parts.with_link(&link, stiffness, damping))
}
