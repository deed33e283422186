//! A plan that can fill a grid: one of the oscillator, or one of a machine.

use crate::machine::no_files;
use crate::text::Document;
use crate::{MachinePlan, Plan, PlanError};
use serde::Serialize;

/// A plan of the oscillator or of a machine. Its JSON is that of the plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum StudyPlan {
    /// A plan of the oscillator.
    Oscillator(Box<Plan>),
    /// A plan of a machine.
    Machine(Box<MachinePlan>),
}

impl From<&Plan> for StudyPlan {
    fn from(plan: &Plan) -> Self {
        Self::Oscillator(Box::new(plan.clone()))
    }
}

impl From<&MachinePlan> for StudyPlan {
    fn from(plan: &MachinePlan) -> Self {
        Self::Machine(Box::new(plan.clone()))
    }
}

impl From<&Self> for StudyPlan {
    fn from(plan: &Self) -> Self {
        plan.clone()
    }
}

impl StudyPlan {
    /// Reads a plan written as TOML or, where it begins with a brace, as JSON. `files` returns the text of a file that a
    /// machine names, or says why not.
    ///
    /// # Errors
    /// [`PlanError`] says what is wrong, and where.
    pub fn from_text(text: &str, files: impl FnOnce(&str) -> Result<String, String>) -> Result<Self, PlanError> {
        let document = Document::parse(text)?;
        Ok(if document.has_machine() {
            Self::Machine(Box::new(MachinePlan::of_document(&document, files)?))
        } else {
            Self::Oscillator(Box::new(Plan::of_document(&document)?))
        })
    }

    /// Reads a plan that names no files, as a store keeps it.
    ///
    /// # Errors
    /// [`PlanError`] says what is wrong, and where.
    pub fn from_json(text: &str) -> Result<Self, PlanError> {
        Self::from_text(text, no_files)
    }

    /// The plan of the oscillator; `None` for a machine.
    #[must_use]
    pub fn oscillator(&self) -> Option<&Plan> {
        if let Self::Oscillator(plan) = self { Some(plan) } else { None }
    }

    /// The same plan for all ways to write the same question.
    ///
    /// # Errors
    /// [`PlanError`] for a parameter of a second stop if there is none.
    pub fn canonical(&self) -> Result<Self, PlanError> {
        Ok(match self {
            Self::Oscillator(plan) => Self::Oscillator(Box::new(plan.canonical()?)),
            Self::Machine(plan) => Self::Machine(plan.clone()),
        })
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self) -> Result<(), PlanError> {
        match self {
            Self::Oscillator(plan) => plan.check(),
            Self::Machine(plan) => plan.check(),
        }
    }

    /// An identifier of the content: the first 16 digits of the SHA-256 of the plan as JSON.
    #[must_use]
    pub fn hash(&self) -> String {
        match self {
            Self::Oscillator(plan) => plan.hash(),
            Self::Machine(plan) => plan.hash(),
        }
    }

    /// Tiles of a shard along each axis, if the plan says so.
    #[must_use]
    pub fn shard(&self) -> Option<u32> {
        match self {
            Self::Oscillator(plan) => plan.shard,
            Self::Machine(plan) => plan.shard,
        }
    }

    /// A title in words.
    #[must_use]
    pub fn title(&self) -> String {
        match self {
            Self::Oscillator(plan) => plan.title(),
            Self::Machine(plan) => plan.title(),
        }
    }

    /// The plan as TOML. Numbers have all their digits.
    #[must_use]
    pub fn to_toml(&self) -> String {
        match self {
            Self::Oscillator(plan) => plan.to_toml(),
            Self::Machine(plan) => plan.to_toml(),
        }
    }
}
