//! Regions of a plane of parameters as polygons.

/// The condition that bounds a region along an edge of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// A multiplier is +1: two orbits meet.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// A pair of complex multipliers lies on the unit circle. An oscillator has no such edge.
    Torus,
    /// The orbit merges with an orbit of half the period at a flip of that orbit, or with a symmetric orbit at its
    /// branch point.
    Merging,
    /// An impact has speed zero.
    NoSpeed,
    /// A flight grazes a stop.
    Touch,
    /// The events of the motion change in another way, as where a rest or a hold begins. An oscillator has no such edge.
    Change,
    /// The edge of the frame.
    Frame,
}

impl Bound {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Flip => "flip",
            Self::Torus => "torus",
            Self::Merging => "merging",
            Self::NoSpeed => "no speed",
            Self::Touch => "touch",
            Self::Change => "change",
            Self::Frame => "frame",
        }
    }
}

/// A vertex of a polygon: a corner or a point on an edge of the region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Values of the two parameters.
    pub values: (f64, f64),
    /// The bound of the region from this vertex to the next one.
    pub bound: Bound,
}

/// A closed polygon; the last vertex is connected to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Its vertices, with the region on the left.
    pub vertices: Vec<Vertex>,
    /// Whether it is the edge of a hole.
    pub hole: bool,
    /// The sheet that it bounds: true for orbits whose multipliers are below +1, false for the other sheet.
    pub below: bool,
}

impl Polygon {
    /// Twice the area; negative for a hole.
    pub(crate) fn area(&self) -> f64 {
        self.edges().map(|((x, y), (u, v))| x * v - u * y).sum()
    }

    fn edges(&self) -> impl Iterator<Item = ((f64, f64), (f64, f64))> + '_ {
        let m = self.vertices.len();
        (0..m).map(move |k| (self.vertices[k].values, self.vertices[(k + 1) % m].values))
    }

    /// How many times the polygon encloses a point counterclockwise.
    pub(crate) fn winding(&self, (x, y): (f64, f64)) -> i32 {
        // edges that cross the ray from the point to the right, upwards or downwards
        let meets = |((x0, y0), (x1, y1)): ((f64, f64), (f64, f64))| {
            let across = (y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0);
            if !across {
                0
            } else if y1 > y0 {
                1
            } else {
                -1
            }
        };
        self.edges().map(meets).sum()
    }

    /// The distance of a point from the polygon, with lengths divided by `scales`, and the index of the nearest edge.
    pub(crate) fn nearest(&self, (x, y): (f64, f64), scales: (f64, f64)) -> (f64, usize) {
        let scaled = |(u, v): (f64, f64)| ((u - x) / scales.0, (v - y) / scales.1);
        let to_edge = |(a, b): ((f64, f64), (f64, f64))| {
            let ((ax, ay), (bx, by)) = (scaled(a), scaled(b));
            let (dx, dy) = (bx - ax, by - ay);
            let square = dx * dx + dy * dy;
            // the foot of the perpendicular, or the nearer end of the edge
            let t = if square > 0.0 { (-(ax * dx + ay * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
            crate::math::hypot(ax + t * dx, ay + t * dy)
        };
        let edges = self.edges().map(to_edge).enumerate();
        edges.fold((f64::INFINITY, 0), |least, (k, distance)| if distance < least.0 { (distance, k) } else { least })
    }
}

/// A region of a plane of two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its polygons.
    pub polygons: Vec<Polygon>,
    /// The points of the grid at which the search for orbits and the polygons disagree, because a trace failed there or
    /// an orbit sticks.
    pub unresolved: Vec<(f64, f64)>,
}

impl Region {
    /// Whether a point lies in the region.
    #[must_use]
    pub fn contains(&self, point: (f64, f64)) -> bool {
        [true, false].into_iter().any(|below| self.sheets(point, below) > 0)
    }

    /// The number of sheets of that kind over a point; polygons of several sheets may overlap.
    pub(crate) fn sheets(&self, point: (f64, f64), below: bool) -> usize {
        let windings = self.polygons.iter().filter(|p| p.below == below).map(|p| p.winding(point));
        usize::try_from(windings.sum::<i32>()).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64, hole: bool) -> Polygon {
        let mut corners = vec![(-half, -half), (half, -half), (half, half), (-half, half)];
        if hole {
            corners.reverse();
        }
        let vertices = corners.into_iter().map(|values| Vertex { values, bound: Bound::Fold }).collect();
        Polygon { vertices, hole, below: true }
    }

    #[test]
    fn sheets_may_overlap() {
        let region = Region { polygons: vec![square(2.0, false), square(1.0, false)], unresolved: Vec::new() };
        assert!(region.contains((1.5, 0.3)) && region.contains((0.2, 0.3)) && !region.contains((2.5, 0.3)));
    }

    #[test]
    fn a_square_with_a_hole() {
        let region = Region { polygons: vec![square(2.0, false), square(1.0, true)], unresolved: Vec::new() };
        assert!(region.contains((1.5, 0.3)) && !region.contains((0.2, 0.3)) && !region.contains((2.5, 0.3)));
        assert_eq!((region.polygons[0].area(), region.polygons[1].area()), (32.0, -8.0));
        assert!((region.polygons[0].nearest((3.0, 1.0), (1.0, 2.0)).0 - 1.0).abs() < 1e-15);
        assert!((region.polygons[0].nearest((0.0, 3.0), (1.0, 2.0)).0 - 0.5).abs() < 1e-15);
    }
}
