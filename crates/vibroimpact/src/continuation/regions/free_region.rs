//! The region of the motion without impacts, in closed form.
//!
//! The steady motion without impacts clears the stops where its amplitude does not exceed a gap:
//!
//! $$`|f| = \frac{1}{\sqrt{(1-\beta^2)^2 + 4\zeta^2\beta^2}} \le \min(\delta, \delta_2),`$$
//!
//! whatever the restitutions are. In every plane of two parameters one of them, here called $`y`$, must be at least a
//! known function of the other one, $`x`$: a gap must be at least $`|f|`$, and the damping ratio at least
//!
//! $$`\zeta = \frac{\sqrt{1/g^2 - (1-\beta^2)^2}}{2\beta}, \qquad g = \min(\delta, \delta_2).`$$
//!
//! The values of $`x`$ at which this function enters or leaves the frame, jumps or has a corner are also known. They
//! follow from $`|f| = g`$, solved for the frequency,
//! $`\beta^2 = 1 - 2\zeta^2 \pm \sqrt{1/g^2 - 4\zeta^2(1-\zeta^2)}`$, or for the damping ratio. So the polygons need no
//! search, and no part of the region is missed, however narrow the resonance is.
//!
//! Over other numbers, such as the mass and the force of a machine, the limit has no such form. There the region is outlined on a
//! grid, and parts of it that are smaller than a cell can be missed.
//!
//! With damping the motion is stable wherever it exists. Without damping it is one of a continuum of motions without
//! impacts, each neutrally stable, so it has a region of existence and no region of stability.

use super::options::{RegionKind, RegionOptions};
use super::outline::Outline;
use super::polygon::{Bound, Polygon, Region, Vertex};
use crate::continuation::curves::Frame;
use crate::math::{hypot, sort_by};
use crate::system::{Oscillator, Parameter, Side};

/// The region of the motion without impacts of `osc` in a frame of two parameters.
pub(crate) fn free_region(osc: &Oscillator, kind: RegionKind, frame: &Frame, options: RegionOptions) -> Region {
    let mut region = Region { polygons: Vec::new(), unresolved: Vec::new() };
    let Some((first, second)) = frame.plane.parameters() else {
        if !frame.sensible() {
            return region;
        }
        let holds = |at: (f64, f64)| {
            let there = frame.plane.set(osc, at).ok();
            there.is_some_and(|osc| {
                (kind == RegionKind::Existence || osc.damping() > 0.0) && osc.free_amplitude() <= nearest(&osc)
            })
        };
        let (ranges, cells, halvings) = (&frame.ranges, CELLS, HALVINGS);
        region.polygons = Outline { ranges, cells, halvings, options, holds: &holds }.polygons();
        let (columns, rows) = options.grid;
        let nodes = (0..rows).flat_map(|j| (0..columns).map(move |i| frame.node((i, j), options.grid)));
        region.unresolved = nodes.filter(|at| holds(*at) != region.contains(*at)).collect();
        return region;
    };
    let damped = osc.damping() > 0.0 || [first, second].contains(&Parameter::Damping);
    if !frame.sensible() || (kind == RegionKind::Stability && !damped) {
        return region;
    }
    // x is the frequency, in which the limit has a maximum; without a frequency it is a parameter without influence, or
    // any other
    let idle = |p| matches!(p, Parameter::Restitution | Parameter::SecondRestitution);
    let swapped = second.is_frequency() || (!first.is_frequency() && idle(second) && !idle(first));
    let (x, y) = if swapped { (1, 0) } else { (0, 1) };
    let side = |k: usize| {
        let (parameters, ranges) = ([first, second], [&frame.ranges.0, &frame.ranges.1]);
        let scale = if k == 0 { frame.scales().0 } else { frame.scales().1 };
        Axis { parameter: parameters[k], low: *ranges[k].start(), high: *ranges[k].end(), scale }
    };
    let (x, y) = (side(x), side(y));
    // only y >= limit is needed, so the largest y decides whether a value of x can belong to the region
    if let Ok(osc) = y.parameter.set(osc, y.high) {
        region.polygons = Limit { osc, x, y, options }.polygons(swapped);
    }
    region
}

/// The number of cells along each side of the frame over numbers of a machine.
const CELLS: u32 = 192;
/// The number of halvings after which a bracket of any width has the width of a rounding error.
const HALVINGS: u32 = 60;

/// One parameter of the frame with its range.
#[derive(Clone, Copy)]
struct Axis {
    parameter: Parameter,
    low: f64,
    high: f64,
    /// The change that has length 1.
    scale: f64,
}

/// The least `y` at which the motion clears the stops, as a function of `x`.
struct Limit {
    osc: Oscillator,
    x: Axis,
    y: Axis,
    options: RegionOptions,
}

impl Limit {
    /// The least `y` at `x`: minus infinity if every `y` is sufficient, infinity if none is.
    fn at(&self, x: f64) -> f64 {
        let Some(osc) = self.x.parameter.set(&self.osc, x).ok() else { return f64::INFINITY };
        let needed = |other: Option<Side>| {
            let mut stops = osc.stops().filter(|(side, _)| Some(*side) != other);
            stops.all(|(_, stop)| osc.free_amplitude() <= stop.gap)
        };
        match self.y.parameter {
            Parameter::Gap if needed(Some(Side::Upper)) => osc.free_amplitude(),
            Parameter::SecondGap if needed(Some(Side::Lower)) => osc.free_amplitude(),
            Parameter::Damping => least_damping(osc.beta(), nearest(&osc)),
            Parameter::Restitution | Parameter::SecondRestitution if needed(None) => f64::NEG_INFINITY,
            _ => f64::INFINITY,
        }
    }

    /// The values of `x` inside the frame between which the limit is smooth and does not cross an edge of the frame.
    fn breaks(&self) -> Vec<f64> {
        let (beta, damping) = (self.osc.beta(), self.osc.damping());
        let gaps = || self.osc.stops().filter(|(side, _)| Some(*side) != varied(self.y.parameter));
        let mut levels: Vec<f64> = gaps().map(|(_, stop)| stop.gap).collect();
        // for each damping ratio of interest: the values of x at which the amplitude equals one of these levels
        let mut dampings = vec![damping];
        match self.y.parameter {
            Parameter::Gap | Parameter::SecondGap => levels.extend([self.y.low, self.y.high]),
            Parameter::Damping => dampings = vec![self.y.low, self.y.high, 0.0],
            _ => {}
        }
        let mut breaks = Vec::new();
        for zeta in dampings {
            match self.x.parameter {
                Parameter::Beta | Parameter::InverseBeta => {
                    let betas = levels.iter().flat_map(|g| frequencies(*g, zeta));
                    // at sqrt(1 - 2 zeta^2) is the peak of the resonance, so that the amplitude is monotonic between
                    // the breaks
                    let betas = betas.chain([(1.0 - 2.0 * zeta * zeta).max(0.0).sqrt()]).filter(|beta| *beta > 0.0);
                    let inverse = self.x.parameter == Parameter::InverseBeta;
                    breaks.extend(betas.map(|beta| if inverse { 1.0 / beta } else { beta }));
                }
                Parameter::Damping => breaks.extend(levels.iter().map(|g| least_damping(beta, *g))),
                // at the amplitude itself, and where the other gap becomes the smaller one
                Parameter::Gap | Parameter::SecondGap => {
                    let amplitude = Parameter::Damping.set(&self.osc, zeta).map(|osc| osc.free_amplitude());
                    breaks.extend(amplitude.ok().into_iter().chain(levels.iter().copied()));
                }
                Parameter::Restitution | Parameter::SecondRestitution => {}
            }
        }
        breaks.retain(|x| *x > self.x.low && *x < self.x.high);
        sort_by(&mut breaks, f64::total_cmp);
        breaks.dedup();
        breaks
    }

    /// One polygon for each interval of `x` on which some `y` of the frame is sufficient.
    fn polygons(&self, swapped: bool) -> Vec<Polygon> {
        let ends: Vec<f64> = core::iter::once(self.x.low).chain(self.breaks()).chain([self.x.high]).collect();
        let mut polygons = Vec::new();
        // the lower edge of the current polygon, from left to right
        let mut under: Vec<Vertex> = Vec::new();
        for pair in ends.windows(2) {
            if self.at(0.5 * (pair[0] + pair[1])) < self.y.high {
                self.lower(pair[0], pair[1], &mut under);
            } else if under.len() > 1 {
                polygons.push(self.closed(core::mem::take(&mut under), swapped));
            }
        }
        if under.len() > 1 {
            polygons.push(self.closed(under, swapped));
        }
        polygons
    }

    /// Adds the lower edge of the polygon between two of these values of `x`.
    fn lower(&self, from: f64, to: f64, under: &mut Vec<Vertex>) {
        let touches = self.at(0.5 * (from + to)) > self.y.low;
        let bound = if touches { Bound::Touch } else { Bound::Frame };
        // if the limit jumps at x, its value on the side of this interval
        let inside = |x: f64| {
            let at = self.at(x);
            if at.is_finite() { at } else { self.at(x + ASIDE * (0.5 * (from + to) - x)) }
        };
        let value = |x: f64| if touches { inside(x).clamp(self.y.low, self.y.high) } else { self.y.low };
        let (a, b) = (Vertex { values: (from, value(from)), bound }, Vertex { values: (to, value(to)), bound });
        // an interval begins with the last vertex of the one before; its bound applies from there on
        match under.last_mut() {
            Some(last) => last.bound = bound,
            None => under.push(a),
        }
        if touches {
            self.between((a, b), &value, under, 0);
        }
        under.push(b);
    }

    /// Adds points of the limit between two of its points until the edges are short and accurate.
    fn between(&self, (a, b): (Vertex, Vertex), value: &dyn Fn(f64) -> f64, under: &mut Vec<Vertex>, depth: u32) {
        let scaled = |(x, y): (f64, f64)| (x / self.x.scale, y / self.y.scale);
        let x = 0.5 * (a.values.0 + b.values.0);
        let middle = Vertex { values: (x, value(x)), bound: a.bound };
        let ((ax, ay), (bx, by), (mx, my)) = (scaled(a.values), scaled(b.values), scaled(middle.values));
        let (dx, dy) = (bx - ax, by - ay);
        let length = hypot(dx, dy);
        let off = ((mx - ax) * dy - (my - ay) * dx).abs() / length.max(f64::MIN_POSITIVE);
        let fine = length <= self.options.longest && off <= self.options.accuracy;
        if fine || depth >= DEEPEST || under.len() >= self.options.vertices as usize {
            return;
        }
        self.between((a, middle), value, under, depth + 1);
        under.push(middle);
        self.between((middle, b), value, under, depth + 1);
    }

    /// The polygon above a lower edge, with the region on its left.
    fn closed(&self, mut under: Vec<Vertex>, swapped: bool) -> Polygon {
        let (left, right) = (under[0].values, under[under.len() - 1].values);
        // at a vertical edge inside the frame the amplitude begins to exceed a gap, for every y
        let side = |x: f64| if x == self.x.low || x == self.x.high { Bound::Frame } else { Bound::Touch };
        if let Some(last) = under.last_mut() {
            last.bound = side(right.0);
        }
        let corners = [(right.0, Bound::Frame), (left.0, side(left.0))];
        let above = corners.map(|(x, bound)| Vertex { values: (x, self.y.high), bound });
        let mut vertices: Vec<Vertex> = under.into_iter().chain(above).collect();
        vertices.dedup_by(|next, one| {
            let same = next.values == one.values;
            // the remaining vertex has the bound of the later one
            one.bound = if same { next.bound } else { one.bound };
            same
        });
        if vertices.len() > 1 && vertices.first().map(|v| v.values) == vertices.last().map(|v| v.values) {
            vertices.pop();
        }
        if swapped {
            vertices = mirrored(&vertices);
        }
        Polygon { vertices, hole: false, below: true }
    }
}

/// The polygon with its coordinates exchanged, and in reverse order, so that the region stays on its left.
fn mirrored(vertices: &[Vertex]) -> Vec<Vertex> {
    let count = vertices.len();
    // an edge is stored with its first vertex, which in reverse order is the other one
    let turned = (0..count).rev().map(|k| {
        let (x, y) = vertices[k].values;
        Vertex { values: (y, x), bound: vertices[(k + count - 1) % count].bound }
    });
    turned.collect()
}

/// The stop whose gap is this parameter.
const fn varied(parameter: Parameter) -> Option<Side> {
    match parameter {
        Parameter::Gap => Some(Side::Upper),
        Parameter::SecondGap => Some(Side::Lower),
        _ => None,
    }
}

/// The smaller gap.
fn nearest(osc: &Oscillator) -> f64 {
    osc.stops().map(|(_, stop)| stop.gap).fold(f64::INFINITY, f64::min)
}

/// The smallest damping ratio at which the amplitude at `beta` is at most `gap`.
fn least_damping(beta: f64, gap: f64) -> f64 {
    if gap <= 0.0 {
        return f64::INFINITY;
    }
    let off = ((1.0 - beta) * (1.0 + beta)).abs();
    ((1.0 / gap - off) * (1.0 / gap + off)).max(0.0).sqrt() / (2.0 * beta)
}

/// The frequency ratios at which the amplitude is `gap`.
fn frequencies(gap: f64, zeta: f64) -> impl Iterator<Item = f64> {
    let root = (gap > 0.0).then(|| (1.0 / (gap * gap) - 4.0 * zeta * zeta * (1.0 - zeta) * (1.0 + zeta)).sqrt());
    let squares = root.into_iter().flat_map(move |root| [-1.0, 1.0].map(|sign| 1.0 - 2.0 * zeta * zeta + sign * root));
    squares.filter(|square| *square > 0.0).map(f64::sqrt)
}

/// The largest number of times that an edge is halved.
const DEEPEST: u32 = 40;
/// The distance from a jump at which the limit on one side is evaluated, as a fraction of half the interval.
const ASIDE: f64 = 1e-12;
