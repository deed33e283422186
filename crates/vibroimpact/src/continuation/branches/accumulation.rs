//! Where a branch gains impact after impact: the complete chatter at the end of it.
//!
//! Towards a chatter that completes just at the release, cycles gain an impact at values that come closer together by a fixed
//! factor, each of them with a fold and a touch of its own, so that no branch gets there. The limit is known from its
//! release: beyond, the motion from there comes to rest, and on this side it does not.

use super::impact_branch::ImpactBranch;
use super::point::{BranchEvent, Change, SolutionPoint};
use crate::orbit::{DEFAULT_EVENTS, Excursion, cycle_distance};
use crate::system::Side;
use crate::verdict::Label;

impl ImpactBranch {
    /// The limit of the impacts that appeared on this branch one after another; `None` if they do not tend to a complete chatter.
    pub(crate) fn accumulation(&self) -> Option<SolutionPoint> {
        let added = |(value, event): &(f64, BranchEvent)| match event {
            BranchEvent::Grazing { change: Change::Appears, side, .. } => Some((*value, *side)),
            _ => None,
        };
        let added: Option<Vec<(f64, Side)>> = self.grazed.iter().rev().take(LEAST).map(added).collect();
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
        // as far again as the values of the touches would go on
        let mut outside = last;
        let mut inside = last + 2.0 * step * ratio / (1.0 - ratio);
        if rests(outside).is_some() {
            return None;
        }
        for _ in 0..MAX_HALVINGS {
            let middle = 0.5 * (inside + outside);
            if middle == inside || middle == outside {
                break;
            }
            if rests(middle).is_some() {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        let (osc, _) = self.cycles().split_at(&self.tracer.here.w, inside)?;
        let limit = rests(inside)?;
        let rest = limit.rests().last().filter(|rest| rest.held * osc.beta() < SHRUNK)?.span;
        let cycle = limit.cycle()?;
        // it has to be the limit of this branch, not of another one
        let mine = &self.tracer.here.known.cycle.points;
        let alike = |shift: usize| {
            let turned = mine.iter().cycle().skip(shift).zip(&cycle.points).take(mine.len() / 2);
            turned.into_iter().all(|(a, b)| cycle_distance(&a.state, &b.state) < NEAR)
        };
        if mine.len() < LEAST || !(0..mine.len()).any(alike) {
            return None;
        }
        let before = Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods);
        let event = BranchEvent::Chatter { side: rest.side, phase: rest.release, before };
        Some(SolutionPoint { value: inside, cycle, physical: true, event: Some(event) })
    }
}

/// Impacts that have to appear one after another.
const LEAST: usize = 3;
/// Halvings down to neighbouring numbers, at most.
const MAX_HALVINGS: u32 = 100;
/// A rest of this much phase or less, found next to where there is none, is none.
const SHRUNK: f64 = 1e-6;
/// How near the first half of its impacts have to be to those of the limit.
const NEAR: f64 = 0.1;
