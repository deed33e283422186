//! A plan, its result, and everything that is reported of it: the JSON object, the table and the figure.

pub mod machine;
pub mod oscillator;

use crate::figure::coloured::Coloured;
use crate::figure::overlay::Overlay;
use crate::scene::View;
use crate::{AnswerError, Asked, Table, Units};
use serde::{Serialize, Serializer};
use vibroimpact_plot::Figure;
use vibroimpact_study::{Control, Plan, Results, System, run};

/// A plan and its result, in memory. Its [`Serialize`] form is the JSON object that the command prints with `--json`.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Of an oscillator.
    Oscillator(Box<oscillator::Answer>),
    /// Of a machine.
    Machine(Box<machine::Answer>),
}

/// Options for the figure and the table of an answer.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The view of a settled motion, a simulated motion or an attractor.
    pub view: Option<View>,
    /// Time between the points of a simulated waveform. Default: a hundredth of the forcing period; of a machine without
    /// forcing, a thousandth of the whole time.
    pub step: Option<f64>,
    /// Whether to simulate the orbit diagram and to draw it behind a branch.
    pub diagram: bool,
    /// Whether to draw the inadmissible solutions of a branch.
    pub inadmissible: bool,
    /// The quantity whose values are the colours of a map or basin.
    pub colour: Option<Coloured>,
    /// The layers of a map, and a point and a line over it.
    pub overlay: Overlay,
}

impl Default for Shown {
    fn default() -> Self {
        Self { view: None, step: None, diagram: true, inadmissible: false, colour: None, overlay: Overlay::default() }
    }
}

/// Runs a plan in memory, like [`run`]. The units of the plan, if it has any, are those of the results; `units` are
/// those of a plan of an oscillator without units. A machine has the name of its title, or [another](Answer::named).
///
/// # Errors
/// [`AnswerError`] for an invalid plan, or when stopped.
pub fn answer(plan: &Plan, units: Units, control: &Control<'_>) -> Result<Answer, AnswerError> {
    let plan = plan.complete()?;
    let results = run(&plan, control)?;
    match (&plan.system, results) {
        (System::Machine(source), Results::Machine(results)) => {
            let name = source.title.clone().unwrap_or_else(|| "machine".to_owned());
            let (source, (machine, start)) = ((**source).clone(), source.described()?);
            Ok(Answer::Machine(Box::new(machine::Answer { name, source, machine, start, results, plan })))
        }
        (System::Oscillator(system), results) => {
            let (system, osc) = (*system, system.oscillator()?);
            let units = if plan.units.is_some() { Units::of_plan(&plan) } else { units };
            let asked = Asked { system, units };
            Ok(Answer::Oscillator(Box::new(oscillator::Answer { asked, osc, results, plan, paper_rule: None })))
        }
        // a plan of a machine has no other result
        (System::Machine(_), _) => Err(vibroimpact_study::PlanError::OfOscillator.into()),
    }
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Oscillator(answer) => answer.serialize(to),
            Self::Machine(answer) => answer.serialize(to),
        }
    }
}

impl Answer {
    /// The plan, [complete](Plan::complete).
    #[must_use]
    pub const fn plan(&self) -> &Plan {
        match self {
            Self::Oscillator(answer) => &answer.plan,
            Self::Machine(answer) => &answer.plan,
        }
    }

    /// The same; a machine has this name.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        if let Self::Machine(answer) = &mut self {
            name.clone_into(&mut answer.name);
        }
        self
    }

    /// The line that the command prints with `--json`, without the line break.
    #[must_use]
    pub fn json(&self) -> String {
        // texts and numbers can always be written as JSON
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The same without what takes longest to compute: the harmonics and the transient of a settled motion.
    #[must_use]
    pub fn brief(&self) -> String {
        match self {
            Self::Oscillator(answer) => answer.brief(),
            Self::Machine(_) => self.json(),
        }
    }

    /// The figure that the command draws with `--plot`. For a settled motion it shows the motion after the transient;
    /// for exponents it shows both sections, if points of them were requested. `None` for a view that the answer does not
    /// have. The orbit diagram behind a branch is computed here.
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be drawn, or when stopped.
    pub fn figure(&self, shown: &Shown, control: &Control<'_>) -> Result<Option<Figure>, AnswerError> {
        match self {
            Self::Oscillator(answer) => answer.figure(shown, control),
            Self::Machine(answer) => answer.figure(shown, control),
        }
    }

    /// The table that the command writes with `--csv`; for a simulation the waveform. `None` for
    /// exponents without points of their sections.
    ///
    /// # Errors
    /// [`AnswerError`] for a result that cannot be tabulated.
    pub fn table(&self, shown: &Shown) -> Result<Option<Table<'_>>, AnswerError> {
        match self {
            Self::Oscillator(answer) => answer.table(shown),
            Self::Machine(answer) => answer.table(shown),
        }
    }
}
