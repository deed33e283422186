//! The figure of a refined map or basin: points between others that agree are not computed.

use crate::figure::stored::figure_with;
use crate::{AnswerError, Shown};
use core::convert::Infallible;
use vibroimpact_plot::Figure;
use vibroimpact_study::study::{Sheet, StudyArrays, StudyPlan, in_memory};
use vibroimpact_study::{Column, Control, Plan, Study};

/// The arrays of a study in memory.
struct Arrays {
    plan: StudyPlan,
    sheet: Sheet,
}

impl StudyArrays for Arrays {
    type Error = Infallible;

    fn plan(&self) -> &StudyPlan {
        &self.plan
    }

    fn study(&self) -> &Study {
        &self.sheet.study
    }

    fn array(&self, field: usize) -> Result<Column, Infallible> {
        Ok(self.sheet.columns[field].clone())
    }
}

/// The figure that the command draws from a store with the tiles of this plan, which are computed in memory.
///
/// # Errors
/// [`AnswerError`] for an invalid plan, a plan without a grid, or when stopped.
pub fn refined_figure(plan: &Plan, shown: &Shown, control: &Control<'_>) -> Result<Figure, AnswerError> {
    let plan = plan.canonical()?;
    let sheet = in_memory(Study::new(&plan)?, control)?;
    let arrays = Arrays { plan: StudyPlan::from(&plan), sheet };
    figure_with(&arrays, shown.colour.as_ref(), (shown.stripes, shown.boundaries))
}

impl From<Infallible> for AnswerError {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}
