//! A grazing event on a branch: the event itself, and the cycle with which the branch continues.

use super::free::{arriving, leaving};
use super::graze::{Beyond, beyond};
use super::impact_branch::ImpactBranch;
use super::problem::BranchSolution;
use crate::continuation::equations::test_functions::TestFunction;
use crate::continuation::event::{BranchEvent, EventDetail};
use crate::continuation::trace::tracer::{Crossing, last};
use crate::orbit::{closest, crest};
use crate::system::{Side, phase};
use crate::verdict::Label;

impl ImpactBranch {
    /// The index of impact `k` in the list of impacts of the cycle at this point.
    pub(crate) fn listed(&self, at: &BranchSolution, k: usize) -> usize {
        let points = &at.known.cycle.points;
        let Some((_, ring)) = self.cycles().split(&at.w).filter(|(_, ring)| k < ring.len()) else { return k };
        let theta = phase::wrap(ring.theta(k));
        points.iter().position(|p| p.state.phase == theta && p.state.velocity == ring.speed(k)).unwrap_or(k)
    }

    /// Reports a grazing event and continues beyond it. Impacts and flights of this step that graze together are one
    /// event.
    pub(crate) fn graze(&mut self, crossed: &[Crossing], at: &BranchSolution) {
        let together = crossed.iter().take_while(|(s, _)| s - crossed[0].0 < TOGETHER);
        let tests: Vec<TestFunction> = together.filter_map(|(_, j)| j.map(|j| self.tracer.problem.tests[j])).collect();
        let gone: Vec<usize> =
            tests.iter().filter_map(|w| if let TestFunction::Speed(k) = w { Some(*k) } else { None }).collect();
        let rooms: Vec<Side> =
            tests.iter().filter_map(|w| if let TestFunction::Room(side) = w { Some(*side) } else { None }).collect();
        let mut touches: Vec<_> = tests
            .iter()
            .filter_map(|w| if let TestFunction::Clear(k, side) = w { Some((*k, *side)) } else { None })
            .collect();
        if !gone.is_empty() {
            // a flight that grazes at the same time belongs to another period of the cycle on this side
            touches.clear();
        }
        let Some((osc, ring)) = self.cycles().split(&at.w) else {
            return self.finish(BranchEvent::NoConvergence);
        };
        let before = Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods);
        let (appears, k, side) = match (touches.first(), gone.first(), rooms.first()) {
            (Some(&(k, side)), ..) => (true, k, side),
            (None, Some(&k), _) => (false, k, ring.side(k)),
            (None, None, Some(&side)) => (true, 0, side),
            (None, None, None) => return self.finish(BranchEvent::NoConvergence),
        };
        let phase_of = |k: usize, side: Side| match appears {
            true if ring.len() == 0 => crest(&osc, side),
            true => {
                let time = closest(&osc, &ring, k, side).map_or(0.0, |closest| closest.time);
                phase::advance(phase::wrap(ring.theta(k)), osc.beta(), time)
            }
            false => phase::wrap(ring.theta(k)),
        };
        // a cycle without impacts has no impact numbers
        let place_of = |k: usize, side: Side| ((ring.len() > 0).then(|| self.listed(at, k)), phase_of(k, side));
        let (impact, phase) = place_of(k, side);
        let second = match (touches.get(1), gone.get(1), rooms.get(1)) {
            (Some(&second), ..) => Some(second),
            (None, Some(&k), _) => Some((k, ring.side(k))),
            (None, None, Some(&side)) => Some((0, side)),
            (None, None, None) => None,
        };
        let also = second.map(|(k, side)| place_of(k, side));
        let value = last(&at.w);
        let next = if ring.len() == 0 {
            arriving(self.cycles(), &osc, value, &rooms)
        } else if (0..ring.len()).all(|k| ring.speed(k).abs() < AT_REST) {
            // where the motion without impacts just reaches the stop, all impacts of a longer cycle disappear together
            let next = leaving(self.cycles(), &osc, value, side);
            if next.is_none() {
                let detail = EventDetail::at(phase, (before, None));
                return self.end(at, BranchEvent::LossOfContact { stop: side.place(), detail: Some(detail) });
            }
            next
        } else {
            beyond(self.cycles(), (&osc, &ring, value), &touches, &gone, &at.tangent)
        };
        let Some((Beyond { equations, w, tangent, positive }, after)) = next.and_then(|next| {
            let (_, ring) = next.equations.split(&next.w)?;
            let label = Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods);
            Some((next, label))
        }) else {
            return self.finish(BranchEvent::NoConvergence);
        };
        // the parameter goes back on the branch that continues
        let turns = self.cycles().pace(&at.tangent) * equations.pace(&tangent) < 0.0;
        let detail = EventDetail { impact, phase, also, labels: (before, Some(after)) };
        let (stop, other) = (side.place(), second.map(|(_, side)| side.place()));
        let event = BranchEvent::Grazing { stop, also: other, appears, turns, detail: Some(detail) };
        let again = |(v, e): &(f64, BranchEvent)| (v - value).abs() < AGAIN * (1.0 + value.abs()) && alike(e, &event);
        if self.path.grazed.iter().any(again) {
            return self.end(at, BranchEvent::Closed);
        }
        self.path.grazed.push((value, event));
        self.add(at, Some(event));
        if equations.impacts() > self.path.options.impacts as usize {
            self.tracer.here.w.clone_from(&at.w);
            self.tracer.here.known.clone_from(&at.known);
            return self.finish(BranchEvent::ImpactLimit);
        }
        if !self.go_on(equations, w, tangent, &positive) {
            self.finish(BranchEvent::NoConvergence);
        }
    }
}

/// Whether two grazing events at the same value are the same event.
fn alike(a: &BranchEvent, b: &BranchEvent) -> bool {
    use BranchEvent::Grazing;
    match (a, b) {
        (
            Grazing { stop, appears, detail: Some(one), .. },
            Grazing { stop: other_stop, appears: other_appears, detail: Some(other), .. },
        ) => {
            (stop, appears, one.labels) == (other_stop, other_appears, other.labels)
                && phase::difference(one.phase, other.phase).abs() < 1e-6
        }
        _ => false,
    }
}

/// Grazing contacts not further apart than this along the step are one event.
const TOGETHER: f64 = 1e-9;
/// Speeds below this at a grazing event count as zero: there they are located to rounding.
const AT_REST: f64 = 1e-6;
/// Grazing events at values closer than this, relative to the value, can be the same event.
const AGAIN: f64 = 1e-9;
