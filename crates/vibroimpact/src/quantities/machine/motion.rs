//! The quantities of a steady motion of a machine.

use super::super::Quantity;
use super::super::sums::{Scale, Sums, mean_over};
use super::part::{Part, machine_quantity};
use super::sums::PartSums;
use super::tally::Tally;
use crate::events::{End, Place};
use crate::lyapunov::blocks::FEWEST;
use crate::lyapunov::{Measured, Tail};
use crate::machine::{Machine, MachineError};
use crate::orbit::{MachineFrame, MachineLap, machine::Cycle};
use crate::regime::ContactState;
use crate::verdict::Verdict;
use crate::verdict::machine::State;

/// The quantities of a motion of a machine, in its own units: of the whole machine, of the forces of each order, of its
/// stops, friction joints and coordinates ([`Part::quantities`] lists those of each).
///
/// Powers balance: over a cycle the work of forces, moving stops and belts is what is lost in impacts, in the dampers of
/// stops, in friction and in the damping of the structure. A constant force does no work over a cycle, except along a free
/// translation: there it does its own times the drift, which belongs to the power of the whole machine. Quantities that are
/// not defined are NaN, as those per forcing period of a machine without forcing, and the displacements of coordinates
/// that a free translation moves, because they depend on where the machine is.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantities {
    entries: Vec<(Part, Quantity, Measured)>,
}

impl Quantities {
    /// The value of a quantity of a part; NaN if it is not defined.
    #[must_use]
    pub fn get(&self, part: Part, quantity: Quantity) -> f64 {
        self.measured(part, quantity).value
    }

    /// The value with its error: three standard errors of a mean over a chaotic motion, 0 where it is exact to rounding,
    /// NaN for an extreme of a chaotic motion.
    #[must_use]
    pub fn measured(&self, part: Part, quantity: Quantity) -> Measured {
        let found = self.entries.iter().find(|(own, name, _)| (*own, *name) == (part, quantity));
        found.map_or(Measured { value: f64::NAN, error: f64::NAN }, |(.., measured)| *measured)
    }

    /// The value at a path, as `power` or `stop.wall.impulse_per_period`;
    /// [`machine_quantity_paths`](super::machine_quantity_paths) lists all.
    ///
    /// # Errors
    /// [`MachineError`] if the path leads to no quantity of `machine`.
    pub fn value(&self, machine: &Machine, path: &str) -> Result<f64, MachineError> {
        let (part, quantity) = machine_quantity(machine, path)?;
        Ok(self.get(part, quantity))
    }

    /// All quantities with their values and errors, in the order of reports.
    pub fn iter(&self) -> impl Iterator<Item = (Part, Quantity, Measured)> + '_ {
        self.entries.iter().copied()
    }

    fn from_fn(machine: &Machine, value: impl Fn(Part, Quantity) -> Measured) -> Self {
        let of = |part: Part| part.quantities().iter().map(move |quantity| (part, *quantity));
        let all = Part::all(machine).into_iter().flat_map(of);
        Self { entries: all.map(|(part, quantity)| (part, quantity, value(part, quantity))).collect() }
    }

    /// Those of a motion whose sums over its blocks are these; `exact` if it is a whole motion.
    fn of(machine: &Machine, tally: &Tally<'_>, blocks: &[PartSums], exact: bool) -> Self {
        let period = machine.period().unwrap_or(f64::NAN);
        // no free translation moves it, so over a cycle it comes back
        let returns = |part| matches!(part, Part::Coordinate(i) if !tally.moves_freely(i));
        Self::from_fn(machine, |part, quantity| {
            let placeless = matches!(part, Part::Coordinate(i) if tally.moves_freely(i) && quantity.of_place());
            if placeless || tally.skipped && !quantity.of_impacts() {
                return Measured { value: f64::NAN, error: f64::NAN };
            }
            if exact && quantity == Quantity::VelocityMean && returns(part) {
                return Measured::default();
            }
            if !quantity.is_mean() {
                let value = tally.extremes.get(part, quantity);
                return Measured { value, error: if exact { 0.0 } else { f64::NAN } };
            }
            let sums: Vec<Sums> = blocks.iter().map(|block| block.of(part)).collect();
            let Measured { value, error } = mean_over(&sums, quantity, Scale { period, damping: 1.0 });
            Measured { value, error: if exact { 0.0 } else { error } }
        })
    }
}

/// The quantities of a cycle of a machine, stable or not, over its smallest period; `None` if the motion from its state
/// does not go on for a period.
///
/// ```
/// use vibroimpact::events::Start;
/// use vibroimpact::machine::{Machine, MachineParts};
/// use vibroimpact::quantities::machine_quantities;
/// use vibroimpact::verdict::{SettleOptions, settle_machine};
/// let parts = MachineParts::new(["mass"])
///     .with_mass(0, 1.0)
///     .with_link(&[1.0], 1.0, 0.1)
///     .with_frequency(0.6)
///     .with_force(0, 1, 0.0, 1.0)
///     .with_rigid_stop("wall", &[1.0], 0.5, 0.5);
/// let machine = Machine::new(parts)?;
/// let settled = settle_machine(&machine, &Start::default(), &SettleOptions::default())?;
/// let found = machine_quantities(&machine, &settled.verdict).unwrap();
/// let of = |path| found.value(&machine, path);
/// let lost = of("impact_power")? + of("damping_power")?;
/// assert!((of("power")? - lost).abs() < 1e-13 * lost);
/// assert!(of("q.mass.displacement_max")? <= 0.5 + 1e-15);
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[must_use]
pub fn machine_cycle_quantities(machine: &Machine, cycle: &Cycle) -> Option<Quantities> {
    over_time(&MachineFrame::new(machine), cycle.strobes.first()?, cycle.period)
}

/// The quantities of the motion with this verdict: over the smallest period of a cycle, over a forcing period of a motion
/// without a further event, and over the last [`MEASURED_IMPACTS`](crate::quantities::MEASURED_IMPACTS) events of chaos,
/// where means have error bars.
///
/// `None` for an undecided motion. A motion without a further event that does not settle, as one without damping,
/// depends on its start: only what its stops do not do is known.
#[must_use]
pub fn machine_quantities(machine: &Machine, verdict: &Verdict<Machine>) -> Option<Quantities> {
    match verdict {
        Verdict::Periodic(cycle) => machine_cycle_quantities(machine, cycle),
        Verdict::NoImpact(last) | Verdict::Stuck(last) => Some(quiet(machine, &last.place)),
        Verdict::Chaotic(chaos) => measured(machine, &chaos.tail),
        Verdict::Undecided(_) => None,
    }
}

/// The quantities of the motion from a state over a time, after which it repeats.
fn over_time(frame: &MachineFrame<'_>, from: &Place, time: f64) -> Option<Quantities> {
    let mut tally = Tally::new(frame);
    let mut motion = frame.resume(from.clone()).limited(frame.limits().time);
    let mut steps = 0;
    loop {
        let (begin, left) = (motion.place().clone(), time - motion.time());
        let passage = motion.step()?;
        // after the last event the motion is the last flight for as long as it is asked for
        let for_ever = matches!(motion.end(), Some(End::Never | End::Stuck));
        if left <= passage.duration || for_ever {
            tally.flight(&begin, &passage.structure, left, &[]);
            break;
        }
        tally.flight(&begin, &passage.structure, passage.duration, &[]);
        tally.event(&passage, &motion.take_events());
        tally.chatter(&passage, left - passage.duration);
        if left <= passage.time() {
            break;
        }
        steps += 1;
        if motion.end().is_some() || steps > STEPS {
            return None;
        }
    }
    frame.keep(&motion);
    tally.close();
    let whole = tally.take();
    Some(Quantities::of(frame.machine, &tally, &[whole], true))
}

/// The largest number of steps of a cycle.
const STEPS: u32 = 100_000;
/// A motion that returns to its state to within this part of its size repeats.
const CLOSED: f64 = 1e-10;

/// A steady response attracts if all its multipliers are below this: without damping they are 1 to rounding.
const ATTRACTS: f64 = 1.0 - 1e-9;

/// The quantities of a motion without a further event, from one of its states.
fn quiet(machine: &Machine, from: &Place) -> Quantities {
    let frame = MachineFrame::new(machine);
    steady(&frame, from).unwrap_or_else(|| {
        // nothing takes energy, so a motion that stays bounded gets none
        let open = from.states.iter().all(|state| *state == ContactState::Open);
        let idle = open && machine.parts().damping.largest() == 0.0;
        let zero = |part: Part, quantity: Quantity| match (part, quantity) {
            (_, Quantity::ImpactSpeedMean) => false,
            (Part::Stop(j), _) => from.states[j] == ContactState::Open,
            (Part::Whole, _) => idle || quantity.of_impacts(),
            (Part::Force(_), _) => idle,
            (Part::Joint(_) | Part::Coordinate(_), _) => false,
        };
        Quantities::from_fn(machine, |part, quantity| Measured {
            value: if zero(part, quantity) { 0.0 } else { f64::NAN },
            error: 0.0,
        })
    })
}

/// Those of the steady motion or the rest to which it comes; `None` if it comes to none.
fn steady(frame: &MachineFrame<'_>, from: &Place) -> Option<Quantities> {
    let structure = frame.structure(&from.states)?;
    let fastest = structure.fastest();
    let time = frame.machine.period().unwrap_or(if fastest > 0.0 { 1.0 / fastest } else { 1.0 });
    if frame.machine.period().is_some()
        && let Some(cycle) = Cycle::near(frame, from, 1)
        && cycle.multipliers.iter().all(|multiplier| multiplier.modulus() < ATTRACTS)
    {
        return over_time(frame, cycle.strobes.first()?, cycle.period);
    }
    let lap = MachineLap::replay(frame, from, time)?;
    let (size, speed) = lap.sizes;
    // at rest without forcing, velocities are what is left of a motion
    let sizes = (size, speed.max(size / time));
    (frame.distance(from, &lap.end, sizes) <= CLOSED).then(|| over_time(frame, from, time))?
}

/// The quantities of a chaotic motion over its last steps.
fn measured(machine: &Machine, tail: &Tail<State>) -> Option<Quantities> {
    let frame = MachineFrame::new(machine);
    let mut tally = Tally::new(&frame);
    let mut motion = frame.resume(tail.from.place.clone()).limited(frame.limits().time);
    let wanted = tail.impacts.min(FEWEST as u64);
    let mut blocks = Vec::new();
    for count in 1..=tail.impacts {
        let begin = motion.place().clone();
        let passage = motion.step()?;
        if motion.end().is_some() {
            return None;
        }
        tally.flight(&begin, &passage.structure, passage.duration, &[]);
        tally.event(&passage, &motion.take_events());
        tally.chatter(&passage, f64::INFINITY);
        // block k ends with step number (k + 1) n / wanted
        if count >= (blocks.len() as u64 + 1) * tail.impacts / wanted {
            blocks.push(tally.take());
        }
    }
    (!blocks.is_empty()).then(|| Quantities::of(machine, &tally, &blocks, false))
}
