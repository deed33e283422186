//! Where the flight of a cycle that rests on a stop, or whose joint holds, vanishes: beyond, no force pulls the structure off the stop, or
//! lets the joint slip.

use super::beyond::LastMotion;
use super::problem::{MachineProblem, MachineSolution};
use crate::continuation::trace::tracer::{Tracer, last};
use crate::events::End;
use crate::machine::Machine;
use crate::math::root;
use crate::orbit::{MachineFrame, RingEvent};
use crate::regime::GuardKind;

/// How far beyond a solution the motion is followed, in the scale of the number. Closer to the limit than the last one, the flight
/// is so short that rounding decides its events.
const BEYOND: [f64; 3] = [1e-7, 1e-5, 1e-3];
/// For how many periods, and how many events.
const PERIODS: f64 = 4.0;
const EVENTS: usize = 2_000;

/// The solution at which the structure begins to rest for ever, if that is right beyond this one, and the stop that it leaves before or
/// the joint that slips.
pub(super) fn rest_for_ever(tracer: &Tracer<MachineProblem>, at: &MachineSolution) -> Option<(MachineSolution, usize)> {
    let equations = &tracer.problem.equations;
    let released = |event: &RingEvent| match event.guard {
        GuardKind::Reaction(stop) => Some(stop),
        GuardKind::LimitForward(joint) | GuardKind::LimitBackward(joint) => Some(event.back.len() + joint),
        _ => None,
    };
    let place = equations.ring.events.iter().find_map(released)?;
    let motion = LastMotion::of(tracer, at)?;
    let rests = |number: f64| equations.family.at(number).is_some_and(|machine| motion.rests(&machine, place));
    let step = last(&at.tangent).signum() * equations.scales[0];
    let (from, to) = tracer.problem.range;
    let beyond = BEYOND.into_iter().map(|by| motion.number + by * step);
    let resting = beyond.filter(|number| (from..=to).contains(number)).find(|number| rests(*number))?;
    let (first, _) = root::border(resting, motion.number, rests);
    let mut limit = at.clone();
    *limit.w.last_mut()? = first;
    Some((limit, place))
}

impl LastMotion {
    /// Whether the motion of another machine from here comes to rest for ever on this stop, or with this joint holding.
    fn rests(&self, machine: &Machine, place: usize) -> bool {
        let mut motion = MachineFrame::new(machine).resume(self.begin.clone());
        let until = PERIODS * self.period;
        let _ = motion.by_ref().take(EVENTS).take_while(|event| event.time < until).count();
        matches!(motion.end(), Some(End::Stuck | End::Never)) && motion.place().states[place].constrains()
    }
}
