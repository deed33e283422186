//! Curves of folds, flips and grazing impacts in a plane of two parameters, and the points of codimension two on them.

use super::arc::{Equations, correct, tangent};
use super::options::BranchError;
use super::plane::{Condition, Plane};
use super::point::{BranchEvent, Change, Point};
use super::walk::{Spot, Stride, Walk};
use crate::orbit::{Cycle, Floquet, Orbit, Ring, ring_cycle};
use crate::system::{Oscillator, Parameter, Side};
use core::ops::RangeInclusive;
use std::collections::VecDeque;

/// A plane of two parameters and the box in it that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The parameters.
    pub parameters: (Parameter, Parameter),
    /// Their ranges.
    pub ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
}

impl Frame {
    /// What a change of each parameter counts by: a quarter of its range.
    pub(super) fn scales(&self) -> (f64, f64) {
        let quarter = |range: &RangeInclusive<f64>| 0.25 * (range.end() - range.start());
        (quarter(&self.ranges.0), quarter(&self.ranges.1))
    }

    /// Whether the ranges are finite and in order.
    pub(super) fn sensible(&self) -> bool {
        let good = |r: &RangeInclusive<f64>| r.start().is_finite() && r.end().is_finite() && r.start() < r.end();
        good(&self.ranges.0) && good(&self.ranges.1)
    }

    /// Its edges, each positive inside.
    pub(super) fn edges(&self) -> [Condition; 4] {
        let (p, q) = &self.ranges;
        [
            Condition::Line(1.0, 0.0, *p.start()),
            Condition::Line(-1.0, 0.0, -*p.end()),
            Condition::Line(0.0, 1.0, *q.start()),
            Condition::Line(0.0, -1.0, -*q.end()),
        ]
    }

    /// The same with each range shrunk by a share of it at either end.
    pub(super) fn shrunk(&self, share: f64) -> Self {
        let shrink = |r: &RangeInclusive<f64>| {
            let by = share * (r.end() - r.start());
            r.start() + by..=r.end() - by
        };
        Self { parameters: self.parameters, ranges: (shrink(&self.ranges.0), shrink(&self.ranges.1)) }
    }

    /// Whether it holds a point.
    pub(super) fn holds(&self, (p, q): (f64, f64)) -> bool {
        self.ranges.0.contains(&p) && self.ranges.1.contains(&q)
    }
}

/// What holds along a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// A multiplier is +1 and the parameters turn.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// An impact has speed zero.
    Grazing,
}

/// A point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Values of the two parameters.
    pub values: (f64, f64),
    /// The cycle; on a grazing curve with the impact of speed zero in it.
    pub cycle: Cycle,
    /// Whether it is a possible motion (on a grazing curve: apart from that impact).
    pub physical: bool,
    /// What happens here; `None` for an ordinary point.
    pub event: Option<CurveEvent>,
}

/// What happens at a point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveEvent {
    /// A fold curve comes back on itself: two folds meet.
    Cusp,
    /// A grazing impact without the infinite multiplier: the trace of the linearised turn is zero, and curves of folds
    /// and flips end on the grazing curve. Without damping, for 1/n, where $`\sin(2\pi n/\beta) = 0`$.
    ResonantGrazing,
    /// A second impact has speed zero, or another flight touches a stop.
    DoubleGrazing,
    /// The mass touches with no acceleration.
    DegenerateGrazing,
    /// A flight of a cycle at a fold or a flip touches a stop: beyond, the curve is not one of motions.
    Touch,
    /// Both multipliers are -1, which takes a determinant of 1: restitution 1 and no damping.
    OneToTwo,
    /// The curve closed.
    Closed,
    /// The edge of the box.
    EndOfBox,
    /// The most points were reached.
    StepLimit,
    /// The curve was lost.
    NoConvergence,
}

impl CurveEvent {
    /// Its name in tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::ResonantGrazing => "resonant grazing",
            Self::DoubleGrazing => "double grazing",
            Self::DegenerateGrazing => "degenerate grazing",
            Self::Touch => "touch",
            Self::OneToTwo => "1:2",
            Self::Closed => "closed",
            Self::EndOfBox => "end of box",
            Self::StepLimit => "step limit",
            Self::NoConvergence => "no convergence",
        }
    }
}

/// How a curve is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveOptions {
    /// The longest step: phases in radians, speeds, and parameters in quarters of their ranges.
    pub longest: f64,
    /// The most points.
    pub points: u32,
}

impl Default for CurveOptions {
    /// Steps up to 0.05, 20 000 points.
    fn default() -> Self {
        Self { longest: 0.05, points: 20_000 }
    }
}

/// A curve of folds, flips or grazing impacts: an iterator over its points, one way from where it was begun.
#[derive(Clone, Debug)]
pub struct Curve {
    kind: CurveKind,
    /// The grazing impact, on a grazing curve.
    grazing: Option<usize>,
    walk: Walk,
    begin: (Vec<f64>, Vec<f64>),
    options: CurveOptions,
    count: u32,
    pending: VecDeque<CurvePoint>,
    over: bool,
}

impl Curve {
    /// The two ways along the curve through an event of a branch of `osc` in `parameter`: a fold, a flip, a grazing or a
    /// loss of contact. `parameter` need not be one of those of `frame`.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] for another event, [`BranchError::OutOfRange`] if the point lies outside the frame,
    /// [`BranchError::NoCycle`] if no curve is found through it.
    pub fn through(
        osc: &Oscillator,
        point: &Point,
        parameter: Parameter,
        frame: &Frame,
        options: CurveOptions,
    ) -> Result<[Self; 2], BranchError> {
        let osc = parameter.set(osc, point.value).map_err(|_| BranchError::NoCycle)?;
        let mut ring = Ring::of(&osc, &point.cycle).ok_or(BranchError::Rests)?;
        let (kind, grazing) = match point.event {
            Some(BranchEvent::Fold) => (CurveKind::Fold, None),
            Some(BranchEvent::Flip) => (CurveKind::Flip, None),
            Some(BranchEvent::Grazing { change: Change::Disappears, impact, .. }) => (CurveKind::Grazing, Some(impact)),
            Some(BranchEvent::LossOfContact { .. }) => (CurveKind::Grazing, Some(0)),
            Some(BranchEvent::Grazing { change: Change::Appears, side, phase, .. }) if ring.len() == 0 => {
                ring = Ring { sides: vec![side], unknowns: vec![phase, 0.0], periods: 1 };
                (CurveKind::Grazing, Some(0))
            }
            Some(BranchEvent::Grazing { change: Change::Appears, impact, side, phase, .. }) => {
                let ahead = crate::system::phase::wrap(phase - ring.theta(impact));
                // the touch may come more than a turn after the impact: where the mass is nearest
                let touch = crate::orbit::closest(&osc, &ring, impact, side);
                let theta = ring.theta(impact) + touch.map_or(ahead, |touch| osc.beta() * touch.time);
                ring.insert(impact, theta, side);
                (CurveKind::Grazing, Some(impact + 1))
            }
            _ => return Err(BranchError::NotThere),
        };
        let values = (frame.parameters.0.get(&osc), frame.parameters.1.get(&osc));
        let (Some(p), Some(q)) = values else {
            return Err(BranchError::NoSuchParameter(frame.parameters.1.name()));
        };
        if !frame.sensible() || !frame.holds((p, q)) {
            let (low, high) = (*frame.ranges.0.start(), *frame.ranges.0.end());
            return Err(BranchError::OutOfRange { value: p, low, high });
        }
        let condition = match (kind, grazing) {
            (CurveKind::Fold, _) => Condition::PlusOne,
            (CurveKind::Flip, _) => Condition::MinusOne,
            (CurveKind::Grazing, k) => Condition::Speed(k.unwrap_or(0)),
        };
        let plane = Plane::new(&osc, frame.parameters, frame.scales(), &ring, condition);
        let mut watched: Vec<Condition> = frame.edges().to_vec();
        for k in 0..ring.len() {
            if grazing != Some(k) {
                watched.push(Condition::Speed(k));
            }
            watched.extend(osc.stops().map(|(side, _)| Condition::Clear(k, side)));
        }
        if let Some(k) = grazing {
            watched.extend([Condition::Trace, Condition::Pull(k)]);
        }
        let w = Plane::join(&ring, (p, q));
        let forth = Self::begin(kind, grazing, plane.clone(), watched.clone(), &w, 1.0, options);
        let back = Self::begin(kind, grazing, plane, watched, &w, -1.0, options);
        match (forth, back) {
            (Some(forth), Some(back)) => Ok([forth, back]),
            _ => Err(BranchError::NoCycle),
        }
    }

    fn begin(
        kind: CurveKind,
        grazing: Option<usize>,
        plane: Plane,
        watched: Vec<Condition>,
        w: &[f64],
        way: f64,
        options: CurveOptions,
    ) -> Option<Self> {
        let (p, q) = (w.len() - 2, w.len() - 1);
        // along whichever parameter changes the curve's point; first onto the curve itself
        let row = |at: usize| {
            let mut row = vec![0.0; w.len()];
            row[at] = way;
            row
        };
        let rows = [row(p), row(q)];
        let usable = |row: &&Vec<f64>| tangent(&plane, w, row).is_some_and(|t| t.iter().all(|t| t.is_finite()));
        let row = rows.iter().find(usable)?.clone();
        let along = tangent(&plane, w, &row)?;
        let fix = plane.row(&along);
        let level = fix.iter().zip(w).map(|(r, w)| r * w).sum();
        let (w, _) = correct(&plane, w, &fix, level)?;
        let walk = Walk::new(plane, watched, w.clone(), &row, options.longest)?;
        let begin = (w, walk.here.tangent.clone());
        let mut curve = Self { kind, grazing, walk, begin, options, count: 0, pending: VecDeque::new(), over: false };
        let first = curve.point(&curve.walk.here, None)?;
        curve.pending.push_back(first);
        Some(curve)
    }

    /// What holds along it.
    #[must_use]
    pub const fn kind(&self) -> CurveKind {
        self.kind
    }

    fn point(&self, spot: &Spot, event: Option<CurveEvent>) -> Option<CurvePoint> {
        let (osc, ring, flights) = self.walk.plane.flights(&spot.w)?;
        let cycle = ring_cycle(&osc, &ring, &flights);
        let physical = match self.grazing {
            None => Orbit::judged(&osc, cycle.clone()).physical,
            Some(k) => grazes(&self.walk.watched, spot, k),
        };
        Some(CurvePoint { values: Plane::values(&spot.w), cycle, physical, event })
    }

    fn emit(&mut self, spot: &Spot, event: Option<CurveEvent>) {
        if let Some(point) = self.point(spot, event) {
            self.pending.push_back(point);
        }
        self.count += 1;
    }

    fn finish(&mut self, spot: &Spot, event: CurveEvent) {
        self.emit(spot, Some(event));
        self.over = true;
    }

    fn advance(&mut self) {
        let here = self.walk.here.clone();
        if self.count >= self.options.points {
            return self.finish(&here, CurveEvent::StepLimit);
        }
        let Some(Stride { there, length, mut crossed }) = self.walk.stride() else {
            return self.finish(&here, CurveEvent::NoConvergence);
        };
        let course = |spot: &Spot| self.walk.plane.scaled(&spot.tangent);
        let ((p, q), (r, s)) = (course(&here), course(&there));
        if self.kind == CurveKind::Fold && p * r + q * s < 0.0 {
            let f = |at: f64| {
                let spot = self.walk.spot(self.walk.between(&there, at, length)?)?;
                let (r, s) = course(&spot);
                Some(p * r + q * s)
            };
            let ends = ((0.0, p * p + q * q), (length, p * r + q * s));
            match super::root::between(f, ends.0, ends.1, 1e-13) {
                Some(at) => crossed.push((at, usize::MAX)),
                None => return self.finish(&here, CurveEvent::NoConvergence),
            }
            crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        for (at, j) in crossed {
            let Some(spot) = self.walk.between(&there, at, length).and_then(|w| self.walk.spot(w)) else {
                return self.finish(&here, CurveEvent::NoConvergence);
            };
            let event = match self.walk.watched.get(j) {
                None => CurveEvent::Cusp,
                Some(Condition::Line(..)) => {
                    let flat = self.walk.plane.flights(&spot.w).map(|(o, r, f)| Floquet::new(&o, &r, &f).determinant);
                    if self.kind == CurveKind::Flip && flat.is_some_and(|det| (det - 1.0).abs() < 1e-12) {
                        self.emit(&spot, Some(CurveEvent::OneToTwo));
                    }
                    return self.finish(&spot, CurveEvent::EndOfBox);
                }
                Some(Condition::Trace) => CurveEvent::ResonantGrazing,
                Some(Condition::Pull(_)) => CurveEvent::DegenerateGrazing,
                Some(Condition::Speed(_)) if self.kind != CurveKind::Grazing => {
                    return self.finish(&spot, CurveEvent::ResonantGrazing);
                }
                Some(_) if self.kind == CurveKind::Grazing => CurveEvent::DoubleGrazing,
                Some(_) => CurveEvent::Touch,
            };
            self.emit(&spot, Some(event));
        }
        let closed = self.closes(&there);
        self.walk.settle(there.clone());
        self.emit(&there, closed.then_some(CurveEvent::Closed));
        self.over = closed;
    }

    /// Whether the step to `there` passes the beginning.
    fn closes(&self, there: &Spot) -> bool {
        let (w, along) = &self.begin;
        let ahead = |spot: &Spot| {
            let off: Vec<f64> = spot.w.iter().zip(w).map(|(a, b)| a - b).collect();
            (self.walk.plane.dot(&off, along), self.walk.plane.length(&off))
        };
        let ((before, _), (after, away)) = (ahead(&self.walk.here), ahead(there));
        let onwards = self.walk.plane.dot(along, &there.tangent) > 0.5;
        self.count > 3 && before < 0.0 && after >= 0.0 && away < 2.0 * self.options.longest && onwards
    }
}

/// Whether nothing but the impact of speed zero is wrong with the cycle at a point of a grazing curve.
fn grazes(watched: &[Condition], spot: &Spot, _grazing: usize) -> bool {
    watched.iter().zip(&spot.values).all(|(condition, &value)| match condition {
        Condition::Speed(_) | Condition::Pull(_) => value > -1e-9,
        Condition::Clear(_, Side::Upper | Side::Lower) => value > -1e-9,
        _ => true,
    })
}

impl Iterator for Curve {
    type Item = CurvePoint;

    fn next(&mut self) -> Option<CurvePoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}
