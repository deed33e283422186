//! The largest box of parameters in which a motion was found.
//!
//! The motion is carried along straight lines from the centre of the box: to the centres of its faces, to its corners,
//! and to scattered points of its surface. Steps are halved where the motion is lost, so the place where it is lost on a
//! line is located to a small part of the largest size. The directions of the lines on which it is lost first are then
//! varied, one coordinate at a time, as long as it is lost earlier. The box ends at the first place where the motion was
//! lost on any line. So the motion was found at all points that were tried in the box; nothing is proved about the
//! points between.

use super::carry::{Loss, carry};
use super::events::ParameterMargin;
use super::scope::Scope;
use crate::{Control, RunError, Stopped, SystemPlan};
use vibroimpact::Oscillator;
use vibroimpact::math::sort_by;
use vibroimpact::orbit::Cycle;

/// A box of parameters: each lies within a multiple of its scale from its value.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionBox {
    /// The multiple.
    pub size: f64,
    /// The largest multiple that was allowed: at an end of a range, or at an event in one parameter.
    pub largest: f64,
    /// Number of lines along which the motion was carried.
    pub lines: u64,
    /// Number of points in the box at which it was found.
    pub points: u64,
    /// Where the motion was lost next to the box; `None` if it was found up to the largest size.
    pub edge: Option<BoxEdge>,
}

/// A point next to a box at which the motion was not found.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxEdge {
    /// The values of the parameters that vary, in their order.
    pub values: Vec<f64>,
    /// Why it was not found.
    pub loss: Loss,
}

/// Number of steps of a line up to the largest size, if nothing is lost.
const STEPS: f64 = 32.0;
/// The place where the motion is lost is located to this part of the largest size.
const RESOLUTION: f64 = 1e-6;
/// Lines are followed to this multiple of the largest size, to find those on which the motion is lost first.
const BEYOND: f64 = 1.5;
/// The changes of a coordinate of a direction, the largest first.
const CHANGES: [f64; 5] = [0.5, 0.25, 0.125, 0.0625, 0.031_25];
/// The largest number of times that all coordinates are changed by one size of change.
const ROUNDS: u32 = 4;
/// The largest number of lines whose directions are varied.
const VARIED: usize = 4;

/// The box around a system of the stable motion `cycle`, up to its nearest event in one parameter at most.
///
/// # Errors
/// [`RunError`] for an invalid system, or when stopped. The stop flag is read at every line.
pub(crate) fn tried_box(
    system: &SystemPlan,
    cycle: &Cycle,
    margins: &[ParameterMargin],
    scattered: u32,
    control: &Control<'_>,
) -> Result<MotionBox, RunError> {
    let (scopes, largest): (Vec<Scope>, f64) = (margins.iter().map(|one| one.scope).collect(), largest(margins));
    let none = MotionBox { size: 0.0, largest, lines: 0, points: 0, edge: None };
    let Ok(centre) = carry(&system.oscillator()?, cycle) else { return Ok(none) };
    let mut trial = Trial { system, scopes: &scopes, centre, largest, control, lines: 0, sizes: Vec::new() };
    let n = scopes.len();
    let mut lost: Vec<(Vec<f64>, Lost)> = Vec::new();
    for direction in directions(n, scattered) {
        if let Some(place) = trial.follow(&direction, BEYOND * largest)? {
            lost.push((direction, place));
        }
    }
    sort_by(&mut lost, |(_, a), (_, b)| a.size.total_cmp(&b.size));
    let mut first: Option<Lost> = None;
    for (direction, place) in lost.into_iter().take(VARIED) {
        let place = trial.descend(direction, place)?;
        if first.as_ref().is_none_or(|first| place.size < first.size) {
            first = Some(place);
        }
    }
    let first = first.filter(|first| first.size < largest);
    let size = first.as_ref().map_or(largest, |first| first.size);
    let points = 1 + trial.sizes.iter().filter(|tried| **tried <= size).count() as u64;
    Ok(MotionBox { size, largest, lines: trial.lines, points, edge: first.map(|first| first.edge) })
}

/// The largest size of a box that stays in all ranges and contains no event in one parameter alone.
fn largest(margins: &[ParameterMargin]) -> f64 {
    let events = margins.iter().flat_map(|one| {
        let ends = one.ends().into_iter().filter(|(.., end)| end.point.is_some());
        ends.map(|(.., end)| end.scaled(&one.scope))
    });
    let ranges = margins.iter().map(|one| one.scope.largest());
    let size = events.chain(ranges).fold(f64::INFINITY, f64::min);
    if size.is_finite() {
        return size;
    }
    // all ends of the ranges are ends of the possible values
    margins.iter().map(|one| one.scope.farthest()).fold(0.0, f64::max)
}

/// The place on a line where the motion is lost: the last size at which it was found, and the point next to it.
struct Lost {
    size: f64,
    edge: BoxEdge,
}

/// The lines that are tried.
struct Trial<'a, 'c> {
    system: &'a SystemPlan,
    scopes: &'a [Scope],
    /// The motion at the centre of the box.
    centre: Cycle,
    largest: f64,
    control: &'a Control<'c>,
    /// The number of lines so far.
    lines: u64,
    /// The sizes of the box at whose surface the motion was found.
    sizes: Vec<f64>,
}

impl Trial<'_, '_> {
    /// The values of the parameters on the line in a direction where the box has this size.
    fn values(&self, direction: &[f64], size: f64) -> Vec<f64> {
        self.scopes.iter().zip(direction).map(|(scope, along)| scope.at(size * along)).collect()
    }

    /// The system with these values; `None` if the two stops leave no room.
    fn oscillator(&self, values: &[f64]) -> Option<Oscillator> {
        let all = self.scopes.iter().zip(values).map(|(scope, value)| (scope.parameter, *value));
        self.system.with_all(all).and_then(|system| system.oscillator()).ok()
    }

    /// Carries the motion along a line to this size. Returns where it is lost before.
    fn follow(&mut self, direction: &[f64], to: f64) -> Result<Option<Lost>, RunError> {
        if self.control.stopping() {
            return Err(Stopped { done: 0, total: 1 }.into());
        }
        self.lines += 1;
        let (longest, shortest) = (self.largest / STEPS, self.largest * RESOLUTION);
        let (mut size, mut step, mut here) = (0.0, longest, self.centre.clone());
        while size < to {
            let next = if size + step < to { size + step } else { to };
            let values = self.values(direction, next);
            match self.oscillator(&values).ok_or(Loss::NoSystem).and_then(|osc| carry(&osc, &here)) {
                Ok(there) => {
                    (size, here) = (next, there);
                    self.sizes.push(size);
                    step = longest.min(2.0 * step);
                }
                Err(loss) if next - size <= shortest => {
                    return Ok(Some(Lost { size, edge: BoxEdge { values, loss } }));
                }
                Err(_) => step = 0.5 * (next - size),
            }
        }
        Ok(None)
    }

    /// Varies a direction, one coordinate at a time, as long as the motion is lost earlier.
    fn descend(&mut self, mut direction: Vec<f64>, mut place: Lost) -> Result<Lost, RunError> {
        let n = direction.len();
        for change in CHANGES {
            for _ in 0..ROUNDS {
                let before = place.size;
                for (k, way) in (0..n).flat_map(|k| [(k, change), (k, -change)]) {
                    let Some(other) = moved(&direction, k, way) else { continue };
                    if let Some(earlier) = self.follow(&other, place.size)? {
                        (direction, place) = (other, earlier);
                    }
                }
                if place.size >= before {
                    break;
                }
            }
        }
        Ok(place)
    }
}

/// A direction with another value of coordinate `k`, on the surface of the cube; `None` if it is the same direction.
fn moved(direction: &[f64], k: usize, change: f64) -> Option<Vec<f64>> {
    let mut other = direction.to_vec();
    other[k] = (other[k] + change).clamp(-1.0, 1.0);
    let farthest = other.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    other.iter_mut().for_each(|x| *x /= farthest);
    (farthest > 0.0 && other != direction).then_some(other)
}

/// The points of the surface of the cube from -1 to 1 in `n` dimensions to which lines go: the centres of its faces,
/// its corners, and scattered points.
fn directions(n: usize, scattered: u32) -> impl Iterator<Item = Vec<f64>> {
    let unit = move |k: usize, sign: f64| (0..n).map(|j| if j == k { sign } else { 0.0 }).collect::<Vec<_>>();
    let faces = (0..n).flat_map(move |k| [unit(k, 1.0), unit(k, -1.0)]);
    let sign = |corner: u32, j: usize| if corner >> j & 1 == 0 { 1.0 } else { -1.0 };
    let corners = (0..1_u32 << n).map(move |corner| (0..n).map(|j| sign(corner, j)).collect());
    // with one parameter the corners are the faces
    let corners = corners.filter(move |_| n > 1);
    faces.chain(corners).chain((0..scattered).filter(move |_| n > 1).map(move |k| scattered_point(n, k)))
}

/// Point `k` of a sequence on the surface of the cube. A Kronecker sequence in the cube, with the powers of the inverse
/// of the root of x^(n+1) = x + 1, which spread evenly in `n` dimensions, is moved from the centre to the surface.
fn scattered_point(n: usize, k: u32) -> Vec<f64> {
    let order = f64::from(u32::try_from(n).unwrap_or(u32::MAX));
    // the iteration contracts to the root, which lies between 1 and 2
    let root = (0..60).fold(1.5_f64, |root, _| (1.0 + root).powf(1.0 / (order + 1.0)));
    let mut power = 1.0;
    let inside: Vec<f64> = (0..n)
        .map(|_| {
            power /= root;
            2.0 * (0.5 + f64::from(k + 1) * power).fract() - 1.0
        })
        .collect();
    let farthest = inside.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    inside.iter().map(|x| x / farthest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_lie_on_the_surface_and_are_spread() {
        let all: Vec<Vec<f64>> = directions(3, 500).collect();
        assert_eq!(all.len(), 6 + 8 + 500);
        let size = |point: &[f64]| point.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(all.iter().all(|point| (size(point) - 1.0).abs() < 1e-12));
        // each of the 24 quarters of the faces has its part of the points
        for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            for quarter in 0..4 {
                let inside = |point: &&Vec<f64>| {
                    let (a, b) = (point[(axis + 1) % 3], point[(axis + 2) % 3]);
                    point[axis] == sign && (a > 0.0) == (quarter & 1 == 0) && (b > 0.0) == (quarter & 2 == 0)
                };
                let count = all[14..].iter().filter(inside).count();
                assert!((10..=32).contains(&count), "{axis} {sign} {quarter}: {count}");
            }
        }
        assert_eq!(directions(1, 500).collect::<Vec<_>>(), [[1.0], [-1.0]]);
    }
}
