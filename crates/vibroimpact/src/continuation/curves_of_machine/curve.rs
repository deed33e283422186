//! Curves of events of machines in a plane of two numbers.

use super::beside::bare;
use super::end::reason;
use super::equations::CurveEquations;
use super::origin::origin;
use super::plane::{MachineCurveError, MachinePlane};
use super::point::{MachineCurveEvent, MachineCurveKind, MachineCurvePoint};
use super::problem::{CurveProblem, CurveSolution, Watched};
use crate::continuation::curves::CurveOptions;
use crate::continuation::equations::plane_tracer::first_step;
use crate::continuation::of_machine::{ADAPTED, Difference, Judged, MachinePoint, difference, edge};
use crate::continuation::trace::equations::{Equations, correct, tangent};
use crate::continuation::trace::tracer::{Step, Tracer};
use crate::orbit::MachineFrame;
use std::collections::VecDeque;

/// A curve of an event of a machine: an iterator over its points in one direction from the point at which it begins.
#[derive(Clone, Debug)]
pub struct MachineCurve {
    tracer: Tracer<CurveProblem>,
    begin: CurveSolution,
    options: CurveOptions,
    count: u32,
    pending: VecDeque<MachineCurvePoint>,
    over: bool,
}

/// A number that changes by less than this along the curve, in quarters of its range over the arclength, changes by
/// rounding.
const SLOWEST: f64 = 1e-9;
/// The distance, in parts of a step, before a limit whose rate is zero at which solutions can be judged inadmissible.
const INEXACT: f64 = 1e-2;
/// A curve with no further step that is closer to an edge of the frame than this, in quarters of the range, ends there.
const AT_EDGE: f64 = 1e-7;

impl MachineCurve {
    /// The two directions along the curve through an event of a branch; `values` are those of both numbers there.
    ///
    /// # Errors
    /// [`MachineCurveError::NotThere`] for an event that begins no curve, [`MachineCurveError::OutOfRange`] if the point lies
    /// outside the frame, [`MachineCurveError::NoCurve`] if no curve is found through it.
    pub fn through(
        plane: &MachinePlane,
        values: (f64, f64),
        point: &MachinePoint,
        options: CurveOptions,
    ) -> Result<[Self; 2], MachineCurveError> {
        let (problem, w) = origin(plane, values, point)?;
        let start = |way| Self::start(problem.clone(), &w, way, options).ok_or(MachineCurveError::NoCurve);
        Ok([start(1.0)?, start(-1.0)?])
    }

    /// The curve through the solution near `w`, in the direction in which a number increases (`way` 1) or decreases (-1).
    fn start(mut problem: CurveProblem, w: &[f64], way: f64, options: CurveOptions) -> Option<Self> {
        let length = w.len();
        let row = |at: usize| {
            let mut row = vec![0.0; length];
            row[at] = way;
            row
        };
        // in the direction in which the curve changes a number most
        let pace = |at: usize| {
            let along = tangent(&problem, w, &row(at))?;
            let (p, q) = problem.equations.course(&along);
            Some(if at == length - 2 { p.abs() } else { q.abs() })
        };
        let (p, q) = (pace(length - 2), pace(length - 1));
        let at = if p.unwrap_or(0.0) > SLOWEST { length - 2 } else { length - 1 };
        (p.unwrap_or(0.0).max(q.unwrap_or(0.0)) > SLOWEST).then_some(())?;
        let along = tangent(&problem, w, &row(at))?;
        let fix = problem.row(&along);
        let level = fix.iter().zip(w).map(|(r, w)| r * w).sum();
        let (w, _) = correct(&problem, w, &fix, level)?;
        problem.renew(&w);
        let along = tangent(&problem, &w, &row(at))?;
        let tracer = Tracer::new(problem, w, along, first_step(options.longest))?;
        let begin = tracer.here.clone();
        let mut curve = Self { tracer, begin, options, count: 1, pending: VecDeque::new(), over: false };
        let first = curve.point(&curve.tracer.here, None)?;
        curve.pending.push_back(first);
        Some(curve)
    }

    /// What holds along the curve.
    #[must_use]
    pub const fn kind(&self) -> MachineCurveKind {
        self.tracer.problem.kind
    }

    /// The point of the curve at a solution. At an event rounding can make it inadmissible, and the cycle of the last point
    /// stands for it.
    fn point(&self, at: &CurveSolution, event: Option<MachineCurveEvent>) -> Option<MachineCurvePoint> {
        let equations = &self.tracer.problem.equations;
        let (machine, ring) = equations.split(&at.w)?;
        let cycle = at.known.cycle.clone().or_else(|| self.tracer.here.known.cycle.clone())?;
        let residual = equations.condition.residual(&MachineFrame::new(&machine), &ring, &at.known.multipliers);
        let touch = equations.condition.touch().map(|at| ring.place(at).phase);
        let touch =
            touch.filter(|_| machine.period().is_some() && matches!(self.kind(), MachineCurveKind::Grazing { .. }));
        Some(MachineCurvePoint { values: CurveEquations::values(&at.w), cycle, residual, touch, event })
    }

    /// Adds a point. An ordinary one with which the largest number is reached ends the curve.
    fn emit(&mut self, at: &CurveSolution, event: Option<MachineCurveEvent>) {
        let last_one = event.is_none() && self.count + 1 >= self.options.points;
        let event = if last_one { Some(MachineCurveEvent::StepLimit) } else { event };
        self.over |= last_one;
        if let Some(point) = self.point(at, event) {
            self.pending.push_back(point);
        }
        self.count += 1;
    }

    fn finish(&mut self, at: &CurveSolution, event: MachineCurveEvent) {
        self.emit(at, Some(event));
        self.over = true;
    }

    /// Takes one step, reports the events on it, or ends the curve.
    fn advance(&mut self) {
        let here = self.tracer.here.clone();
        if self.count >= self.options.points {
            return self.finish(&here, MachineCurveEvent::StepLimit);
        }
        match self.tracer.step() {
            Some(step) => self.go_through(&step),
            None => match self.on_edge(&here, AT_EDGE) {
                Some(edge) => self.finish(&edge, MachineCurveEvent::EndOfBox),
                None => {
                    let event = reason(&self.tracer.problem, &here).unwrap_or(MachineCurveEvent::NoConvergence);
                    self.finish(&here, event);
                }
            },
        }
    }

    fn go_through(&mut self, step: &Step<Judged>) {
        let outside = (!step.there.known.physical()).then(|| edge(&self.tracer, step, step.length, Judged::physical));
        let until = match &outside {
            Some(Some((s, ..))) => *s,
            Some(None) => 0.0,
            None => f64::INFINITY,
        };
        for (s, what) in &step.crossed {
            let Some(what) = what.map(|j| self.tracer.problem.watched[j]) else { continue };
            // close to a limit whose rate is zero, rounding decides on which side of it the motion leaves its rest
            if *s >= until + if what == Watched::Release { INEXACT * step.length } else { 0.0 } {
                continue;
            }
            let Some(at) = self.tracer.between(step, *s).and_then(|w| self.tracer.solution(w)) else { continue };
            match self.tracer.problem.event(what) {
                None => {
                    let edge = self.on_edge(&at, f64::INFINITY).unwrap_or(at);
                    return self.finish(&edge, MachineCurveEvent::EndOfBox);
                }
                // two real multipliers whose product is 1 are no torus bifurcation
                Some(_) if what == Watched::Pair && !circled(&at.known) => {}
                // at a cusp the curve turns back in the plane
                Some(_) if what == Watched::Bending && !self.turns(step) => {}
                Some((event, true)) => return self.finish(&at, event),
                Some((event, false)) => self.emit(&at, Some(event)),
            }
        }
        match outside {
            Some(Some((_, at, beyond))) => {
                let event = self.beyond(&beyond);
                return self.finish(&at, event);
            }
            Some(None) => {
                let here = self.tracer.here.clone();
                return self.finish(&here, MachineCurveEvent::NoConvergence);
            }
            None => {}
        }
        let closed = self.count > 3 && self.tracer.closes(&self.begin, &step.there);
        self.tracer.take(step.there.clone());
        self.emit(&step.there, closed.then_some(MachineCurveEvent::Closed));
        self.over |= closed;
        self.adapt();
    }

    /// Changes the number of impacts of a chatter in the signature to the time that is left after them.
    fn adapt(&mut self) {
        for _ in 0..ADAPTED {
            let Some((problem, w)) = self.tracer.problem.adapted(&self.tracer.here) else { break };
            let way = self.tracer.problem.equations.course(&self.tracer.here.tangent);
            let length = w.len();
            let (at, by) = if way.0.abs() > way.1.abs() { (length - 2, way.0) } else { (length - 1, way.1) };
            let mut row = vec![0.0; length];
            row[at] = by.signum();
            let Some((w, _)) = correct(&problem, &w, &row, by.signum() * w[at]) else { break };
            let step = self.tracer.step;
            let next = tangent(&problem, &w, &row).and_then(|along| Tracer::new(problem, w, along, step));
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
    fn beyond(&self, known: &Judged) -> MachineCurveEvent {
        let equations = &self.tracer.problem.equations;
        let ring = equations.signature();
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
        let grazing = matches!(self.kind(), MachineCurveKind::Grazing { .. });
        let rigid = |stop: usize| {
            let (p, q) = CurveEquations::values(&self.tracer.here.w);
            let machine = self.tracer.problem.equations.plane.at((p, q));
            machine.is_some_and(|machine| CurveProblem::rigid(&machine.stops()[stop].law))
        };
        match found {
            Difference::Appears { stop, .. } | Difference::Disappears { stop, .. } if grazing => {
                MachineCurveEvent::DoubleGrazing { stop }
            }
            Difference::Disappears { stop, .. } if rigid(stop) => MachineCurveEvent::ResonantGrazing { stop },
            Difference::Appears { stop, .. } | Difference::Disappears { stop, .. } => MachineCurveEvent::Touch { stop },
            Difference::Corner { first, second } => MachineCurveEvent::Corner { first, second },
            Difference::Rest { place, .. } => MachineCurveEvent::Rest { place },
            Difference::Other { place } => MachineCurveEvent::Change { place },
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
        let range = if which == 0 { &problem.equations.plane.ranges.0 } else { &problem.equations.plane.ranges.1 };
        let end = if upper { *range.end() } else { *range.start() };
        let mut row = vec![0.0; at.w.len()];
        let column = at.w.len() - 2 + which;
        row[column] = 1.0;
        let (mut w, _) = correct(problem, &at.w, &row, end)?;
        w[column] = end;
        self.tracer.solution(w)
    }
}

/// Whether a pair of complex multipliers lies on the unit circle.
fn circled(known: &Judged) -> bool {
    known.multipliers.iter().any(|m| m.im.abs() > 1e-6 && (m.modulus() - 1.0).abs() < 1e-6)
}

impl Iterator for MachineCurve {
    type Item = MachineCurvePoint;

    fn next(&mut self) -> Option<MachineCurvePoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}
