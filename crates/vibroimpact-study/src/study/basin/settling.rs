//! The motions of the starts of a tile: starts of one system are settled together.

use super::OscillatorBasin;
use super::oscillator::{Found, Notes, TRAPS, WORTH_A_SURVEY};
use crate::SystemPlan;
use crate::grid::Block;
use crate::study::code;
use crate::study::fill::spread;
use std::collections::HashMap;
use vibroimpact::lanes::Width;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{
    Census, CountedMotion, Ending, KnownAttractors, Reason, Settlement, Verdict, settle_each, settle_many,
};
use vibroimpact::{Oscillator, Start};

/// A point that was not computed, or has no valid system.
const NOTHING: Ending = Ending { reason: Reason::SearchLimit, impacts: 0 };

impl OscillatorBasin {
    /// Settles the given points of a tile. Returns for each point the index of its motion in the tile.
    pub(super) fn settled(
        &self,
        block: &Block,
        wanted: &[usize],
        (met, into): (&mut Census, &mut Notes),
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<u32>> {
        into.endings.resize(block.points(), NOTHING);
        if let Some((osc, survey)) = &self.one {
            let start = |k: usize| self.start(osc, &self.system, &block.index(wanted[k]));
            let all: Vec<usize> = (0..wanted.len()).collect();
            let (motions, cells) = self.among(osc, (&all, wanted), start, survey, &mut into.endings, tick)?;
            let numbers: Vec<u32> = motions.iter().map(|found| whole(met.add_found(found))).collect();
            return Some(cells.into_iter().map(|cell| numbers[cell as usize]).collect());
        }
        // starts of one system are settled together
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        for (k, number) in wanted.iter().enumerate() {
            let group = *known.entry(self.starts.key(&block.index(*number))).or_insert_with(|| {
                groups.push(Vec::new());
                groups.len() - 1
            });
            groups[group].push(k);
        }
        let mut numbers = vec![0; wanted.len()];
        // the starts of systems with few of them share lanes
        let mut few: Vec<(Vec<usize>, SystemPlan, Oscillator)> = Vec::new();
        for group in groups {
            let first = block.index(wanted[group[0]]);
            // the corners are valid; a point between them that is not is undecided
            let Some((there, osc)) = self.starts.system(&self.system, &first) else {
                let number = whole(into.found.len());
                into.found.push(Found { code: crate::study::UNDECIDED, multipliers: None, quantities: None });
                group.iter().for_each(|k| numbers[*k] = number);
                if group.iter().any(|_| tick()) {
                    return None;
                }
                continue;
            };
            if group.len() as u64 <= WORTH_A_SURVEY {
                few.push((group, there, osc));
                continue;
            }
            let start = |k: usize| self.start(&osc, &there, &block.index(wanted[group[k]]));
            let traps = if self.transient() { 0 } else { TRAPS };
            let chosen = spread(group.len() as u64, traps).filter_map(|k| usize::try_from(k).ok()).map(start);
            let survey = KnownAttractors::survey(&osc, chosen, &self.options);
            let (motions, cells) = self.among(&osc, (&group, wanted), start, &survey, &mut into.endings, tick)?;
            let own: Vec<u32> = motions.iter().map(|found| self.found(&osc, &found.verdict, &mut into.found)).collect();
            group.iter().zip(cells).for_each(|(k, cell)| numbers[*k] = own[cell as usize]);
        }
        for ((group, _, osc), settlement) in few.iter().zip(self.of_few(block, wanted, &few, tick)?) {
            let own: Vec<u32> =
                settlement.motions.iter().map(|found| self.found(osc, &found.verdict, &mut into.found)).collect();
            for ((k, cell), ending) in group.iter().zip(&settlement.cells).zip(&settlement.endings) {
                numbers[*k] = own[*cell as usize];
                into.endings[wanted[*k]] = *ending;
            }
        }
        Some(numbers)
    }

    /// Settles the few starts of each of several systems, side by side.
    fn of_few(
        &self,
        block: &Block,
        wanted: &[usize],
        few: &[(Vec<usize>, SystemPlan, Oscillator)],
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Settlement>> {
        let counted: Vec<(Oscillator, u64)> = few.iter().map(|(group, _, osc)| (*osc, group.len() as u64)).collect();
        let start = |system: usize, k: u64| {
            let (group, there, osc) = &few[system];
            self.start(osc, there, &block.index(wanted[group[usize::try_from(k).unwrap_or(0)]]))
        };
        let mut settlements = vec![Settlement::default(); few.len()];
        settle_each(&counted, &start, &self.options, false, Width::best(), &mut |system, settlement| {
            settlements[system] = settlement;
            few[system].0.iter().fold(false, |stop, _| tick() || stop)
        })
        .then_some(settlements)
    }

    /// Settles starts of one oscillator, and notes how each was decided. `group` are the places of the starts in `wanted`.
    fn among(
        &self,
        osc: &Oscillator,
        (group, wanted): (&[usize], &[usize]),
        start: impl Fn(usize) -> Start,
        survey: &KnownAttractors,
        endings: &mut [Ending],
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<(Vec<CountedMotion>, Vec<u32>)> {
        let start = |k: u64| start(usize::try_from(k).unwrap_or(0));
        let range = 0..group.len() as u64;
        let settlement = settle_many(osc, range, &start, survey, &self.options, Width::best(), &|| tick());
        if settlement.cells.len() < group.len() {
            return None;
        }
        for (k, ending) in group.iter().zip(&settlement.endings) {
            endings[wanted[*k]] = *ending;
        }
        Some((settlement.motions, settlement.cells))
    }

    /// The number of a motion in a tile of several systems. Without quantities and multipliers motions are their labels.
    fn found(&self, osc: &Oscillator, verdict: &Verdict, all: &mut Vec<Found>) -> u32 {
        let code = code(verdict);
        let bare = self.asked().is_empty() && !self.of_points();
        let known = if bare { all.iter().position(|known| known.code == code) } else { None };
        whole(known.unwrap_or_else(|| {
            let asked = self.asked();
            let quantities = if asked.is_empty() { None } else { of_verdict_only(osc, verdict, asked) };
            let multipliers = if self.of_systems() { verdict.multipliers(osc) } else { None };
            all.push(Found { code, multipliers, quantities });
            all.len() - 1
        }))
    }
}

/// An index of a motion.
fn whole(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}
