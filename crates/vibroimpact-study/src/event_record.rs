//! An event of a branch as names and numbers, for the JSON of the command and the Python package.

use vibroimpact::Side;
use vibroimpact::continuation::{BranchEvent, Change, SolutionPoint};

/// An event of a branch. Fields that do not apply to its kind are `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventRecord {
    /// Name of the kind of event.
    pub kind: &'static str,
    /// Whether the branch ends at the event.
    pub ends: bool,
    /// The label before the event.
    pub label_before: String,
    /// The label after the event, if the branch continues or leads to a motion with a label.
    pub label_after: Option<String>,
    /// Whether an impact appears or disappears.
    pub change: Option<&'static str>,
    /// Number of the impact in the cycle of the point, counted from 1; `None` if the cycle has no impacts.
    pub impact: Option<usize>,
    /// The stop of the contact.
    pub side: Option<Side>,
    /// The phase of the force at the contact.
    pub phase: Option<f64>,
    /// Whether the parameter turns back at the event.
    pub turns: Option<bool>,
    /// A second grazing contact at the same value: its impact (as above), its stop and its phase.
    pub also: Option<(Option<usize>, Side, f64)>,
}

impl EventRecord {
    /// The record of the event at a point of a branch.
    #[must_use]
    pub fn of(point: &SolutionPoint, event: &BranchEvent) -> Self {
        let label = point.cycle.label.to_string();
        // a cycle without impacts has no impact numbers
        let counted = |impact: usize| (!point.cycle.points.is_empty()).then_some(impact + 1);
        let bare = Self {
            kind: event.name(),
            ends: event.ends(),
            label_after: (!event.ends()).then(|| label.clone()),
            label_before: label.clone(),
            ..Self::default()
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
