//! The table `[machine]` of a machine file.

use super::named::Named;
use super::number::NumberText;
use super::shapes::{MatrixText, VectorText};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The table `[machine]`: a linear structure with forces, stops and friction joints.
///
/// The structure is given by matrices, by `bodies` with links between them, or by modes; bodies and modes may be
/// combined. All numbers are in one consistent system of units, such as SI.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WrittenMachine {
    /// Names of the coordinates. Bodies have coordinates of their names, and modes `mode1`, `mode2`, ... by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coordinates: Option<Vec<String>>,
    /// The bodies with their masses: `{ body = 1.0, shoe = 2.0 }`. Instead of `mass`.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub bodies: Named<NumberText>,
    /// The file with the modes, a CSV table; instead of tables `mode`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<String>,
    /// Mass matrix, symmetric and positive definite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<MatrixText>,
    /// Damping matrix, symmetric and positive semidefinite; 0 when absent. Dampers of links are added.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<MatrixText>,
    /// Damping ratios of the modes of the mass and stiffness matrices, from the lowest frequency; instead of `damping`.
    /// Dampers of links are added.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal_damping: Option<Vec<NumberText>>,
    /// Stiffness matrix, symmetric and positive semidefinite; 0 when absent. Springs of links are added.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<MatrixText>,
    /// Constant force: on each coordinate, or `{ body = -9.81 }`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub constant: Option<VectorText>,
    /// Angular frequency of the forcing, in radians per unit of time; no forcing when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency: Option<NumberText>,
    /// Frequency of the forcing in periods per unit of time; instead of `frequency`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<NumberText>,
    /// How impacts on several rigid stops at one time act; `together` when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impacts: Option<ImpactsText>,
    /// Modes of vibration.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mode: Vec<ModeText>,
    /// Springs and dampers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub link: Vec<LinkText>,
    /// Harmonic forces; forces of one order are added.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub force: Vec<ForceText>,
    /// Stops.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stop: Vec<StopText>,
    /// Friction joints.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub friction: Vec<FrictionText>,
}

/// The law of impacts on several rigid stops at one time, or on one while others are closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ImpactsText {
    /// All at once, by Moreau's law.
    #[default]
    Together,
    /// In turn, as in a cradle: stops that close push first, then those that they make close.
    InTurn,
}

/// A mode of vibration. Its amplitude is a coordinate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModeText {
    /// Angular natural frequency; 0 for a rigid-body mode. This or `frequency_hz`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency: Option<NumberText>,
    /// Natural frequency in periods per unit of time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<NumberText>,
    /// Damping ratio; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping_ratio: Option<NumberText>,
    /// Modal mass: 1 when absent, for mass-normalised shapes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub modal_mass: Option<NumberText>,
    /// Displacements of named points in this mode: `{ tip = 1.2, middle = -0.3 }`; the same points in each mode.
    #[serde(default)]
    pub shape: Named<NumberText>,
}

/// A spring and a damper between two bodies, or between a body and the ground.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinkText {
    /// Its name; the two names in `between` with a hyphen when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// What it joins: `["body", "shoe"]` or `["body", "ground"]`.
    pub between: [String; 2],
    /// Stiffness of the spring; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<NumberText>,
    /// Damping coefficient; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<NumberText>,
}

/// A harmonic force, `cos * cos(order theta) + sin * sin(order theta)` with `theta = frequency t + phase`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceText {
    /// The order of the harmonic; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub order: Option<u32>,
    /// The body or point on which it acts; `cos` and `sin` are one number each then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
    /// Cosine amplitude: on each coordinate, `{ shoe = 0.1 }`, or with `at` one number. 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cos: Option<VectorText>,
    /// Sine amplitude, likewise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sin: Option<VectorText>,
}

/// A stop. It is open while `gap - direction.q - motion` is positive. It is rigid if `restitution` is given, and
/// compliant if `stiffness` is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopText {
    /// Its name.
    pub name: String,
    /// The direction in which the gap closes: a number for each coordinate, or `{ body = 1, shoe = -1 }`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<VectorText>,
    /// Instead of `direction`: the gap closes when the first moves towards the second in positive direction, as
    /// `["body", "ground"]`; with `["ground", "body"]` it closes when the body moves in negative direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// Instead of `direction`: the body or point that meets the stop when it moves in positive direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
    /// The gap where all coordinates are 0.
    pub gap: NumberText,
    /// Restitution of a rigid stop, 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<NumberText>,
    /// Stiffness of a compliant stop.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<NumberText>,
    /// Damping coefficient of a compliant stop; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<NumberText>,
    /// Force of a compliant stop at the moment of closing; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preload: Option<NumberText>,
    /// When a compliant stop opens; `force` when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub opening: Option<OpeningText>,
    /// The motion of the stop, a sum of harmonics; at rest when absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<MotionText>,
}

/// When a compliant stop opens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OpeningText {
    /// When its force falls to 0: it never pulls.
    #[default]
    Force,
    /// When its gap opens; a damped stop pulls before.
    Position,
}

/// A harmonic of the motion of a stop, `cos * cos(order theta) + sin * sin(order theta)`; it closes the gap.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionText {
    /// The order of the harmonic; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub order: Option<u32>,
    /// Cosine amplitude; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cos: Option<NumberText>,
    /// Sine amplitude; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sin: Option<NumberText>,
}

/// A joint with Coulomb friction of a given normal force. It acts against `direction.qdot - belt`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionText {
    /// Its name.
    pub name: String,
    /// The direction of sliding: a number for each coordinate, or `{ body = 1, shoe = -1 }`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<VectorText>,
    /// Instead of `direction`: what slides on what, as `["body", "ground"]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// Instead of `direction`: the body or point that slides on the ground.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
    /// The friction force while it slides.
    pub sliding: NumberText,
    /// The largest force that holds it at rest, at least `sliding`; equal to it when absent.
    #[serde(default, rename = "static", skip_serializing_if = "Option::is_none")]
    pub limit: Option<NumberText>,
    /// The velocity of the belt under it; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub belt: Option<NumberText>,
}
