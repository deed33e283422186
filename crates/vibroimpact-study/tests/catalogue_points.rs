//! Regions, margins, responses and many starts of machines of the catalogue, compared with single questions at scattered points.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test may stop at what it did not expect, and a long one tells how far it is"
)]

use serde_json::{Value, json};
use vibroimpact::continuation::Region;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::machine_cycle_quantities;
use vibroimpact::verdict::Verdict;
use vibroimpact_study::machine::{CATALOGUE, MachineSource};
use vibroimpact_study::{Control, Plan, PlanResults, Results, Task, run};

/// What is wrong, told at once because a long run takes its time.
#[derive(Default)]
struct Faults(Vec<String>);

impl Faults {
    fn push(&mut self, fault: String) {
        eprintln!("{fault}");
        self.0.push(fault);
    }

    fn none(self) {
        assert!(self.0.is_empty(), "{}", self.0.join("\n"));
    }
}

/// Everyday few points of some machines; with `VIBROIMPACT_LONG=1` fifty of all, which takes an hour, or of the one that
/// `VIBROIMPACT_MACHINE` names.
fn cases() -> impl Iterator<Item = (MachineSource, usize)> {
    let long = std::env::var("VIBROIMPACT_LONG").is_ok();
    let few = ["two-mass-hammer", "sdnd106"];
    let only = std::env::var("VIBROIMPACT_MACHINE").ok();
    let taken = move |name: &&str| only.as_ref().map_or(long || few.contains(name), |only| only == name);
    let names = CATALOGUE.iter().map(|entry| entry.name).filter(taken);
    names.map(move |name| {
        if long {
            eprintln!("{name}");
        }
        (MachineSource::of_catalogue(name).unwrap(), if long { 50 } else { 4 })
    })
}

fn answered(source: &MachineSource, task: Value) -> Option<Results<MachineSource>> {
    let task: Task = serde_json::from_value(task).unwrap();
    match run(&Plan::new(source.clone(), task), &Control::default()) {
        Ok(PlanResults::Machine(found)) => Some(found),
        _ => None,
    }
}

fn settled(source: &MachineSource) -> Verdict<vibroimpact::machine::Machine> {
    let Some(Results::Settle(found)) = answered(source, json!({"settle": {}})) else { panic!("{:?}", source.title) };
    found.verdict
}

/// A machine with other numbers.
fn with(source: &MachineSource, numbers: &[(&str, f64)]) -> MachineSource {
    numbers.iter().fold(source.clone(), |source, (name, value)| source.with(name, *value).unwrap())
}

/// The stable cycles with a label: that to which the machine settles, and those that are found.
fn stable(source: &MachineSource, label: &str) -> Vec<Cycle> {
    let own = match settled(source) {
        Verdict::Periodic(cycle) if cycle.label.to_string() == label => vec![cycle],
        _ => Vec::new(),
    };
    let found = match answered(source, json!({"orbit": {"label": label}})) {
        Some(Results::Orbit(found)) => found.into_iter().map(|orbit| orbit.cycle).collect(),
        _ => Vec::new(),
    };
    own.into_iter().chain(found).filter(Cycle::stable).collect()
}

/// Numbers in (0, 1), one after another, of low discrepancy.
fn scattered(k: usize) -> [f64; 2] {
    [0.754_877_666, 0.569_840_296].map(|step| (0.5 + step * (k as f64 + 1.0)).fract())
}

/// The first two parameters that are not 0, or numbers of a machine without parameters, with ranges about their values.
fn ranges(source: &MachineSource) -> Vec<(String, f64, f64)> {
    let mut numbers: Vec<(String, f64)> =
        source.parameters.0.iter().map(|(name, value)| (name.clone(), *value)).collect();
    if numbers.is_empty() {
        numbers = source.machine().unwrap().numbers();
    }
    let range = |(name, value): (String, f64)| {
        let (low, high) = (0.85 * value, 1.15 * value);
        (name, low.min(high), low.max(high))
    };
    numbers.into_iter().filter(|(_, value)| *value != 0.0).map(range).take(2).collect()
}

/// The label of the motion from rest, if it is a stable cycle.
fn own_label(source: &MachineSource) -> Option<String> {
    match settled(source) {
        Verdict::Periodic(cycle) if cycle.stable() => Some(cycle.label.to_string()),
        _ => None,
    }
}

#[test]
fn many_points_settle_as_each_alone() {
    let mut faults = Faults::default();
    for (source, count) in cases() {
        let ranges = ranges(&source);
        let values = |which: usize| -> Vec<f64> {
            let (_, low, high) = ranges[which];
            (0..count).map(|k| low + (high - low) * scattered(k)[which]).collect()
        };
        let columns = |which: usize| json!({"vary": ranges[which].0, "values": values(which)});
        let listed: Vec<Value> = (0..ranges.len()).map(columns).collect();
        let Some(Results::Map(found)) = answered(&source, json!({"settle_many": {"points": {"listed": listed}}}))
        else {
            panic!("{:?}", source.title)
        };
        for (k, cell) in found.points.iter().enumerate() {
            let numbers: Vec<_> = ranges.iter().enumerate().map(|(i, (name, ..))| (&name[..], values(i)[k])).collect();
            let alone = settled(&with(&source, &numbers));
            if cell[0].label != alone.label() {
                faults.push(format!("{:?} {numbers:?}: {} alone, {}", source.title, alone.label(), cell[0].label));
            }
        }
    }
    faults.none();
}

#[test]
fn a_motion_is_there_within_its_margins() {
    let mut faults = Faults::default();
    for (source, count) in cases() {
        let Some(label) = own_label(&source) else { continue };
        // a cycle through a long chatter cannot be followed
        let Some(Results::Margins(found)) = answered(&source, json!({"margins": {}})) else { continue };
        let parts = [0.002, 0.3, 0.5, 0.7, 0.998];
        let mut left = count;
        for margin in &found.parameters {
            let (low, high) = (margin.down.value, margin.up.value);
            for part in parts.into_iter().take(left) {
                let there = with(&source, &[(&margin.scope.parameter, low + part * (high - low))]);
                let Verdict::Periodic(cycle) = &found.motion else { panic!("{:?}", source.title) };
                // the motion itself goes on, where others begin elsewhere
                let near = there.clone().starting(&cycle.state);
                if own_label(&near).as_ref() != Some(&label) && stable(&there, &label).is_empty() {
                    let (name, number) = (&source.title, &margin.scope.parameter);
                    faults.push(format!("{name:?}: {label}, {number} between {low} and {high}, at {part} of it"));
                }
            }
            left = left.saturating_sub(parts.len());
        }
    }
    faults.none();
}

#[test]
fn branches_of_a_response_are_orbits() {
    let mut faults = Faults::default();
    for (source, count) in cases() {
        let (name, low, high) = ranges(&source).remove(0);
        let over = json!({"response": {"vary": name, "over": format!("{low}:{high}:12")}});
        let Some(Results::Response(found)) = answered(&source, over) else { panic!("{:?}", source.title) };
        let rows: Vec<_> = found.branches.iter().flatten().filter(|row| row.stable() && row.event.is_none()).collect();
        for row in rows.iter().step_by((rows.len() / count).max(1)) {
            let there = with(&source, &[(&name, row.value)]);
            let machine = there.machine().unwrap();
            let value = row.quantities[found.shown];
            let same = |cycle: &Cycle| {
                let quantities = machine_cycle_quantities(&machine, cycle).unwrap();
                let other = quantities.value(&machine, &found.quantities[found.shown]).unwrap();
                (other - value).abs() < 1e-6 * (1.0 + value.abs())
            };
            let all = stable(&there, &row.label);
            if !all.iter().any(same) {
                faults.push(format!("{:?}: {} at {name} = {}, {value}", source.title, row.label, row.value));
            }
        }
    }
    faults.none();
}

#[test]
fn regions_have_the_orbits_that_are_found() {
    let mut faults = Faults::default();
    for (source, count) in cases() {
        let (Some(label), ranges) = (own_label(&source), ranges(&source)) else { continue };
        // what follows a long chatter changes at numbers that are closer than any grid
        if label.starts_with("inf") {
            continue;
        }
        let [(p, p0, p1), (q, q0, q1)] = &ranges[..] else { continue };
        let stretch = |name: &str, from: f64, to: f64| json!({"parameter": name, "from": from, "to": to});
        let (across, up) = (stretch(p, *p0, *p1), stretch(q, *q0, *q1));
        let plan = json!({"region": {"label": label, "across": across, "up": up, "grid": 8}});
        let Some(Results::Region(found)) = answered(&source, plan) else { panic!("{:?}", source.title) };
        for k in 0..count {
            let [x, y] = scattered(k);
            let at = (p0 + x * (p1 - p0), q0 + y * (q1 - q0));
            if near_an_edge(&found.stability, at, (p1 - p0, q1 - q0)) {
                continue;
            }
            let there = with(&source, &[(p, at.0), (q, at.1)]);
            let inside = found.stability.contains(at);
            if inside == stable(&there, &label).is_empty() {
                faults.push(format!("{:?}: {label} at {p}, {q} = {at:?}, inside {inside}", source.title));
            }
        }
    }
    faults.none();
}

/// Whether a point is closer to an edge than the edge is off, in parts of the ranges.
fn near_an_edge(region: &Region, (x, y): (f64, f64), (width, height): (f64, f64)) -> bool {
    region.polygons.iter().any(|polygon| {
        let count = polygon.vertices.len();
        (0..count).any(|k| {
            let place = |k: usize| {
                let (p, q) = polygon.vertices[k % count].values;
                ((p - x) / width, (q - y) / height)
            };
            let ((ax, ay), (bx, by)) = (place(k), place(k + 1));
            let (dx, dy) = (bx - ax, by - ay);
            let part = (-(ax * dx + ay * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
            (ax + part * dx).hypot(ay + part * dy) < 2e-3
        })
    })
}
