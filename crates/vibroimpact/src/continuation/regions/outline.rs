//! The polygons around the points of a frame at which a condition holds, whatever the condition is.
//!
//! The condition is evaluated at the corners of square cells. Between a corner at which it holds and one at which it does
//! not, bisection finds a point of the edge of the set to rounding, and these points are joined cell by cell (marching
//! squares). A piece of the set, or a hole, that is smaller than a cell can be missed. Cells outside the frame, at which
//! nothing holds, close the polygons along it.

use super::options::RegionOptions;
use super::polygon::{Bound, Polygon, Vertex};
use crate::continuation::curves::{Ranges, scales};
use crate::math::hypot;
use std::collections::BTreeMap;

/// The largest number of times that an edge is halved.
const DEEPEST: u32 = 24;

/// The edge of the set is looked for within half the length of a chord from its middle, first within this power of 1/2.
const NEAR: u32 = 12;

/// A side of a cell: from the corner `(i, j)` to the right, or upwards.
type Side = (u32, u32, bool);

/// The search for the polygons around the points at which a condition holds.
pub(crate) struct Outline<'a> {
    pub(crate) ranges: &'a Ranges,
    /// The number of cells along each side of the frame.
    pub(crate) cells: u32,
    /// How often the way from a point of the set to one outside is halved.
    pub(crate) halvings: u32,
    pub(crate) options: RegionOptions,
    pub(crate) holds: &'a dyn Fn((f64, f64)) -> bool,
}

impl Outline<'_> {
    /// The corner `(i, j)`: corners 1 to `cells + 1` are in the frame, 0 and `cells + 2` lie on it but count as outside.
    fn corner(&self, (i, j): (u32, u32)) -> (f64, f64) {
        let at = |range: &core::ops::RangeInclusive<f64>, k: u32| match k {
            0 | 1 => *range.start(),
            k if k > self.cells => *range.end(),
            k => range.start() + (range.end() - range.start()) * (f64::from(k - 1) / f64::from(self.cells)),
        };
        (at(&self.ranges.0, i), at(&self.ranges.1, j))
    }

    /// The polygons, with the set on their left. Of an edge that is not that of the frame nothing is known, and it is
    /// [`Bound::Touch`].
    pub(crate) fn polygons(&self) -> Vec<Polygon> {
        let width = self.cells + 3;
        let inside = |i: u32, j: u32| (1..=self.cells + 1).contains(&i) && (1..=self.cells + 1).contains(&j);
        let corners = (0..width * width).map(|k| (k % width, k / width));
        let holds: Vec<bool> = corners.map(|(i, j)| inside(i, j) && (self.holds)(self.corner((i, j)))).collect();
        let mut after = self.joined(&|(i, j)| holds[(j * width + i) as usize]);
        let mut polygons = Vec::new();
        while let Some((&first, _)) = after.iter().next() {
            let (mut side, mut vertices) = (first, Vec::new());
            while let Some((next, bound)) = after.remove(&side) {
                vertices.push(Vertex { values: self.crossing(side, &holds), bound });
                side = next;
            }
            let vertices = self.refined(&self.straightened(vertices));
            let mut polygon = Polygon { vertices, hole: false, below: true };
            polygon.hole = polygon.area() < 0.0;
            if polygon.vertices.len() > 2 {
                polygons.push(polygon);
            }
        }
        polygons
    }

    /// For each side that the edge of the set crosses, the side that it crosses next, with the set on its left.
    fn joined(&self, holds: &dyn Fn((u32, u32)) -> bool) -> BTreeMap<Side, (Side, Bound)> {
        let mut after = BTreeMap::new();
        for (i, j) in (0..=self.cells + 1).flat_map(|j| (0..=self.cells + 1).map(move |i| (i, j))) {
            // counterclockwise, each corner with the side that follows it
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let sides = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
            let there = corners.map(holds);
            let turns = |k: usize, from: bool| there[k] == from && there[(k + 1) % 4] != from;
            let leaves = (0..4).filter(|&k| turns(k, true)).count();
            // of two opposite corners, one set if the centre belongs to it, otherwise two
            let ((x, y), (u, v)) = (self.corner(corners[0]), self.corner(corners[2]));
            let joins = leaves > 1 && (self.holds)((0.5 * (x + u), 0.5 * (y + v)));
            let beyond = [i, j].into_iter().any(|k| k == 0 || k > self.cells);
            let bound = if beyond { Bound::Frame } else { Bound::Touch };
            for k in (0..4).filter(|&k| turns(k, true)) {
                let way = |step: usize| if joins { (k + step) % 4 } else { (k + 4 - step) % 4 };
                if let Some(enters) = (1..4).map(way).find(|&k| turns(k, false)) {
                    after.insert(sides[k], (sides[enters], bound));
                }
            }
        }
        after
    }

    /// The point of a side at which the edge of the set crosses it.
    fn crossing(&self, (i, j, up): Side, holds: &[bool]) -> (f64, f64) {
        let (a, b) = ((i, j), if up { (i, j + 1) } else { (i + 1, j) });
        let here = holds[(j * (self.cells + 3) + i) as usize];
        let (inside, outside) = if here { (a, b) } else { (b, a) };
        self.edge(self.corner(inside), self.corner(outside))
    }

    /// The last point of the set on the way from one of its points to one outside; on the frame both are the same point.
    // bisection keeps a point on each side, and the inner one is returned, so that all vertices are in the set
    fn edge(&self, mut inside: (f64, f64), mut outside: (f64, f64)) -> (f64, f64) {
        for _ in 0..self.halvings {
            let middle = middle(inside, outside);
            *(if (self.holds)(middle) { &mut inside } else { &mut outside }) = middle;
        }
        inside
    }

    /// Without repeated vertices, and without those between two corners of the frame.
    fn straightened(&self, vertices: Vec<Vertex>) -> Vec<Vertex> {
        let ends = [&self.ranges.0, &self.ranges.1].map(|range| [*range.start(), *range.end()]);
        let is_corner = |(x, y): (f64, f64)| ends[0].contains(&x) && ends[1].contains(&y);
        let mut kept: Vec<Vertex> = Vec::new();
        for vertex in vertices {
            match kept.last_mut() {
                // the edge that remains is the one that leaves the place
                Some(last) if last.values == vertex.values => last.bound = vertex.bound,
                Some(last)
                    if last.bound == Bound::Frame && vertex.bound == Bound::Frame && !is_corner(vertex.values) => {}
                _ => kept.push(vertex),
            }
        }
        if kept.len() > 1 && kept.first().map(|v| v.values) == kept.last().map(|v| v.values) {
            kept.pop();
        }
        kept
    }

    /// With points of the edge of the set between the vertices, until the polygon is as fine and as accurate as asked.
    fn refined(&self, vertices: &[Vertex]) -> Vec<Vertex> {
        let mut fine = Vec::new();
        for (k, vertex) in vertices.iter().enumerate() {
            fine.push(*vertex);
            if vertex.bound == Bound::Touch {
                self.between(vertex.values, vertices[(k + 1) % vertices.len()].values, &mut fine, 0);
            }
        }
        fine
    }

    /// Adds points of the edge of the set between two of its points.
    fn between(&self, a: (f64, f64), b: (f64, f64), fine: &mut Vec<Vertex>, depth: u32) {
        let scales = scales(self.ranges);
        let (dx, dy) = ((b.0 - a.0) / scales.0, (b.1 - a.1) / scales.1);
        let (length, m) = (hypot(dx, dy), middle(a, b));
        // the set is on the left, so the edge is on the right of a point of the set
        let sign = if (self.holds)(m) { 1.0 } else { -1.0 };
        let aside = |part: f64| (m.0 + sign * part * dy * scales.0, m.1 - sign * part * dx * scales.1);
        let parts = (0..NEAR).rev().map(|k| 0.5 / f64::from(1_u32 << k));
        // the nearest places first, so that another part of the set is not taken for this edge
        let Some(beyond) = parts.map(aside).find(|at| (self.holds)(*at) != (sign > 0.0)) else { return };
        let found = if sign > 0.0 { self.edge(m, beyond) } else { self.edge(beyond, m) };
        let off = hypot((found.0 - m.0) / scales.0, (found.1 - m.1) / scales.1);
        let enough = length <= self.options.longest && off <= self.options.accuracy;
        if enough || depth >= DEEPEST || fine.len() >= self.options.vertices as usize || !inside(self.ranges, found) {
            return;
        }
        self.between(a, found, fine, depth + 1);
        fine.push(Vertex { values: found, bound: Bound::Touch });
        self.between(found, b, fine, depth + 1);
    }
}

fn inside((across, up): &Ranges, (p, q): (f64, f64)) -> bool {
    across.contains(&p) && up.contains(&q)
}

fn middle(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    fn outline(holds: &dyn Fn((f64, f64)) -> bool) -> Vec<Polygon> {
        let (ranges, options) = ((-1.0..=3.0, 0.0..=2.0), RegionOptions::default());
        Outline { ranges: &ranges, cells: 192, halvings: 60, options, holds }.polygons()
    }

    fn area(polygons: &[Polygon]) -> f64 {
        polygons.iter().map(|polygon| 0.5 * polygon.area()).sum()
    }

    #[test]
    fn a_ring_has_an_outline_with_a_hole() {
        let radius = |(x, y): (f64, f64)| hypot(x - 1.0, y - 1.0);
        let ring = outline(&|at| (0.3..=0.8).contains(&radius(at)));
        assert_eq!((ring.len(), ring.iter().filter(|polygon| polygon.hole).count()), (2, 1));
        assert!((area(&ring) - PI * (0.64 - 0.09)).abs() < 1e-3, "{}", area(&ring));
        let vertices = ring.iter().flat_map(|polygon| &polygon.vertices);
        let off = |vertex: &Vertex| (radius(vertex.values) - 0.3).abs().min((radius(vertex.values) - 0.8).abs());
        assert!(vertices.clone().all(|vertex| vertex.bound == Bound::Touch && off(vertex) < 1e-15));
    }

    #[test]
    fn the_frame_closes_an_outline() {
        // all of the frame, and what is left of an oblique line
        let all = outline(&|_| true);
        assert_eq!((all.len(), all[0].vertices.len(), area(&all)), (1, 4, 8.0));
        assert!(all[0].vertices.iter().all(|vertex| vertex.bound == Bound::Frame));
        assert!(outline(&|_| false).is_empty());
        let half = outline(&|(x, y)| x + 0.3 * y < 1.0);
        assert!((area(&half) - 3.4).abs() < 1e-12, "{}", area(&half));
        let frame = half[0].vertices.iter().filter(|vertex| vertex.bound == Bound::Frame).count();
        assert_eq!((half.len(), frame), (1, 3));
    }

    /// Two triangles that meet in the middle of a cell, and the two others.
    #[test]
    fn sets_that_meet_in_a_point() {
        for sign in [1.0, -1.0] {
            let found = outline(&|(x, y)| sign * (x - 1.003) * (y - 0.997) > 0.0);
            let exact = if sign > 0.0 { 1.997 * 1.003 + 2.003 * 0.997 } else { 1.997 * 0.997 + 2.003 * 1.003 };
            assert!((area(&found) - exact).abs() < 1e-3, "{} {exact}", area(&found));
        }
    }
}
