//! All Lyapunov exponents of the motion of a machine from a start.

use super::dimension;
use super::exponents::{ExponentOptions, exponents_while};
use crate::events::{MachineMotion, MachineStart};
use crate::lyapunov::{MEASURED_IMPACTS, MachineMeasure, MachineSpectrum, Measured};
use crate::machine::{Machine, MachineError};
use crate::math::sort_by;
use crate::orbit::MachineFrame;
use crate::verdict::{
    MachineTail, MachineVerdict, Recorded, Recurring, Reduced, SettleOptions, Step, settle_machine_while,
};
use std::sync::Arc;

/// The exponents of a motion of a machine, and where they come from.
#[derive(Clone, Debug)]
pub struct MachineExponents {
    /// The exponents; `None` if the motion ends in a way for which there are none.
    pub spectrum: Option<MachineSpectrum>,
    /// What the motion settles into.
    pub motion: MachineVerdict,
    /// Whether they are exact: from the multipliers of a cycle, or from the structure at rest.
    pub exact: bool,
}

impl MachineExponents {
    /// The Kaplan-Yorke dimension of the flow in the space of coordinates, velocities and the phase of the forcing, by the exponents
    /// (J. L. Kaplan and J. A. Yorke, doi:10.1007/BFb0064319). Its error is a bound to first order from those of the exponents.
    /// `None` if the largest exponent is not known to differ from 0.
    #[must_use]
    pub fn flow_dimension(&self, machine: &Machine) -> Option<Measured> {
        let found = dimension::of_exponents(&self.spectrum.as_ref()?.exponents)?;
        // the exponent 0 along the phase is not one of them; without forcing that along the motion is
        let along = if machine.period().is_some() { 1.0 } else { 0.0 };
        Some(Measured { value: found.value + along, error: found.error })
    }

    /// The dimension of the section at one phase of the forcing, or across the flow without forcing: one less than that of the flow.
    #[must_use]
    pub fn section_dimension(&self, machine: &Machine) -> Option<Measured> {
        self.flow_dimension(machine).map(|of| Measured { value: (of.value - 1.0).max(0.0), error: of.error })
    }
}

/// The number of events over which exponents are measured by default, and of the transient before.
pub const DEFAULT_EVENTS: u32 = 20_000;
/// See [`DEFAULT_EVENTS`].
pub const DEFAULT_MACHINE_TRANSIENT: u32 = 1_000;

/// The exponents of the motion of `machine` from `start`: exact if it settles into a cycle or comes to an end, otherwise
/// measured over `events` events after `transient`; stopped when `go_on` returns false, and then `None`. Of a machine that
/// [is an oscillator](Machine::reduced) they are measured over impacts, as [`exponents_while`] does.
///
/// # Errors
/// [`MachineError`] for an invalid start.
pub fn machine_exponents_while(
    machine: &Machine,
    start: &MachineStart,
    (events, transient): (u32, u32),
    go_on: &dyn Fn() -> bool,
) -> Result<Option<MachineExponents>, MachineError> {
    let watch = SettleOptions { chaos_over: 0, max_impacts: transient.max(2_000), ..SettleOptions::default() };
    let Some(mut settled) = settle_machine_while(machine, start, &watch, go_on)? else { return Ok(None) };
    if matches!(settled.verdict, MachineVerdict::Chaotic { .. } | MachineVerdict::Undecided { .. })
        && let Some(reduced) = Reduced::new(machine, &watch)
        && let Some(from) = reduced.start(start)
    {
        let lengths = ExponentOptions::new(u64::from(events), u64::from(transient));
        let Some(found) = exponents_while(reduced.oscillator(), from, &lengths, go_on) else { return Ok(None) };
        if let Some(motion) = reduced.measured(&found.motion) {
            if let Some(spectrum) = motion.spectrum().cloned() {
                return Ok(Some(MachineExponents { spectrum: Some(spectrum), motion, exact: false }));
            }
            // it has settled later
            settled.verdict = motion;
        }
    }
    let exact = |exponents: Vec<f64>, closings: f64| {
        let measured = |value: f64| Measured { value, error: 0.0 };
        MachineSpectrum {
            exponents: exponents.into_iter().map(measured).collect(),
            closings: measured(closings),
            time: f64::INFINITY,
        }
    };
    match &settled.verdict {
        MachineVerdict::Periodic(cycle) => {
            let own = cycle.logs.iter().map(|log| log / cycle.period);
            // a neighbour that is moved along a free translation stays as far away, and without forcing one that is ahead
            let kept = cycle.translations() + if machine.period().is_none() { 1 } else { 0 };
            let mut rates: Vec<f64> = own.chain((0..kept).map(|_| 0.0)).collect();
            sort_by(&mut rates, |a, b| b.total_cmp(a));
            let closings = f64::from(cycle.counts.iter().sum::<u32>()) / cycle.period;
            let spectrum = Some(exact(rates, closings));
            return Ok(Some(MachineExponents { spectrum, motion: settled.verdict, exact: true }));
        }
        MachineVerdict::NoImpact(_) | MachineVerdict::Stuck(_) => {
            // those of the structure in its last regime
            let frame = MachineFrame::new(machine);
            let mut motion = MachineMotion::new(machine, start, frame.limits())?;
            while motion.step().is_some() {
                motion.take_events();
                if !go_on() {
                    return Ok(None);
                }
            }
            let place = motion.place();
            let rates = frame.structure(&place.states).and_then(|structure| structure.growth(machine.n()));
            let spectrum = rates.map(|rates| exact(rates, 0.0));
            return Ok(Some(MachineExponents { spectrum, motion: settled.verdict, exact: true }));
        }
        _ => {}
    }
    measured(machine, start, (events, transient), settled.verdict, go_on)
}

/// The exponents measured along the machine's own motion, which settles into `settled` if they do not show chaos.
fn measured(
    machine: &Machine,
    start: &MachineStart,
    (events, transient): (u32, u32),
    settled: MachineVerdict,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<MachineExponents>, MachineError> {
    let system = Recorded::new(MachineFrame::new(machine));
    let mut motion = MachineMotion::new(machine, start, system.frame.limits())?;
    let mut measure: Option<MachineMeasure> = None;
    let mut seen = 0_u32;
    let mut tail = MachineTail::end(motion.place());
    while measure.as_ref().is_none_or(|measure| !measure.complete()) {
        if !go_on() {
            return Ok(None);
        }
        let Some((step, _)) = Step::next(&mut motion) else { break };
        if motion.end().is_some() {
            break;
        }
        seen += 1;
        tail.steps += 1;
        let (interval, step) = (step.passage.time(), Arc::new(step));
        match &mut measure {
            Some(measure) => {
                if u64::from(measure.left()) == MEASURED_IMPACTS {
                    tail = MachineTail { from: step.begin.clone(), steps: 1 };
                }
                system.add(measure, &step, interval);
            }
            None if seen >= transient => measure = Some(system.measure(&step, events)),
            None => {}
        }
    }
    let spectrum = measure.and_then(|measure| measure.spectrum());
    let motion = match &spectrum {
        Some(found) if found.chaotic() => {
            let tail = MachineTail { steps: tail.steps.min(MEASURED_IMPACTS), ..tail };
            MachineVerdict::Chaotic { spectrum: found.clone(), events: u64::from(seen), tail }
        }
        _ => settled,
    };
    Ok(Some(MachineExponents { spectrum, motion, exact: false }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{MachineParts, Opening, StopLaw};

    fn machine(law: StopLaw, gap: f64) -> Machine {
        let parts = MachineParts::new(["mass"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.05)
            .with_frequency(1.0 / 1.11)
            .with_force(0, 1, 0.0, 1.0);
        Machine::new(parts.with_stop("stop", &[1.0], gap, law)).unwrap()
    }

    /// An undamped soft stop changes no volume: the exponents sum to minus the structure's own damping, exactly.
    #[test]
    fn the_sum_of_exponents() {
        for (gap, stiffness) in [(0.0, 30.0), (2.0, 400.0), (2.6, 900.0)] {
            let law = StopLaw::Compliant { stiffness, damping: 0.0, preload: 0.0, opening: Opening::Force };
            let machine = machine(law, gap);
            let found =
                machine_exponents_while(&machine, &MachineStart::default(), (5_000, 500), &|| true).unwrap().unwrap();
            let spectrum = found.spectrum.unwrap();
            let sum: f64 = spectrum.exponents.iter().map(|exponent| exponent.value).sum();
            assert!((sum + 0.05).abs() < 1e-9, "{gap} {} {sum}", found.motion.label());
        }
    }

    #[test]
    fn without_contacts_those_of_the_structure() {
        let machine = machine(StopLaw::Rigid { restitution: 0.5 }, 100.0);
        let found = machine_exponents_while(&machine, &MachineStart::default(), (100, 100), &|| true).unwrap().unwrap();
        assert!(matches!(found.motion, MachineVerdict::NoImpact(_)));
        assert!(found.spectrum.unwrap().exponents.iter().all(|exponent| (exponent.value + 0.025).abs() < 1e-12));
    }

    /// Those of a machine that is an oscillator are those of the oscillator, per unit of its time, and agree with those along the
    /// machine's own motion.
    #[test]
    fn of_an_oscillator() {
        let of = crate::scenario::U.oscillator();
        let (mass, stiffness, force) = (0.2, 5.0, 3.0);
        let parts = MachineParts::new(["mass"])
            .with_mass(0, mass)
            .with_link(&[1.0], stiffness, 0.0)
            .with_frequency(of.beta() * 5.0)
            .with_force(0, 1, 0.0, force);
        let law = StopLaw::Rigid { restitution: of.restitution() };
        let machine = Machine::new(parts.with_stop("stop", &[1.0], of.gap() * force / stiffness, law)).unwrap();
        let start = MachineStart::default();
        let found = machine_exponents_while(&machine, &start, (20_000, 1_000), &|| true).unwrap().unwrap();
        let expected =
            super::super::exponents::exponents(&of, crate::Start::at_rest(&of), &ExponentOptions::new(20_000, 1_000));
        let unknown =
            MachineVerdict::Undecided { why: crate::verdict::MachineUndecided::Events, spectrum: None, events: 0 };
        let own = measured(&machine, &start, (20_000, 1_000), unknown, &|| true).unwrap().unwrap();
        assert_eq!((found.motion.label(), own.motion.label()), ("chaotic".to_owned(), "chaotic".to_owned()));
        let (found, own) = (found.spectrum.unwrap(), own.spectrum.unwrap());
        for ((one, other), want) in found.exponents.iter().zip(&own.exponents).zip(expected.exponents) {
            // the same motion to rounding, which chaos enlarges: within the bars of both
            assert!((one.value / 5.0 - want.value).abs() < want.error, "{one:?} {want:?}");
            assert!((one.error / 5.0 / want.error - 1.0).abs() < 0.5, "{one:?} {want:?}");
            assert!((one.value - other.value).abs() < one.error + other.error, "{one:?} {other:?}");
        }
        assert!((found.closings.value / own.closings.value - 1.0).abs() < 0.02);
    }
}
