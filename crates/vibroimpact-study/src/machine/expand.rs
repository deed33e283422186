//! The expansion of a machine file: every short form becomes matrices, vectors and directions.

use super::error::{MachineFileError, MachineProblem};
use super::named::Named;
use super::number::NumberText;
use super::places::{Places, check_name};
use super::shapes::VectorText;
use super::structure::{frequency, places, structure};
use super::text::{ForceText, FrictionText, ImpactsText, MotionText, OpeningText, StopText, WrittenMachine};
use vibroimpact::machine::{
    FrictionJoint, HarmonicForce, HarmonicMotion, ImpactLaw, MachineParts, Opening, Stop, StopLaw,
};

/// The expansion. The sizes of all its vectors and matrices are right; the rest is checked by the machine.
pub(super) fn expand(text: &WrittenMachine, parameters: &Named<f64>) -> Result<MachineParts, MachineFileError> {
    let places = places(text, parameters)?;
    let mut parts = structure(text, &places)?;
    if let Some(constant) = &text.constant {
        parts.constant = places.vector("constant", constant)?;
    }
    parts.frequency = frequency("", text.frequency.as_ref(), text.frequency_hz.as_ref(), &places)?;
    forces(&mut parts.forces, &text.force, &places)?;
    parts.stops = text.stop.iter().map(|stop| expand_stop(stop, &places)).collect::<Result<_, _>>()?;
    parts.impacts = match text.impacts.unwrap_or_default() {
        ImpactsText::Together => ImpactLaw::Together,
        ImpactsText::InTurn => ImpactLaw::InTurn,
    };
    parts.joints = text.friction.iter().map(|joint| expand_joint(joint, &places)).collect::<Result<_, _>>()?;
    Ok(parts)
}

/// Forces of one order are added.
fn forces(all: &mut Vec<HarmonicForce>, texts: &[ForceText], places: &Places<'_>) -> Result<(), MachineFileError> {
    for text in texts {
        let order = text.order.unwrap_or(1);
        let amplitude = |side: &str, amplitude: Option<&VectorText>| {
            let path = format!("force.{order}.{side}");
            match (amplitude, &text.at) {
                (None, _) => Ok(vec![0.0; places.n()]),
                (Some(VectorText::One(number)), Some(at)) => {
                    let direction = places.direction(&format!("force.{order}.at"), at)?;
                    let size = places.value(&format!("{path}.{at}"), number)?;
                    Ok(direction.iter().map(|value| size * value).collect())
                }
                (Some(_), Some(_)) => {
                    Err(MachineFileError::new(path, MachineProblem::Foreign("with `at` it is one number")))
                }
                (Some(vector), None) => places.vector(&path, vector),
            }
        };
        let (cos, sin) = (amplitude("cos", text.cos.as_ref())?, amplitude("sin", text.sin.as_ref())?);
        match all.iter_mut().find(|force| force.order == order) {
            Some(force) => {
                for (sum, value) in force.cos.iter_mut().zip(cos).chain(force.sin.iter_mut().zip(sin)) {
                    *sum += value;
                }
            }
            None => all.push(HarmonicForce { order, cos, sin }),
        }
    }
    Ok(())
}

/// The direction of a stop or a joint, in one of three forms.
fn direction(
    path: &str,
    forms: (Option<&VectorText>, Option<&[String; 2]>, Option<&String>),
    places: &Places<'_>,
) -> Result<Vec<f64>, MachineFileError> {
    match forms {
        (Some(direction), None, None) => places.vector(&format!("{path}.direction"), direction),
        (None, Some(names), None) => places.between(&format!("{path}.between"), names),
        (None, None, Some(name)) => places.direction(&format!("{path}.at"), name),
        (None, None, None) => Err(MachineFileError::new(path, MachineProblem::Missing("direction, between or at"))),
        _ => Err(MachineFileError::new(path, MachineProblem::Several("direction, between and at"))),
    }
}

fn expand_stop(text: &StopText, places: &Places<'_>) -> Result<Stop, MachineFileError> {
    check_name("stop", &text.name)?;
    let path = format!("stop.{}", text.name);
    let direction = direction(&path, (text.direction.as_ref(), text.between.as_ref(), text.at.as_ref()), places)?;
    let number = |field: &str, number: &NumberText| places.value(&format!("{path}.{field}"), number);
    let or_zero = |field: &str, number: Option<&NumberText>| places.value_or(&format!("{path}.{field}"), number, 0.0);
    let law = match (&text.restitution, &text.stiffness) {
        (Some(restitution), None) => {
            let compliant = [
                ("damping", text.damping.is_some()),
                ("preload", text.preload.is_some()),
                ("opening", text.opening.is_some()),
            ];
            if let Some((field, _)) = compliant.iter().find(|(_, given)| *given) {
                let problem =
                    MachineProblem::Foreign("a stop with restitution is rigid; a compliant one has stiffness");
                return Err(MachineFileError::new(format!("{path}.{field}"), problem));
            }
            StopLaw::Rigid { restitution: number("restitution", restitution)? }
        }
        (None, Some(stiffness)) => StopLaw::Compliant {
            stiffness: number("stiffness", stiffness)?,
            damping: or_zero("damping", text.damping.as_ref())?,
            preload: or_zero("preload", text.preload.as_ref())?,
            opening: match text.opening.unwrap_or_default() {
                OpeningText::Force => Opening::Force,
                OpeningText::Position => Opening::Position,
            },
        },
        (None, None) => {
            let needed = "restitution of a rigid stop, or stiffness of a compliant one,";
            return Err(MachineFileError::new(path, MachineProblem::Missing(needed)));
        }
        (Some(_), Some(_)) => {
            return Err(MachineFileError::new(path, MachineProblem::Several("restitution and stiffness")));
        }
    };
    let motion = |motion: &MotionText| {
        let order = motion.order.unwrap_or(1);
        Ok::<_, MachineFileError>(HarmonicMotion {
            order,
            cos: or_zero(&format!("motion.{order}.cos"), motion.cos.as_ref())?,
            sin: or_zero(&format!("motion.{order}.sin"), motion.sin.as_ref())?,
        })
    };
    let orders: Vec<u32> = text.motion.iter().map(|motion| motion.order.unwrap_or(1)).collect();
    if let Some(twice) = orders.iter().enumerate().find(|(k, order)| orders[..*k].contains(order)) {
        return Err(MachineFileError::text(format!("{path}.motion.{}", twice.1), "the order is given twice"));
    }
    Ok(Stop {
        name: text.name.clone(),
        direction,
        gap: number("gap", &text.gap)?,
        motion: text.motion.iter().map(motion).collect::<Result<_, _>>()?,
        law,
    })
}

fn expand_joint(text: &FrictionText, places: &Places<'_>) -> Result<FrictionJoint, MachineFileError> {
    check_name("friction", &text.name)?;
    let path = format!("friction.{}", text.name);
    let sliding = places.value(&format!("{path}.sliding"), &text.sliding)?;
    Ok(FrictionJoint {
        name: text.name.clone(),
        direction: direction(&path, (text.direction.as_ref(), text.between.as_ref(), text.at.as_ref()), places)?,
        sliding,
        limit: places.value_or(&format!("{path}.static"), text.limit.as_ref(), sliding)?,
        belt: places.value_or(&format!("{path}.belt"), text.belt.as_ref(), 0.0)?,
    })
}
