//! Curves of folds, flips and grazing impacts in a plane of two parameters, and the points of codimension two on them.

use super::end::{Trail, reason};
use super::frame::Frame;
use super::point::{CurveEvent, CurveKind, CurveOptions, CurvePoint};
use crate::continuation::branches::{BranchError, BranchEvent, Change, SolutionPoint};
use crate::continuation::equations::plane_equations::{Condition, Plane};
use crate::continuation::equations::plane_tracer::{PlaneSolution, PlaneTracer};
use crate::continuation::trace::equations::{Equations, correct, tangent};
use crate::continuation::trace::root;
use crate::math::{Multiplier, hypot, sort_by};
use crate::orbit::{Floquet, Orbit, Ring, ring_cycle};
use crate::system::{Oscillator, ParameterPath, Side, SystemError};
use std::collections::VecDeque;

/// A curve of folds, flips or grazing impacts: an iterator over its points in one direction from the point at which it
/// begins.
#[derive(Clone, Debug)]
pub struct Curve {
    kind: CurveKind,
    /// The index of the grazing impact, on a grazing curve.
    grazing: Option<usize>,
    tracer: PlaneTracer,
    begin: PlaneSolution,
    options: CurveOptions,
    count: u32,
    pending: VecDeque<CurvePoint>,
    over: bool,
    trail: Trail,
}

impl Curve {
    /// The two directions along the curve through an event of a branch of `osc` in `parameter`: a fold, a flip, a
    /// grazing event or a loss of contact. `parameter` need not be one of those of `frame`. In a plane of machines it is
    /// the line of that machine along which the branch was followed.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] for another event, [`BranchError::OutOfRange`] if the point lies outside the frame,
    /// [`BranchError::NoCycle`] if no curve is found through it.
    pub fn through(
        osc: &Oscillator,
        point: &SolutionPoint,
        parameter: impl Into<ParameterPath>,
        frame: &Frame,
        options: CurveOptions,
    ) -> Result<[Self; 2], BranchError> {
        let (osc, (p, q)) = frame.plane.on_line(osc, parameter.into(), point.value).map_err(|error| match error {
            SystemError::NoSecondStop(name) => BranchError::NoSuchParameter(name),
            _ => BranchError::NoCycle,
        })?;
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
                // the grazing contact can be more than one forcing period after the impact: it is where the mass is
                // closest to the stop
                let touch = crate::orbit::closest(&osc, &ring, impact, side);
                let theta = ring.theta(impact) + touch.map_or(ahead, |touch| osc.beta() * touch.time);
                ring.insert(impact, theta, side);
                (CurveKind::Grazing, Some(impact + 1))
            }
            _ => return Err(BranchError::NotThere),
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
        let plane = Plane::new(&osc, frame.plane, frame.scales(), &ring, condition);
        let mut watched: Vec<Condition> = frame.edges().to_vec();
        for k in 0..ring.len() {
            if grazing != Some(k) {
                watched.push(Condition::Speed(k));
            }
            // one impact of speed zero in n periods is the motion without impacts, whose other maxima are the same
            // contact
            let itself = |side: Side| grazing.is_some() && ring.len() == 1 && side == ring.side(k);
            watched.extend(osc.stops().filter(|(s, _)| !itself(*s)).map(|(side, _)| Condition::Clear(k, side)));
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

    /// The curve through the solution near `w`, in the direction in which a parameter increases (`way` 1) or decreases
    /// (-1).
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
        // in the direction in which a parameter changes along the curve, after a correction onto the curve itself
        let row = |at: usize| {
            let mut row = vec![0.0; w.len()];
            row[at] = way;
            row
        };
        let rows = [row(p), row(q)];
        // a parameter that changes only by rounding determines no direction
        let pace = |row: &Vec<f64>| tangent(&plane, w, row).map(|t| plane.pace(&t, row));
        let usable =
            |least: f64| rows.iter().find(|row| pace(row).is_some_and(|pace| pace > least && pace.is_finite()));
        let row = usable(SLOWEST).or_else(|| usable(0.0))?.clone();
        let along = tangent(&plane, w, &row)?;
        let fix = plane.row(&along);
        let level = fix.iter().zip(w).map(|(r, w)| r * w).sum();
        let (w, _) = correct(&plane, w, &fix, level)?;
        let tracer = PlaneTracer::along(plane, watched, w, &row, options.longest)?;
        let begin = tracer.here.clone();
        let mut curve = Self {
            kind,
            grazing,
            tracer,
            begin,
            options,
            count: 0,
            pending: VecDeque::new(),
            over: false,
            trail: Trail::default(),
        };
        let first = curve.point(&curve.tracer.here, None)?;
        curve.pending.push_back(first);
        Some(curve)
    }

    /// The kind of the curve.
    #[must_use]
    pub const fn kind(&self) -> CurveKind {
        self.kind
    }

    /// The point of the curve at a solution.
    fn point(&self, spot: &PlaneSolution, event: Option<CurveEvent>) -> Option<CurvePoint> {
        let (osc, ring, flights) = self.tracer.problem.plane.flights(&spot.w)?;
        let mut cycle = ring_cycle(&osc, &ring, &flights);
        if self.grazing.is_some() {
            // the derivative is proportional to the inverse of the speed, so it does not exist at speed zero
            cycle.multipliers = [Multiplier { re: f64::NAN, im: f64::NAN }; 2];
        }
        let physical = match self.grazing {
            // at an event or a grazing impact, the limit of admissible solutions counts as admissible
            None if event.is_none() => Orbit::judged(&osc, cycle.clone()).physical,
            _ => grazes(&self.tracer.problem.watched, spot),
        };
        Some(CurvePoint { values: Plane::values(&spot.w), cycle, physical, event })
    }

    fn emit(&mut self, spot: &PlaneSolution, event: Option<CurveEvent>) {
        if let Some(point) = self.point(spot, event) {
            self.pending.push_back(point);
        }
        self.count += 1;
    }

    fn finish(&mut self, spot: &PlaneSolution, event: CurveEvent) {
        self.emit(spot, Some(event));
        self.over = true;
    }

    /// Takes one step, reports the events on it, or ends the curve.
    fn advance(&mut self) {
        let here = self.tracer.here.clone();
        if self.count >= self.options.points {
            return self.finish(&here, CurveEvent::StepLimit);
        }
        let Some(mut step) = self.tracer.step() else {
            if let Some(edge) = self.on_edge() {
                return self.end_of_box(&edge);
            }
            let (spot, event) =
                reason(&self.tracer, self.kind, &self.trail).unwrap_or((here, CurveEvent::NoConvergence));
            return self.finish(&spot, event);
        };
        let course = |spot: &PlaneSolution| self.tracer.problem.plane.scaled(&spot.tangent);
        let ((p, q), (r, s)) = (course(&here), course(&step.there));
        // where only the speeds still change, rounding changes the direction in the plane
        let moves = hypot(p, q).max(hypot(r, s)) > STILL;
        if self.kind == CurveKind::Fold && p * r + q * s < 0.0 && moves {
            let f = |at: f64| {
                let (r, s) = course(&self.tracer.solution(self.tracer.between(&step, at)?)?);
                Some(p * r + q * s)
            };
            let ends = ((0.0, p * p + q * q), (step.length, p * r + q * s));
            match root::between(f, ends.0, ends.1, 1e-13) {
                Some(at) => step.crossed.push((at, None)),
                None => return self.finish(&here, CurveEvent::NoConvergence),
            }
            sort_by(&mut step.crossed, |a, b| a.0.total_cmp(&b.0));
        }
        for &(at, what) in &step.crossed {
            let Some(spot) = self.tracer.between(&step, at).and_then(|w| self.tracer.solution(w)) else {
                return self.finish(&here, CurveEvent::NoConvergence);
            };
            let event = match what.map(|j| self.tracer.problem.watched[j]) {
                None => CurveEvent::Cusp,
                Some(Condition::Line(..)) => return self.end_of_box(&spot),
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
        let there = step.there;
        let closed = self.count > 3 && self.tracer.closes(&self.begin, &there);
        self.tracer.take(there.clone());
        if self.kind == CurveKind::Fold {
            self.trail.pass(&self.tracer);
        }
        self.emit(&there, closed.then_some(CurveEvent::Closed));
        self.over = closed;
    }

    /// The point on an edge of the frame, if the curve has come close to it. Beyond the edge the parameters can be
    /// invalid, so no step succeeds there.
    fn on_edge(&self) -> Option<PlaneSolution> {
        let here = &self.tracer.here;
        let edges = self.tracer.problem.watched.iter().zip(&here.values);
        let near = |(condition, value): (&Condition, &f64)| match condition {
            Condition::Line(a, b, c) if value.abs() < AT_EDGE => Some((*a, *b, *c)),
            _ => None,
        };
        edges.filter_map(near).find_map(|(a, b, c)| {
            let mut row = vec![0.0; here.w.len()];
            let (p, q) = (row.len() - 2, row.len() - 1);
            (row[p], row[q]) = (a, b);
            let (mut w, _) = correct(&self.tracer.problem.plane, &here.w, &row, c)?;
            let at = if a == 0.0 { (q, c / b) } else { (p, c / a) };
            w[at.0] = at.1;
            self.tracer.solution(w)
        })
    }

    /// Ends the curve on an edge of the frame.
    fn end_of_box(&mut self, spot: &PlaneSolution) {
        let turn = self.tracer.problem.plane.flights(&spot.w).map(|(o, r, f)| Floquet::new(&o, &r, &f).determinant);
        if self.kind == CurveKind::Flip && turn.is_some_and(|det| (det - 1.0).abs() < 1e-12) {
            self.emit(spot, Some(CurveEvent::OneToTwo));
        }
        self.finish(spot, CurveEvent::EndOfBox);
    }
}

/// Whether the cycle at a point of a curve is admissible, if impacts of speed zero and grazing contacts are permitted.
fn grazes(watched: &[Condition], spot: &PlaneSolution) -> bool {
    watched.iter().zip(&spot.values).all(|(condition, &value)| match condition {
        Condition::Speed(_) | Condition::Pull(_) => value > -1e-9,
        Condition::Clear(_, Side::Upper | Side::Lower) => value > -1e-9,
        _ => true,
    })
}

/// A curve with no further step that is closer to an edge of the frame than this ends at the edge.
const AT_EDGE: f64 = 1e-8;
/// A parameter that changes by less than this along the curve, in quarters of its range over the arclength, changes by
/// rounding.
const SLOWEST: f64 = 1e-9;
/// If the parameters change by less than this over the arclength, their direction is not used.
const STILL: f64 = 1e-4;

impl Iterator for Curve {
    type Item = CurvePoint;

    fn next(&mut self) -> Option<CurvePoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}
