//! Curves of events of machines: folds and flips of a machine that is an oscillator are those of the oscillator, in the numbers
//! of the machine.
//!
//! Curves of grazing are those of the machine's own equations, which have the multipliers of the cycle without the contact.

use super::branches::{MachineBranchEvent, MachinePoint};
use super::curves::{MachineCurvePoint, MachinePlane, UnreducedCurve};
use super::reduced_branch::oscillator;
use crate::continuation::branches::{BranchError, BranchEvent, SolutionPoint};
use crate::continuation::curves::{Curve, CurveEvent, CurveKind, CurveOptions, CurvePoint};
use crate::math::hypot;
use crate::orbit::MachineCycle;
use crate::system::{OscillatorFamily, Side};

/// A curve of an event of a machine: an iterator over its points in one direction from the point at which it begins.
#[derive(Clone, Debug)]
pub struct MachineCurve(Method);

#[derive(Clone, Debug)]
enum Method {
    Reduced(Box<ReducedCurve>),
    Unreduced(Box<UnreducedCurve>),
}

impl MachineCurve {
    /// The two directions along the curve through an event of a branch; `values` are those of both numbers there.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] for an event that begins no curve, [`BranchError::OutOfRange`] if the point lies outside the
    /// frame, [`BranchError::NoCycle`] if no curve is found through it.
    pub fn through(
        plane: &MachinePlane,
        values: (f64, f64),
        point: &MachinePoint,
        options: CurveOptions,
    ) -> Result<[Self; 2], BranchError> {
        match ReducedCurve::through(plane, values, point, options) {
            Some(both) => Ok(both.map(|curve| Self(Method::Reduced(Box::new(curve))))),
            None => Self::unreduced(plane, values, point, options),
        }
    }

    /// The same, with a machine that is an oscillator followed as any other.
    ///
    /// # Errors
    /// As [`through`](Self::through).
    pub fn unreduced(
        plane: &MachinePlane,
        values: (f64, f64),
        point: &MachinePoint,
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

impl Iterator for MachineCurve {
    type Item = MachineCurvePoint;

    fn next(&mut self) -> Option<MachineCurvePoint> {
        match &mut self.0 {
            Method::Reduced(curve) => curve.next(),
            Method::Unreduced(curve) => curve.next(),
        }
    }
}

/// A curve of the oscillator that a machine is, as far as its cycles are admissible.
#[derive(Clone, Debug)]
struct ReducedCurve {
    curve: Curve,
    plane: MachinePlane,
    stops: usize,
    left: u32,
}

impl ReducedCurve {
    /// `None` for another event, if the machine is no oscillator somewhere in the frame, or if no curve is found.
    fn through(
        plane: &MachinePlane,
        values: (f64, f64),
        point: &MachinePoint,
        options: CurveOptions,
    ) -> Option<[Self; 2]> {
        let event = match point.event? {
            MachineBranchEvent::Fold => BranchEvent::Fold,
            MachineBranchEvent::Flip => BranchEvent::Flip,
            _ => return None,
        };
        let (osc, frame) = plane.reduced(values)?;
        let cycle = point.cycle.to_oscillator(&plane.family.reduction(values.into())?)?;
        let there = SolutionPoint { value: values.0, cycle, physical: true, event: Some(event) };
        // the line to the event, along the first number
        let (family, second) = (plane.family.clone(), values.1);
        let line = OscillatorFamily::new(move |[first]| oscillator(&family, [first, second]), [values.0]);
        let both = Curve::through(&osc, &there, line, &frame, options).ok()?;
        let stops = point.cycle.counts.len();
        Some(both.map(|curve| Self { curve, plane: plane.clone(), stops, left: options.points }))
    }

    fn converted(&self, point: &CurvePoint) -> Option<MachineCurvePoint> {
        let reduction = self.plane.family.reduction(point.values.into())?;
        let stop = |place: usize| reduction.stop(if place == 0 { Side::Upper } else { Side::Lower }).unwrap_or(place);
        let event = point.event.map(|event| match event {
            CurveEvent::ResonantGrazing { stop: place } => CurveEvent::ResonantGrazing { stop: stop(place) },
            CurveEvent::Touch { stop: place } => CurveEvent::Touch { stop: stop(place) },
            other => other,
        });
        let to = if self.curve.kind() == CurveKind::Flip { -1.0 } else { 1.0 };
        let off = point.cycle.multipliers.iter().map(|one| hypot(one.re - to, one.im)).fold(f64::INFINITY, f64::min);
        let cycle = MachineCycle::of_oscillator(&reduction, self.stops, &point.cycle)?;
        Some(MachineCurvePoint { values: point.values, cycle, residual: off, touch: None, event })
    }

    fn next(&mut self) -> Option<MachineCurvePoint> {
        self.left = self.left.checked_sub(1)?;
        let point = self.curve.next()?;
        // beyond a touch the cycles are inadmissible
        let converted = if point.physical { self.converted(&point) } else { None };
        let Some(mut point) = converted else {
            self.left = 0;
            return None;
        };
        if self.left == 0 && point.event.is_none() {
            point.event = Some(CurveEvent::StepLimit);
        }
        Some(point)
    }
}
