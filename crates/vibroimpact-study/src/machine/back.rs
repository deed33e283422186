//! From the matrices of a machine back to the table `[machine]`, which reads as the same machine to the last bit.

use super::number::NumberText;
use super::shapes::{MatrixText, VectorText};
use super::text::{ForceText, FrictionText, ImpactsText, MotionText, OpeningText, StopText, WrittenMachine};
use vibroimpact::machine::{FrictionJoint, HarmonicForce, ImpactLaw, MachineParts, Opening, Stop, StopLaw};
use vibroimpact::math::Matrix;

/// A positive zero, which is what an absent number stands for.
const fn zero(value: f64) -> bool {
    value.to_bits() == 0
}

fn list(values: &[f64]) -> Vec<NumberText> {
    values.iter().map(|value| NumberText::Value(*value)).collect()
}

fn vector(values: &[f64]) -> Option<VectorText> {
    (!values.iter().all(|value| zero(*value))).then(|| VectorText::List(list(values)))
}

fn unless_zero(value: f64) -> Option<NumberText> {
    (!zero(value)).then_some(NumberText::Value(value))
}

fn matrix(matrix: &Matrix) -> MatrixText {
    let n = matrix.rows();
    let inside = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).filter(|(i, j)| i != j);
    if inside.into_iter().all(|place| zero(matrix[place])) {
        MatrixText::Diagonal((0..n).map(|i| NumberText::Value(matrix[(i, i)])).collect())
    } else {
        MatrixText::Rows((0..n).map(|i| list(matrix.row(i))).collect())
    }
}

impl From<&MachineParts> for WrittenMachine {
    fn from(parts: &MachineParts) -> Self {
        let unless_zero = |values: &Matrix| values.values().iter().any(|value| !zero(*value)).then(|| matrix(values));
        Self {
            coordinates: Some(parts.coordinates.clone()),
            mass: Some(matrix(&parts.mass)),
            damping: unless_zero(&parts.damping),
            stiffness: unless_zero(&parts.stiffness),
            constant: vector(&parts.constant),
            frequency: parts.frequency.map(NumberText::Value),
            force: parts.forces.iter().map(force).collect(),
            stop: parts.stops.iter().map(stop).collect(),
            friction: parts.joints.iter().map(friction).collect(),
            impacts: (parts.impacts == ImpactLaw::InTurn).then_some(ImpactsText::InTurn),
            ..Self::default()
        }
    }
}

fn force(force: &HarmonicForce) -> ForceText {
    ForceText { order: Some(force.order), at: None, cos: vector(&force.cos), sin: vector(&force.sin) }
}

fn stop(stop: &Stop) -> StopText {
    let text = StopText {
        name: stop.name.clone(),
        direction: Some(VectorText::List(list(&stop.direction))),
        gap: NumberText::Value(stop.gap),
        motion: stop
            .motion
            .iter()
            .map(|motion| MotionText {
                order: Some(motion.order),
                cos: unless_zero(motion.cos),
                sin: unless_zero(motion.sin),
            })
            .collect(),
        ..StopText::default()
    };
    match stop.law {
        StopLaw::Rigid { restitution } => StopText { restitution: Some(NumberText::Value(restitution)), ..text },
        StopLaw::Compliant { stiffness, damping, preload, opening } => StopText {
            stiffness: Some(NumberText::Value(stiffness)),
            damping: unless_zero(damping),
            preload: unless_zero(preload),
            opening: (opening == Opening::Position).then_some(OpeningText::Position),
            ..text
        },
    }
}

fn friction(joint: &FrictionJoint) -> FrictionText {
    FrictionText {
        name: joint.name.clone(),
        direction: Some(VectorText::List(list(&joint.direction))),
        sliding: NumberText::Value(joint.sliding),
        limit: (joint.limit.to_bits() != joint.sliding.to_bits()).then_some(NumberText::Value(joint.limit)),
        belt: unless_zero(joint.belt),
        ..FrictionText::default()
    }
}
