//! A progress bar with rate and remaining time. It is shown on stderr if that is a terminal and the work takes long.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Time after which the duration is estimated, if the work will take long.
const SAMPLE: Duration = Duration::from_secs(2);
/// Work longer than this is announced.
const LONG: Duration = Duration::from_mins(1);
/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

pub(crate) struct Progress {
    bar: ProgressBar,
    begun: Instant,
    wanted: bool,
    shown: AtomicBool,
    /// What is done how often by how many threads, until the duration was estimated.
    task: Option<Task>,
    estimated: AtomicBool,
}

struct Task {
    total: u64,
    unit: String,
    threads: usize,
}

impl Task {
    /// The estimated duration of the whole work as a sentence, if it is long. The rate of the first seconds is that of the
    /// survey and the first tiles, so the number is rounded.
    fn estimate(&self, done: u64, elapsed: Duration) -> Option<String> {
        if done == 0 || done >= self.total {
            return None;
        }
        #[allow(clippy::cast_precision_loss)] // an estimate
        let seconds = elapsed.as_secs_f64() * self.total as f64 / done as f64;
        let time = match seconds {
            seconds if seconds < LONG.as_secs_f64() => return None,
            seconds if seconds < 5400.0 => format!("{:.0} min", seconds / 60.0),
            seconds if seconds < 172_800.0 => format!("{:.0} h", seconds / 3600.0),
            seconds => format!("{:.0} days", seconds / 86_400.0),
        };
        let threads = if self.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", self.threads) };
        Some(format!("about {time} for {} {} on {threads}", grouped(self.total), self.unit))
    }
}

/// A number with commas between thousands.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|group| core::str::from_utf8(group).ok()).collect();
    groups.join(",")
}

impl Progress {
    /// A bar for `total` units, such as "starts".
    pub(crate) fn new(total: u64, unit: &str, (threads, quiet): (usize, bool)) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        let style = format!(
            "{{msg}}{{bar:32}} {{percent:>3}} %  {{human_pos}}/{{human_len}} {unit}  {{per_sec}}  {{eta}} left"
        );
        if let Ok(style) = ProgressStyle::with_template(&style) {
            bar.set_style(style);
        }
        Self {
            bar,
            begun: Instant::now(),
            wanted: !quiet && std::io::stderr().is_terminal(),
            shown: AtomicBool::new(false),
            task: (total > 0).then(|| Task { total, unit: unit.to_owned(), threads: threads_used(threads) }),
            estimated: AtomicBool::new(false),
        }
    }

    /// Sets the amount done.
    pub(crate) fn at(&self, done: u64) {
        if self.wanted
            && !self.shown.load(Ordering::Relaxed)
            && self.begun.elapsed() > PATIENCE
            && !self.shown.swap(true, Ordering::Relaxed)
        {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_position(done);
        self.announce(done);
    }

    /// Prints the estimated duration of long work once, above the bar.
    fn announce(&self, done: u64) {
        let elapsed = self.begun.elapsed();
        let (Some(task), true) = (&self.task, self.wanted && elapsed > SAMPLE) else { return };
        if !self.estimated.swap(true, Ordering::Relaxed)
            && let Some(sentence) = task.estimate(done, elapsed)
        {
            self.bar.println(sentence);
        }
    }

    /// Begins a new stage of `total` points.
    pub(crate) fn stage(&self, name: &str, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(0);
        self.bar.reset_eta();
        self.bar.set_message(format!("{name:<12} "));
    }
}

/// The number of threads for a requested number, which is 0 for one per processor.
fn threads_used(requested: usize) -> usize {
    if requested > 0 { requested } else { std::thread::available_parallelism().map_or(1, usize::from) }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_work_is_announced() {
        let task = |threads| Task { total: 160_000, unit: "points".into(), threads };
        let seconds = Duration::from_secs;
        assert_eq!(task(2).estimate(444, seconds(2)).as_deref(), Some("about 12 min for 160,000 points on 2 threads"));
        assert_eq!(task(1).estimate(16, seconds(2)).as_deref(), Some("about 6 h for 160,000 points on 1 thread"));
        assert_eq!(task(2).estimate(1, seconds(2)).as_deref(), Some("about 4 days for 160,000 points on 2 threads"));
        // work that is short, or of which nothing is known, is not
        assert_eq!([0, 80_000, 160_000].map(|done| task(2).estimate(done, seconds(2))), [None, None, None]);
        assert_eq!([0, 999, 1000, 12_345_678].map(grouped), ["0", "999", "1,000", "12,345,678"]);
        assert_eq!(threads_used(3), 3);
        assert!(threads_used(0) >= 1);
    }
}
