//! The points of branches of any system, and their events.

use super::CycleView;
use crate::json::event::side;
use crate::{Asked, BranchQuantity, Units, Varied};
use vibroimpact::Label;
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{BranchEvent, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::Stability;
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{Branches, Chosen, Cut, EventRecord, Followed, OrbitNumber, Origin, Parameter};

/// Branches along a line.
#[derive(Clone, Debug)]
pub struct BranchesView<'a, V> {
    /// The label of the orbit at which the first branch begins.
    pub label: Label,
    /// Which of those with its label it is; `None` for the motion from the start of a machine.
    pub number: Option<OrbitNumber>,
    /// Its stability; `None` for a solution that is not admissible.
    pub stability: Option<Stability>,
    /// The line, and the units of the results.
    pub cut: Cut<V>,
    /// See above.
    pub units: Units,
    /// What stands for each cycle of a machine without stops.
    pub quantity: Option<BranchQuantity<'a>>,
    /// The machine; `None` for an oscillator.
    pub machine: Option<&'a Machine>,
    /// The branches; that of the orbit comes first.
    pub branches: Vec<BranchRows<'a>>,
    /// Events at which a further branch was expected but could not be followed.
    pub lost: Vec<OriginView>,
}

/// One branch.
#[derive(Clone, Debug)]
pub struct BranchRows<'a> {
    /// Where it begins; `None` for the first branch.
    pub origin: Option<OriginView>,
    /// Its points.
    pub points: Vec<PointView<'a>>,
}

/// The event at which a branch begins.
#[derive(Clone, Copy, Debug)]
pub struct OriginView {
    /// The number of the branch on which it lies, counted from 1.
    pub branch: usize,
    /// Its name.
    pub kind: &'static str,
    /// The value of what varies.
    pub value: f64,
}

/// A point of a branch.
#[derive(Clone, Debug)]
pub struct PointView<'a> {
    /// The value of what varies, as the core has it.
    pub(crate) raw: f64,
    /// The values of one or two numbers that vary.
    pub values: Vec<f64>,
    /// The cycle there; at an event the one before it.
    pub cycle: CycleView<'a>,
    /// Whether it is a motion.
    pub admissible: bool,
    /// The event there.
    pub event: Option<Event<'a>>,
}

/// An event of a branch.
#[derive(Clone, Debug)]
pub enum Event<'a> {
    /// On a branch of an oscillator.
    Oscillator {
        /// The point.
        point: &'a SolutionPoint,
        /// The event.
        event: BranchEvent,
    },
    /// On a branch of a machine.
    Machine {
        /// The event.
        event: machine::BranchEvent,
        /// The labels on both sides.
        labels: (Label, Option<String>),
        /// The machine.
        machine: &'a Machine,
    },
}

impl PointView<'_> {
    /// The name of its event; empty if there is none.
    #[must_use]
    pub fn event_name(&self) -> &'static str {
        self.event.as_ref().map_or("", Event::name)
    }

    /// Whether it is a motion that attracts its neighbourhood.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.admissible && self.cycle.stability().is_stable()
    }
}

impl<'a> Event<'a> {
    /// Its name in tables.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Oscillator { event, .. } => event.name(),
            Self::Machine { event, .. } => event.name(),
        }
    }

    /// Whether the branch ends there.
    #[must_use]
    pub fn ends(&self) -> bool {
        match self {
            Self::Oscillator { event, .. } => event.ends(),
            Self::Machine { event, .. } => event.ends(),
        }
    }

    /// Whether what varies reached the end of its range.
    #[must_use]
    pub const fn is_end_of_range(&self) -> bool {
        use machine::BranchEvent as M;
        matches!(
            self,
            Self::Oscillator { event: BranchEvent::EndOfRange, .. } | Self::Machine { event: M::EndOfRange, .. }
        )
    }

    /// Whether only the search for the branch ends there, and nothing happens to the motion.
    #[must_use]
    pub const fn is_end_of_search(&self) -> bool {
        use BranchEvent as E;
        use machine::BranchEvent as M;
        match self {
            Self::Oscillator { event, .. } => {
                matches!(event, E::Closed | E::EndOfRange | E::StepLimit | E::ImpactLimit | E::NoConvergence)
            }
            Self::Machine { event, .. } => {
                matches!(event, M::Closed | M::EndOfRange | M::StepLimit | M::Discontinuity | M::NoConvergence)
            }
        }
    }

    /// Whether a cycle that sticks may have other closings with the same label beyond it.
    pub(crate) const fn changes_closings(&self) -> bool {
        use BranchEvent as E;
        use machine::BranchEvent as M;
        match self {
            Self::Oscillator { event, .. } => matches!(event, E::Grazing { .. } | E::SoftLanding { .. }),
            Self::Machine { event, .. } => {
                matches!(event, M::Grazing { .. } | M::Sticking { .. } | M::Corner { .. } | M::Change { .. })
            }
        }
    }

    /// The labels before and after it. Where only the search ends both are that of the cycle.
    #[must_use]
    pub fn labels(&self) -> (String, String) {
        let (before, after) = match self {
            Self::Oscillator { point, event } => {
                let record = EventRecord::of(point, event);
                (record.label_before, record.label_after)
            }
            Self::Machine { labels: (before, after), .. } => (before.to_string(), after.clone()),
        };
        let after = after.unwrap_or_else(|| before.clone());
        (before, after)
    }

    /// The name of its stop or joint.
    #[must_use]
    pub fn stop(&self) -> Option<&'a str> {
        match self {
            Self::Oscillator { point, event } => EventRecord::of(point, event).side.map(side),
            Self::Machine { event, machine, .. } => event.place().map(|place| machine.name_of(place)),
        }
    }
}

/// The points of a branch of an oscillator along a line.
#[must_use]
pub fn points<'a>(all: &'a [SolutionPoint], cut: &Cut, asked: &Asked) -> Vec<PointView<'a>> {
    all.iter().map(|point| PointView::of_oscillator(point, cut, asked)).collect()
}

/// The points of a branch of a machine along a line. It ends where its orbit ceases to be admissible.
#[must_use]
pub fn machine_points<'a>(
    all: &'a [machine::SolutionPoint],
    cut: &Cut<String>,
    machine: &'a Machine,
) -> Vec<PointView<'a>> {
    (0..all.len()).map(|k| PointView::of_machine(&all[k], all.get(k + 1), (cut, machine))).collect()
}

impl<'a> PointView<'a> {
    fn of_oscillator(point: &'a SolutionPoint, cut: &Cut, Asked { system, units }: &Asked) -> Self {
        let there = units.at(cut.vary, point.value);
        Self {
            raw: point.value,
            values: cut.names().zip(cut.values(point.value)).map(|(of, value)| value * there.of(*of)).collect(),
            cycle: CycleView::of_oscillator(&point.cycle, cut.oscillator(system, point.value).ok(), there),
            admissible: point.physical,
            event: point.event.map(|event| Event::Oscillator { point, event }),
        }
    }

    /// A point and the one after it.
    fn of_machine(
        point: &'a machine::SolutionPoint,
        next: Option<&machine::SolutionPoint>,
        (cut, machine): (&Cut<String>, &'a Machine),
    ) -> Self {
        // a point at an event has the cycle before it
        let after = next.map(|next| next.cycle.label.to_string());
        Self {
            raw: point.value,
            values: cut.values(point.value).collect(),
            cycle: CycleView::of_machine(&point.cycle, machine),
            admissible: true,
            event: point.event.map(|event| Event::Machine { event, labels: (point.cycle.label, after), machine }),
        }
    }
}

impl OriginView {
    fn new(branch: usize, point: &PointView<'_>) -> Self {
        Self { branch: branch + 1, kind: point.event_name(), value: point.values[0] }
    }
}

impl<'a> BranchesView<'a, Parameter> {
    /// The branches of an oscillator.
    #[must_use]
    pub fn of_oscillator(found: &'a Branches, cut: &Cut, asked: &Asked) -> Self {
        let point =
            |origin: &Origin| OriginView::new(origin.branch, &PointView::of_oscillator(&origin.point, cut, asked));
        let branches = Self::rows(found, |all| points(all, cut, asked), point);
        let lost = found.lost.iter().map(point).collect();
        Self { lost, ..Self::new(&found.chosen, found.chosen.cycle.label, (cut, asked.units), branches) }
    }
}

impl<'a> BranchesView<'a, String> {
    /// The branches of a machine.
    #[must_use]
    pub fn of_machine(
        found: &'a Branches<Cycle, machine::SolutionPoint>,
        cut: &Cut<String>,
        (machine, source): (&'a Machine, &'a MachineSource),
    ) -> Self {
        let point = |origin: &Origin<machine::SolutionPoint>| {
            OriginView::new(origin.branch, &PointView::of_machine(&origin.point, None, (cut, machine)))
        };
        let branches = Self::rows(found, |all| machine_points(all, cut, machine), point);
        Self {
            machine: Some(machine),
            quantity: BranchQuantity::of(machine, source, cut, found),
            lost: found.lost.iter().map(point).collect(),
            ..Self::new(&found.chosen, found.chosen.cycle.label, (cut, Units::default()), branches)
        }
    }
}

impl<'a, V: Varied> BranchesView<'a, V> {
    fn new<C>(chosen: &Chosen<C>, label: Label, (cut, units): (&Cut<V>, Units), branches: Vec<BranchRows<'a>>) -> Self {
        Self {
            label,
            number: chosen.among,
            stability: chosen.stability,
            cut: cut.clone(),
            units,
            quantity: None,
            machine: None,
            branches,
            lost: Vec::new(),
        }
    }

    fn rows<C, P>(
        found: &'a Branches<C, P>,
        points: impl Fn(&'a [P]) -> Vec<PointView<'a>>,
        origin: impl Fn(&Origin<P>) -> OriginView,
    ) -> Vec<BranchRows<'a>> {
        let row = |branch: &'a Followed<P>| BranchRows {
            origin: branch.origin.as_ref().map(&origin),
            points: points(&branch.points),
        };
        found.followed.iter().map(row).collect()
    }

    /// The names of what varies in tables.
    pub(crate) fn columns(&self) -> Vec<String> {
        self.cut.names().map(|name| name.column(&self.units).to_owned()).collect()
    }

    /// The points of each branch.
    pub(crate) fn points(&self) -> impl Iterator<Item = &[PointView<'a>]> {
        self.branches.iter().map(|branch| branch.points.as_slice())
    }
}
