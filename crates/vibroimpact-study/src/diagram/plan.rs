//! The plan of an orbit diagram: the parameter and its values, the starts, and the points to show.

use crate::cut::in_proportion;
use crate::name::{Name, Renamed, Written};
use crate::quantity::Quantity;
use crate::{Cut, Parameter, PlanError, Span, Stretch, SystemPlan, Values, limits};
use serde::{Deserialize, Serialize};

/// Default number of impacts or forcing periods before the points shown.
pub const DEFAULT_TRANSIENT: u64 = 500;
/// Default number of impacts or states shown at each value.
pub const DEFAULT_KEEP: u64 = 64;

/// One parameter over rising or falling values, and what is shown of the motion at each value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "V: Name, S: Serialize", deserialize = "V: Name, S: Deserialize<'de> + Default")
)]
#[schemars(rename = "DiagramPlan", bound = "V: Name, S: schemars::JsonSchema + Default + Serialize")]
pub struct DiagramPlan<V = Parameter, S = Show> {
    /// The number that varies; its value in the system counts for nothing.
    #[serde(with = "crate::name")]
    #[schemars(with = "Written")]
    pub vary: V,
    /// Its values, which rise or fall.
    pub over: Values,
    /// A second parameter that varies with it, in proportion, from its value at the first to its value at the last: the
    /// diagram along any line through two parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub also: Option<Stretch<V>>,
    /// What is shown; velocity, or speed of a machine, when absent.
    #[serde(default)]
    pub show: S,
    /// How the starts at each value are chosen.
    #[serde(default)]
    pub direction: SweepDirection,
    /// Impacts, or forcing periods for states at phase 0, before anything is shown. The motion whose
    /// quantity is shown is settled, however long its transient is.
    #[serde(default = "transient")]
    pub transient: u64,
    /// Impacts or states shown at each value, at most: a motion that repeats itself is shown once.
    #[serde(default = "keep")]
    pub keep: u64,
}

impl<V, S: Default> DiagramPlan<V, S> {
    /// The usual diagram over these values.
    #[must_use]
    pub fn new(vary: V, over: impl Into<Values>) -> Self {
        let (direction, transient, keep) = (SweepDirection::default(), DEFAULT_TRANSIENT, DEFAULT_KEEP);
        Self { vary, over: over.into(), also: None, show: S::default(), direction, transient, keep }
    }
}

const fn transient() -> u64 {
    DEFAULT_TRANSIENT
}

const fn keep() -> u64 {
    DEFAULT_KEEP
}

/// What is shown of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Show {
    /// Phase and speed of arrival of its impacts.
    #[default]
    Velocity,
    /// Position and velocity once in every forcing period, at phase 0.
    Strobe,
    /// One value of the settled motion: that of this quantity.
    Quantity(Quantity),
}

/// What is shown as a plan has it. Of an oscillator it is `velocity`, `strobe` or a quantity. Of a machine it is `speed`, the phase
/// and speed of each closing of a stop; the value of `q.COORDINATE` or `qdot.COORDINATE` once in every forcing period, at phase 0; or
/// a quantity of the settled motion by its path.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "`velocity`, `strobe`, a table with a `quantity`, or a path of a machine"
)]
pub enum ShowText {
    /// A word, or a path of a machine.
    Word(String),
    /// A quantity of an oscillator.
    Quantity {
        /// Its name.
        quantity: String,
    },
}

impl Default for ShowText {
    fn default() -> Self {
        Self::Word("velocity".to_owned())
    }
}

impl From<Show> for ShowText {
    fn from(show: Show) -> Self {
        match show {
            Show::Velocity => Self::Word("velocity".to_owned()),
            Show::Strobe => Self::Word("strobe".to_owned()),
            Show::Quantity(quantity) => Self::Quantity { quantity: quantity.name().to_owned() },
        }
    }
}

impl From<String> for ShowText {
    fn from(path: String) -> Self {
        Self::Word(path)
    }
}

/// What a diagram shows of a motion of any system.
pub trait Shown: Clone + PartialEq + core::fmt::Debug {
    /// Each closing of a stop, with its phase and speed.
    fn closings() -> Self;

    /// Whether it is each closing of a stop, with its phase and speed.
    fn is_closings(&self) -> bool;

    /// Whether it is a state at phase 0.
    fn is_states(&self) -> bool;
}

impl Shown for Show {
    fn closings() -> Self {
        Self::Velocity
    }

    fn is_closings(&self) -> bool {
        *self == Self::Velocity
    }

    fn is_states(&self) -> bool {
        *self == Self::Strobe
    }
}

/// What is shown of closings of a machine.
const SPEED: &str = "speed";

/// What is shown of a machine, as in [`ShowText`].
impl Shown for String {
    fn closings() -> Self {
        SPEED.to_owned()
    }

    fn is_closings(&self) -> bool {
        self == SPEED
    }

    /// The path of a quantity of a coordinate has one more name.
    fn is_states(&self) -> bool {
        self.split_once('.').is_some_and(|(head, name)| matches!(head, "q" | "qdot") && !name.contains('.'))
    }
}

impl TryFrom<&ShowText> for Show {
    type Error = PlanError;

    fn try_from(text: &ShowText) -> Result<Self, PlanError> {
        match text {
            ShowText::Word(word) if word == "velocity" => Ok(Self::Velocity),
            ShowText::Word(word) if word == "strobe" => Ok(Self::Strobe),
            ShowText::Word(word) => {
                let shown: String = word.chars().take(60).collect();
                Err(PlanError::Name(format!("`{shown}` is neither velocity nor strobe nor a table with a quantity")))
            }
            ShowText::Quantity { quantity } => Ok(Self::Quantity(Quantity::of(quantity)?)),
        }
    }
}

impl TryFrom<&ShowText> for String {
    type Error = PlanError;

    fn try_from(text: &ShowText) -> Result<Self, PlanError> {
        let (ShowText::Word(path) | ShowText::Quantity { quantity: path }) = text;
        Ok(path.clone())
    }
}

/// How the starts at each value are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SweepDirection {
    /// Values rise, and the last state at one is the start at the next.
    Up,
    /// The same with falling values.
    Down,
    /// Both of these, one after the other: where they differ, motions coexist.
    #[default]
    Both,
    /// Several scattered starts at each value; no state is carried from one value to the next.
    Scatter {
        /// How many.
        starts: u64,
        /// Which sequence of them.
        #[serde(default)]
        seed: u64,
    },
}

/// Maximum number of impacts or states shown at a value.
const MOST_KEPT: u64 = 100_000;
/// Maximum number of points that one run keeps in memory.
const MOST_POINTS: u64 = 20_000_000;

impl SweepDirection {
    /// Number of motions followed at each value.
    pub(crate) const fn runs(self) -> u64 {
        match self {
            Self::Up | Self::Down => 1,
            Self::Both => 2,
            Self::Scatter { starts, .. } => starts,
        }
    }
}

/// Checks the values of a diagram, which a sweep takes one after another.
pub(crate) fn check_order(over: &Values) -> Result<(), PlanError> {
    over.check()?;
    let sentence = "the values of a diagram rise or fall, and those of the list do neither\nhint: sort them";
    if over.in_order() { Ok(()) } else { Err(PlanError::refused(sentence)) }
}

/// Checks the lengths of a diagram: those of the transient and of what is shown, and the number of all points.
pub(crate) fn check_shown(
    over: &Values,
    direction: SweepDirection,
    (transient, keep): (u64, u64),
) -> Result<(), PlanError> {
    limits::check("transient", transient, 0..=limits::MOST_TRANSIENT)?;
    limits::check("keep", keep, 1..=MOST_KEPT)?;
    if let SweepDirection::Scatter { starts: given, .. } = direction {
        limits::starts(given, limits::MOST_STARTS)?;
    }
    let (columns, rows) = (over.count() as u64, direction.runs() * keep);
    if columns.saturating_mul(rows) > MOST_POINTS {
        return Err(PlanError::Size { what: "points", columns, rows, most: MOST_POINTS });
    }
    Ok(())
}

/// Value number `k` of a second parameter with these ends, if the values of the first are evenly spaced: rounded as a range of
/// that parameter would be.
fn even(over: &Values, (from, to): (f64, f64), k: u32) -> Option<f64> {
    let Values::Span(over) = over else { return None };
    if over.is_logarithmic() { None } else { Some(Span::new(from, to, over.count()).ok()?.at(k)) }
}

impl<V, S> DiagramPlan<V, S> {
    /// The same with other names of the numbers that vary and of what is shown.
    pub(crate) fn named<W, T, E>(
        &self,
        name: &impl Fn(&V) -> Result<W, E>,
        show: &impl Fn(&S) -> Result<T, E>,
    ) -> Result<DiagramPlan<W, T>, E> {
        let Self { direction, transient, keep, .. } = self;
        let also = self.also.named(name)?;
        let (vary, over, show) = (name(&self.vary)?, self.over.clone(), show(&self.show)?);
        Ok(DiagramPlan { vary, over, also, show, direction: *direction, transient: *transient, keep: *keep })
    }

    /// Number of motions followed at each value.
    #[must_use]
    pub const fn runs(&self) -> u64 {
        self.direction.runs()
    }

    /// The values of the numbers that vary at value number `k`. If the values are evenly spaced, those of the second number are
    /// too, rounded as a range of that number would be.
    pub fn values(&self, k: u32) -> impl Iterator<Item = f64> + use<V, S> {
        let first = self.over.at(k as usize);
        let second = self.also.as_ref().map(|also| {
            let ends = (also.from, also.to);
            even(&self.over, ends, k).unwrap_or_else(|| in_proportion(first, self.over.ends(), ends))
        });
        core::iter::once(first).chain(second)
    }
}

impl<V: Clone, S> DiagramPlan<V, S> {
    /// The line of the diagram.
    #[must_use]
    pub fn cut(&self) -> Cut<V> {
        Cut { vary: self.vary.clone(), ends: self.over.ends(), also: self.also.clone() }
    }
}

impl DiagramPlan {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        check_order(&self.over)?;
        self.cut().check(system)?;
        check_shown(&self.over, self.direction, (self.transient, self.keep))
    }

    /// The system at value number `k`. Parameters that do not vary are those of `system`.
    pub(crate) fn system(&self, system: &SystemPlan, k: u32) -> Result<SystemPlan, PlanError> {
        system.with_all(self.cut().names().copied().zip(self.values(k)))
    }
}
