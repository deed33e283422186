//! A very light body, as a node without mass is modelled, between a heavy one and a stop.

use super::*;

pub(super) fn draw(draw: &mut Draw) -> Drawn {
    let light = draw.pick(&[1e-3, 1e-4, 1e-6, 1e-9]);
    let mut parts = bodies('b', 2).with_mass(0, 1.0).with_mass(1, light);
    parts = parts.with_frequency(draw.number(0.4, 1.5)).with_force(0, 1, 0.0, draw.number(0.5, 1.5));
    parts = parts.with_link(&along(2, 0, 1.0), 1.0, 0.1);
    parts = parts.with_link(&between(2, 0, 1), draw.number(1.0, 20.0), draw.number(0.05, 1.0));
    parts = parts.with_stop("wall", &along(2, 1, 1.0), draw.pick(&[0.0, 0.2, 0.5]), draw.law());
    Drawn::new(parts, Start::default())
}
