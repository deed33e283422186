//! An event of a branch in plain words and numbers: what the command's JSON and the Python package tell of it.

use vibroimpact::Side;
use vibroimpact::continuation::{BranchEvent, Change, SolutionPoint};

/// An event, with what its kind has to tell; the rest is absent.
#[derive(Clone, Debug, PartialEq)]
pub struct EventRecord {
    /// Its name.
    pub kind: &'static str,
    /// Whether the branch ends there.
    pub ends: bool,
    /// The label before it.
    pub label_before: String,
    /// The label after it, where the branch goes on or leads to a motion with a name.
    pub label_after: Option<String>,
    /// Whether an impact appears or disappears.
    pub change: Option<&'static str>,
    /// Which impact of the point's cycle, counted from 1; none where the cycle has none.
    pub impact: Option<usize>,
    /// At which stop.
    pub side: Option<Side>,
    /// At which phase of the force.
    pub phase: Option<f64>,
    /// Whether the parameter turns back.
    pub turns: Option<bool>,
    /// Another touch at the same value: its impact, as above, its stop and its phase.
    pub also: Option<(Option<usize>, Side, f64)>,
}

impl EventRecord {
    /// What there is to tell of an event at a point of a branch.
    #[must_use]
    pub fn of(point: &SolutionPoint, event: &BranchEvent) -> Self {
        let label = point.cycle.label.to_string();
        // where there are none, none is counted
        let counted = |impact: usize| (!point.cycle.points.is_empty()).then_some(impact + 1);
        let bare = Self {
            kind: event.name(),
            ends: event.ends(),
            label_after: (!event.ends()).then(|| label.clone()),
            label_before: label.clone(),
            change: None,
            impact: None,
            side: None,
            phase: None,
            turns: None,
            also: None,
        };
        match *event {
            BranchEvent::Grazing { change, impact, side, phase, before, after, turns, also } => Self {
                label_before: before.to_string(),
                label_after: Some(after.to_string()),
                change: Some(match change {
                    Change::Appears => "appears",
                    Change::Disappears => "disappears",
                }),
                impact: counted(impact),
                side: Some(side),
                phase: Some(phase),
                turns: Some(turns),
                also: also.map(|touch| (counted(touch.impact), touch.side, touch.phase)),
                ..bare
            },
            BranchEvent::SoftLanding { impact, side, phase, before, after } => Self {
                label_before: before.to_string(),
                label_after: Some(after.to_string()),
                impact: Some(impact + 1),
                side: Some(side),
                phase: Some(phase),
                ..bare
            },
            BranchEvent::Chatter { side, phase, before } => Self {
                label_before: before.to_string(),
                label_after: Some(label),
                side: Some(side),
                phase: Some(phase),
                ..bare
            },
            BranchEvent::LossOfContact { side, phase } | BranchEvent::EndOfRest { side, phase } => {
                Self { side: Some(side), phase: Some(phase), ..bare }
            }
            BranchEvent::RestForEver { side } => Self { side: Some(side), ..bare },
            BranchEvent::Stick { impact } => Self { impact: Some(impact + 1), ..bare },
            _ => bare,
        }
    }
}
