//! Branches on which one impact after another appears, and the complete chatter to which they tend.
//!
//! Towards a chatter that is completed exactly at the release, cycles gain impacts at values of the parameter whose
//! distances decrease by a fixed factor. Each of these values has a fold and a grazing event of its own, so no branch
//! reaches the limit. The limit is computed from the release: on one side of it the motion from the release sticks, on
//! the other side it does not.

use super::impact_branch::ImpactBranch;
use super::point::SolutionPoint;
use crate::continuation::event::{BranchEvent, EventDetail};
use crate::math::root;
use crate::orbit::{DEFAULT_EVENTS, Excursion, cycle_distance};
use crate::system::Side;
use crate::verdict::Label;

impl ImpactBranch {
    /// The limit of the values at which impacts appeared on this branch; `None` if they do not tend to a complete
    /// chatter.
    pub(crate) fn accumulation(&self) -> Option<SolutionPoint> {
        let added = |(value, event): &(f64, BranchEvent)| match event {
            BranchEvent::Grazing { stop, appears: true, .. } => Some((*value, Side::at(*stop))),
            _ => None,
        };
        let added: Option<Vec<(f64, Side)>> = self.path.grazed.iter().rev().take(LEAST).map(added).collect();
        let [(last, side), (second, _), (first, _)] = added?[..] else { return None };
        let (step, before) = (last - second, second - first);
        let ratio = step / before;
        if !(ratio > 0.0 && ratio < 1.0) {
            return None;
        }
        let (_, ring) = self.cycles().split(&self.tracer.here.w)?;
        let rests = |value: f64| -> Option<Excursion> {
            let (osc, _) = self.cycles().split_at(&self.tracer.here.w, value)?;
            let excursion = Excursion::new(&osc, side, DEFAULT_EVENTS, 0.5 + f64::from(ring.periods))?;
            (excursion.periods == Some(ring.periods)).then_some(excursion)
        };
        // twice as far as the limit of the geometric series of these values
        let outside = last;
        let inside = last + 2.0 * step * ratio / (1.0 - ratio);
        if rests(outside).is_some() {
            return None;
        }
        let (inside, _) = root::border(inside, outside, |value| rests(value).is_some());
        let (osc, _) = self.cycles().split_at(&self.tracer.here.w, inside)?;
        let limit = rests(inside)?;
        let rest = limit.rests().last().filter(|rest| rest.held * osc.beta() < SHRUNK)?.span;
        let cycle = limit.cycle()?;
        // the limit must be that of this branch
        let mine = &self.tracer.here.known.cycle.points;
        let alike = |shift: usize| {
            let turned = mine.iter().cycle().skip(shift).zip(&cycle.points).take(mine.len() / 2);
            turned.into_iter().all(|(a, b)| cycle_distance(&a.state, &b.state) < NEAR)
        };
        if mine.len() < LEAST || !(0..mine.len()).any(alike) {
            return None;
        }
        let before = Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods);
        let detail = EventDetail::at(rest.release, (before, Some(cycle.label)));
        let event = BranchEvent::Sticking { stop: rest.side.place(), begins: true, detail: Some(detail) };
        Some(SolutionPoint { value: inside, cycle, physical: true, event: Some(event) })
    }
}

/// The number of impacts that must have appeared one after another.
const LEAST: usize = 3;
/// A time of sticking below this, as a phase, counts as zero if there is no sticking at the neighbouring value.
const SHRUNK: f64 = 1e-6;
/// The largest distance of the impacts in the first half of the cycle from those of the limit.
const NEAR: f64 = 0.1;
