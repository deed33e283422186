//! A contender: a program called as `CMD WORKLOAD SECONDS` or `CMD impacts FILE`, and how it is called.

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::rates::Workload;
use super::setup::Workshop;

/// Time beyond the one asked for that a contender may take to start, compile itself and settle.
const GRACE: Duration = Duration::from_secs(120);
/// Time for all starts of the accuracy table.
const IMPACTS: Duration = Duration::from_secs(1800);

/// What a contender said about a workload.
#[derive(Clone, Debug, Default)]
pub(super) struct Answer {
    /// Impacts or starts per second.
    pub(super) rate: f64,
    /// How many starts got which label.
    pub(super) labels: Vec<(String, u64)>,
    /// The part of the time spent in a Python callback.
    pub(super) callback_share: f64,
}

/// A program, and the rows of the tables it fills.
pub(super) struct Contender {
    /// What the rows are called.
    pub(super) rows: &'static [&'static str],
    /// Whether it is vibroimpact.
    pub(super) ours: bool,
    /// Ours: what its rows are called in the answer, and further arguments.
    keys: &'static [&'static str],
    further: &'static [&'static str],
    /// Makes the beginning of its command.
    call: Box<dyn Fn() -> Command>,
}

/// The two rates in the answer of `vibro bench`: one motion after another, and side by side.
const SCALAR: &str = "scalar";
const LANES: &str = "lanes";

/// All contenders, the baseline first and ours last.
pub(super) fn all(workshop: &Workshop) -> Vec<Contender> {
    let c = |rows, file: &str| {
        let (program, folder) = (workshop.c_peer(file), workshop.clone());
        Contender { rows, ours: false, keys: &[], further: &[], call: Box::new(move || folder.command(&program)) }
    };
    let python = |rows, file: &str, arguments: &'static [&'static str]| {
        let (file, folder) = (workshop.sources.join("python").join(file), workshop.clone());
        let command = move || {
            let mut command = folder.command(&folder.python);
            command.arg(&file).args(arguments);
            command
        };
        Contender { rows, ours: false, keys: &[], further: &[], call: Box::new(command) }
    };
    let vibro = |rows, keys, further| {
        let folder = workshop.clone();
        Contender { rows, ours: true, keys, further, call: Box::new(move || folder.command(&folder.vibro)) }
    };
    vec![
        c(&["C, scan (baseline)"], "scan"),
        c(&["C, scan with a table of sines"], "table"),
        c(&["C, safe search"], "safe"),
        python(&["Numba, scan"], "numba_scan.py", &[]),
        python(&["heyoka, one motion"], "heyoka_scalar.py", &[]),
        python(&["heyoka, batch"], "heyoka_batch.py", &[]),
        python(&["SciPy, RK45 as it comes"], "scipy_events.py", &["RK45"]),
        python(&["SciPy, DOP853, rtol 1e-9"], "scipy_events.py", &["DOP853"]),
        vibro(&["vibroimpact, lanes held to AVX2"], &[LANES], &["--width", "avx2"]),
        vibro(&["vibroimpact, one motion", "vibroimpact, lanes"], &[SCALAR, LANES], &[]),
    ]
}

impl Contender {
    /// Its first or only row, as its name.
    pub(super) fn name(&self) -> &'static str {
        self.rows[0]
    }

    /// Whether it can be run at all: `vibro bench` may not be there yet.
    ///
    /// # Errors
    /// The sentence that says so.
    pub(super) fn ready(&self) -> Result<(), String> {
        if !self.ours {
            return Ok(());
        }
        let mut command = (self.call)();
        command.args(["bench", "--help"]).stderr(Stdio::null());
        output(command, GRACE).map(drop).map_err(|_| "this `vibro` has no command `bench`".to_owned())
    }

    /// Runs a workload for a time: what each row gets, or why it gets nothing.
    ///
    /// # Errors
    /// The sentence that says why no row gets anything.
    pub(super) fn run(&self, workload: Workload, seconds: f64) -> Result<Vec<Result<Answer, String>>, String> {
        let limit = GRACE + Duration::from_secs_f64(4.0 * seconds);
        let seconds = seconds.to_string();
        let mut command = (self.call)();
        if self.ours {
            command.args(["bench", "--json", "--quiet", "--threads", "1", "--workload", workload.name()]);
            command.args(["--seconds", &seconds]).args(self.further);
            let answer = json(&output(command, limit)?)?;
            return Ok(self.keys.iter().map(|key| of_vibro(&answer, workload, key)).collect());
        }
        command.args([workload.name(), &seconds]);
        let answer = json(&output(command, limit)?)?;
        let rate = answer["rate"].as_f64().ok_or("the answer names no rate")?;
        let callback_share = answer["callback_share"].as_f64().unwrap_or(0.0);
        let labels = answer["labels"].as_object().into_iter().flatten();
        let labels = labels.filter_map(|(label, n)| Some((label.clone(), n.as_u64()?))).collect();
        Ok(vec![Ok(Answer { rate, labels, callback_share })])
    }

    /// The first impact times of the starts in a file, by a peer.
    ///
    /// # Errors
    /// The sentence that says what went wrong.
    pub(super) fn impacts(&self, file: &Path) -> Result<Vec<Vec<f64>>, String> {
        let mut command = (self.call)();
        command.arg("impacts").arg(file);
        let text = output(command, IMPACTS)?;
        let times = |line: &str| line.split_whitespace().map(str::parse).collect::<Result<_, _>>();
        let lists: Result<Vec<Vec<f64>>, _> = text.lines().map(times).collect();
        lists.map_err(|error| format!("the impact times cannot be read: {error}"))
    }
}

/// A rate in the answer of `vibro bench`.
fn of_vibro(answer: &Value, workload: Workload, row: &str) -> Result<Answer, String> {
    let rates = &answer[workload.measure()];
    let rate = rates[workload.name()][row].as_f64().or_else(|| match row {
        // the basin's is one number, in lanes, and another one beside it
        SCALAR => rates[format!("{}_scalar", workload.name())].as_f64(),
        _ => rates[workload.name()].as_f64(),
    });
    let rate = rate.ok_or_else(|| format!("`vibro bench` names no rate `{row}` for `{}`", workload.name()))?;
    Ok(Answer { rate, ..Answer::default() })
}

fn json(text: &str) -> Result<Value, String> {
    serde_json::from_str(text).map_err(|error| format!("the answer cannot be read: {error}"))
}

/// What a program prints; past the limit it is stopped.
///
/// # Errors
/// The sentence that says how it ended.
pub(super) fn output(mut command: Command, limit: Duration) -> Result<String, String> {
    let program = Path::new(command.get_program()).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let failed = |error: std::io::Error| format!("`{program}` cannot be run: {error}");
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(failed)?;
    // read beside the wait: a pipe that is full would stop the child for ever
    let mut pipe = child.stdout.take().ok_or("no pipe")?;
    let reader = thread::spawn(move || {
        let mut text = String::new();
        pipe.read_to_string(&mut text).map(|_| text)
    });
    let begin = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(failed)? {
            break status;
        }
        if begin.elapsed() > limit {
            child.kill().and_then(|()| child.wait()).map_err(failed)?;
            return Err(format!("`{program}` took more than {} s and was stopped", limit.as_secs()));
        }
        thread::sleep(Duration::from_millis(5));
    };
    let text = reader.join().map_err(|_| "the reader of a pipe panicked".to_owned())?.map_err(failed)?;
    if status.success() { Ok(text) } else { Err(format!("`{program}` ended with {status}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_answer_of_vibro_is_read_by_row() {
        let answer = serde_json::json!({
            "impacts_per_second": {"chaos": {"scalar": 2.0, "lanes": 8.0}},
            "starts_per_second": {"basin": 5.0, "basin_scalar": 1.0},
        });
        let rate = |workload, row| of_vibro(&answer, workload, row).map(|answer| answer.rate);
        assert_eq!(rate(Workload::Chaos, "lanes"), Ok(8.0));
        assert_eq!(rate(Workload::Basin, "scalar"), Ok(1.0));
        assert_eq!(rate(Workload::Basin, "lanes"), Ok(5.0));
        assert!(rate(Workload::Regular, "lanes").is_err_and(|why| why.contains("no rate `lanes` for `regular`")));
    }

    #[test]
    fn a_program_that_hangs_is_stopped() {
        let mut sleep = Command::new("sleep");
        sleep.arg("30");
        let why = output(sleep, Duration::from_millis(50)).unwrap_err();
        assert!(why.contains("`sleep` took more than"), "{why}");
    }

    #[test]
    fn more_than_a_pipe_holds_is_read() {
        let mut many = Command::new("seq");
        many.arg("100000");
        assert_eq!(output(many, Duration::from_secs(20)).unwrap().lines().count(), 100_000);
    }
}
