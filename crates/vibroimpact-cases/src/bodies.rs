//! Bodies in a row: their coordinates and the directions of their stops.

use vibroimpact::machine::MachineParts;

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
