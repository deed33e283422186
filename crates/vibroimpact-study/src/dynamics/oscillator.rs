//! An oscillator, as tasks ask for it.

use super::{Dynamics, Setup};
use crate::diagram::{DiagramPoint, Show, carried_state, point, state_on};
use crate::in_memory::{DIAGRAM_TILE, attractors, basin, diagram, map};
use crate::map::options;
use crate::margins::{MotionBox, ParameterMargin, tried_box};
use crate::orbit_line::OrbitLine;
use crate::region::Over;
use crate::simulate::simulate;
use crate::stretch::check_plane;
use crate::study::SweepFill;
use crate::{
    Control, Coordinate, CurvePlan, Cut, FollowedEvent, LyapunovPlan, MarginsPlan, Orbit, Parameter, PlanError,
    PlanResults, Quantity, Results, RunError, ScaledParameter, Scope, SectionPoints, SimulatePlan, Simulated,
    StartPlan, Stopped, Stretch, SystemPlan, Task,
};
use vibroimpact::chaos::{exponents_while, section_while};
use vibroimpact::continuation::{
    BranchError, BranchOptions, Curve, CurveEvent, CurveOptions, CurvePoint, SolutionPoint,
};
use vibroimpact::motion::Event;
use vibroimpact::orbit::{Cycle, FindOptions, Stability, earlier_contact, find_while, refine, without_impacts};
use vibroimpact::quantities::{Quantities, of_cycle, of_verdict};
use vibroimpact::verdict::{Census, Count, NoImpact, SettleOptions, Settled, Verdict, settle_while};
use vibroimpact::{Label, Oscillator, ParameterPath, Start};

/// Two cycles closer than this are the same one.
const SAME: f64 = 1e-6;

/// The values of all quantities.
fn all(of: Quantities) -> Vec<f64> {
    Quantity::ALL.into_iter().map(|quantity| of.get(quantity)).collect()
}

impl SystemPlan {
    /// The oscillator with a start.
    pub(crate) fn setup(&self, start: StartPlan) -> Result<Setup<'_, Self>, PlanError> {
        let system = self.oscillator()?;
        Ok(Setup { written: self, start: start.start(&system)?, system })
    }
}

impl Dynamics for SystemPlan {
    type Name = Parameter;
    type Coordinate = Coordinate;
    type Quantity = Quantity;
    type Shown = Show;
    type System = Oscillator;
    type Start = Start;
    type Event = Event;
    type Along = (Oscillator, ParameterPath);
    type CurvePoint = CurvePoint;
    type Curve = Curve;

    /// The starts of grids are checked with them.
    fn setup_of(&self, task: &Task) -> Result<Setup<'_, Self>, PlanError> {
        self.setup(match task {
            Task::Basin(_) => StartPlan::default(),
            Task::Lyapunov(plan) if !plan.axes.is_empty() => StartPlan::default(),
            task => task.start().copied().flatten().unwrap_or_default(),
        })
    }

    fn placed(_: &Oscillator, mut start: Start, coordinate: &Coordinate, value: f64) -> Result<Start, PlanError> {
        match coordinate {
            Coordinate::X => start.x = value,
            Coordinate::V => start.v = value,
            Coordinate::Phase => start.phase = value,
            Coordinate::Parameter(of) => {
                let (task, known) = ("second start", "x or v");
                return Err(PlanError::WrongAxis { task, name: of.name().into(), known });
            }
        }
        Ok(start)
    }

    fn allowed(osc: &Oscillator, start: Start) -> Result<Start, PlanError> {
        Ok(Start::new(osc, start.x, start.v, start.phase)?)
    }

    fn check_own(of: &Setup<'_, Self>, task: &Task) -> Result<(), PlanError> {
        match task {
            Task::Basin(plan) => plan.typed::<Coordinate, Quantity>()?.check(of.written),
            Task::Map(plan) => plan.typed::<Coordinate, Quantity>()?.check(of.written),
            Task::Diagram(plan) => plan.typed::<Parameter, Show>()?.check(of.written),
            Task::Lyapunov(plan) => plan.typed::<Coordinate>()?.check(of.written),
            Task::Margins(plan) => plan.typed::<Parameter>()?.check(of.written),
            Task::SettleMany(_) => Err(PlanError::OfMachine),
            _ => Ok(()),
        }
    }

    fn own(results: PlanResults) -> Option<Results<Self>> {
        if let PlanResults::Oscillator(own) = results { Some(own) } else { None }
    }

    fn simulate(of: &Setup<'_, Self>, plan: &SimulatePlan, control: &Control<'_>) -> Result<Simulated, RunError> {
        Ok(simulate(&of.system, of.start, plan, control)?)
    }

    fn attractors(
        of: &Setup<'_, Self>,
        starts: (u64, u64),
        options: &SettleOptions,
        control: &Control<'_>,
    ) -> Result<Census, RunError> {
        attractors(of.written, starts, options, control)
    }

    fn exponents(
        of: &Setup<'_, Self>,
        plan: &LyapunovPlan,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Results<Self>, RunError> {
        let (osc, start, stopped) = (&of.system, of.start, Stopped { done: 0, total: 1 });
        let section = |points| section_while(osc, start, plan.lengths().1, points, go_on).ok_or(stopped);
        let section = plan.points.map(section).transpose()?;
        let found = exponents_while(osc, start, &plan.options(), go_on).ok_or(stopped)?;
        Ok(Results::Lyapunov(found, section.map(|section| SectionPoints::of_oscillator(osc, &section))))
    }

    fn over_grid(of: &Setup<'_, Self>, task: &Task, control: &Control<'_>) -> Result<Results<Self>, RunError> {
        let system = of.written;
        Ok(match task {
            Task::Basin(plan) => Results::Basin(basin(system, &plan.typed()?, control)?),
            Task::Map(plan) => Results::Map(map(system, &plan.typed()?, control)?),
            Task::Diagram(plan) => {
                let task = SweepFill::new(system, &plan.typed()?, Some(DIAGRAM_TILE));
                Results::Diagram(diagram(&task, control)?)
            }
            _ => return Err(PlanError::OfMachine.into()),
        })
    }

    fn shown_point(show: &Show, numbers: &[f64]) -> Option<DiagramPoint> {
        point(*show, numbers)
    }

    fn number(&self, name: &Parameter) -> Result<f64, PlanError> {
        self.value(*name)
    }

    fn check_line(&self, cut: &Cut) -> Result<(), PlanError> {
        cut.check(self)
    }

    fn check_ends(&self, cut: &Cut) -> Result<(), PlanError> {
        cut.check(self)
    }

    fn check_curve(kind: FollowedEvent) -> Result<(), PlanError> {
        match kind {
            FollowedEvent::Fold | FollowedEvent::Flip | FollowedEvent::Grazing => Ok(()),
            _ => {
                let known = "its curves are fold, flip and grazing";
                Err(PlanError::refused(format!("an oscillator has no curve of {}; {known}", kind.name())))
            }
        }
    }

    fn check_plane(&self, one: &Stretch, two: &Stretch) -> Result<(), PlanError> {
        check_plane(self, one, two)
    }

    fn over(&self, across: &Stretch, up: &Stretch) -> Result<Over, PlanError> {
        let corner = self.with_all([(across.parameter, across.from), (up.parameter, up.from)])?;
        Ok(Over::Oscillators(corner.oscillator()?, across.frame(up, self)?))
    }

    fn line(&self, cut: &Cut, from: f64, points: u32) -> Result<OrbitLine<Self::Along>, PlanError> {
        let own = self.value(cut.vary).is_ok_and(|own| own == from);
        let osc = if own { self.oscillator()? } else { cut.oscillator(self, from)? };
        let path = cut.varying(self, from)?;
        // the inverse of a value may be rounded to a value outside the range
        let begin = path.get(&osc)?;
        let end = |end: f64| if end == from { begin } else { end };
        Ok(OrbitLine::over((osc, path), (end(cut.ends.0), end(cut.ends.1)), points))
    }

    fn system_on(&self, cut: &Cut, _: &OrbitLine<Self::Along>, value: f64) -> Option<Oscillator> {
        cut.oscillator(self, value).ok()
    }

    fn label(_: &Oscillator, text: Option<&str>, in_a_plane: bool) -> Result<Option<Label>, PlanError> {
        let label: Label = text.ok_or(PlanError::NoLabel)?.parse()?;
        if in_a_plane && label.impacts == Count::Infinite {
            return Err(BranchError::Rests.into());
        }
        Ok(Some(label))
    }

    fn orbits(osc: &Oscillator, label: Label, go_on: &dyn Fn() -> bool) -> Result<Vec<Orbit>, RunError> {
        let found = find_while(osc, label, FindOptions::default(), go_on).ok_or(Stopped { done: 0, total: 1 })?;
        let orbit =
            |of: vibroimpact::orbit::Orbit| Orbit { cycle: of.cycle, admissible: of.physical, earlier: of.earlier };
        Ok(found.into_iter().map(orbit).collect())
    }

    /// Without damping, motions without impacts are no single cycle.
    fn check_followed(osc: &Oscillator, label: Label) -> Result<(), PlanError> {
        let free = label.impacts == Count::Finite(0) && osc.damping() == 0.0;
        if free { Err(BranchError::Undamped.into()) } else { Ok(()) }
    }

    fn no_orbit(label: Label, others: usize) -> PlanError {
        PlanError::NoOrbit { label, others }
    }

    fn settle(
        osc: &Oscillator,
        start: &Start,
        impacts: Option<u32>,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Settled, RunError> {
        let settled = settle_while(osc, *start, &options(impacts), go_on);
        settled.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
    }

    fn stability(cycle: &Cycle) -> Stability {
        cycle.stability()
    }

    /// The motion without impacts is a cycle if it is damped.
    fn cycle(osc: &Oscillator, motion: &Verdict) -> Option<Cycle> {
        match motion {
            Verdict::Periodic(cycle) => Some(cycle.clone()),
            Verdict::NoImpact(NoImpact::Landing { .. }) => None,
            Verdict::NoImpact(_) => without_impacts(osc).filter(|cycle| earlier_contact(osc, cycle).is_none()),
            _ => None,
        }
    }

    fn free_numbers(&self) -> Result<Vec<Parameter>, PlanError> {
        Ok(MarginsPlan::parameters(self))
    }

    fn scope(&self, varied: &ScaledParameter, within: f64) -> Result<Scope, PlanError> {
        Scope::new(self, *varied, within)
    }

    fn motion_box(
        &self,
        cycle: &Cycle,
        margins: &[ParameterMargin],
        plan: &MarginsPlan,
        control: &Control<'_>,
    ) -> Result<Option<MotionBox>, RunError> {
        if !cycle.stable() {
            return Ok(None);
        }
        Ok(Some(tried_box(self, cycle, margins, plan.lines(), control)?))
    }

    fn carried(
        of: &Setup<'_, Self>,
        cut: &Cut,
        before: Option<(f64, Start)>,
        (value, osc): (f64, &Oscillator),
    ) -> Result<Start, PlanError> {
        let Some((from, left)) = before else { return Ok(Start::at_rest(osc)) };
        carried_state(left, &cut.system(of.written, from)?, &cut.system(of.written, value)?)
    }

    fn reached(osc: &Oscillator, motion: &Verdict, start: Start) -> Start {
        state_on(osc, motion, start)
    }

    fn quantity_names(_: &Oscillator) -> Vec<String> {
        Quantity::ALL.map(|quantity| quantity.name().to_owned()).to_vec()
    }

    fn quantity(_: &Oscillator, given: Option<&Quantity>) -> Result<String, PlanError> {
        Ok(given.map_or(Quantity::DisplacementAmplitude, |given| *given).name().to_owned())
    }

    fn quantities(osc: &Oscillator, motion: &Verdict) -> Option<Vec<f64>> {
        of_verdict(osc, motion).map(all)
    }

    fn cycle_quantities(osc: &Oscillator, cycle: &Cycle) -> Option<Vec<f64>> {
        of_cycle(osc, cycle).map(all)
    }

    /// Newton's method from one of the points leads to the cycle.
    fn passes(osc: &Oscillator, cycle: &Cycle, between: [&SolutionPoint; 2]) -> bool {
        between.into_iter().any(|point| {
            let guess = &point.cycle;
            if guess.label != cycle.label {
                return false;
            }
            if guess.points.is_empty() || !cycle.rests.is_empty() {
                // the only motion of its label: the steady one, or that of a release
                return guess.rests.len() == cycle.rests.len();
            }
            refine(osc, guess).is_some_and(|orbit| orbit.cycle.same_as(cycle, SAME))
        })
    }

    fn line_of_events(of: &Setup<'_, Self>, plan: &CurvePlan) -> Result<(OrbitLine<Self::Along>, f64), PlanError> {
        let of_body = plan.vary.of_body().or(plan.and.of_body());
        let path = match (of.written.body.filter(|_| of_body.is_some()), plan.vary.parameter.of_oscillator()) {
            (Some(body), _) => body.line(plan.vary.parameter, None)?,
            (None, Some(parameter)) => parameter.into(),
            (None, None) => return Err(PlanError::NoBody(plan.vary.parameter.name())),
        };
        let own = path.get(&of.system)?;
        // the inverse of a value at an end of the range may be rounded to a value outside
        let range = (plan.vary.from.min(own), plan.vary.to.max(own));
        Ok((OrbitLine::over((of.system, path), range, BranchOptions::default().points), own))
    }

    fn curve(
        of: &Setup<'_, Self>,
        plan: &CurvePlan,
        line: OrbitLine<Self::Along>,
        event: &SolutionPoint,
    ) -> Result<([Curve; 2], Vec<usize>), PlanError> {
        let usual = CurveOptions::default();
        let options = CurveOptions { points: plan.points.unwrap_or(usual.points), ..usual };
        let there = of.written.with_all([(plan.vary.parameter, event.value)])?;
        let frame = plan.vary.frame(&plan.and, &there)?;
        Ok((Curve::through(&of.system, event, line.along.1, &frame, options)?, Vec::new()))
    }

    fn curve_event(point: &CurvePoint) -> Option<CurveEvent> {
        point.event
    }
}

/// An oscillator that starts at rest.
#[cfg(test)]
pub(crate) fn at_rest(system: &SystemPlan) -> Setup<'_, SystemPlan> {
    system.setup(StartPlan::default()).unwrap()
}
