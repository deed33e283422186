//! Curves of events of machines in a plane of two numbers.

use super::beside::bare;
use super::end::reason;
use super::equations::CurveEquations;
use super::origin::origin;
use super::plane::Plane;
use super::point::CurvePoint;
use super::problem::{CurveProblem, CurveSolution, Watched};
use crate::continuation::branches::BranchError;
use crate::continuation::curves::{CurveEvent, CurveKind, CurveOptions};
use crate::continuation::equations::plane_tracer::{beginning, first_step};
use crate::continuation::machine::branches::{
    ADAPTED, Difference, Judged, MachineEquations, SolutionPoint, difference, edge,
};
use crate::continuation::trace::driver::{Driver, Path};
use crate::continuation::trace::equations::{correct, tangent, unit};
use crate::continuation::trace::tracer::{Step, Tracer};
use crate::orbit::MachineFrame;

/// A curve by the equations of the machine.
#[derive(Clone, Debug)]
pub(crate) struct UnreducedCurve(EventCurve);

/// A curve keeps nothing beside its tracer.
#[derive(Clone, Debug)]
struct EventPath;

type EventCurve = Driver<EventPath>;

/// The distance, in parts of a step, before a limit whose rate is zero at which solutions can be judged inadmissible.
const INEXACT: f64 = 1e-2;
/// A curve with no further step that is closer to an edge of the frame than this, in quarters of the range, ends there.
const AT_EDGE: f64 = 1e-7;

impl Path for EventPath {
    type Problem = CurveProblem;
    type Event = CurveEvent;
    type Point = CurvePoint;

    const EXACT: bool = true;

    /// At an event rounding can make a solution inadmissible: the cycle of the last point stands for it.
    fn point(curve: &EventCurve, at: &CurveSolution, event: Option<CurveEvent>) -> Option<CurvePoint> {
        let CurveProblem { equations, kind, .. } = &curve.tracer.problem;
        let (machine, ring) = equations.split(&at.w)?;
        let cycle = at.known.cycle.clone().or_else(|| curve.tracer.here.known.cycle.clone())?;
        let residual = equations.condition.residual(&MachineFrame::new(&machine), &ring, &at.known.multipliers);
        let touch = equations.condition.touch().map(|at| ring.place(at).phase);
        let touch = touch.filter(|_| machine.period().is_some() && matches!(kind, CurveKind::Grazing { .. }));
        Some(CurvePoint { values: CurveEquations::values(&at.w), cycle, residual, touch, event })
    }

    fn go_through(curve: &mut EventCurve, step: Step<Judged>) {
        curve.go_through(step);
    }

    fn stop(curve: &mut EventCurve) {
        let here = &curve.tracer.here;
        match curve.on_edge(here, AT_EDGE) {
            Some(edge) => curve.end(&edge, CurveEvent::EndOfBox),
            None => {
                let event = reason(&curve.tracer.problem, here).unwrap_or(CurveEvent::NoConvergence);
                curve.finish(event);
            }
        }
    }
}

impl UnreducedCurve {
    /// The two directions along the curve through an event of a branch; `values` are those of both numbers there.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] for an event that begins no curve, [`BranchError::OutOfRange`] if the point lies outside the
    /// frame, [`BranchError::NoCycle`] if no curve is found through it.
    pub(crate) fn through(
        plane: &Plane,
        values: (f64, f64),
        point: &SolutionPoint,
        options: CurveOptions,
    ) -> Result<[Self; 2], BranchError> {
        let (problem, w) = origin(plane, values, point)?;
        let begin = |way| {
            let (w, row) = beginning(&problem.equations, &w, way)?;
            let mut problem = problem.clone();
            problem.renew(&w);
            let along = tangent(&problem.equations, &w, &row)?;
            let tracer = Tracer::new(problem, w, along, first_step(options.longest))?;
            Driver::new(EventPath, tracer, options.points).map(Self)
        };
        begin(1.0).zip(begin(-1.0)).map(|(forth, back)| [forth, back]).ok_or(BranchError::NoCycle)
    }

    /// What holds along the curve.
    #[must_use]
    pub(crate) const fn kind(&self) -> CurveKind {
        self.0.tracer.problem.kind
    }
}

impl Iterator for UnreducedCurve {
    type Item = CurvePoint;

    fn next(&mut self) -> Option<CurvePoint> {
        self.0.next()
    }
}

impl EventCurve {
    /// Reports the events on a step, up to one that ends the curve.
    fn go_through(&mut self, step: Step<Judged>) {
        let outside = (!step.there.known.physical()).then(|| edge(&self.tracer, &step, step.length, Judged::physical));
        let until = match &outside {
            Some(Some((s, ..))) => *s,
            // not even the edge was found: nothing on the step counts
            Some(None) => 0.0,
            None => f64::INFINITY,
        };
        for (s, what) in &step.crossed {
            let Some(what) = what.map(|j| self.tracer.problem.watched[j]) else { continue };
            // close to a limit whose rate is zero, rounding decides on which side of it the motion leaves its rest
            if *s >= until + if what == Watched::Release { INEXACT * step.length } else { 0.0 } {
                continue;
            }
            let Some(at) = self.tracer.at(&step, *s) else { continue };
            match self.tracer.problem.event(what) {
                None => {
                    let edge = self.on_edge(&at, f64::INFINITY).unwrap_or(at);
                    return self.end(&edge, CurveEvent::EndOfBox);
                }
                // two real multipliers with the product 1 are no bifurcation
                Some(_) if what == Watched::Pair && !at.known.multipliers.iter().any(|m| m.is_on_circle()) => {}
                // at a cusp the curve turns back in the plane
                Some(_) if what == Watched::Bending && !self.turns(&step) => {}
                Some((event, true)) => return self.end(&at, event),
                Some((event, false)) => self.add(&at, Some(event)),
            }
        }
        match outside {
            Some(Some((_, at, beyond))) => self.end(&at, self.beyond(&beyond)),
            Some(None) => self.finish(CurveEvent::NoConvergence),
            None => {
                self.take(step.there);
                self.adapt();
            }
        }
    }

    /// Changes the number of impacts of a chatter in the signature to the time that is left after them.
    fn adapt(&mut self) {
        for _ in 0..ADAPTED {
            let Some((problem, w)) = self.tracer.problem.adapted(&self.tracer.here) else { break };
            let way = self.tracer.problem.equations.course(&self.tracer.here.tangent);
            let length = w.len();
            // the number that changes more is held while the other events are solved anew
            let (at, by) = if way.0.abs() > way.1.abs() { (length - 2, way.0) } else { (length - 1, way.1) };
            let row = unit(length, at, by.signum());
            let Some((w, _)) = correct(&problem.equations, &w, &row, by.signum() * w[at]) else { break };
            let step = self.tracer.step;
            let next = tangent(&problem.equations, &w, &row).and_then(|along| Tracer::new(problem, w, along, step));
            let Some(tracer) = next.filter(|tracer| tracer.here.known.physical()) else { break };
            self.tracer = tracer;
        }
    }

    /// Whether the two numbers change in opposite directions at both ends of a step.
    fn turns(&self, step: &Step<Judged>) -> bool {
        let course = |at: &CurveSolution| self.tracer.problem.equations.course(&at.tangent);
        let ((p, q), (r, s)) = (course(&self.tracer.here), course(&step.there));
        p * r + q * s < 0.0
    }

    /// Why solutions are not admissible beyond.
    fn beyond(&self, known: &Judged) -> CurveEvent {
        let equations = &self.tracer.problem.equations;
        let ring = &equations.events.ring;
        let moments = equations
            .split(&self.tracer.here.w)
            .map_or_else(Vec::new, |(machine, ring)| equations.condition.moments(&MachineFrame::new(&machine), &ring));
        let stops = ring.events.first().map_or(0, |event| event.back.len());
        let seen = known.seen.first().map(|event| event.guard.place(stops));
        let found = if moments.is_empty() {
            difference(ring, known)
        } else {
            match bare(ring, &moments) {
                Some(bare) => difference(&bare, &Judged { rising: None, ..known.clone() }),
                None => seen
                    .filter(|stop| *stop < stops)
                    .map_or(Difference::Other { place: None }, |stop| Difference::Appears { at: 0, stop }),
            }
        };
        let grazing = matches!(self.tracer.problem.kind, CurveKind::Grazing { .. });
        let rigid = |stop: usize| {
            let machine = equations.events.family.machine(MachineEquations::numbers(&self.tracer.here.w));
            machine.is_some_and(|machine| CurveProblem::rigid(&machine.stops()[stop].law))
        };
        match found {
            Difference::Appears { stop, .. } | Difference::Disappears { stop, .. } if grazing => {
                CurveEvent::DoubleGrazing { stop }
            }
            Difference::Disappears { stop, .. } if rigid(stop) => CurveEvent::ResonantGrazing { stop },
            Difference::Appears { stop, .. } | Difference::Disappears { stop, .. } => CurveEvent::Touch { stop },
            Difference::Corner { first, second } => CurveEvent::Corner { first, second },
            Difference::Rest { place, .. } => CurveEvent::Rest { place },
            Difference::Other { place } => CurveEvent::Change { place },
        }
    }

    /// The point on an edge of the frame near a solution that is closer to it than `near`, or beyond. The number is exactly
    /// that of the edge.
    fn on_edge(&self, at: &CurveSolution, near: f64) -> Option<CurveSolution> {
        let problem = &self.tracer.problem;
        let edges = problem.watched.iter().zip(&at.values);
        let closest = edges
            .filter_map(
                |(what, value)| {
                    if let Watched::Edge(which, upper) = what { Some((*which, *upper, *value)) } else { None }
                },
            )
            .min_by(|a, b| a.2.total_cmp(&b.2))
            .filter(|(.., value)| *value < near);
        let (which, upper, _) = closest?;
        let ranges = &problem.equations.ranges;
        let range = if which == 0 { &ranges.0 } else { &ranges.1 };
        let end = if upper { *range.end() } else { *range.start() };
        let column = at.w.len() - 2 + which;
        let row = unit(at.w.len(), column, 1.0);
        // the solution is there within the resolution of zeros, and rounding errors of its unknowns can be larger than what ends a correction
        let located = || ((at.w[column] - end).abs() <= EDGE * end.abs().max(f64::MIN_POSITIVE)).then(|| at.w.clone());
        let mut w = correct(&problem.equations, &at.w, &row, end).map(|(w, _)| w).or_else(located)?;
        // the correction leaves it within rounding
        w[column] = end;
        self.tracer.solution(w)
    }
}

/// A number is at the end of its range if it differs from it by less, relative to it.
const EDGE: f64 = 1e-8;
