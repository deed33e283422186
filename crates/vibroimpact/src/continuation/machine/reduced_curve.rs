//! Curves of events of machines: folds and flips of a machine that is an oscillator are those of the oscillator, in the numbers
//! of the machine.
//!
//! Curves of grazing are those of the machine's own equations, along which the multipliers of the cycle without the contact have
//! zeros of their own. Where these equations find no cycle, as of the motion without impacts, they are those of the oscillator.

use super::branches::SolutionPoint;
use super::curves::{CurvePoint, Plane, UnreducedCurve};
use super::reduced_branch::oscillator;
use crate::continuation::branches;
use crate::continuation::branches::BranchError;
use crate::continuation::curves;
use crate::continuation::curves::{CurveEvent, CurveKind, CurveOptions};
use crate::continuation::event::{BranchEvent, EventDetail};
use crate::math::hypot;
use crate::motion::ImpactState;
use crate::orbit;
use crate::orbit::{Count, Label, Ring, blocks, closest, crest, machine::Cycle, ring_cycle};
use crate::system::{Oscillator, OscillatorFamily, Side, phase};

/// A curve of an event of a machine: an iterator over its points in one direction from the point at which it begins.
#[derive(Clone, Debug)]
pub struct Curve(Method);

#[derive(Clone, Debug)]
enum Method {
    Reduced(Box<ReducedCurve>),
    Unreduced(Box<UnreducedCurve>),
}

impl Curve {
    /// The two directions along the curve through an event of a branch; `values` are those of both numbers there.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] for an event that begins no curve, [`BranchError::OutOfRange`] if the point lies outside the
    /// frame, [`BranchError::NoCycle`] if no curve is found through it.
    pub fn through(
        plane: &Plane,
        values: (f64, f64),
        point: &SolutionPoint,
        options: CurveOptions,
    ) -> Result<[Self; 2], BranchError> {
        let reduced = || {
            let both = ReducedCurve::through(plane, values, point, options)?;
            Some(both.map(|curve| Self(Method::Reduced(Box::new(curve)))))
        };
        if matches!(point.event, Some(BranchEvent::Fold | BranchEvent::Flip))
            && let Some(both) = reduced()
        {
            return Ok(both);
        }
        Self::unreduced(plane, values, point, options).or_else(|error| reduced().ok_or(error))
    }

    /// The same, with a machine that is an oscillator followed as any other.
    ///
    /// # Errors
    /// As [`through`](Self::through).
    pub fn unreduced(
        plane: &Plane,
        values: (f64, f64),
        point: &SolutionPoint,
        options: CurveOptions,
    ) -> Result<[Self; 2], BranchError> {
        let both = UnreducedCurve::through(plane, values, point, options)?;
        Ok(both.map(|curve| Self(Method::Unreduced(Box::new(curve)))))
    }

    /// What holds along the curve.
    #[must_use]
    pub const fn kind(&self) -> CurveKind {
        match &self.0 {
            Method::Reduced(curve) => curve.curve.kind(),
            Method::Unreduced(curve) => curve.kind(),
        }
    }
}

impl Iterator for Curve {
    type Item = CurvePoint;

    fn next(&mut self) -> Option<CurvePoint> {
        match &mut self.0 {
            Method::Reduced(curve) => curve.next(),
            Method::Unreduced(curve) => curve.next(),
        }
    }
}

/// A curve of the oscillator that a machine is, as far as its cycles are admissible.
#[derive(Clone, Debug)]
struct ReducedCurve {
    curve: curves::Curve,
    plane: Plane,
    stops: usize,
    left: u32,
    last: Option<CurvePoint>,
}

impl ReducedCurve {
    /// `None` for another event, if the machine is no oscillator somewhere in the frame, or if no curve is found.
    fn through(plane: &Plane, values: (f64, f64), point: &SolutionPoint, options: CurveOptions) -> Option<[Self; 2]> {
        let (osc, frame) = plane.reduced(values)?;
        let reduction = plane.family.reduction(values.into())?;
        let cycle = point.cycle.to_oscillator(&reduction)?;
        let event = match point.event? {
            event @ (BranchEvent::Fold | BranchEvent::Flip) => event,
            BranchEvent::Grazing { stop, appears: true, .. } => appearing(&osc, &cycle, reduction.side(stop)?)?,
            BranchEvent::Grazing { stop, .. } | BranchEvent::LossOfContact { stop, .. } => {
                disappearing(&cycle, reduction.side(stop)?)?
            }
            _ => return None,
        };
        let there = branches::SolutionPoint { value: values.0, cycle, physical: true, event: Some(event) };
        // the line to the event, along the first number
        let (family, second) = (plane.family.clone(), values.1);
        let line = OscillatorFamily::new(move |[first]| oscillator(&family, [first, second]), [values.0]);
        let both = curves::Curve::through(&osc, &there, line, &frame, options).ok()?;
        let stops = point.cycle.counts.len();
        Some(both.map(|curve| Self { curve, plane: plane.clone(), stops, left: options.points, last: None }))
    }

    fn converted(&self, point: &curves::CurvePoint) -> Option<CurvePoint> {
        let reduction = self.plane.family.reduction(point.values.into())?;
        // the oscillator counts the upper stop first, the machine as it is described
        let stop = |place: usize| reduction.stop(Side::at(place)).unwrap_or(place);
        let event = point.event.map(|event| match event {
            CurveEvent::ResonantGrazing { stop: place } => CurveEvent::ResonantGrazing { stop: stop(place) },
            CurveEvent::DegenerateGrazing { stop: place } => CurveEvent::DegenerateGrazing { stop: stop(place) },
            CurveEvent::DoubleGrazing { stop: place } => CurveEvent::DoubleGrazing { stop: stop(place) },
            CurveEvent::Touch { stop: place } => CurveEvent::Touch { stop: stop(place) },
            other => other,
        });
        // how far the multiplier is from the value that the curve prescribes
        let nearest = |to: f64| {
            let off = point.cycle.multipliers.iter().map(|one| hypot(one.re - to, one.im));
            off.fold(f64::INFINITY, f64::min)
        };
        let (cycle, residual, touch) = match self.curve.kind() {
            CurveKind::Grazing { .. } => {
                let (cycle, touch) = without_touch(&reduction.oscillator, &point.cycle)?;
                let phase = phase::wrap(touch.phase - reduction.phase());
                (cycle, touch.velocity.abs() / point.cycle.fastest().max(f64::MIN_POSITIVE), Some(phase))
            }
            CurveKind::Flip => (point.cycle.clone(), nearest(-1.0), None),
            _ => (point.cycle.clone(), nearest(1.0), None),
        };
        let cycle = Cycle::of_oscillator(&reduction, self.stops, &cycle)?;
        Some(CurvePoint { values: point.values, cycle, residual, touch, event })
    }

    /// The end where the cycles cease to be admissible without an event that says so.
    fn change(&mut self) -> Option<CurvePoint> {
        self.left = 0;
        let last = self.last.take().filter(|last| last.event.is_none())?;
        Some(CurvePoint { event: Some(CurveEvent::Change { place: None }), ..last })
    }

    fn next(&mut self) -> Option<CurvePoint> {
        self.left = self.left.checked_sub(1)?;
        let point = self.curve.next()?;
        // beyond a touch the cycles are inadmissible
        let converted = if point.physical { self.converted(&point) } else { None };
        let Some(mut point) = converted else { return self.change() };
        if self.left == 0 && point.event.is_none() {
            point.event = Some(CurveEvent::StepLimit);
        }
        self.last = Some(point.clone());
        Some(point)
    }
}

/// The grazing at which a flight of a cycle comes to touch a stop: that which comes closest.
fn appearing(osc: &Oscillator, cycle: &orbit::Cycle, side: Side) -> Option<BranchEvent> {
    let ring = Ring::of(osc, cycle)?;
    let distance = |k: &usize| closest(osc, &ring, *k, side).map_or(f64::INFINITY, |closest| closest.distance.abs());
    let impact = (0..ring.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let phase = crest(osc, side);
    Some(grazing(cycle, (true, impact.unwrap_or(0)), (side, phase)))
}

/// The grazing at which an impact of a cycle on a stop loses its speed: that of the slowest.
fn disappearing(cycle: &orbit::Cycle, side: Side) -> Option<BranchEvent> {
    let speed = |k: &usize| cycle.points[*k].state.velocity;
    let on_side = (0..cycle.points.len()).filter(|k| cycle.points[*k].state.side == side);
    let impact = on_side.min_by(|a, b| speed(a).total_cmp(&speed(b)))?;
    Some(grazing(cycle, (false, impact), (side, cycle.points[impact].state.phase)))
}

fn grazing(cycle: &orbit::Cycle, (appears, impact): (bool, usize), (side, phase): (Side, f64)) -> BranchEvent {
    // a cycle without impacts has no impact numbers
    let impact = (!cycle.points.is_empty()).then_some(impact);
    let detail = EventDetail { impact, phase, also: None, labels: (cycle.label, None) };
    BranchEvent::Grazing { stop: side.place(), also: None, appears, turns: false, detail: Some(detail) }
}

/// The cycle of a grazing curve without its contact, and the contact.
fn without_touch(osc: &Oscillator, cycle: &orbit::Cycle) -> Option<(orbit::Cycle, ImpactState)> {
    let mut points = cycle.points.clone();
    let speed = |k: &usize| points[*k].state.velocity.abs();
    let touch = (0..points.len()).min_by(|a, b| speed(a).total_cmp(&speed(b)))?;
    let removed = points.remove(touch);
    // the flights before and after the touch are one
    if let Some(last) = points.len().checked_sub(1) {
        points[touch.checked_sub(1).unwrap_or(last)].interval += removed.interval;
    }
    let impacts = Count::Finite(u32::try_from(points.len()).ok()?);
    let ring = Ring::of(osc, &orbit::Cycle { label: Label { impacts, ..cycle.label }, points, ..cycle.clone() })?;
    Some((ring_cycle(osc, &ring, &blocks(osc, &ring)?), removed.state))
}
