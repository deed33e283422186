//! `vibro status`: the progress of a store.

use super::stored;
use crate::failure::Failure;
use crate::report::stored::title;
use crate::report::tallies::undecided;
use crate::session::Session;
use clap::Args;
use serde::Serialize;
use std::time::{Duration, SystemTime};
use vibroimpact_study::{StudyPlan, counted};

/// The progress of a store: the tiles that are done, the time that is left, and the plan
#[derive(Clone, Debug, Args)]
pub(crate) struct Status {
    /// The store
    #[arg(value_name = "STORE")]
    store: String,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

#[derive(Serialize)]
struct StatusFields<'a> {
    store: String,
    tiles: u64,
    tiles_done: u64,
    points: u64,
    points_done: u64,
    /// Number of points with an undecided motion among those done; null for a store without labels or with very many points.
    points_undecided: Option<u64>,
    complete: bool,
    /// Estimated seconds for the remaining tiles, at the rate of the last ones.
    seconds_left: Option<f64>,
    /// Seconds since the last tile was completed.
    seconds_since: Option<f64>,
    /// Numbers of the missing tiles, at most a thousand.
    missing: Vec<u64>,
    /// Number of further missing tiles.
    missing_left_out: u64,
    bytes: u64,
    begun_by: &'a str,
    plan: &'a StudyPlan,
    plan_hash: String,
}

pub(super) fn run(args: &Status, session: &Session) -> Result<(), Failure> {
    let store = stored::open(&args.store)?;
    let found = store.progress()?;
    let since = found.last.and_then(|last| SystemTime::now().duration_since(last).ok());
    if args.json {
        return session.print_json(&StatusFields {
            store: store.place(),
            tiles: found.tiles,
            tiles_done: found.done,
            points: found.points,
            points_done: found.points_done,
            points_undecided: undecided(&store).unwrap_or(None),
            complete: found.complete,
            seconds_left: found.left.map(|left| left.as_secs_f64()),
            seconds_since: since.map(|since| since.as_secs_f64()),
            missing: found.missing,
            missing_left_out: found.missing_left_out,
            bytes: found.bytes,
            begun_by: store.begun_by(),
            plan: store.plan(),
            plan_hash: store.plan().hash(),
        });
    }
    let mut text = format!(
        "{}\n{} of {}, {} of {}; {}\n",
        title(store.plan()),
        found.done,
        counted(found.tiles, "tile"),
        found.points_done,
        counted(found.points, "point"),
        size(found.bytes)
    );
    text.push_str(&open(found.points - found.points_done, undecided(&store).unwrap_or(None)));
    if found.complete {
        text.push_str("complete\n");
    } else {
        if let Some(left) = found.left {
            text.push_str(&format!("about {} left at the rate of the last tiles", clock(left)));
            text.push_str(&since.map_or_else(String::new, |since| format!(", the last {} ago", clock(since))));
            text.push('\n');
        }
        text.push_str(&missing(&found.missing, found.tiles - found.done));
    }
    text.push_str(&format!(
        "\nplan {}, begun by vibroimpact {}\n\n{}",
        store.plan().hash(),
        store.begun_by(),
        store.plan().to_toml()
    ));
    session.print(&text)
}

/// The points that are not computed, and those with a motion that is undecided.
fn open(missing: u64, undecided: Option<u64>) -> String {
    let missing = (missing > 0).then(|| format!("{} not computed", counted(missing, "point")));
    let undecided = undecided.filter(|count| *count > 0);
    let undecided = undecided.map(|count| format!("{} with an undecided motion", counted(count, "point")));
    let all: Vec<String> = missing.into_iter().chain(undecided).collect();
    if all.is_empty() { String::new() } else { format!("{}\n", all.join(", ")) }
}

/// The text of the numbers of missing tiles, with consecutive numbers joined.
fn missing(tiles: &[u64], count: u64) -> String {
    const SHOWN: usize = 8;
    if count == 0 {
        return "all tiles are there, but the store was not concluded: `vibro resume` does that\n".into();
    }
    let runs: Vec<&[u64]> = tiles.chunk_by(|a, b| a + 1 == *b).collect();
    let name = |run: &&[u64]| match run {
        [one] => one.to_string(),
        run => format!("{} to {}", run[0], run[run.len() - 1]),
    };
    let named: Vec<String> = runs.iter().take(SHOWN).map(name).collect();
    let shown: u64 = runs.iter().take(SHOWN).map(|run| run.len() as u64).sum();
    let more = if shown < count { format!(" and {} more", count - shown) } else { String::new() };
    format!("missing tiles: {}{more}\n", named.join(", "))
}

fn clock(time: Duration) -> String {
    let s = time.as_secs();
    match s {
        0..=99 => format!("{s} s"),
        100..=5999 => format!("{} min", s / 60),
        _ => format!("{} h {} min", s / 3600, s / 60 % 60),
    }
}

#[allow(clippy::cast_precision_loss)] // for human readers
fn size(bytes: u64) -> String {
    match bytes {
        0..=9_999 => format!("{bytes} bytes"),
        10_000..=9_999_999 => format!("{:.0} kB", bytes as f64 / 1e3),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(missing(&[0, 1, 2, 7, 9, 10], 6), "missing tiles: 0 to 2, 7, 9 to 10\n");
        assert!(missing(&[], 0).contains("not concluded"));
        assert_eq!(open(0, Some(0)), "");
        assert_eq!(open(7, Some(1)), "7 points not computed, 1 point with an undecided motion\n");
        assert_eq!(open(0, None), "");
        let odd: Vec<u64> = (0..40).map(|k| 2 * k).collect();
        assert!(missing(&odd, 40).ends_with("14 and 32 more\n"));
        assert_eq!(missing(&[0, 1, 2], 5000), "missing tiles: 0 to 2 and 4997 more\n");
        assert_eq!([50, 4000, 40_000].map(|s| clock(Duration::from_secs(s))), ["50 s", "66 min", "11 h 6 min"]);
        assert_eq!([12, 20_000, 20_000_000].map(size), ["12 bytes", "20 kB", "20.0 MB"]);
    }
}
