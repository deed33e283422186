//! Curves of folds, flips and grazing impacts in a plane of two parameters, and the points of codimension two on them.

use super::end::{Trail, reason};
use super::event::{CurveEvent, CurveKind};
use super::frame::{Frame, check};
use super::point::{CurveOptions, CurvePoint};
use crate::continuation::branches::{BranchError, SolutionPoint};
use crate::continuation::equations::plane_equations::{Condition, Plane};
use crate::continuation::equations::plane_tracer::{PlaneProblem, PlaneSolution, PlaneTracer, beginning};
use crate::continuation::event::{BranchEvent, EventDetail};
use crate::continuation::trace::driver::{Driver, Path, PathEvent};
use crate::continuation::trace::equations::correct;
use crate::continuation::trace::tracer::Step;
use crate::math::root;
use crate::math::{Multiplier, hypot, sort_by};
use crate::orbit::{Floquet, Orbit, Ring, ring_cycle};
use crate::system::{Oscillator, ParameterPath, Side, SystemError};

/// A curve of folds, flips or grazing impacts: an iterator over its points in one direction from the point at which it
/// begins.
#[derive(Clone, Debug)]
pub struct Curve(ConditionCurve);

/// What a curve keeps beside its tracer.
#[derive(Clone, Debug)]
struct ConditionPath {
    kind: CurveKind,
    /// The index of the grazing impact, on a grazing curve.
    grazing: Option<usize>,
    trail: Trail,
}

type ConditionCurve = Driver<ConditionPath>;

impl PathEvent for CurveEvent {
    const CLOSED: Self = Self::Closed;
    const STEP_LIMIT: Self = Self::StepLimit;
    const NO_CONVERGENCE: Self = Self::NoConvergence;
}

impl Path for ConditionPath {
    type Problem = PlaneProblem;
    type Event = CurveEvent;
    type Point = CurvePoint;

    const EXACT: bool = false;

    fn point(curve: &ConditionCurve, at: &PlaneSolution, event: Option<CurveEvent>) -> Option<CurvePoint> {
        let PlaneProblem { plane, watched } = &curve.tracer.problem;
        let (osc, ring, flights) = plane.flights(&at.w)?;
        let mut cycle = ring_cycle(&osc, &ring, &flights);
        let grazing = curve.path.grazing.is_some();
        if grazing {
            // the derivative is proportional to the inverse of the speed, so it does not exist at speed zero
            cycle.multipliers = [Multiplier { re: f64::NAN, im: f64::NAN }; 2];
        }
        // at an event or a grazing impact, the limit of admissible solutions counts as admissible
        let limit = grazing || event.is_some();
        let physical = if limit { grazes(watched, at) } else { Orbit::judged(&osc, cycle.clone()).physical };
        Some(CurvePoint { values: Plane::values(&at.w), cycle, physical, event })
    }

    fn go_through(curve: &mut ConditionCurve, step: Step<()>) {
        curve.go_through(step);
    }

    fn stop(curve: &mut ConditionCurve) {
        if let Some(edge) = curve.on_edge() {
            return curve.end_of_box(&edge);
        }
        match reason(&curve.tracer, curve.path.kind, &curve.path.trail) {
            Some((at, event)) => curve.end(&at, event),
            None => curve.finish(CurveEvent::NoConvergence),
        }
    }
}

impl Curve {
    /// The two directions along the curve through an event of a branch of `osc` in `parameter`: a fold, a flip, a
    /// grazing event or a loss of contact. `parameter` need not be one of those of `frame`. The plane of a family must
    /// have been given at the event.
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
        let (osc, (p, q)) = frame.plane.on_line(osc, &parameter.into(), point.value).map_err(|error| match error {
            SystemError::NoSecondStop(name) => BranchError::NoSuchParameter(name),
            _ => BranchError::NoCycle,
        })?;
        let mut ring = Ring::of(&osc, &point.cycle).ok_or(BranchError::Rests)?;
        let condition = match point.event {
            Some(BranchEvent::Fold) => Condition::PlusOne,
            Some(BranchEvent::Flip) => Condition::MinusOne,
            Some(BranchEvent::LossOfContact { .. }) => Condition::Speed(0),
            Some(BranchEvent::Grazing {
                stop,
                appears: true,
                detail: Some(EventDetail { impact: None, phase, .. }),
                ..
            }) => {
                ring = Ring { sides: vec![Side::at(stop)], unknowns: vec![phase, 0.0], periods: 1 };
                Condition::Speed(0)
            }
            Some(BranchEvent::Grazing { appears: false, detail, .. }) => {
                Condition::Speed(detail.and_then(|detail| detail.impact).unwrap_or(0))
            }
            Some(BranchEvent::Grazing {
                stop, detail: Some(EventDetail { impact: Some(impact), phase, .. }), ..
            }) => {
                let side = Side::at(stop);
                let ahead = crate::system::phase::wrap(phase - ring.theta(impact));
                // the grazing contact can be more than one forcing period after the impact: it is where the mass is
                // closest to the stop
                let touch = crate::orbit::closest(&osc, &ring, impact, side);
                let theta = ring.theta(impact) + touch.map_or(ahead, |touch| osc.beta() * touch.time);
                ring.insert(impact, theta, side);
                Condition::Speed(impact + 1)
            }
            _ => return Err(BranchError::NotThere),
        };
        check(&frame.ranges, (p, q))?;
        let (kind, grazing) = match condition {
            Condition::Speed(k) => (CurveKind::Grazing { stop: ring.side(k).place() }, Some(k)),
            Condition::MinusOne => (CurveKind::Flip, None),
            _ => (CurveKind::Fold, None),
        };
        let plane = Plane::new(&osc, frame.plane.clone(), frame.scales(), &ring, condition);
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
        let begin = |way| {
            let (w, row) = beginning(&plane, &w, way)?;
            let tracer = PlaneTracer::along(plane.clone(), watched.clone(), w, &row, options.longest)?;
            Driver::new(ConditionPath { kind, grazing, trail: Trail::default() }, tracer, options.points).map(Self)
        };
        begin(1.0).zip(begin(-1.0)).map(|(forth, back)| [forth, back]).ok_or(BranchError::NoCycle)
    }

    /// The kind of the curve.
    #[must_use]
    pub const fn kind(&self) -> CurveKind {
        self.0.path.kind
    }
}

impl Iterator for Curve {
    type Item = CurvePoint;

    fn next(&mut self) -> Option<CurvePoint> {
        self.0.next()
    }
}

impl ConditionCurve {
    /// Reports the events on a step, up to one that ends the curve.
    fn go_through(&mut self, mut step: Step<()>) {
        let kind = self.path.kind;
        if kind == CurveKind::Fold && self.turns(&step) {
            let Some(at) = self.cusp(&step) else { return self.finish(CurveEvent::NoConvergence) };
            step.crossed.push((at, None));
            sort_by(&mut step.crossed, |a, b| a.0.total_cmp(&b.0));
        }
        for &(at, what) in &step.crossed {
            let Some(spot) = self.tracer.at(&step, at) else {
                return self.finish(CurveEvent::NoConvergence);
            };
            let Some(condition) = what.map(|j| self.tracer.problem.watched[j]) else {
                self.add(&spot, Some(CurveEvent::Cusp));
                continue;
            };
            let event = match (condition, self.stop_of(condition)) {
                (Condition::Line(..), _) => return self.end_of_box(&spot),
                (Condition::Trace, stop) => CurveEvent::ResonantGrazing { stop },
                (Condition::Pull(_), stop) => CurveEvent::DegenerateGrazing { stop },
                (_, stop) if self.path.grazing.is_some() => CurveEvent::DoubleGrazing { stop },
                (Condition::Speed(_), stop) => return self.end(&spot, CurveEvent::ResonantGrazing { stop }),
                (_, stop) => CurveEvent::Touch { stop },
            };
            self.add(&spot, Some(event));
        }
        self.take(step.there);
        if kind == CurveKind::Fold {
            self.path.trail.pass(&self.tracer);
        }
    }

    /// The place of the stop of a condition; that of the grazing impact if the condition has no other.
    fn stop_of(&self, condition: Condition) -> usize {
        let side = match condition {
            Condition::Clear(_, side) => side,
            Condition::Speed(k) | Condition::Pull(k) => self.tracer.problem.plane.sides[k],
            _ => self.path.grazing.map_or(Side::Upper, |k| self.tracer.problem.plane.sides[k]),
        };
        side.place()
    }

    /// The direction of the curve in the plane, in quarters of the ranges.
    fn course(&self, at: &PlaneSolution) -> (f64, f64) {
        self.tracer.problem.plane.scaled(&at.tangent)
    }

    /// Whether the curve turns back in the plane on a step. Where only the speeds still change, rounding changes its
    /// direction in the plane.
    fn turns(&self, step: &Step<()>) -> bool {
        let ((p, q), (r, s)) = (self.course(&self.tracer.here), self.course(&step.there));
        p * r + q * s < 0.0 && hypot(p, q).max(hypot(r, s)) > STILL
    }

    /// The distance along a step at which the curve turns back.
    fn cusp(&self, step: &Step<()>) -> Option<f64> {
        let (p, q) = self.course(&self.tracer.here);
        let along = |(r, s): (f64, f64)| p * r + q * s;
        let at = |s: f64| Some(along(self.course(&self.tracer.at(step, s)?)));
        root::between(at, (0.0, along((p, q))), (step.length, along(self.course(&step.there))), 1e-13)
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
            // exactly on the edge
            let at = if a == 0.0 { (q, c / b) } else { (p, c / a) };
            w[at.0] = at.1;
            self.tracer.solution(w)
        })
    }

    /// Ends the curve on an edge of the frame.
    fn end_of_box(&mut self, spot: &PlaneSolution) {
        let turn = self.tracer.problem.plane.flights(&spot.w).map(|(o, r, f)| Floquet::new(&o, &r, &f).determinant);
        // with a determinant of 1 the other multiplier is -1 as well
        if self.path.kind == CurveKind::Flip && turn.is_some_and(|det| (det - 1.0).abs() < 1e-12) {
            self.add(spot, Some(CurveEvent::OneToTwo));
        }
        self.end(spot, CurveEvent::EndOfBox);
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
/// If the parameters change by less than this over the arclength, their direction is not used.
const STILL: f64 = 1e-4;
