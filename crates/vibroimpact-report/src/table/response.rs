//! The response over a parameter: one row for each motion of a sweep and each point of a branch.

use super::Table;
use super::quantities::{cells, columns};
use crate::Units;
use crate::number::Number;
use vibroimpact::quantities::Quantity;
use vibroimpact_study::{ResponseCurves, SweptMotion};

/// The table of `vibro response`, with all quantities. The first column is `up`, `down` or the number of a branch.
#[must_use]
pub fn table<'a>(found: &'a ResponseCurves, units: &'a Units) -> Table<'a> {
    let (vary, unit) = (found.plan.vary, units.of(found.plan.vary));
    let swept = move |name: &'static str, motions: &'a [SweptMotion]| {
        motions.iter().map(move |motion| {
            let own = cells(&Quantity::ALL, motion.quantities, &units.at(vary, motion.value));
            format!("{name},{},{},true,,{own}", Number(motion.value * unit), motion.label)
        })
    };
    let branches = found.branches.iter().enumerate().flat_map(move |(k, branch)| {
        branch.points.iter().map(move |point| {
            let solution = &point.solution;
            let own = cells(&Quantity::ALL, point.quantities, &units.at(vary, solution.value));
            format!(
                "{},{},{},{},{},{}{own}",
                k + 1,
                Number(solution.value * unit),
                solution.cycle.label,
                solution.physical,
                solution.stable(),
                solution.stability()
            )
        })
    });
    let header = format!(
        "curve,{},label,admissible,stable,stability{}",
        units.column_of(found.plan.vary),
        columns(&Quantity::ALL, units)
    );
    Table::new(header, swept("up", &found.up).chain(swept("down", &found.down)).chain(branches))
}
