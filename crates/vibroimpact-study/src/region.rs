//! The regions of a plane of two parameters in which a motion exists and in which it is stable.

use crate::chosen::followable;
use crate::name::Name;
use crate::stretch::check_plane;
use crate::{Control, Parameter, PlanError, RunError, Stretch, SystemPlan, limits, tiles};
use serde::{Deserialize, Serialize};
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{Frame, Region, RegionKind, RegionOptions, region_while};
use vibroimpact::{Label, Oscillator, PhysicalParameter};

/// Default number of grid points, in each direction, at which orbits are searched.
pub const DEFAULT_GRID: u32 = 24;
/// Largest allowed number of grid points in each direction.
const MOST_GRID: u32 = 400;

/// The regions of a motion in a plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "RegionPlan", bound = "V: Name")]
pub struct RegionPlan<V = Parameter> {
    /// m/n.
    pub label: String,
    /// The number on the abscissa and its range.
    pub across: Stretch<V>,
    /// The number on the ordinate and its range.
    pub up: Stretch<V>,
    /// Number of grid points in each direction at which orbits are searched. Smaller parts of a region may be missed.
    #[serde(default = "grid")]
    pub grid: u32,
}

pub(crate) const fn grid() -> u32 {
    DEFAULT_GRID
}

impl<V> RegionPlan<V> {
    /// The same with other names of the numbers that vary.
    pub(crate) fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<RegionPlan<W>, E> {
        let (label, across, up) = (self.label.clone(), self.across.named(name)?, self.up.named(name)?);
        Ok(RegionPlan { label, across, up, grid: self.grid })
    }

    /// Whether it is the motion without impacts, whose region follows from its amplitude.
    #[must_use]
    pub fn clears(&self) -> bool {
        self.label.parse() == Ok(Label::new(0, 1))
    }
}

impl RegionPlan {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        followable(Some(&self.label))?;
        check_grid(self.grid)?;
        check_plane(system, &self.across, &self.up)
    }

    /// Whether the motion loses no energy anywhere in the plane. It is then neutrally stable and has no region of
    /// stability.
    #[must_use]
    pub fn neutral(&self, system: &SystemPlan) -> bool {
        let varied = |parameter| [self.across.parameter, self.up.parameter].contains(&parameter);
        use PhysicalParameter::{DampingCoefficient, DampingRatio, Restitutions};
        let any = |parameters: &[PhysicalParameter]| parameters.iter().any(|one| varied(Parameter::Physical(*one)));
        let damps = varied(Parameter::Damping) || any(&[DampingCoefficient, DampingRatio]);
        let undamped = system.damping == 0.0 && !damps;
        let elastic = |parameter, restitution: f64| restitution == 1.0 && !varied(parameter) && !any(&[Restitutions]);
        let lossless = elastic(Parameter::Restitution, system.restitution)
            && system.second_stop.is_none_or(|stop| elastic(Parameter::SecondRestitution, stop.restitution));
        undamped && (self.clears() || lossless)
    }
}

/// Checks the grid of a region.
pub(crate) fn check_grid(grid: u32) -> Result<(), PlanError> {
    limits::check("grid", grid, 2..=MOST_GRID)
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
pub(crate) struct Plane {
    over: Over,
    options: RegionOptions,
}

/// The systems of a plane.
pub(crate) enum Over {
    Oscillators(Oscillator, Frame),
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
    fn new(system: &SystemPlan, across: &Stretch, up: &Stretch, grid: u32) -> Result<Self, PlanError> {
        let corner = system.with_all([(across.parameter, across.from), (up.parameter, up.from)])?;
        Ok(Self::of(Over::Oscillators(corner.oscillator()?, across.frame(up, system)?), grid))
    }

    pub(crate) fn of(over: Over, grid: u32) -> Self {
        Self { over, options: RegionOptions { grid: (grid, grid), ..RegionOptions::default() } }
    }

    /// Both regions of one motion.
    pub(crate) fn both(&self, label: Label, control: &Control<'_>) -> Result<Regions, RunError> {
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
    check_plane(system, across, up)?;
    let wanted = labels.iter().map(|label| Ok((followable(Some(label))?, None, RegionKind::Stability)));
    let wanted = wanted.collect::<Result<Vec<_>, PlanError>>()?;
    Plane::new(system, across, up, grid)?.regions(&wanted, control)
}

/// Computes both regions.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped. The stop flag is read at every point of the grid and at every
/// step.
pub(crate) fn regions(system: &SystemPlan, plan: &RegionPlan, control: &Control<'_>) -> Result<Regions, RunError> {
    plan.check(system)?;
    let label = followable(Some(&plan.label))?;
    Plane::new(system, &plan.across, &plan.up, plan.grid)?.both(label, control)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Plan;

    fn plan() -> (SystemPlan, RegionPlan) {
        let system = SystemPlan { inverse_beta: Some(1.05), gap: 1.0, restitution: 0.5, ..SystemPlan::default() };
        let across = Stretch { parameter: Parameter::InverseBeta, from: 1.05, to: 1.2 };
        let up = Stretch { parameter: Parameter::Gap, from: 1.0, to: 2.5 };
        (system, RegionPlan { label: "1/1".into(), across, up, grid: 5 })
    }

    /// 1/1 flips at 1.829: stable below, unstable above. The result is the same for any number of threads.
    #[test]
    fn one_impact_a_period_about_its_flip() {
        let (system, plan) = plan();
        let found = regions(&system, &plan, &Control { threads: 1, ..Control::default() }).unwrap();
        for (gap, stable) in [(1.828, true), (1.830, false)] {
            assert!(found.existence.contains((1.11, gap)));
            assert_eq!(found.stability.contains((1.11, gap)), stable, "{gap}");
        }
        assert_eq!(regions(&system, &plan, &Control { threads: 2, ..Control::default() }).unwrap(), found);
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
        let found = regions(&damped, &zero, &Control::default()).unwrap();
        // |f| is 3.17 at 1/beta = 1.199 and 6.9 at 1.06
        assert!(found.existence == found.stability && found.existence.contains((1.199, 3.3)));
        assert!(
            !found.existence.contains((1.199, 3.1)) && !found.existence.contains((1.06, 6.0)) && !zero.neutral(&damped)
        );
        let undamped = regions(&system, &zero, &Control::default()).unwrap();
        // without damping |f| is 3.29 and 9.1
        assert!(undamped.existence.contains((1.199, 3.4)) && !undamped.existence.contains((1.06, 7.9)));
        assert!(undamped.stability.polygons.is_empty() && zero.neutral(&system) && !plan.neutral(&system));
        let elastic = SystemPlan { restitution: 1.0, ..system };
        assert!(plan.neutral(&elastic) && !plan.neutral(&SystemPlan { damping: 0.1, ..elastic }));
    }

    /// A region over numbers of a machine contains the points at which its oscillator lies in the region over parameters of
    /// the oscillator.
    #[test]
    fn numbers_of_a_machine() {
        use vibroimpact::PhysicalParameter::{Force, Mass};
        let machine = crate::PhysicalPlan {
            mass_kg: Some(1.0),
            stiffness_n_per_m: Some(1e4),
            force_n: Some(20.0),
            omega_rad_per_s: Some(100.0),
            gap_m: Some(3e-3),
            restitution: Some(0.5),
            ..crate::PhysicalPlan::default()
        };
        let system = SystemPlan::of_machine(machine.driven().unwrap()).unwrap();
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let (mass, force) = (Parameter::Physical(Mass), Parameter::Physical(Force));
        let plan =
            RegionPlan { label: "1/1".into(), across: over(mass, 0.7, 0.95), up: over(force, 10.0, 60.0), grid: 12 };
        assert_eq!(Plan::new(system, plan.clone()).check(), Ok(()));
        let found = regions(&system, &plan, &Control::default()).unwrap();
        let plain = SystemPlan { machine: None, ..system };
        let known = RegionPlan {
            across: over(Parameter::InverseBeta, 1.0, 1.25),
            up: over(Parameter::Gap, 0.4, 4.0),
            grid: 24,
            ..plan.clone()
        };
        let known = regions(&plain, &known, &Control::default()).unwrap();
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
        let found = regions(&system, &free, &Control::default()).unwrap();
        assert!(found.existence.unresolved.is_empty() && found.stability == found.existence);
        for (m, f) in (0..200).map(|k| (0.701 + 0.00123 * f64::from(k), 10.1 + 49.0 * (0.618 * f64::from(k)).fract())) {
            let osc = system.with_all([(mass, m), (force, f)]).unwrap().oscillator().unwrap();
            let room = osc.gap() - osc.free_amplitude();
            assert!(found.existence.contains((m, f)) == (room > 0.0) || room.abs() < 1e-3, "{m} kg, {f} N: {room}");
        }
        let mixed = RegionPlan { up: over(Parameter::Gap, 0.4, 2.0), ..plan };
        assert!(matches!(mixed.check(&system), Err(PlanError::MixedPlane("gap", "mass_kg"))));
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
            let stopped = regions(&system, &plan, &Control { stop: &stop, ..Control::default() });
            assert!(matches!(stopped, Err(RunError::Stopped(_))), "{stopped:?}");
        });
    }

    #[test]
    fn a_plan_survives_json_and_nonsense_is_refused() {
        let (system, good) = plan();
        let whole = Plan::new(system, good.clone());
        assert_eq!(whole.check(), Ok(()));
        let text = serde_json::to_string(&whole).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), whole);
        for (plan, sentence) in [
            (RegionPlan { grid: 1, ..good.clone() }, "grid = 1 lies outside 2 <= grid <= 400"),
            (RegionPlan { label: "inf/1".into(), ..good.clone() }, "a cycle that rests"),
            (RegionPlan { up: good.across, ..good.clone() }, "inverse_beta and inverse_beta do not span a plane"),
        ] {
            let message = plan.check(&system).unwrap_err().to_string();
            assert!(message.starts_with(sentence), "{message}");
        }
    }
}
