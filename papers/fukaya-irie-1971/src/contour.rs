//! Outlines of a region known only by asking whether a point is inside: marching squares on a grid of answers, each
//! crossing refined by bisection.
//!
//! The grid decides what can be seen: an island or a channel narrower than a step may be missed. The crossings do not
//! depend on it; they are right to [`BISECTIONS`] halvings of a step.

use std::collections::BTreeMap;

/// Halvings of a grid step: 2^-16 of a step is far below a line's width.
pub(crate) const BISECTIONS: u32 = 16;

/// A grid of nodes over a rectangle, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nodes {
    pub(crate) x: (f64, f64),
    pub(crate) y: (f64, f64),
    pub(crate) nx: u32,
    pub(crate) ny: u32,
}

impl Nodes {
    /// How many.
    pub(crate) const fn count(&self) -> usize {
        self.nx as usize * self.ny as usize
    }

    /// Node number `k`, row by row.
    pub(crate) fn at(&self, k: usize) -> (f64, f64) {
        let along = |(a, b): (f64, f64), i: usize, n: u32| {
            #[allow(clippy::cast_precision_loss)] // a few hundred
            let t = i as f64 / f64::from(n - 1);
            a + (b - a) * t
        };
        let nx = self.nx as usize;
        (along(self.x, k % nx, self.nx), along(self.y, k / nx, self.ny))
    }

    /// The node nearest to a point.
    pub(crate) fn nearest(&self, x: f64, y: f64) -> usize {
        let along = |(a, b): (f64, f64), v: f64, n: u32| {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // clamped to the grid
            let i = ((v - a) / (b - a) * f64::from(n - 1)).round().clamp(0.0, f64::from(n - 1)) as usize;
            i
        };
        along(self.y, y, self.ny) * self.nx as usize + along(self.x, x, self.nx)
    }

    /// The neighbours of a node, the four nearest.
    pub(crate) fn neighbours(&self, k: usize) -> impl Iterator<Item = usize> {
        let (nx, ny) = (self.nx as usize, self.ny as usize);
        let (i, j) = (k % nx, k / nx);
        [(i > 0).then(|| k - 1), (i + 1 < nx).then(|| k + 1), (j > 0).then(|| k - nx), (j + 1 < ny).then(|| k + nx)]
            .into_iter()
            .flatten()
    }
}

/// The lines that part the nodes inside from those outside. `cross` gives the place between a node inside (its first
/// argument) and a neighbour outside. Lines end where the grid ends.
pub(crate) fn outlines(
    nodes: &Nodes,
    inside: &[bool],
    mut cross: impl FnMut(usize, usize) -> (f64, f64),
) -> Vec<Vec<(f64, f64)>> {
    let nx = nodes.nx as usize;
    // a crossing lies on the edge between two nodes and is named by them
    type Edge = (usize, usize);
    let mut joined: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    let mut join = |a: Edge, b: Edge| {
        joined.entry(a).or_default().push(b);
        joined.entry(b).or_default().push(a);
    };
    for k in 0..nodes.count() - nx {
        if k % nx == nx - 1 {
            continue;
        }
        let corners = [k, k + 1, k + nx + 1, k + nx];
        let mut crossed = Vec::with_capacity(4);
        for c in 0..4 {
            let (a, b) = (corners[c], corners[(c + 1) % 4]);
            if inside[a] != inside[b] {
                crossed.push((a.min(b), a.max(b)));
            }
        }
        match crossed.as_slice() {
            [a, b] => join(*a, *b),
            // a saddle: the two corners inside are kept apart
            [a, b, c, d] if inside[k] => {
                join(*a, *d);
                join(*b, *c);
            }
            [a, b, c, d] => {
                join(*a, *b);
                join(*c, *d);
            }
            _ => {}
        }
    }
    let mut lines = Vec::new();
    // ends first, then the closed rings that are left
    let ends: Vec<Edge> = joined
        .iter()
        .filter(|(_, others)| others.len() == 1)
        .map(|(edge, _)| *edge)
        .chain(joined.keys().copied())
        .collect();
    for first in ends {
        let mut line = vec![first];
        let mut here = first;
        while let Some(next) = joined.get_mut(&here).and_then(Vec::pop) {
            if let Some(others) = joined.get_mut(&next)
                && let Some(back) = others.iter().position(|edge| *edge == here)
            {
                others.remove(back);
            }
            line.push(next);
            here = next;
        }
        if line.len() > 1 {
            let place = |(a, b): Edge| if inside[a] { (a, b) } else { (b, a) };
            lines.push(
                line.into_iter()
                    .map(|edge| {
                        let (a, b) = place(edge);
                        cross(a, b)
                    })
                    .collect(),
            );
        }
    }
    lines
}

/// The last point inside between `a`, inside, and `b`, outside; `ask` is called with points ever nearer to the border.
pub(crate) fn bisect(a: (f64, f64), b: (f64, f64), mut ask: impl FnMut(f64, f64) -> bool) -> (f64, f64) {
    let on = |t: f64| (a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t);
    let (mut lo, mut hi) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let t = 0.5 * (lo + hi);
        let (x, y) = on(t);
        if ask(x, y) { lo = t } else { hi = t }
    }
    on(0.5 * (lo + hi))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_has_one_round_outline() {
        let nodes = Nodes { x: (-1.0, 1.0), y: (-1.0, 1.0), nx: 21, ny: 21 };
        let ask = |x: f64, y: f64| x * x + y * y < 0.5;
        let inside: Vec<bool> = (0..nodes.count()).map(|k| ask(nodes.at(k).0, nodes.at(k).1)).collect();
        let lines = outlines(&nodes, &inside, |a, b| bisect(nodes.at(a), nodes.at(b), ask));
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        assert!(lines[0].iter().all(|(x, y)| (x * x + y * y - 0.5).abs() < 1e-5));
        assert_eq!(nodes.nearest(0.11, -0.52), nodes.nearest(0.1, -0.5));
    }

    #[test]
    fn a_half_plane_has_an_open_one() {
        let nodes = Nodes { x: (0.0, 1.0), y: (0.0, 1.0), nx: 5, ny: 9 };
        let inside: Vec<bool> = (0..nodes.count()).map(|k| nodes.at(k).0 < 0.4).collect();
        let lines = outlines(&nodes, &inside, |a, b| bisect(nodes.at(a), nodes.at(b), |x, _| x < 0.4));
        assert_eq!((lines.len(), lines[0].len()), (1, 9));
    }
}
