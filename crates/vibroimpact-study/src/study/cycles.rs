//! Numbers for the cycles of one system, the same in all tiles, and for the rests of a machine, which may be on different stops.
//!
//! Two different motions may have the same label, such as 1/1 or stuck. A survey before the first tile, which every tile repeats
//! with the same result, numbers the cycles that it finds. A tile that finds another cycle gives it a preliminary
//! number below [`NONE`]. When all tiles are complete, these few cycles are computed again and numbered in the order of
//! the tiles.

use super::basin::{BasinFill, Basins, MachineBasin, OscillatorBasin};
use super::stored_motion::{Stored, StoredCycle};
use super::tables::{Cells, StudyTable, Tiles};
use crate::Unit;
use crate::field::{Column, Field};
use crate::grid::Grid;
use std::collections::BTreeMap;
use vibroimpact::verdict::{Census, CountedMotion, Verdict};

/// Number of a motion that has none.
pub(super) const NONE: i32 = -1;
/// Number of the cycle of a start that lies beyond a rigid stop, which counts for no share.
pub(super) const BEYOND: i32 = i32::MIN + 1;
/// Preliminary number of the first cycle that only this tile has found; further ones count downwards.
const UNKNOWN: i32 = -2;

/// The field with the number of the cycle of each start, beside that with its `label`.
pub(super) fn field(label: Field) -> Field {
    Field {
        name: "cycle".into(),
        long_name: "number of the cycle that the start leads to, in the tables cycle_*".into(),
        fill: i32::MIN,
        flags: vec![(i32::MIN, "not_computed"), (NONE, "no_cycle")],
        comment: "numbers below -1 stand for cycles that are numbered when all tiles are there",
        ..label
    }
}

/// The number of a motion in a tile. Cycles that the survey has not found are added to `unknown`.
pub(super) fn number<S: Stored>(known: &[Verdict<S>], unknown: &mut Census<S>, found: &CountedMotion<S>) -> i32 {
    if S::stored_cycle(&found.verdict).is_none() {
        return NONE;
    }
    let whole = |n: usize| i32::try_from(n).unwrap_or(i32::MAX / 2);
    match known.iter().position(|other| other.same_as(&found.verdict, SAME)) {
        Some(k) => whole(k),
        None => UNKNOWN - whole(unknown.add_found(found)),
    }
}

/// Whether it is a preliminary number.
const fn preliminary(n: i32) -> bool {
    n <= UNKNOWN && n > BEYOND
}

/// Two cycles closer than this are the same one, as in a census.
pub(super) const SAME: f64 = 1e-6;

/// The cycles found by a survey.
pub(super) fn survey<S: Stored>(found: &Census<S>) -> Vec<Verdict<S>> {
    let numbered = found.motions().iter().filter(|found| S::stored_cycle(&found.verdict).is_some());
    numbered.map(|found| found.verdict.clone()).collect()
}

/// A basin of one oscillator or of one machine, whose cycles are numbered.
pub(crate) enum Numbered<'a> {
    Oscillator(&'a BasinFill<OscillatorBasin>),
    Machine(&'a BasinFill<MachineBasin>),
}

impl Numbered<'_> {
    pub(super) fn conclude<T: Tiles>(&self, grid: &Grid, tiles: &mut T) -> Result<Vec<StudyTable>, T::Error> {
        match self {
            Self::Oscillator(of) => of.conclude(grid, tiles),
            Self::Machine(of) => of.conclude(grid, tiles),
        }
    }
}

/// The number of the field that contains the numbers.
const FIELD: usize = 1;

impl<B: Basins> BasinFill<B> {
    fn conclude<T: Tiles>(&self, grid: &Grid, tiles: &mut T) -> Result<Vec<StudyTable>, T::Error> {
        let known = self.cycles().unwrap_or_default();
        let mut cycles = known.to_vec();
        let mut counts: BTreeMap<i32, u64> = BTreeMap::new();
        let mut add = |own: &[(i32, u64)]| own.iter().for_each(|(n, count)| *counts.entry(*n).or_default() += count);
        // the tiles with cycles that the survey has not found
        let mut further: BTreeMap<u64, Vec<(i32, u64)>> = BTreeMap::new();
        let surveyed = |n: i32| !preliminary(n) && usize::try_from(n).map_or(true, |n| n < known.len());
        tiles.counts(grid.tiles(), FIELD, &mut |k, own| {
            if own.iter().all(|(n, _)| surveyed(*n)) {
                add(own);
            } else {
                further.insert(k, own.to_vec());
            }
        })?;
        for (k, own) in further {
            // Some of these tiles may have their final numbers already, if a conclusion was killed or a tile was mended. Such a
            // tile is computed again if it was the first with one of its cycles, so that all conclusions are the same.
            let renumbers = own.iter().any(|(n, _)| preliminary(*n));
            let first = own.iter().any(|(n, _)| usize::try_from(*n).is_ok_and(|n| n >= cycles.len()));
            let mut renumbered = Vec::new();
            if renumbers || first {
                for found in self.unknown(&grid.tile(k)).motions() {
                    let same = cycles.iter().position(|other| other.same_as(&found.verdict, SAME));
                    renumbered.push(same.unwrap_or_else(|| {
                        cycles.push(found.verdict.clone());
                        cycles.len() - 1
                    }));
                }
            }
            if !renumbers {
                add(&own);
                continue;
            }
            let mut numbers = tiles.read(k, FIELD)?.whole().to_vec();
            for n in numbers.iter_mut().filter(|n| preliminary(**n)) {
                let place = usize::try_from(UNKNOWN - *n).unwrap_or(usize::MAX);
                *n = renumbered.get(place).and_then(|n| i32::try_from(*n).ok()).unwrap_or(NONE);
            }
            let column = Column::I32(numbers);
            tiles.write(k, FIELD, &column)?;
            add(&column.counts());
        }
        let count = |n: i32| counts.get(&n).copied().unwrap_or(0);
        let starts: Vec<u64> = (0..cycles.len()).map(|n| i32::try_from(n).map_or(0, count)).collect();
        let cycles: Vec<StoredCycle> = cycles.iter().filter_map(B::System::stored_cycle).collect();
        Ok(tables(&cycles, (&self.of.stops(), &starts), (grid.points() - count(BEYOND), B::System::UNITS)))
    }
}

/// The tables of the cycles: labels, numbers of starts that lead to each, stability, and impacts.
#[allow(clippy::cast_precision_loss)] // counts below 2^53
fn tables(
    cycles: &[StoredCycle],
    (stops, starts): (&[String], &[u64]),
    (total, units): (u64, [Unit; 2]),
) -> Vec<StudyTable> {
    let longest = cycles.iter().map(|cycle| cycle.points.len()).max().unwrap_or(0);
    let count = cycles.len();
    let table = |name, long_name, unit, values| StudyTable {
        name,
        long_name,
        unit,
        dimensions: vec![("cycles", count)],
        values,
    };
    let real = |values: Vec<f64>| Cells::Numbers(Column::F64(values));
    let labels = Cells::Text(cycles.iter().map(|cycle| cycle.label.clone()).collect());
    let shares = real(starts.iter().map(|n| *n as f64 / total as f64).collect());
    let largest = real(cycles.iter().map(|cycle| cycle.multiplier).collect());
    let mut tables = vec![
        table("cycle_label", "motion m/n", Unit::NUMBER, labels),
        table("cycle_share", "share of the starts that lead to the cycle", Unit::NUMBER, shares),
        table("cycle_multiplier", "largest modulus of the Floquet multipliers", Unit::NUMBER, largest),
    ];
    if cycles.iter().any(|cycle| !cycle.stops.is_empty()) {
        let name = |stop: &usize| stops.get(*stop).map_or("", String::as_str);
        let names = |cycle: &StoredCycle| cycle.stops.iter().map(name).collect::<Vec<_>>().join(" ");
        let names = Cells::Text(cycles.iter().map(names).collect());
        tables.push(table("cycle_stop", "stops that stay closed for ever", Unit::NUMBER, names));
    }
    if longest > 0 {
        let each = |name, long_name, unit, k: usize| {
            let padded = cycles.iter().flat_map(|cycle| {
                let impacts = cycle.points.iter().map(|point| point[k]);
                impacts.chain(core::iter::repeat(f64::NAN)).take(longest).collect::<Vec<_>>()
            });
            let dimensions = vec![("cycles", count), ("impact", longest)];
            StudyTable { name, long_name, unit, dimensions, values: real(padded.collect()) }
        };
        tables.push(each("cycle_phase", "phase of the force at the impact", Unit::ANGLE, 0));
        tables.push(each("cycle_velocity", "speed of arrival", units[0], 1));
        tables.push(each("cycle_interval", "time to the next impact", units[1], 2));
    }
    if count == 0 { Vec::new() } else { tables }
}
