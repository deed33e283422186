//! All Lyapunov exponents of the motion of a machine from a start.

use super::exponents::{self, ExponentOptions, Exponents, Grounds, exponents_while};
use crate::events::{Motion, Start};
use crate::lyapunov::blocks::MEASURE;
use crate::lyapunov::{Measured, Run, Tail};
use crate::machine::{Machine, MachineError};
use crate::math::sort_by;
use crate::orbit::MachineFrame;
use crate::verdict::machine::State;
use crate::verdict::{Chaos, Recorded, Reduced, SettleOptions, Step, Verdict, settle_as};

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
    start: &Start,
    (events, transient): (u32, u32),
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Exponents<Machine>>, MachineError> {
    let watch = SettleOptions { chaos_over: 0, max_impacts: transient.max(2_000), ..SettleOptions::default() };
    let reduced = Reduced::of(machine, start, &watch);
    let Some(mut motion) = settle_as(reduced.as_ref(), machine, start, &watch, go_on)?.map(|settled| settled.verdict)
    else {
        return Ok(None);
    };
    if matches!(motion, Verdict::Chaotic(_) | Verdict::Undecided(_))
        && let Some((reduced, from)) = &reduced
    {
        let lengths = ExponentOptions::new(u64::from(events), u64::from(transient));
        let Some(found) = exponents_while(reduced.oscillator(), *from, &lengths, go_on) else { return Ok(None) };
        if let Some(of) = reduced.measured(&found.motion) {
            if of.spectrum().is_some() {
                return Ok(Some(found.of_machine(of, reduced.time())));
            }
            // it has settled later
            motion = of;
        }
    }
    let exact = |motion: Verdict<Machine>, rates: Option<Vec<f64>>, closings: f64| {
        let grounds = rates.as_ref().map_or(Grounds::Undecided { impacts: 0 }, |_| Grounds::Exact);
        let mut rates = rates.unwrap_or_else(|| vec![f64::NAN; 2 * machine.n()]);
        // the largest first
        sort_by(&mut rates, |a, b| b.total_cmp(a));
        let exponents = rates.into_iter().map(Measured::exact).collect();
        let forced = machine.period().is_some();
        Ok(Some(Exponents::new(motion, (exponents, Measured::exact(closings)), (&[], grounds), forced)))
    };
    match &motion {
        Verdict::Periodic(cycle) => {
            // the logarithm of a multiplier is the growth in a period
            let own = cycle.logs.iter().map(|log| log / cycle.period);
            // a neighbour that is moved along a free translation stays as far away, and without forcing one that is ahead
            let kept = cycle.translations() + if machine.period().is_none() { 1 } else { 0 };
            let rates = own.chain((0..kept).map(|_| 0.0)).collect();
            let closings = f64::from(cycle.counts.iter().sum::<u32>()) / cycle.period;
            exact(motion, Some(rates), closings)
        }
        Verdict::NoImpact(_) | Verdict::Stuck(_) => {
            // those of the structure in its last regime
            let frame = MachineFrame::new(machine);
            let mut last = Motion::new(machine, start, frame.limits())?;
            while last.step().is_some() {
                // nobody looks at them: they would only take memory
                last.take_events();
                if !go_on() {
                    return Ok(None);
                }
            }
            let structure = frame.structure(&last.place().states);
            exact(motion, structure.and_then(|structure| structure.growth(machine.n())), 0.0)
        }
        Verdict::Chaotic(_) | Verdict::Undecided(_) => measured(machine, start, (events, transient), motion, go_on),
    }
}

impl Exponents {
    /// Those of a machine that is an oscillator whose unit of time is `time`, with the verdict on the machine.
    fn of_machine(self, motion: Verdict<Machine>, time: f64) -> Exponents<Machine> {
        let rate = |of: Measured| of.scaled(1.0 / time);
        let grounds = match self.grounds {
            Grounds::Measured { impacts, transient, time: measured, blocks } => {
                Grounds::Measured { impacts, transient, time: measured * time, blocks }
            }
            of => of,
        };
        Exponents {
            motion,
            exponents: self.exponents.into_iter().map(rate).collect(),
            sum: rate(self.sum),
            identity: self.identity / time,
            impact_rate: rate(self.impact_rate),
            section_dimension: self.section_dimension,
            flow_dimension: self.flow_dimension,
            grounds,
        }
    }
}

/// The exponents measured along the machine's own motion, which settles into `settled` if they do not show chaos.
fn measured(
    machine: &Machine,
    start: &Start,
    (events, transient): (u32, u32),
    settled: Verdict<Machine>,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Exponents<Machine>>, MachineError> {
    let system = Recorded::new(MachineFrame::new(machine));
    let mut motion = Motion::new(machine, start, system.frame.limits())?;
    let mut run = Run::new(system.tangents(), u64::from(transient), u64::from(events));
    let mut seen = 0;
    let mut tail = Tail::new(State::of(motion.place()));
    while !run.complete() {
        if !go_on() {
            return Ok(None);
        }
        let Some((step, _)) = Step::next(&mut motion) else { break };
        if motion.end().is_some() {
            break;
        }
        seen += 1;
        system.pass(&mut run, &step, step.passage.time());
        tail.impact(&State::of(&step.end), run.left());
    }
    let none = || (vec![Measured::exact(f64::NAN); 2 * machine.n()], Measured::exact(f64::NAN));
    let Some((spectrum, blocks)) = run.spectrum(MEASURE) else {
        let grounds = Grounds::Undecided { impacts: seen };
        return Ok(Some(Exponents::new(settled, none(), (&[], grounds), machine.period().is_some())));
    };
    let rates = (spectrum.exponents.clone(), spectrum.impact_rate);
    let motion = if spectrum.chaotic() {
        Verdict::Chaotic(Chaos { spectrum, impacts: seen, tail: tail.so_far() })
    } else {
        settled
    };
    let grounds = exponents::measured(&run, &blocks);
    Ok(Some(Exponents::new(motion, rates, (&blocks, grounds), machine.period().is_some())))
}
