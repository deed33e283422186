//! Which contenders get the first impacts right: their times against those of `vibro simulate`.

use std::f64::consts::TAU;
use std::fs;
use std::thread;
use std::time::Duration;

use serde_json::Value;

use super::contender::{self, Contender};
use super::setup::Workshop;
use super::starts::{self, Group, RESTITUTION, Start};

/// Impacts compared for each start.
pub(super) const FIRST: usize = 5;
/// Difference in time that makes an impact wrong.
pub(super) const TOLERANCE: f64 = 1e-6;
/// Forcing periods for which a start is followed.
pub(super) const PERIODS: f64 = 20.0;

/// The table: for each contender, for each group, how many starts have a wrong impact.
pub(super) struct Accuracy {
    /// Names of the groups, the number of their starts and of the impacts compared.
    pub(super) groups: Vec<(&'static str, usize, usize)>,
    pub(super) rows: Vec<(&'static str, Vec<usize>)>,
}

/// What really happens to a start.
#[derive(Debug, PartialEq)]
struct Truth {
    /// Times of its impacts, at most [`FIRST`].
    times: Vec<f64>,
    /// Whether more would follow: after the fifth, or once the mass has come to rest on the stop, of which the peers know
    /// nothing.
    goes_on: bool,
}

/// Asks for the truth, then each peer.
///
/// # Errors
/// The sentence that says what failed.
pub(super) fn judge(workshop: &Workshop, contenders: &[Contender], number: usize) -> Result<Accuracy, String> {
    let groups = starts::groups(number);
    let starts: Vec<Start> = groups.iter().flat_map(|group| group.starts.iter().copied()).collect();
    println!("accuracy: the truth about {} starts, by `vibro simulate`", starts.len());
    let truths = truths(workshop, &starts)?;
    let file = workshop.folder.join("starts.txt");
    let lines: Vec<String> = starts.iter().map(Start::line).collect();
    fs::write(&file, lines.join("\n") + "\n")
        .map_err(|error| format!("{} cannot be written: {error}", file.display()))?;

    let mut rows = Vec::new();
    for peer in contenders.iter().filter(|contender| !contender.ours) {
        let name = peer.name();
        let found = peer.impacts(&file).map_err(|why| format!("{name}: {why}"))?;
        if found.len() != starts.len() {
            return Err(format!("{name} answers {} starts of {}", found.len(), starts.len()));
        }
        let wrong: Vec<bool> = truths.iter().zip(&found).map(|(truth, times)| !agrees(truth, times)).collect();
        let counts = in_groups(&groups, |range| wrong[range].iter().filter(|&&wrong| wrong).count());
        println!("  {name:30} {counts:?} wrong");
        rows.push((name, counts));
    }
    let compared = in_groups(&groups, |range| truths[range].iter().map(|truth| truth.times.len()).sum());
    let groups = groups.iter().zip(compared).map(|(group, impacts)| (group.name, group.starts.len(), impacts));
    Ok(Accuracy { groups: groups.collect(), rows })
}

/// A number for each group, from the range of its starts.
fn in_groups(groups: &[Group], of: impl Fn(std::ops::Range<usize>) -> usize) -> Vec<usize> {
    let mut first = 0;
    let mut next = |group: &Group| {
        let range = first..first + group.starts.len();
        first = range.end;
        of(range)
    };
    groups.iter().map(&mut next).collect()
}

/// Whether the times are those that are true, none missing and none too many.
fn agrees(truth: &Truth, times: &[f64]) -> bool {
    let enough = if truth.goes_on { times.len() >= truth.times.len() } else { times.len() == truth.times.len() };
    enough && truth.times.iter().zip(times).all(|(a, b)| (a - b).abs() <= TOLERANCE)
}

/// Asks `vibro` about each start, on all cores: nothing is timed here.
fn truths(workshop: &Workshop, starts: &[Start]) -> Result<Vec<Truth>, String> {
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let share = starts.len().div_ceil(workers).max(1);
    thread::scope(|scope| {
        let work: Vec<_> = starts
            .chunks(share)
            .map(|part| scope.spawn(move || part.iter().map(|start| truth(workshop, start)).collect()))
            .collect();
        let parts: Vec<Result<Vec<Truth>, String>> =
            work.into_iter().map(|part| part.join().unwrap_or_else(|_| Err("a worker panicked".to_owned()))).collect();
        let whole: Result<Vec<Vec<Truth>>, String> = parts.into_iter().collect();
        Ok(whole?.into_iter().flatten().collect())
    })
}

fn truth(workshop: &Workshop, start: &Start) -> Result<Truth, String> {
    let mut command = workshop.command(&workshop.vibro);
    command.args(["simulate", "--json", "--quiet", "--impacts", &FIRST.to_string()]);
    let numbers = [
        ("--inverse-beta", start.inverse_beta),
        ("--gap", start.gap),
        ("--restitution", RESTITUTION),
        ("--x", start.x),
        ("--v", start.v),
        ("--phase", start.phase),
    ];
    for (name, value) in numbers {
        command.arg(name).arg(value.to_string());
    }
    let text = contender::output(command, Duration::from_secs(60))?;
    let unreadable = |why: &str| format!("the answer of `vibro simulate` to `{}` cannot be read: {why}", start.line());
    let answer: Value = serde_json::from_str(&text).map_err(|error| unreadable(&error.to_string()))?;
    read_truth(&answer, PERIODS * TAU * start.inverse_beta).ok_or_else(|| unreadable("no events"))
}

/// The impacts before the horizon, up to the first stick.
fn read_truth(answer: &Value, horizon: f64) -> Option<Truth> {
    let mut times = Vec::new();
    for event in answer["events"].as_array()? {
        let time = event["time"].as_f64()?;
        if time > horizon {
            return Some(Truth { times, goes_on: false });
        }
        match event["kind"].as_str()? {
            "impact" => times.push(time),
            "stick" | "release" => return Some(Truth { times, goes_on: true }),
            _ => {}
        }
    }
    let goes_on = times.len() == FIRST;
    Some(Truth { times, goes_on })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn events(list: &[(&str, f64)]) -> Value {
        let events: Vec<Value> = list.iter().map(|(kind, time)| json!({"kind": kind, "time": time})).collect();
        json!({ "events": events })
    }

    #[test]
    fn the_truth_ends_at_a_stick_and_at_the_horizon() {
        let stick = events(&[("impact", 1.0), ("graze", 1.5), ("stick", 2.0), ("impact", 3.0)]);
        assert_eq!(read_truth(&stick, 10.0), Some(Truth { times: vec![1.0], goes_on: true }));
        let late = events(&[("impact", 1.0), ("impact", 11.0)]);
        assert_eq!(read_truth(&late, 10.0), Some(Truth { times: vec![1.0], goes_on: false }));
        assert_eq!(read_truth(&events(&[]), 10.0), Some(Truth { times: vec![], goes_on: false }));
        assert_eq!(read_truth(&json!({}), 10.0), None);
    }

    #[test]
    fn late_missing_and_extra_impacts_are_wrong() {
        let closed = Truth { times: vec![1.0, 2.0], goes_on: false };
        assert!(agrees(&closed, &[1.0, 2.0 + 1e-7]));
        assert!(!agrees(&closed, &[1.0, 2.0 + 1e-5]));
        assert!(!agrees(&closed, &[1.0]));
        assert!(!agrees(&closed, &[1.0, 2.0, 3.0]));
        assert!(agrees(&Truth { goes_on: true, ..closed }, &[1.0, 2.0, 3.0]));
        assert!(agrees(&Truth { times: vec![], goes_on: false }, &[]));
    }
}
