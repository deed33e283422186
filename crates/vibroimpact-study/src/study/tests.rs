//! Compares studies with the same questions computed point by point.

use super::*;
use crate::Axis;
use crate::axis::{Coordinate, Values};
use crate::{
    BasinPlan, Control, DiagramPlan, DrawnPoints, ListedColumn, LyapunovPlan, MapPlan, Parameter, PointRange,
    PointRule, PointsPlan, Span, StartPlan, Stretch, SystemPlan,
};
use vibroimpact::verdict::{Reason, SettleOptions};

const S: SystemPlan = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);

fn span(text: &str) -> Span {
    text.parse().unwrap()
}

/// A basin without axes.
fn no_axes() -> BasinPlan {
    BasinPlan { axes: Vec::new(), ..BasinPlan::plane(span("0:1:2"), span("0:1:2"), 0.0) }
}

fn sheet(system: SystemPlan, task: Task, tile: Option<u32>, threads: usize) -> Sheet {
    let plan = Plan { tile, ..Plan::new(system, task) };
    in_memory(Study::new(&plan).unwrap(), &Control { threads, ..Control::default() }).unwrap()
}

fn columns<'a>(sheet: &'a Sheet, name: &str) -> &'a Column {
    &sheet.columns[sheet.fields.iter().position(|field| field.name == name).unwrap()]
}

#[test]
fn a_basin_is_that_of_the_starts_one_by_one() {
    let plan = BasinPlan::plane(span("-4:0.75:37"), span("-4:4:29"), 0.3);
    let found = sheet(S, Task::from(plan.clone()), Some(10), 2);
    let direct = crate::in_memory::basin(&S, &plan, &Control::default()).unwrap();
    let labels: Vec<String> = columns(&found, "label").whole().iter().map(|c| label_of(*c).unwrap()).collect();
    let want: Vec<String> = (0..37 * 29).map(|k| direct.label(k).into_owned()).collect();
    assert_eq!(labels, want);
    // the numbers distinguish motions with the same label, and the table counts their starts
    let cycles = columns(&found, "cycle").whole();
    let number = |motion: u16| cycles[direct.cells.iter().position(|m| *m == motion).unwrap()];
    assert!(direct.cells.iter().zip(cycles).all(|(motion, cycle)| *cycle == number(*motion)));
    let share = found.tables.iter().find(|table| table.name == "cycle_share").unwrap();
    let Cells::Numbers(Column::F64(shares)) = &share.values else { panic!() };
    assert_eq!(shares.len(), 2);
    for (m, motion) in direct.motions.iter().enumerate() {
        let cycle = number(u16::try_from(m).unwrap());
        assert_eq!(shares[cycle as usize], motion.count as f64 / (37.0 * 29.0));
    }
    for (tile, threads) in [(1, 2), (7, 1), (64, 3), (300, 8)] {
        let other = sheet(S, Task::from(plan.clone()), Some(tile), threads);
        assert!(other.columns == found.columns && other.tables == found.tables, "{tile}");
    }
}

/// With an empty survey all cycles are numbered at the end.
#[test]
fn cycles_that_nobody_knew_of_are_numbered_at_the_end() {
    let task = Task::from(BasinPlan::plane(span("-4:0.75:20"), span("-4:4:20"), 0.0));
    let plan = Plan { tile: Some(8), ..Plan::new(S, task) };
    let Task::Basin(basin) = &plan.task else { panic!() };
    let told = in_memory(Study::new(&plan).unwrap(), &Control::default()).unwrap();
    let untold = BasinFill::plane(&S, &basin.typed().unwrap(), plan.tile).unwrap().forgetful();
    let untold = in_memory(Study::of(Box::new(untold)), &Control::default()).unwrap();
    let (a, b) = (columns(&told, "cycle").whole(), columns(&untold, "cycle").whole());
    assert!(b.iter().all(|n| (0..2).contains(n)), "{b:?}");
    // the same motions, possibly in another order
    let swapped = a[0] != b[0];
    assert!(a.iter().zip(b).all(|(a, b)| (a == b) != swapped));
}

/// Tiles in memory.
struct Kept(Vec<Vec<Column>>);

impl Tiles for Kept {
    type Error = core::convert::Infallible;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, Self::Error> {
        Ok(self.0[usize::try_from(tile).unwrap()][field].clone())
    }

    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), Self::Error> {
        self.0[usize::try_from(tile).unwrap()][field] = column.clone();
        Ok(())
    }
}

/// A conclusion may be repeated, or follow one that was killed, or that a mended tile makes necessary.
#[test]
fn every_conclusion_is_the_same() {
    let weak = SystemPlan { beta: Some(2.8), inverse_beta: None, gap: 0.1, restitution: 0.97, damping: 0.01, ..S };
    for (system, basin) in [
        (S, BasinPlan::plane(span("-4:0.75:20"), span("-4:4:20"), 0.0)),
        (weak, BasinPlan::plane(span("-0.6:-0.4:24"), span("-4:4:24"), 0.0)),
    ] {
        let study = Study::of(Box::new(BasinFill::plane(&system, &basin, Some(8)).unwrap().forgetful()));
        let count = study.grid().tiles();
        let begun: Vec<Vec<Column>> = (0..count).map(|tile| study.tile(tile, &|| false).unwrap()).collect();
        let mut kept = Kept(begun.clone());
        let tables = study.conclude(&mut kept).unwrap();
        let Cells::Text(labels) = &tables[0].values else { panic!() };
        assert!(labels.len() > 1);
        let done = kept.0.clone();
        for again in 0..3 * count {
            let tile = usize::try_from(again % count).unwrap();
            kept.0 = match again / count {
                0 => done.clone(),
                // killed after this tile
                1 => done[..=tile].iter().chain(&begun[tile + 1..]).cloned().collect(),
                // mended
                _ => (0..done.len()).map(|k| if k == tile { &begun[k] } else { &done[k] }).cloned().collect(),
            };
            assert_eq!(study.conclude(&mut kept).unwrap(), tables, "{again}");
            assert!(kept.0 == done, "{again}");
        }
    }
}

#[test]
fn a_map_is_that_of_its_points() {
    let system = SystemPlan { inverse_beta: Some(1.0), gap: 0.0, ..S };
    let plan = MapPlan::plane(span("0.6:1.4:9"), span("-0.5:2:7"), 6, 1);
    let found = sheet(system, Task::from(plan.clone()), Some(4), 2);
    let direct = crate::in_memory::map(&system, &plan, &Control::default()).unwrap();
    let (labels, shares) = (columns(&found, "label").whole(), columns(&found, "share").real());
    for (k, point) in direct.points.iter().enumerate() {
        for (i, motion) in point.iter().enumerate() {
            assert_eq!(label_of(labels[6 * k + i]).unwrap(), motion.label);
            assert_eq!(shares[6 * k + i], motion.share);
        }
        assert!(labels[6 * k + point.len()..6 * (k + 1)].iter().all(|c| *c == NO_MOTION));
    }
    let along = found.study.coordinates();
    assert_eq!((along[0].dimension.as_str(), along[1].dimension.as_str()), ("gap", "inverse_beta"));
    assert_eq!(along[1].values[1], 0.7);
}

/// Computed points have the results of the full grid; in this example the other points have too.
#[test]
fn refinement_computes_less_and_the_same() {
    let plan = BasinPlan::plane(span("-4:0.75:200"), span("-4:4:200"), 0.0);
    let full = sheet(S, Task::from(plan.clone()), Some(100), 2);
    let fine = sheet(S, Task::from(BasinPlan { refine: Some(8), ..plan }), Some(100), 2);
    let Column::I8(computed) = columns(&fine, "computed") else { panic!() };
    let (a, b) = (columns(&full, "label").whole(), columns(&fine, "label").whole());
    let mut own = 0;
    for k in 0..a.len() {
        if computed[k] == 1 {
            own += 1;
            assert_eq!(a[k], b[k]);
        }
    }
    assert!(own < 26_000, "{own} of 40000 points computed");
    let wrong = a.iter().zip(b).filter(|(a, b)| a != b).count();
    assert!(wrong < 400, "{wrong} of 40000 points differ");

    let system = SystemPlan { inverse_beta: Some(1.0), gap: 0.0, ..S };
    let plan = MapPlan::plane(span("0.6:1.4:33"), span("-0.5:2:33"), 4, 1);
    let full = sheet(system, Task::from(plan.clone()), None, 2);
    let fine = sheet(system, Task::from(MapPlan { refine: Some(4), ..plan }), None, 2);
    let Column::I8(computed) = columns(&fine, "computed") else { panic!() };
    for name in ["label", "share", "speed", "multiplier"] {
        for (k, one) in computed.iter().enumerate().filter(|(_, one)| **one == 1) {
            let same = match (columns(&full, name), columns(&fine, name)) {
                (Column::I32(a), Column::I32(b)) => a[4 * k..4 * k + 4] == b[4 * k..4 * k + 4],
                (Column::F64(a), Column::F64(b)) => {
                    a[4 * k..4 * k + 4].iter().zip(&b[4 * k..4 * k + 4]).all(|(a, b)| a.to_bits() == b.to_bits())
                }
                _ => false,
            };
            assert!(same, "{name} at {k} ({one})");
        }
    }
}

#[test]
fn scattered_starts_exponents_and_three_axes() {
    let found = sheet(S, Task::Attractors { starts: 500, seed: 3, impacts: None }, Some(64), 2);
    let census = vibroimpact::verdict::attractors(&S.oscillator().unwrap(), 500, 3, &SettleOptions::default());
    for motion in census.motions() {
        let here = columns(&found, "label").whole().iter().filter(|c| **c == code(&motion.verdict)).count();
        assert_eq!(here as u64, motion.count);
    }
    let gaps = Axis::parameter(Parameter::Gap, Values::Listed(vec![3.0, 2.0]));
    let speeds = Axis::new(Coordinate::V, span("-1:1:3"));
    let u = SystemPlan { inverse_beta: Some(1.11), gap: 3.0, ..S };
    let plan =
        LyapunovPlan { axes: vec![gaps.clone(), speeds.clone()], impacts: Some(2000), ..LyapunovPlan::default() };
    let found = sheet(u, Task::from(plan), None, 2);
    let exponents = columns(&found, "exponent").real();
    assert_eq!(exponents.len(), 12);
    // each row is one velocity, with gap 3 (chaos at U) and gap 2 (1/2 at T)
    for row in exponents.chunks(4) {
        assert!(row[0] > 0.005 && row[2] < -0.005, "{row:?}");
    }
    let axes = vec![speeds, Axis::new(Coordinate::X, span("-1:0:2")), gaps];
    let basin = BasinPlan { axes, ..no_axes() };
    let found = sheet(u, Task::from(basin), None, 1);
    assert!(found.tables.is_empty() && found.fields.len() == 1);
    let labels = columns(&found, "label").whole();
    let second = crate::SecondStop { gap: 1.0, restitution: 0.5 };
    let two = SystemPlan { second_stop: Some(second), ..u };
    let over = vec![Axis::new(Coordinate::V, span("-9:9:5")), Axis::parameter(Parameter::SecondGap, span("1:2:2"))];
    let starts = BasinPlan { axes: over, ..no_axes() };
    let between = sheet(two, Task::from(starts), None, 1);
    for (k, found) in columns(&between, "label").whole().iter().enumerate() {
        let gap = if k < 5 { 1.0 } else { 2.0 };
        let system = SystemPlan { second_stop: Some(crate::SecondStop { gap, ..second }), ..u };
        let osc = system.oscillator().unwrap();
        let start = vibroimpact::Start::new(&osc, 0.0, [-9.0, -4.5, 0.0, 4.5, 9.0][k % 5], 0.0).unwrap();
        assert_eq!(*found, code(&vibroimpact::verdict::settle(&osc, start, &SettleOptions::default()).verdict));
    }
    assert!(labels[..6].iter().all(|c| *c == CHAOTIC) && labels[6..].iter().all(|c| *c == 10_002), "{labels:?}");
}

#[test]
fn a_diagram_is_that_of_its_steps() {
    use crate::diagram::{Show, SweepDirection};
    let damping = Stretch { parameter: Parameter::Damping, from: 0.0, to: 0.04 };
    for (direction, rows, also) in [
        (SweepDirection::Both, 2, None),
        (SweepDirection::Down, 1, Some(damping)),
        (SweepDirection::Scatter { starts: 3, seed: 1 }, 3, None),
    ] {
        let usual = DiagramPlan::new(Parameter::Gap, span("0:2:41"));
        let plan = DiagramPlan { also, direction, transient: 100, keep: 6, ..usual };
        let found = sheet(S, Task::from(plan.clone()), None, 2);
        let direct = crate::in_memory::diagram(&SweepFill::new(&S, &plan, Some(4)), &Control::default()).unwrap();
        assert_eq!(diagram_of::<SystemPlan>(&plan, &found.columns), direct);
        let beside = found.study.coordinates().into_iter().find(|along| along.name == "damping");
        assert_eq!(beside.map(|along| (along.dimension, along.values[10])), also.map(|_| ("gap".into(), 0.01)));
        let strobes = DiagramPlan { show: Show::Strobe, ..plan.clone() };
        let held = sheet(S, Task::from(strobes.clone()), None, 2);
        assert_eq!(
            diagram_of::<SystemPlan>(&strobes, &held.columns),
            crate::in_memory::diagram(&SweepFill::new(&S, &strobes, Some(4)), &Control::default()).unwrap()
        );
        let speeds = columns(&found, "velocity").real();
        assert_eq!(speeds.len(), rows * 41 * 6);
        for step in &direct.steps {
            let row = match step.sweep {
                crate::diagram::Sweep::Start(k) => usize::try_from(k).unwrap(),
                crate::diagram::Sweep::Down if rows == 2 => 1,
                _ => 0,
            };
            let at = 6 * (41 * row + step.index as usize);
            for (i, point) in step.points.iter().enumerate() {
                let crate::diagram::DiagramPoint::Impact { speed, .. } = point else { continue };
                assert_eq!(speeds[at + i], *speed);
            }
            assert!(speeds[at + step.points.len()..at + 6].iter().all(|v| v.is_nan()));
        }
    }
}

#[test]
fn questions_without_a_grid_are_no_studies() {
    let refusal = Study::new(&Plan::new(S, Task::Settle { start: None, impacts: None })).err().unwrap();
    assert!(refusal.to_string().starts_with("a plan that asks to settle fills no grid"), "{refusal}");
}

/// Points of several systems, with starts of one system among them.
fn some_points() -> PointsPlan {
    let column = |vary, values: Vec<f64>| ListedColumn { vary, values };
    let gaps: Vec<f64> = (0..90).map(|k| if k % 3 == 0 { 0.75 } else { 0.5 + 0.02 * f64::from(k) }).collect();
    let speeds: Vec<f64> = (0..90).map(|k| -2.0 + 0.05 * f64::from(k)).collect();
    PointsPlan::Listed(vec![column(Coordinate::Parameter(Parameter::Gap), gaps), column(Coordinate::V, speeds)])
}

#[test]
fn points_are_settled_as_one_by_one() {
    let (points, start) = (some_points(), StartPlan { x: None, v: 0.0, phase: 0.5 });
    let plan = BasinPlan { transient: true, ..BasinPlan::of_points(points.clone(), start) };
    let found = sheet(S, Task::from(plan.clone()), Some(7), 2);
    let (labels, reasons) = (columns(&found, "label").whole(), columns(&found, "reason").flags());
    let (transients, largest) = (columns(&found, "transient").whole(), columns(&found, "multiplier_1_re").real());
    for k in 0..90 {
        let (osc, start) = points.problem(&S, &start, k).unwrap();
        let settled = vibroimpact::verdict::settle(&osc, start, &SettleOptions::default());
        assert_eq!(labels[k], code(&settled.verdict));
        assert_eq!(Reason::ALL[usize::try_from(reasons[k]).unwrap()], settled.verdict.reason());
        assert_eq!(u64::try_from(transients[k]).unwrap(), settled.impacts);
        let modulus = settled.verdict.multipliers(&osc).map_or(f64::NAN, |[first, _]| first.re);
        assert!((largest[k] - modulus).abs() < 1e-9 || largest[k].is_nan() && modulus.is_nan());
    }
    assert!(labels.iter().collect::<std::collections::HashSet<_>>().len() > 2);
    let other = sheet(S, Task::from(plan), Some(64), 3);
    assert_eq!(columns(&other, "label").whole(), labels);
    assert_eq!(columns(&other, "transient").whole(), transients);
    let names: Vec<String> = found.study.coordinates().into_iter().map(|of| of.name).collect();
    assert_eq!(names, ["gap", "v"]);
}

/// Points of starts of one system are a basin: its cycles are numbered.
#[test]
fn points_of_one_system_are_a_basin() {
    let plane = BasinPlan::plane(span("-4:0.75:25"), span("-4:4:24"), 0.0);
    let direct = sheet(S, Task::from(plane), None, 2);
    let column = |vary, of: fn(usize) -> f64| ListedColumn { vary, values: (0..600).map(of).collect() };
    let points = PointsPlan::Listed(vec![
        column(Coordinate::X, |k| -4.0 + 4.75 * (k % 25) as f64 / 24.0),
        column(Coordinate::V, |k| -4.0 + 8.0 * (k / 25) as f64 / 23.0),
    ]);
    let found = sheet(S, Task::from(BasinPlan::of_points(points, StartPlan::default())), Some(100), 2);
    assert_eq!(columns(&found, "label").whole(), columns(&direct, "label").whole());
    assert_eq!(found.tables.len(), direct.tables.len());
}

/// A point may have a grid of its own.
#[test]
fn points_with_axes() {
    let points = DrawnPoints {
        rule: PointRule::Lhs,
        count: 5,
        seed: 2,
        over: vec![PointRange { vary: Coordinate::Parameter(Parameter::Gap), from: 0.75, to: 1.5 }],
    };
    let points = PointsPlan::Drawn(points);
    let plane = BasinPlan::plane(span("-1:0.5:3"), span("-1:1:2"), 0.25);
    let plan = BasinPlan { points: Some(points.clone()), ..plane.clone() };
    assert_eq!(plan.starts(), 30);
    let found = sheet(S, Task::from(plan), None, 2);
    for k in 0..5 {
        let (_, gap) = points.parameters(k).next().unwrap();
        let alone = sheet(SystemPlan { gap, ..S }, Task::from(plane.clone()), None, 1);
        assert_eq!(columns(&found, "label").whole()[6 * k..6 * k + 6], *columns(&alone, "label").whole());
    }
}
