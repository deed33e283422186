//! A machine, as tasks ask for it.

use super::{Dynamics, Setup};
use crate::diagram::{DiagramPoint, machine_point};
use crate::in_memory::{DIAGRAM_TILE, diagram, machine_attractors, machine_basin, machine_map, machine_points};
use crate::lyapunov::section;
use crate::machine::{MachineSource, StartAxis, VariedMachine};
use crate::map::options;
use crate::margins::{MotionBox, ParameterMargin};
use crate::orbit_line::OrbitLine;
use crate::region::Over;
use crate::simulate::simulate_machine;
use crate::study::SweepFill;
use crate::{
    Control, CurvePlan, Cut, DEFAULT_BRANCH_POINTS, FollowedEvent, LyapunovPlan, MarginsPlan, Orbit, PlanError,
    PlanResults, Results, RunError, ScaledParameter, Scope, SimulatePlan, Simulated, Stopped, Stretch, Task,
};
use vibroimpact::Label;
use vibroimpact::chaos::machine_exponents_while;
use vibroimpact::continuation::machine::{Curve, CurvePoint, Family, Plane, SolutionPoint};
use vibroimpact::continuation::{BranchOptions, CurveEvent, CurveKind, CurveOptions};
use vibroimpact::events::{Event, Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineError};
use vibroimpact::orbit::{Stability, find_machine_while, machine::Cycle};
use vibroimpact::quantities::machine::Quantities;
use vibroimpact::quantities::{
    machine_cycle_quantities, machine_quantities, machine_quantity, machine_quantity_paths, machine_response_quantity,
};
use vibroimpact::verdict::{Census, SettleOptions, Settled, Verdict, scattered_machine_starts, settle_machine_while};

/// Starts of the search for orbits.
const STARTS: u64 = 48;
/// How often the end of a range is moved half way to the value, while no machine has it.
const HALVINGS: u32 = 12;
/// The longest step along a curve: longer than that of an oscillator, because a point takes more work.
const LONGEST: f64 = 0.1;
/// Two speeds that differ by less than this part of them are equal.
const CLOSE: f64 = 1e-6;

/// The error of a machine or a start that is not allowed.
pub(crate) fn refused(error: MachineError) -> PlanError {
    PlanError::Machine(error.into())
}

/// The label of an orbit of a machine: m/n with forcing, m/T without.
///
/// # Errors
/// [`PlanError`] for a text that is no such label.
pub fn machine_label(machine: &Machine, text: &str) -> Result<Label, PlanError> {
    let refused = |what: &str| {
        let given: String = text.chars().take(40).collect();
        PlanError::refused(format!("label `{given}` is {what}"))
    };
    match (machine.period().is_some(), Label::unforced(text)) {
        (false, label) => label.ok_or_else(|| {
            refused("not m/T with m a whole number from 0 to 10000 (or inf/T), and the machine has no forcing\nhint: m closings in one period T of the motion, for example 2/T")
        }),
        (true, Some(_)) => Err(refused(
            "one of a machine without forcing, and the machine has a forcing\nhint: m/n for m closings in n forcing periods, for example 2/1",
        )),
        (true, None) => Ok(text.parse()?),
    }
}

/// The plane of two numbers over their ranges.
fn plane(source: &MachineSource, one: &Stretch<String>, two: &Stretch<String>) -> Plane {
    let corners: Vec<Vec<f64>> =
        [one.from, one.to].iter().flat_map(|p| [vec![*p, two.from], vec![*p, two.to]]).collect();
    let varied = VariedMachine::new(source, [one, two].into_iter().map(|side| side.parameter.as_str()), &corners);
    let family = varied.family(|values: [f64; 2]| values.to_vec());
    Plane::of(family, (one.from..=one.to, two.from..=two.to))
}

/// The values of all quantities.
fn all(found: &Quantities) -> Vec<f64> {
    found.iter().map(|(.., of)| of.value).collect()
}

impl Dynamics for MachineSource {
    type Name = String;
    type Coordinate = String;
    type Quantity = String;
    type Shown = String;
    type System = Machine;
    type Start = Start;
    type Event = Event;
    type Along = Family;
    type CurvePoint = CurvePoint;
    type Curve = Curve;

    fn setup_of(&self, task: &Task) -> Result<Setup<'_, Self>, PlanError> {
        if task.start().is_some_and(Option::is_some) {
            let sentence = "the start of a machine is its table `start`, and the task has one too";
            return Err(PlanError::refused(sentence));
        }
        let (system, start) = self.described()?;
        Ok(Setup { written: self, system, start })
    }

    fn placed(machine: &Machine, mut start: Start, path: &String, value: f64) -> Result<Start, PlanError> {
        StartAxis::of(machine, path)?.set(&mut start, value);
        // contacts and digits belong to the state before
        Ok(Start { contacts: Vec::new(), exact: Vec::new(), ..start })
    }

    fn allowed(machine: &Machine, start: Start) -> Result<Start, PlanError> {
        Motion::new(machine, &start, Limits::default()).map_err(refused)?;
        Ok(start)
    }

    fn check_own(of: &Setup<'_, Self>, task: &Task) -> Result<(), PlanError> {
        let (source, machine) = (of.written, &of.system);
        let own_starts = match task {
            Task::Map(_) | Task::Diagram(_) | Task::Response(_) | Task::SettleMany(_) => true,
            Task::Lyapunov(plan) => !plan.axes.is_empty(),
            _ => false,
        };
        // points with starts of their own do not need that of the machine
        if !own_starts {
            Motion::new(machine, &of.start, Limits::default()).map_err(refused)?;
        }
        match task {
            Task::Simulate(SimulatePlan { periods: Some(_), .. }) if machine.period().is_none() => {
                Err(PlanError::Unforced)
            }
            Task::Basin(plan) => plan.typed::<String, String>()?.check(machine),
            Task::Map(plan) => plan.typed::<String, String>()?.check(source),
            Task::Diagram(plan) => plan.typed::<String, String>()?.check(source),
            Task::Lyapunov(plan) => plan.typed::<String>()?.check(source, machine),
            Task::Margins(plan) => plan.typed::<String>()?.check(of),
            Task::SettleMany(plan) => plan.typed::<String>()?.check(source, machine),
            _ => Ok(()),
        }
    }

    fn own(results: PlanResults) -> Option<Results<Self>> {
        if let PlanResults::Machine(own) = results { Some(own) } else { None }
    }

    fn simulate(
        of: &Setup<'_, Self>,
        plan: &SimulatePlan,
        control: &Control<'_>,
    ) -> Result<Simulated<Event>, RunError> {
        simulate_machine(&of.system, &of.start, plan, control)
    }

    fn attractors(
        of: &Setup<'_, Self>,
        starts: (u64, u64),
        options: &SettleOptions,
        control: &Control<'_>,
    ) -> Result<Census<Machine>, RunError> {
        machine_attractors(&of.system, starts, options, control)
    }

    fn exponents(
        of: &Setup<'_, Self>,
        plan: &LyapunovPlan<String>,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Results<Self>, RunError> {
        let (machine, start, lengths) = (&of.system, &of.start, plan.events());
        let found = machine_exponents_while(machine, start, lengths, go_on).map_err(refused)?;
        let found = found.ok_or(Stopped { done: 0, total: 1 })?;
        let sections = |points| section(machine, start, (u64::from(lengths.1), points), go_on);
        Ok(Results::Lyapunov(found, plan.points.map(sections).transpose()?))
    }

    fn over_grid(of: &Setup<'_, Self>, task: &Task, control: &Control<'_>) -> Result<Results<Self>, RunError> {
        let (source, problem) = (of.written, (&of.system, &of.start));
        Ok(match task {
            Task::Basin(plan) => Results::Basin(machine_basin(problem, &plan.typed()?, control)?),
            Task::Map(plan) => Results::Map(machine_map(source, &plan.typed()?, control)?),
            Task::SettleMany(plan) => Results::Map(machine_points(source, problem, &plan.typed()?, control)?),
            Task::Diagram(plan) => {
                let task = SweepFill::new(source, &plan.typed()?, Some(DIAGRAM_TILE));
                Results::Diagram(diagram(&task, control)?)
            }
            other => return Err(PlanError::NoMachineStudy(other.verb()).into()),
        })
    }

    fn shown_point(show: &String, numbers: &[f64]) -> Option<DiagramPoint> {
        machine_point(show, numbers)
    }

    fn number(&self, name: &String) -> Result<f64, PlanError> {
        Ok(Self::number(self, name)?)
    }

    fn check_line(&self, cut: &Cut<String>) -> Result<(), PlanError> {
        cut.check(self)
    }

    fn check_ends(&self, cut: &Cut<String>) -> Result<(), PlanError> {
        let there = |value| Ok(cut.source(self, value)?.machine().map(drop)?);
        there(cut.ends.0).and_then(|()| there(cut.ends.1))
    }

    fn check_curve(_: FollowedEvent) -> Result<(), PlanError> {
        Ok(())
    }

    fn check_plane(&self, one: &Stretch<String>, two: &Stretch<String>) -> Result<(), PlanError> {
        for Stretch { parameter: path, from, to } in [one, two] {
            Self::number(self, path)?;
            if !(from.is_finite() && to.is_finite() && from < to) {
                return Err(PlanError::no_range(path, (*from, *to)));
            }
        }
        if one.parameter == two.parameter {
            return Err(PlanError::SameParameter(one.parameter.clone().into(), two.parameter.clone().into()));
        }
        for p in [one.from, one.to] {
            for q in [two.from, two.to] {
                self.with(&one.parameter, p)?.with(&two.parameter, q)?.machine()?;
            }
        }
        Ok(())
    }

    fn over(&self, across: &Stretch<String>, up: &Stretch<String>) -> Result<Over, PlanError> {
        let plane = plane(self, across, up);
        Ok(match plane.reduced((across.from, up.from)) {
            Some((osc, frame)) => Over::Oscillators(osc, frame),
            None => Over::Machines(plane),
        })
    }

    fn line(&self, cut: &Cut<String>, _: f64, points: u32) -> Result<OrbitLine<Family>, PlanError> {
        Ok(OrbitLine::new(self, cut, points))
    }

    fn system_on(&self, _: &Cut<String>, line: &OrbitLine<Family>, value: f64) -> Option<Machine> {
        line.along.at(value)
    }

    fn label(machine: &Machine, text: Option<&str>, _: bool) -> Result<Option<Label>, PlanError> {
        text.map(|text| machine_label(machine, text)).transpose()
    }

    /// From scattered starts.
    fn orbits(machine: &Machine, label: Label, go_on: &dyn Fn() -> bool) -> Result<Vec<Orbit<Cycle>>, RunError> {
        let starts = (0..STARTS).map(|k| scattered_machine_starts(machine, 1, k));
        let found = find_machine_while(machine, label, starts, go_on).ok_or(Stopped { done: 0, total: 1 })?;
        // others are not found
        Ok(found.into_iter().map(|cycle| Orbit { cycle, admissible: true, earlier: None }).collect())
    }

    fn no_orbit(label: Label, _: usize) -> PlanError {
        let hint = "`vibro attractors --machine` lists the stable ones";
        PlanError::refused(format!("no orbit {label} was found at this machine\nhint: {hint}"))
    }

    fn settle(
        machine: &Machine,
        start: &Start,
        impacts: Option<u32>,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Settled<Machine>, RunError> {
        let settled = settle_machine_while(machine, start, &options(impacts), go_on);
        settled.map_err(refused)?.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
    }

    fn stability(cycle: &Cycle) -> Stability {
        cycle.stability()
    }

    fn cycle(_: &Machine, motion: &Verdict<Machine>) -> Option<Cycle> {
        if let Verdict::Periodic(cycle) = motion { Some(cycle.clone()) } else { None }
    }

    fn free_numbers(&self) -> Result<Vec<String>, PlanError> {
        Ok(Self::free_numbers(self)?.0.into_iter().map(|(path, _)| path).collect())
    }

    /// The change that counts as 1 is the size of the value. The range ends where no machine has such a number, as where two stops
    /// leave no room.
    fn scope(&self, varied: &ScaledParameter<String>, within: f64) -> Result<Scope<String>, PlanError> {
        let path = &varied.parameter;
        let value = Self::number(self, path)?;
        let ends = match value {
            _ if path.ends_with(".restitution") => [0.0, 1.0],
            0.0 => [1.0 - within, within - 1.0],
            _ => [(value / within).min(value * within), (value / within).max(value * within)],
        };
        let allowed = |mut end: f64| {
            let there = |end: f64| self.with(path, end).is_ok_and(|source| source.machine().is_ok());
            for _ in 0..HALVINGS {
                if there(end) {
                    return end;
                }
                end = value + 0.5 * (end - value);
            }
            value
        };
        let [low, high] = ends.map(allowed);
        let scale = if value == 0.0 { 1.0 } else { value.abs() };
        Ok(Scope { parameter: path.clone(), value, low, high, scale })
    }

    /// None is looked for.
    fn motion_box(
        &self,
        _: &Cycle,
        _: &[ParameterMargin<String, SolutionPoint>],
        _: &MarginsPlan<String>,
        _: &Control<'_>,
    ) -> Result<Option<MotionBox>, RunError> {
        Ok(None)
    }

    fn carried(
        of: &Setup<'_, Self>,
        _: &Cut<String>,
        before: Option<(f64, Start)>,
        (_, machine): (f64, &Machine),
    ) -> Result<Start, PlanError> {
        Ok(before.map_or_else(|| of.start.clone(), |(_, left)| left).within_stops(machine))
    }

    fn reached(machine: &Machine, motion: &Verdict<Machine>, start: Start) -> Start {
        motion.reached(machine).unwrap_or(start)
    }

    fn quantity_names(machine: &Machine) -> Vec<String> {
        machine_quantity_paths(machine)
    }

    fn quantity(machine: &Machine, given: Option<&String>) -> Result<String, PlanError> {
        let path = given.map_or_else(|| machine_response_quantity(machine), Clone::clone);
        machine_quantity(machine, &path).map_err(refused)?;
        Ok(path)
    }

    fn quantities(machine: &Machine, motion: &Verdict<Machine>) -> Option<Vec<f64>> {
        machine_quantities(machine, motion).as_ref().map(all)
    }

    fn cycle_quantities(machine: &Machine, cycle: &Cycle) -> Option<Vec<f64>> {
        machine_cycle_quantities(machine, cycle).as_ref().map(all)
    }

    /// The points differ from the cycle by no more than from each other.
    fn passes(_: &Machine, cycle: &Cycle, between: [&SolutionPoint; 2]) -> bool {
        let speeds = between.map(|point| point.cycle.fastest());
        let apart = (speeds[0] - speeds[1]).abs() + CLOSE * cycle.fastest();
        between.iter().any(|point| point.cycle.label == cycle.label && point.cycle.counts == cycle.counts)
            && speeds.iter().all(|speed| (speed - cycle.fastest()).abs() <= apart)
    }

    fn line_of_events(of: &Setup<'_, Self>, plan: &CurvePlan<String>) -> Result<(OrbitLine<Family>, f64), PlanError> {
        let cut = Cut { vary: plan.vary.parameter.clone(), ends: (plan.vary.from, plan.vary.to), also: None };
        let line = OrbitLine::new(of.written, &cut, BranchOptions::default().points);
        Ok((line, Self::number(of.written, &cut.vary)?))
    }

    fn curve(
        of: &Setup<'_, Self>,
        plan: &CurvePlan<String>,
        _: OrbitLine<Family>,
        event: &SolutionPoint,
    ) -> Result<([Curve; 2], Vec<usize>), PlanError> {
        let plane = plane(of.written, &plan.vary, &plan.and);
        let at = (event.value, Self::number(of.written, &plan.and.parameter)?);
        let options = CurveOptions { longest: LONGEST, points: plan.points.unwrap_or(DEFAULT_BRANCH_POINTS) };
        let both = Curve::through(&plane, at, event, options)?;
        let places = match both[0].kind() {
            CurveKind::Grazing { stop } | CurveKind::Sticking { stop } => vec![stop],
            CurveKind::Holding { joint } => vec![joint],
            CurveKind::Corner { first, second } => vec![first, second],
            _ => Vec::new(),
        };
        Ok((both, places))
    }

    fn curve_event(point: &CurvePoint) -> Option<CurveEvent> {
        point.event
    }
}
