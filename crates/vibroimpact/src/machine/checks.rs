//! The checks of a machine.

use super::parts::{MachineParts, Stop, StopLaw};
use super::{Fault, MachineError};
use crate::math::{Matrix, dot, symmetric_eigen};

/// The largest number of coordinates.
pub const MOST_COORDINATES: usize = 1000;
/// An eigenvalue that is negative by less than this part of the largest element is a rounding error.
const NEGATIVE: f64 = 1e-12;

/// Checks all numbers; the first fault is returned, with its path.
pub(super) fn check(parts: &MachineParts) -> Result<(), MachineError> {
    let n = parts.n();
    if n == 0 {
        return Err(MachineError::new("coordinates", Fault::NoCoordinates));
    }
    if n > MOST_COORDINATES {
        return Err(MachineError::new("coordinates", Fault::TooLarge(n)));
    }
    names("coordinates", parts.coordinates.iter())?;
    names("stop", parts.stops.iter().map(|stop| &stop.name).chain(parts.joints.iter().map(|joint| &joint.name)))?;
    matrix("mass", &parts.mass, n)?;
    matrix("damping", &parts.damping, n)?;
    matrix("stiffness", &parts.stiffness, n)?;
    vector("constant", &parts.constant, n)?;
    if parts.mass.cholesky().is_none() {
        return Err(MachineError::new("mass", Fault::NotPositiveDefinite));
    }
    semidefinite("damping", &parts.damping)?;
    semidefinite("stiffness", &parts.stiffness)?;
    if let Some(frequency) = parts.frequency {
        range("frequency", frequency, 1e-100..=1e100, "1e-100 <= frequency <= 1e100")?;
    }
    for force in &parts.forces {
        let path = format!("force.{}", force.order);
        harmonic(&path, force.order, parts.frequency)?;
        vector(&format!("{path}.cos"), &force.cos, n)?;
        vector(&format!("{path}.sin"), &force.sin, n)?;
    }
    for stop in &parts.stops {
        check_stop(stop, parts)?;
    }
    for joint in &parts.joints {
        let path = format!("friction.{}", joint.name);
        direction(&path, &joint.direction, n)?;
        range(&format!("{path}.sliding"), joint.sliding, 0.0..=f64::MAX, "sliding >= 0")?;
        finite(&format!("{path}.belt"), joint.belt)?;
        // negated, so that it refuses what is not a number
        if !(joint.limit >= joint.sliding && joint.limit.is_finite()) {
            let fault = Fault::Range { value: joint.limit, range: "static >= sliding" };
            return Err(MachineError::new(format!("{path}.static"), fault));
        }
    }
    room(parts)
}

fn check_stop(stop: &Stop, parts: &MachineParts) -> Result<(), MachineError> {
    let path = format!("stop.{}", stop.name);
    direction(&path, &stop.direction, parts.n())?;
    finite(&format!("{path}.gap"), stop.gap)?;
    for motion in &stop.motion {
        let path = format!("{path}.motion.{}", motion.order);
        harmonic(&path, motion.order, parts.frequency)?;
        finite(&format!("{path}.cos"), motion.cos)?;
        finite(&format!("{path}.sin"), motion.sin)?;
    }
    match stop.law {
        StopLaw::Rigid { restitution } => {
            range(&format!("{path}.restitution"), restitution, 0.0..=1.0, "0 <= restitution <= 1")
        }
        StopLaw::Compliant { stiffness, damping, preload, .. } => {
            range(&format!("{path}.stiffness"), stiffness, f64::MIN_POSITIVE..=f64::MAX, "stiffness > 0")?;
            range(&format!("{path}.damping"), damping, 0.0..=f64::MAX, "damping >= 0")?;
            range(&format!("{path}.preload"), preload, 0.0..=f64::MAX, "preload >= 0")
        }
    }
}

fn names<'a>(path: &str, all: impl Iterator<Item = &'a String>) -> Result<(), MachineError> {
    let mut seen: Vec<&String> = Vec::new();
    for name in all {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(plain) {
            return Err(MachineError::new(path, Fault::Name(name.clone())));
        }
        if seen.contains(&name) {
            return Err(MachineError::new(format!("{path}.{name}"), Fault::Twice));
        }
        seen.push(name);
    }
    Ok(())
}

fn finite(path: &str, value: f64) -> Result<(), MachineError> {
    if value.is_finite() { Ok(()) } else { Err(MachineError::new(path, Fault::NotFinite(value))) }
}

fn range(
    path: &str,
    value: f64,
    allowed: core::ops::RangeInclusive<f64>,
    text: &'static str,
) -> Result<(), MachineError> {
    if allowed.contains(&value) { Ok(()) } else { Err(MachineError::new(path, Fault::Range { value, range: text })) }
}

fn harmonic(path: &str, order: u32, frequency: Option<f64>) -> Result<(), MachineError> {
    if order == 0 {
        return Err(MachineError::new(path, Fault::Range { value: 0.0, range: "order >= 1" }));
    }
    if frequency.is_none() {
        return Err(MachineError::new(path, Fault::NoFrequency));
    }
    Ok(())
}

fn vector(path: &str, values: &[f64], n: usize) -> Result<(), MachineError> {
    if values.len() != n {
        let given = format!("{} numbers", values.len());
        return Err(MachineError::new(path, Fault::Size { given, n }));
    }
    values.iter().try_for_each(|value| finite(path, *value))
}

fn direction(path: &str, values: &[f64], n: usize) -> Result<(), MachineError> {
    let path = format!("{path}.direction");
    vector(&path, values, n)?;
    if values.iter().all(|value| *value == 0.0) {
        return Err(MachineError::new(path, Fault::NoDirection));
    }
    Ok(())
}

fn matrix(path: &str, values: &Matrix, n: usize) -> Result<(), MachineError> {
    if (values.rows(), values.columns()) != (n, n) {
        let given = format!("{} rows and {} columns", values.rows(), values.columns());
        return Err(MachineError::new(path, Fault::Size { given, n }));
    }
    for i in 0..n {
        for j in 0..n {
            let (one, other) = (values[(i, j)], values[(j, i)]);
            finite(path, one)?;
            // matrices computed elsewhere are symmetric to rounding of their own elements, or of those beside which they are
            // computed
            let beside =
                || values.row(i).iter().chain(values.row(j)).fold(0.0_f64, |most, value| most.max(value.abs()));
            if (one - other).abs() > 1e-12 * (one.abs() + other.abs())
                && (one - other).abs() > 4.0 * f64::EPSILON * beside()
            {
                let fault = Fault::NotSymmetric { row: i + 1, column: j + 1, one, other };
                return Err(MachineError::new(path, fault));
            }
        }
    }
    Ok(())
}

fn semidefinite(path: &str, values: &Matrix) -> Result<(), MachineError> {
    // a factor of the matrix with its largest rounding error on the diagonal says so at less cost than the eigenvalues
    let mut shifted = values.clone();
    for i in 0..shifted.rows() {
        shifted[(i, i)] += NEGATIVE * values.largest();
    }
    if shifted.cholesky().is_some() {
        return Ok(());
    }
    let (eigenvalues, _) = symmetric_eigen(values);
    match eigenvalues.first() {
        Some(least) if *least < -NEGATIVE * values.largest() => Err(MachineError::new(path, Fault::Negative(*least))),
        _ => Ok(()),
    }
}

/// Two rigid stops that face each other in one direction leave room between them when they are at rest.
fn room(parts: &MachineParts) -> Result<(), MachineError> {
    let rigid = |stop: &&Stop| matches!(stop.law, StopLaw::Rigid { .. });
    for (k, one) in parts.stops.iter().enumerate().filter(|(_, stop)| rigid(stop)) {
        for other in parts.stops[..k].iter().filter(rigid) {
            let (a, b) = (dot(&one.direction, &one.direction), dot(&other.direction, &other.direction));
            let across = dot(&one.direction, &other.direction);
            // two stops face each other along one line
            if across < 0.0 && across * across >= (1.0 - 1e-12) * a * b {
                // lengths along the line, because a gap is in the unit of its direction
                let room = one.gap / a.sqrt() + other.gap / b.sqrt();
                if room <= 0.0 {
                    let fault = Fault::NoRoom { other: other.name.clone(), room };
                    return Err(MachineError::new(format!("stop.{}.gap", one.name), fault));
                }
            }
        }
    }
    Ok(())
}
