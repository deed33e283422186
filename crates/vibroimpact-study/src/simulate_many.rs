//! The events of the motions at many points, by several threads.

use crate::event_columns::{REAL_COLUMNS, Rows};
use crate::simulate::{Bounds, SoFar};
use crate::{Control, EventColumns, PlanError, PointsPlan, RunError, SimulatePlan, StartPlan, SystemPlan, tiles};
use std::sync::Mutex;
use vibroimpact::lanes::Width;
use vibroimpact::motion::{End, Event, EventRecorder, record_events};
use vibroimpact::{Oscillator, Start};

/// Number of points of a tile: of one system, whose motions share lanes, and of several.
const TILES: [usize; 2] = [512, 32];

/// The largest number of cells of a column that is allocated before the number of events is known.
const MOST_CELLS: usize = 1 << 25;
/// The number of events for which there is room if only the time is limited.
const ROOM: u64 = 64;

/// The number of real numbers for which [`simulate_points`] needs memory.
#[must_use]
pub fn real_numbers(points: &PointsPlan, plan: &SimulatePlan) -> usize {
    let rows = rows(points);
    REAL_COLUMNS * rows * room(rows, plan)
}

fn rows(points: &PointsPlan) -> usize {
    usize::try_from(points.count()).unwrap_or(usize::MAX)
}

/// Follows the motion at each point event by event, up to the lengths of a plan, as [`simulate`](crate::simulate())
/// does. The motions of one system are followed side by side. The [real numbers](REAL_COLUMNS) of the
/// events are written to `real`, which has room for [so many](real_numbers), unless the columns are refitted.
///
/// # Errors
/// [`RunError`] for a length outside its range, for the first invalid point, or when stopped.
///
/// # Panics
/// If `real` has another length.
pub fn simulate_points(
    points: &PointsPlan,
    (system, start): (&SystemPlan, &StartPlan),
    plan: &SimulatePlan,
    real: &mut [f64],
    control: &Control<'_>,
) -> Result<EventColumns, RunError> {
    assert_eq!(real.len(), real_numbers(points, plan), "real numbers");
    plan.check()?;
    points.check(system, start, |there, start| start.start(&there.oscillator()?).map(|_| ()))?;
    let one = if points.one_system() { Some(system.oscillator()?) } else { None };
    let tile = TILES[usize::from(one.is_none())];
    let total = rows(points);
    let mut columns = EventColumns::open(total, room(total, plan));
    let parts: Vec<Mutex<Option<Rows<'_>>>> =
        columns.parts(real, tile).into_iter().map(|rows| Mutex::new(Some(rows))).collect();
    let aside = tiles(total as u64, tile as u64, control, |range, tick| {
        let [first, last] = [range.start, range.end].map(|k| usize::try_from(k).unwrap_or(usize::MAX));
        let rows = parts[first / tile].lock().ok().and_then(|mut rows| rows.take());
        let Some(rows) = rows else { return Ok(Vec::new()) };
        let mut part = Part { rows: rows.begun(), so_far: vec![SoFar::default(); last - first], control, tick };
        if let Some(osc) = &one {
            let at = |k: usize| points.start_in((system, system), start, k).start(osc);
            let starts: Vec<Start> = (first..last).map(at).collect::<Result<_, PlanError>>()?;
            part.record(0, osc, &starts, plan);
        } else {
            for k in first..last {
                let (osc, start) = points.problem(system, start, k)?;
                part.record(k - first, &osc, &[start], plan);
                if control.stopping() {
                    break;
                }
            }
        }
        Ok(part.rows.filled().into_iter().map(|(row, event)| (first + row, event)).collect::<Vec<_>>())
    })?;
    drop(parts);
    let aside = aside.into_iter().collect::<Result<Vec<Vec<_>>, PlanError>>()?;
    Ok(columns.fitted(real, aside.into_iter().flatten()))
}

/// The number of events for which each row has room at first: most motions have one for each impact, and a few others.
fn room(rows: usize, plan: &SimulatePlan) -> usize {
    let impacts = plan.impacts.map(|impacts| impacts.saturating_add(impacts / 16 + 4));
    let wanted = impacts.unwrap_or(if plan.limits_time() { ROOM } else { plan.most_impacts() });
    usize::try_from(wanted).unwrap_or(usize::MAX).min(MOST_CELLS / rows.max(1)).max(1)
}

/// The rows of a tile, and the events of each of its motions so far.
struct Part<'a> {
    rows: Rows<'a>,
    so_far: Vec<SoFar>,
    control: &'a Control<'a>,
    tick: &'a (dyn Fn() -> bool + Sync),
}

impl Part<'_> {
    /// Follows the motions of one system into the rows from `first` on.
    fn record(&mut self, first: usize, osc: &Oscillator, starts: &[Start], plan: &SimulatePlan) {
        let bounds = Bounds::new(osc, plan);
        let search = bounds.search;
        record_events(osc, starts, search, Width::best(), &mut Motions { part: self, first, bounds });
    }
}

/// Motions of one system, with the row of the first one.
struct Motions<'p, 'a> {
    part: &'p mut Part<'a>,
    first: usize,
    bounds: Bounds,
}

impl EventRecorder for Motions<'_, '_> {
    // an event in memory, written number by number, could not be read in larger pieces before all are there
    #[inline(always)]
    fn event(&mut self, motion: usize, event: &Event) -> bool {
        let row = self.first + motion;
        let (listed, end) = self.bounds.next(&mut self.part.so_far[row], event);
        if listed {
            self.part.rows.push(row, event);
        }
        if let Some((reason, time, _)) = end {
            self.part.rows.end(row, reason, time);
            return false;
        }
        !self.part.control.stopping()
    }

    fn end(&mut self, motion: usize, end: Option<End>) {
        let row = self.first + motion;
        let (reason, time, _) = self.bounds.ended(&self.part.so_far[row], end);
        self.part.rows.end(row, reason, time);
    }

    fn stopping(&mut self) -> bool {
        (self.part.tick)()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Coordinate, END_REASONS, ListedColumn, Simulated, simulate};
    use core::sync::atomic::{AtomicBool, Ordering};
    use vibroimpact::Side;
    use vibroimpact::motion::EventKind;

    /// What varies, and its value for a number from 0 to 1.
    type Varied = (&'static str, fn(f64) -> f64);

    /// Points with these columns.
    fn listed(columns: &[Varied], count: u32) -> PointsPlan {
        let column = |(name, of): &Varied| ListedColumn {
            vary: Coordinate::named(name).unwrap(),
            values: (0..count).map(|k| of((0.618_034 * f64::from(k)).fract())).collect(),
        };
        PointsPlan::Listed(columns.iter().map(column).collect())
    }

    /// The columns from the events of each motion alone, and their real numbers.
    fn expected(all: &[Simulated]) -> (EventColumns, Vec<f64>) {
        let width = all.iter().map(|one| one.events.len()).max().unwrap();
        let mut columns = EventColumns { room: width, width, ..EventColumns::default() };
        let mut real = [(); REAL_COLUMNS].map(|()| Vec::new());
        for one in all {
            for k in 0..width {
                let event = one.events.get(k);
                let kind = event.map(|event| event.kind);
                columns.kind.push(kind.map_or(-1, |kind| match kind {
                    EventKind::Impact { .. } => 0,
                    EventKind::Graze { .. } => 1,
                    EventKind::Stick { .. } => 2,
                    EventKind::Release => 3,
                }));
                columns.side.push(event.map_or(0, |event| if event.side == Side::Upper { 1 } else { -1 }));
                real[0].push(event.map_or(f64::NAN, |event| event.time));
                real[1].push(event.map_or(f64::NAN, |event| event.phase));
                let (before, after) = match kind {
                    Some(EventKind::Impact { velocity_before, velocity_after }) => (velocity_before, velocity_after),
                    _ => (f64::NAN, f64::NAN),
                };
                real[2].push(before);
                real[3].push(after);
            }
            columns.count.push(i32::try_from(one.events.len()).unwrap());
            columns.end.push(END_REASONS.iter().position(|reason| *reason == one.reason).unwrap().try_into().unwrap());
            columns.end_time.push(one.time);
        }
        (columns, real.concat())
    }

    /// All numbers as bits, so that nan equals nan, without the cells that hold no events in any row.
    fn bits((of, real): &(EventColumns, Vec<f64>)) -> (usize, Vec<i8>, Vec<i32>, Vec<u64>) {
        fn used<T: Copy>(column: &[T], of: &EventColumns) -> Vec<T> {
            column.chunks(of.room.max(1)).flat_map(|row| row[..of.width].to_vec()).collect()
        }
        let real = used(of.refitted.as_ref().unwrap_or(real), of);
        let real = real.iter().chain(&of.end_time).map(|value| value.to_bits()).collect();
        (of.width, [used(&of.kind, of), used(&of.side, of), of.end.clone()].concat(), of.count.clone(), real)
    }

    fn system(inverse: f64, gap: f64, restitution: f64, damping: f64) -> SystemPlan {
        SystemPlan { inverse_beta: Some(inverse), gap, restitution, damping, ..SystemPlan::default() }
    }

    #[test]
    fn the_same_as_one_by_one() {
        let starts: &[Varied] = &[("x", |u| -0.6 - 3.0 * u), ("v", |u| 4.0 * u - 2.0), ("phase", |u| 9.0 * u)];
        let various: &[Varied] = &[("inverse_beta", |u| 0.4 + 2.0 * u), ("gap", |u| 3.0 * u - 0.5), ("v", |u| u)];
        let mut reasons = [0; END_REASONS.len()];
        let (none, impacts) =
            (SimulatePlan::default(), |n| SimulatePlan { impacts: Some(n), ..SimulatePlan::default() });
        let periods = |n| SimulatePlan { periods: Some(n), ..none };
        let both = SimulatePlan { time: Some(60.0), ..periods(20.0) };
        let plans = [impacts(40), periods(12.5), periods(70.0), SimulatePlan { impacts: Some(3), ..both }, none];
        for (number, (over, x, system)) in [
            (starts, None, system(1.8, 0.25, 0.5, 0.0)),
            (starts, None, system(1.11, -0.5, 0.5, 0.0)),
            (starts, None, system(1.3, 0.75, 0.0, 0.01)),
            (starts, None, system(1.3, 0.4, 1.0, 0.0)),
            (starts, None, system(0.5, 40.0, 0.5, 0.0)),
            (starts, None, system(0.5, -0.5, 0.9, 0.05)),
            (various, Some(-0.6), system(1.0, 0.5, 0.6, 0.02)),
        ]
        .into_iter()
        .enumerate()
        {
            let points = listed(over, 530);
            let start = StartPlan { x, ..StartPlan::default() };
            // every other plan with each of them
            for (k, plan) in plans.iter().enumerate().skip(number % 2).step_by(2) {
                let alone = |k| {
                    let (osc, start) = points.problem(&system, &start, k).unwrap();
                    simulate(&osc, start, plan, &Control::default()).unwrap()
                };
                let alone: Vec<Simulated> = (0..530).map(alone).collect();
                for one in &alone {
                    reasons[END_REASONS.iter().position(|reason| *reason == one.reason).unwrap()] += 1;
                }
                let expected = expected(&alone);
                let control = Control { threads: 1 + (k / 2) % 2, ..Control::default() };
                let mut real = vec![0.0; real_numbers(&points, plan)];
                let got = simulate_points(&points, (&system, &start), plan, &mut real, &control).unwrap();
                assert!(bits(&(got, real)) == bits(&expected), "{system:?} {plan:?}");
            }
        }
        assert!(reasons[..3].iter().all(|count| *count > 100), "{reasons:?}");
    }

    #[test]
    fn the_flag_stops_it_also_in_a_long_motion() {
        let (points, system) = (listed(&[("v", |u| u)], 40), system(1.8, 0.25, 0.5, 0.0));
        let stop = AtomicBool::new(false);
        let tell = |done| {
            stop.fetch_or(done >= 1, Ordering::Relaxed);
        };
        let control = Control { stop: &stop, progress: &tell, threads: 1 };
        let start = StartPlan::default();
        let ask = |impacts| {
            let plan = &SimulatePlan { impacts: Some(impacts), ..SimulatePlan::default() };
            let mut real = vec![0.0; real_numbers(&points, plan)];
            simulate_points(&points, (&system, &start), plan, &mut real, &control)
        };
        let stopped = ask(1000);
        assert!(matches!(stopped, Err(RunError::Stopped(of)) if of.done < 40), "{stopped:?}");
        stop.store(true, Ordering::Relaxed);
        let stopped = ask(10_000_000);
        assert!(matches!(stopped, Err(RunError::Stopped(of)) if of.done == 0), "{stopped:?}");
    }

    #[test]
    fn a_length_outside_its_range_is_an_error() {
        let (points, system) = (listed(&[("v", |u| u)], 3), system(1.8, 0.25, 0.5, 0.0));
        let plan = SimulatePlan { periods: Some(-1.0), ..SimulatePlan::default() };
        let mut real = vec![0.0; real_numbers(&points, &plan)];
        let found = simulate_points(&points, (&system, &StartPlan::default()), &plan, &mut real, &Control::default());
        let error = found.unwrap_err().to_string();
        assert!(error.starts_with("periods = -1 lies outside 0 < periods <= 1e9"), "{error}");
    }
}
