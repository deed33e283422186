//! The regions of a plane of two parameters in which a motion exists and in which it is stable.

use crate::dynamics::{Dynamics, Setup};
use crate::name::{Name, renamed};
use crate::{Control, Parameter, PlanError, RunError, Stretch, SystemPlan, limits, tiles};
use serde::{Deserialize, Serialize};
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{BranchError, Frame, Region, RegionKind, RegionOptions, region_while};
use vibroimpact::verdict::Count;
use vibroimpact::{Label, Oscillator};

/// Default number of grid points, in each direction, at which orbits are searched.
pub const DEFAULT_GRID: u32 = 24;
/// Largest allowed number of grid points in each direction.
const MOST_GRID: u32 = 400;

/// The regions of a motion in a plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "RegionPlan", bound = "V: Name")]
pub struct RegionPlan<V = Parameter> {
    /// The label m/n of the motion.
    pub label: String,
    /// The number on the abscissa and its range.
    pub across: Stretch<V>,
    /// The number on the ordinate and its range.
    pub up: Stretch<V>,
    /// Number of points of the grid in each direction at which orbits are searched, 2 to 400. Parts of the region between its
    /// points may be missed.
    #[serde(default = "grid")]
    pub grid: u32,
}

pub(crate) const fn grid() -> u32 {
    DEFAULT_GRID
}

renamed!(RegionPlan: names, parts across up, others label grid);

impl<V> RegionPlan<V> {
    /// Whether it is the motion without impacts, whose region follows from its amplitude.
    #[must_use]
    pub fn clears(&self) -> bool {
        self.label.parse() == Ok(Label::new(0, 1))
    }
}

impl<V: Name> RegionPlan<V> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check<D: Dynamics<Name = V>>(&self, of: &Setup<'_, D>) -> Result<(), PlanError> {
        limits::check("grid", self.grid, 2..=MOST_GRID)?;
        of.written.check_plane(&self.across, &self.up)?;
        self.label(of, &of.written.over(&self.across, &self.up)?).map(|_| ())
    }

    /// The label. Cycles of oscillators with a rest are not followed.
    fn label<D: Dynamics<Name = V>>(&self, of: &Setup<'_, D>, over: &Over) -> Result<Label, PlanError> {
        match over {
            Over::Oscillators(..) => followable(&self.label),
            Over::Machines(_) => D::label(&of.system, Some(&self.label), true)?.ok_or(PlanError::NoLabel),
        }
    }

    /// Whether the motion loses no energy anywhere in the plane. It is then neutrally stable and has no region of
    /// stability.
    #[must_use]
    pub fn neutral<D: Dynamics<Name = V>>(&self, system: &D) -> bool {
        let Ok(Over::Oscillators(osc, frame)) = system.over(&self.across, &self.up) else { return false };
        let loses = |osc: &Oscillator| osc.stops().any(|(_, stop)| stop.restitution < 1.0);
        frame.everywhere(&osc, |osc| osc.damping() == 0.0 && (self.clears() || !loses(osc)))
    }
}

/// The label of an orbit of an oscillator, which can be followed in two parameters.
fn followable(text: &str) -> Result<Label, PlanError> {
    let label: Label = text.parse()?;
    if label.impacts == Count::Infinite { Err(BranchError::Rests.into()) } else { Ok(label) }
}

/// The regions of one motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Regions {
    /// The region where it exists.
    pub existence: Region,
    /// The region where it exists and is stable.
    pub stability: Region,
}

/// The data common to the regions of several motions in one plane.
struct Plane {
    over: Over,
    options: RegionOptions,
}

/// The systems of a plane.
pub enum Over {
    /// Oscillators, of machines too where all of them are.
    Oscillators(Oscillator, Frame),
    /// Machines.
    Machines(machine::Plane),
}

/// The label of a motion, the cycles of machines with it, and which of its regions is computed.
type Wanted<'a> = (Label, Option<&'a machine::Seeds>, RegionKind);

impl Over {
    /// The cycles from which both regions of a motion of machines begin.
    fn seeds(&self, label: Label, options: RegionOptions, control: &Control<'_>) -> Option<machine::Seeds> {
        let Self::Machines(plane) = self else { return None };
        plane.seeds_while(label, options, &|| !control.stopping())
    }

    fn region(
        &self,
        (label, seeds): (Label, Option<&machine::Seeds>),
        kind: RegionKind,
        options: RegionOptions,
        control: &Control<'_>,
    ) -> Option<Region> {
        let go_on = || !control.stopping();
        match self {
            Self::Oscillators(osc, frame) => region_while(osc, label, kind, frame, options, &go_on),
            Self::Machines(plane) => plane.region_from(seeds?, kind, options, &go_on),
        }
    }
}

impl Plane {
    fn new<D: Dynamics>(
        system: &D,
        (across, up): (&Stretch<D::Name>, &Stretch<D::Name>),
        grid: u32,
    ) -> Result<Self, PlanError> {
        let options = RegionOptions { grid: (grid, grid), ..RegionOptions::default() };
        Ok(Self { over: system.over(across, up)?, options })
    }

    /// Both regions of one motion.
    fn both(&self, label: Label, control: &Control<'_>) -> Result<Regions, RunError> {
        let seeds = self.over.seeds(label, self.options, control);
        let wanted = [RegionKind::Existence, RegionKind::Stability].map(|kind| (label, seeds.as_ref(), kind));
        let mut both = self.regions(&wanted, control)?.into_iter();
        let mut next = || both.next().unwrap_or(Region { polygons: Vec::new(), unresolved: Vec::new() });
        Ok(Regions { existence: next(), stability: next() })
    }

    /// Computes several regions, each on a thread of its own.
    fn regions(&self, wanted: &[Wanted<'_>], control: &Control<'_>) -> Result<Vec<Region>, RunError> {
        let each = tiles(wanted.len() as u64, 1, control, |range, tick| {
            // one region for each tile
            let (label, seeds, kind) = wanted[usize::try_from(range.start).unwrap_or(0)];
            let region = self.over.region((label, seeds), kind, self.options, control);
            if region.is_some() {
                tick();
            }
            region
        })?;
        // all regions are present: if one were missing, `tiles` would have returned an error
        Ok(each.into_iter().collect::<Option<_>>().unwrap_or_default())
    }
}

/// The regions of stability of several motions, as lines over a map. They are not the result of a plan, because a
/// region plan has only one motion.
///
/// # Errors
/// [`RunError`] for an invalid label or plane, or when stopped. The stop flag is read at every point of the grid and at
/// every step.
pub fn stability_regions(
    system: &SystemPlan,
    labels: &[String],
    (across, up): (&Stretch, &Stretch),
    grid: u32,
    control: &Control<'_>,
) -> Result<Vec<Region>, RunError> {
    system.check_plane(across, up)?;
    let wanted = labels.iter().map(|label| Ok((followable(label)?, None, RegionKind::Stability)));
    let wanted = wanted.collect::<Result<Vec<_>, PlanError>>()?;
    Plane::new(system, (across, up), grid)?.regions(&wanted, control)
}

/// Computes both regions.
///
/// # Errors
/// [`RunError`] when stopped. The stop flag is read at every point of the grid and at every step.
pub(crate) fn regions<D: Dynamics>(
    of: &Setup<'_, D>,
    plan: &RegionPlan<D::Name>,
    control: &Control<'_>,
) -> Result<Regions, RunError> {
    let plane = Plane::new(of.written, (&plan.across, &plan.up), plan.grid)?;
    plane.both(plan.label(of, &plane.over)?, control)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::at_rest;
    use crate::machine::{MachineSource, no_files};
    use crate::{Plan, PlanResults, Results, run};

    fn plan() -> (SystemPlan, RegionPlan) {
        let system = SystemPlan::from_inverse_beta(1.05, 1.0, 0.5);
        let across = Stretch { parameter: Parameter::InverseBeta, from: 1.05, to: 1.2 };
        let up = Stretch { parameter: Parameter::Gap, from: 1.0, to: 2.5 };
        (system, RegionPlan { label: "1/1".into(), across, up, grid: 5 })
    }

    /// 1/1 flips at 1.829: stable below, unstable above. The result is the same for any number of threads.
    #[test]
    fn one_impact_a_period_about_its_flip() {
        let (system, plan) = plan();
        let found = regions(&at_rest(&system), &plan, &Control { threads: 1, ..Control::default() }).unwrap();
        for (gap, stable) in [(1.828, true), (1.830, false)] {
            assert!(found.existence.contains((1.11, gap)));
            assert_eq!(found.stability.contains((1.11, gap)), stable, "{gap}");
        }
        assert_eq!(regions(&at_rest(&system), &plan, &Control { threads: 2, ..Control::default() }).unwrap(), found);
        let (two, plane) = (["1/1".to_owned(), "1/2".to_owned()], (&plan.across, &plan.up));
        let stable = stability_regions(&system, &two, plane, plan.grid, &Control::default()).unwrap();
        assert_eq!(stable[0], found.stability);
        assert!(stable[1].contains((1.11, 2.0)) && !stable[1].contains((1.11, 1.5)));
    }

    /// Regression test (item 6): "none found" was reported for the motion without impacts.
    #[test]
    fn f06_without_impacts() {
        let (system, plan) = plan();
        let damped = SystemPlan { damping: 0.05, ..system };
        let up = Stretch { parameter: Parameter::Gap, from: 1.0, to: 8.0 };
        let zero = RegionPlan { label: "0".into(), up, ..plan.clone() };
        let found = regions(&at_rest(&damped), &zero, &Control::default()).unwrap();
        // |f| is 3.17 at 1/beta = 1.199 and 6.9 at 1.06
        assert!(found.existence == found.stability && found.existence.contains((1.199, 3.3)));
        assert!(
            !found.existence.contains((1.199, 3.1)) && !found.existence.contains((1.06, 6.0)) && !zero.neutral(&damped)
        );
        let undamped = regions(&at_rest(&system), &zero, &Control::default()).unwrap();
        // without damping |f| is 3.29 and 9.1
        assert!(undamped.existence.contains((1.199, 3.4)) && !undamped.existence.contains((1.06, 7.9)));
        assert!(undamped.stability.polygons.is_empty() && zero.neutral(&system) && !plan.neutral(&system));
        let elastic = SystemPlan { restitution: 1.0, ..system };
        assert!(plan.neutral(&elastic) && !plan.neutral(&SystemPlan { damping: 0.1, ..elastic }));
    }

    /// A region over numbers of a body contains the points at which its oscillator lies in the region over parameters of
    /// the oscillator.
    #[test]
    fn numbers_of_a_body() {
        use crate::BodyNumber::{Force, Mass};
        let body = crate::Body {
            mass_kg: Some(1.0),
            stiffness_n_per_m: Some(1e4),
            force_n: Some(20.0),
            omega_rad_per_s: Some(100.0),
            gap_m: Some(3e-3),
            restitution: Some(0.5),
            ..crate::Body::default()
        };
        let system = SystemPlan::of_body(&body).unwrap();
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let (mass, force) = (Parameter::Body(Mass), Parameter::Body(Force));
        let plan =
            RegionPlan { label: "1/1".into(), across: over(mass, 0.7, 0.95), up: over(force, 10.0, 60.0), grid: 12 };
        assert_eq!(Plan::new(system, plan.clone()).check(), Ok(()));
        let found = regions(&at_rest(&system), &plan, &Control::default()).unwrap();
        let plain = SystemPlan { body: None, ..system };
        let known = RegionPlan {
            across: over(Parameter::InverseBeta, 1.0, 1.25),
            up: over(Parameter::Gap, 0.4, 4.0),
            grid: 24,
            ..plan.clone()
        };
        let known = regions(&at_rest(&plain), &known, &Control::default()).unwrap();
        let (mut inside, mut points) = (0, 0);
        for i in 0..25 {
            for j in 0..25 {
                let (m, f) = (0.7052 + 0.01 * f64::from(i), 10.3 + 2.0 * f64::from(j));
                if m > 0.95 || f > 60.0 {
                    continue;
                }
                let osc = system.with_all([(mass, m), (force, f)]).unwrap().oscillator().unwrap();
                let at = (1.0 / osc.beta(), osc.gap());
                for (own, other) in [(&found.existence, &known.existence), (&found.stability, &known.stability)] {
                    assert_eq!(own.contains((m, f)), other.contains(at), "{m} kg, {f} N: {at:?}");
                    inside += u32::from(own.contains((m, f)));
                    points += 1;
                }
            }
        }
        assert!(inside > points / 20 && inside < points * 19 / 20, "{inside} of {points}");
        // the motion without impacts, against its amplitude
        let free = RegionPlan { label: "0".into(), ..plan.clone() };
        let found = regions(&at_rest(&system), &free, &Control::default()).unwrap();
        assert!(found.existence.unresolved.is_empty() && found.stability == found.existence);
        for (m, f) in (0..200).map(|k| (0.701 + 0.00123 * f64::from(k), 10.1 + 49.0 * (0.618 * f64::from(k)).fract())) {
            let osc = system.with_all([(mass, m), (force, f)]).unwrap().oscillator().unwrap();
            let room = osc.gap() - osc.free_amplitude();
            assert!(found.existence.contains((m, f)) == (room > 0.0) || room.abs() < 1e-3, "{m} kg, {f} N: {room}");
        }
        let mixed = RegionPlan { up: over(Parameter::Gap, 0.4, 2.0), ..plan };
        let mixed = mixed.check(&at_rest(&system)).unwrap_err().to_string();
        assert!(mixed.starts_with("gap and mass_kg do not span a plane: gap is measured in units"), "{mixed}");
    }

    #[test]
    fn stopped_in_the_middle() {
        use core::sync::atomic::{AtomicBool, Ordering};
        let (system, plan) = plan();
        let stop = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                std::thread::sleep(std::time::Duration::from_millis(60));
                stop.store(true, Ordering::Relaxed);
            });
            // a plan that takes some minutes
            let plan = RegionPlan { label: "2/3".into(), grid: 300, ..plan };
            let stopped = regions(&at_rest(&system), &plan, &Control { stop: &stop, ..Control::default() });
            assert!(matches!(stopped, Err(RunError::Stopped(_))), "{stopped:?}");
        });
    }

    const MACHINE: &str = r#"
        [machine]
        coordinates = ["body"]
        mass = [1]
        stiffness = [1]
        frequency = 0.9
        [[machine.force]]
        order = 1
        cos = [0]
        sin = [1]
        [[machine.stop]]
        name = "wall"
        direction = [1]
        gap = 1.0
        restitution = 0.5
    "#;

    fn asked(label: &str) -> Plan {
        let source = MachineSource::from_text(MACHINE, no_files).unwrap();
        let stretch = |path: &str, from, to| Stretch { parameter: path.to_owned(), from, to };
        let across = stretch("frequency", 0.83, 0.95);
        let up = stretch("stop.wall.gap", 1.0, 2.5);
        Plan::new(source, RegionPlan { label: label.to_owned(), across, up, grid: 5 })
    }

    /// In the units of the oscillator the regions are its own, to the last digit but for the direction of steps.
    #[test]
    fn those_of_the_oscillator() {
        let plan = asked("1/1");
        let text = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), plan);
        let PlanResults::Machine(Results::Region(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
        let system = SystemPlan { beta: Some(0.9), gap: 1.0, restitution: 0.5, ..SystemPlan::default() };
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let known = RegionPlan {
            label: "1/1".into(),
            across: over(Parameter::Beta, 0.83, 0.95),
            up: over(Parameter::Gap, 1.0, 2.5),
            grid: 5,
        };
        let known = regions(&at_rest(&system), &known, &Control::default()).unwrap();
        for (own, other) in [(&found.existence, &known.existence), (&found.stability, &known.stability)] {
            assert!(own.unresolved.is_empty() && own.polygons.len() == other.polygons.len());
            for k in 0..900 {
                let at = (0.832 + 0.004 * f64::from(k % 30), 1.013 + 0.05 * f64::from(k / 30));
                assert_eq!(own.contains(at), other.contains(at), "{at:?}");
            }
        }
        assert!(found.stability.contains((1.0 / 1.11, 1.828)) && !found.stability.contains((1.0 / 1.11, 1.830)));
        let rests = run(&asked("inf/1"), &Control::default()).unwrap_err().to_string();
        assert!(rests.starts_with("a cycle that rests"), "{rests}");
    }
}
