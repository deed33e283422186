//! Work at each of many points, by several threads.

use super::PointsPlan;
use crate::{Control, PlanError, RunError, StartPlan, SystemPlan, tiles};
use vibroimpact::{Oscillator, Start};

/// Number of points of a tile.
const TILE: u64 = 32;

impl PointsPlan {
    /// The oscillator and the start at point number `k`; other numbers are those of `system` and `start`.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid system or start.
    pub fn problem(&self, system: &SystemPlan, start: &StartPlan, k: usize) -> Result<(Oscillator, Start), PlanError> {
        let there = if self.one_system() { *system } else { system.with_all(self.parameters(k))? };
        let osc = there.oscillator()?;
        Ok((osc, self.start_in((system, &there), start, k).start(&osc)?))
    }

    /// The results of `work` at all points, in order.
    ///
    /// # Errors
    /// [`RunError`] for the first invalid point, or when stopped.
    pub fn each<T: Send>(
        &self,
        (system, start): (&SystemPlan, &StartPlan),
        control: &Control<'_>,
        work: impl Fn(&Oscillator, Start) -> T + Sync,
    ) -> Result<Vec<T>, RunError> {
        self.check(system, start, |there, start| start.start(&there.oscillator()?).map(|_| ()))?;
        let parts = tiles(self.count(), TILE, control, |range, tick| {
            let mut found = Vec::new();
            for k in range {
                let problem = self.problem(system, start, usize::try_from(k).unwrap_or(usize::MAX));
                found.push(problem.map(|(osc, start)| work(&osc, start)));
                if tick() {
                    break;
                }
            }
            found
        })?;
        parts.into_iter().flatten().map(|found| found.map_err(RunError::from)).collect()
    }
}
