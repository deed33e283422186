//! `cargo xtask test`: all checks, run one after another.
//!
//! A failed step does not stop later ones, so one run shows all failures. The last line is `N passed, M failed`, which
//! continuous integration reads. It counts tests. A step that fails without a failed test (a lint, a build, a dead
//! link) counts as one failure, so the line never reports `0 failed` for a failed run.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::thread::JoinHandle;
use std::time::Instant;

use crate::cost::Log;
use crate::totals::{self, Totals};
use crate::{command, docs, examples, licences, python, tools, wasm, words};

/// The options from the command line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Options {
    /// Run only the steps marked fast.
    fast: bool,
    /// Run the long tests too.
    long: bool,
}

impl Options {
    /// Parses the switches after `test`.
    ///
    /// # Errors
    /// A message that names an unknown switch.
    pub(crate) fn parse(switches: &[&str]) -> Result<Self, String> {
        let mut options = Self::default();
        for &switch in switches {
            match switch {
                "--fast" => options.fast = true,
                "--long" => options.long = true,
                other => return Err(format!("`test` knows --fast and --long, not `{other}`")),
            }
        }
        Ok(options)
    }
}

/// The variable that allows tests to run long.
const LONG: (&str, &str) = ("VIBROIMPACT_LONG", "1");

/// The step that nextest needs beside it, because it runs no doc tests.
const DOC_TESTS: &str = "doc tests";

/// The step that needs the packages of Python, which are downloaded before.
const PYTHON_PACKAGE: &str = "Python package";

#[derive(Clone, Copy)]
enum Work {
    /// A command that succeeds or fails.
    Command,
    /// A command that prints the totals of its tests.
    Tests,
    /// A function of this program.
    Check(fn(&Path) -> Result<String, String>),
}

#[derive(Clone, Copy)]
struct Step {
    name: &'static str,
    /// The command that runs this step alone.
    alone: &'static str,
    work: Work,
    fast: bool,
    /// Whether it is a part of the long run only: it takes long for what it finds.
    long: bool,
    /// Whether the steps after it do not wait for it, because it waits much itself.
    beside: bool,
}

impl Step {
    const fn new(name: &'static str, alone: &'static str, work: Work) -> Self {
        Self { name, alone, work, fast: false, long: false, beside: false }
    }

    const fn fast(self) -> Self {
        Self { fast: true, ..self }
    }

    const fn long(self) -> Self {
        Self { long: true, ..self }
    }

    const fn beside(self) -> Self {
        Self { beside: true, ..self }
    }
}

/// All steps, ordered so that failures show early. A test program in another language is one more line; its last line
/// of output must be known to [`totals`].
fn steps(nextest: bool, python: bool) -> Vec<Step> {
    // All builds have the same features, because with others the derive macros and all dependent crates would be built again.
    // For the same reason no package is excluded: without the Python package, other crates would have fewer features. The
    // feature `s3` needs 74 more crates: it is checked with the lints, and built for its own tests alone.
    let tests = if nextest {
        "cargo nextest run --workspace --no-fail-fast"
    } else {
        // with the doc tests, which cannot be left out without a list of targets; such a list would build tests of the
        // library of the Python package, which has none
        "cargo test --workspace --no-fail-fast"
    };
    let mut steps = vec![
        Step::new("tools", "rustup component add rustfmt clippy", Work::Check(tools::ensure)).fast(),
        Step::new("format", "cargo fmt --all --check", Work::Command).fast(),
        Step::new("licences", "cargo xtask licences", Work::Check(licences::check)),
        Step::new("words", "cargo xtask words", Work::Check(words::check)),
        Step::new("lints", "cargo clippy --workspace --all-targets --all-features -- -D warnings", Work::Command)
            .fast(),
        Step::new("tests", tests, Work::Tests).fast(),
        // as soon as the command is built
        Step::new("explorer", "cargo xtask explorer", Work::Tests).beside(),
        Step::new(DOC_TESTS, "cargo test --workspace --doc --no-fail-fast", Work::Tests),
        Step::new("examples", "cargo xtask examples", Work::Check(examples::run)),
        // the same cases in every run, so that a failure is caused by a change of the code
        Step::new("fuzz", "cargo xtask fuzz --seconds 6 --seed 1", Work::Tests),
        Step::new("documentation", "cargo xtask docs", Work::Check(docs::build)),
        Step::new("WebAssembly", "cargo xtask wasm", Work::Check(wasm::check)).long(),
        Step::new(PYTHON_PACKAGE, "cargo xtask python", Work::Check(python::install)),
        Step::new("buckets", "cargo xtask s3", Work::Tests).long(),
    ];
    if !nextest {
        steps.retain(|step| step.name != DOC_TESTS);
    }
    if python {
        steps.push(Step::new("Python tests", python::TESTS, Work::Tests));
    }
    steps
}

/// Runs the steps, and prints their results and the totals.
pub(crate) fn run(root: &Path, options: Options) -> ExitCode {
    let mut steps = steps(tools::has_nextest(root), python::found(root).is_some());
    steps.retain(|step| (step.fast || !options.fast) && (options.long || !step.long));
    let mut ran = Ran::default();
    let begin = Instant::now();
    let log = command::target(root).ok().and_then(|target| Log::begin(&target));
    let variables = log.as_ref().map(Log::variables).unwrap_or_default();
    let mut packages = steps.iter().any(|step| step.name == PYTHON_PACKAGE).then(|| python::begin(root));
    let mut beside: Vec<(Step, JoinHandle<Taken>)> = Vec::new();
    for (index, step) in steps.iter().enumerate() {
        if step.name == PYTHON_PACKAGE
            && let Some(packages) = packages.take()
        {
            // a thread that failed is reported by the step, which does its work again
            let _ = packages.join();
        }
        println!("\n== {}/{} {}: {}", index + 1, steps.len(), step.name, typed(step, options));
        if step.beside {
            println!("   beside the next steps");
            let (step, root, variables) = (*step, root.to_owned(), variables.clone());
            beside.push((step, std::thread::spawn(move || take(&step, &root, options, &variables))));
        } else {
            ran.record(step, take(step, root, options, &variables));
        }
    }
    ran.join(&mut beside);
    if let Some(sentence) = log.and_then(|log| log.sentence()) {
        println!("\n{sentence}");
    }
    println!("\n{} steps in {:.0} s", steps.len(), begin.elapsed().as_secs_f64());
    for step in &ran.failed {
        println!("{} failed; to run it alone: {}", step.name, typed(step, options));
    }
    println!("{} passed, {} failed", ran.totals.passed, ran.totals.failed);
    if ran.failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// What the steps gave so far.
#[derive(Default)]
struct Ran {
    totals: Totals,
    failed: Vec<Step>,
}

impl Ran {
    /// Prints and adds the result of a step.
    fn record(&mut self, step: &Step, Taken { totals, outcome, seconds }: Taken) {
        self.totals += totals;
        let name = if step.beside { format!("{}: ", step.name) } else { String::new() };
        match outcome {
            Ok(sentence) if sentence.is_empty() => println!("   {name}ok in {seconds:.1} s"),
            Ok(sentence) => println!("   {name}ok in {seconds:.1} s: {sentence}"),
            Err(sentence) => {
                println!("{sentence}\n   {name}FAILED in {seconds:.1} s");
                self.failed.push(*step);
            }
        }
    }

    /// Waits for the steps that run beside the others.
    fn join(&mut self, beside: &mut Vec<(Step, JoinHandle<Taken>)>) {
        for (step, thread) in beside.drain(..) {
            let taken = thread.join().unwrap_or_else(|_| Taken {
                totals: Totals { passed: 0, failed: 1 },
                outcome: Err(format!("{} panicked", step.name)),
                seconds: 0.0,
            });
            self.record(&step, taken);
        }
    }
}

/// The result of a step: the numbers of its tests, a remark or the reason of its failure, and its duration.
struct Taken {
    totals: Totals,
    outcome: Result<String, String>,
    seconds: f64,
}

/// The command that runs the step alone in the same way.
fn typed(step: &Step, options: Options) -> String {
    match step.work {
        Work::Tests if options.long => format!("{}={} {}", LONG.0, LONG.1, step.alone),
        _ => step.alone.to_owned(),
    }
}

/// Variables for the commands of a step.
type Variables = [(&'static str, PathBuf)];

/// Runs one step.
fn take(step: &Step, root: &Path, options: Options, variables: &Variables) -> Taken {
    let begin = Instant::now();
    let mut counted = None;
    let outcome = match step.work {
        Work::Check(run) => run(root),
        Work::Command => {
            let mut command = command::words(root, step.alone);
            command.envs(variables.iter().cloned());
            command::run(command).map(|()| String::new())
        }
        Work::Tests => {
            let mut command = command::words(root, step.alone);
            command.envs(variables.iter().cloned());
            if options.long {
                command.env(LONG.0, LONG.1);
            }
            command::run_reading(command, |line| {
                if let Some(found) = totals::in_line(line) {
                    *counted.get_or_insert_default() += found;
                }
            })
            .map(|()| String::new())
        }
    };
    let (totals, outcome) = settle(&step.work, counted, outcome);
    Taken { totals, outcome, seconds: begin.elapsed().as_secs_f64() }
}

/// Makes totals and result consistent: a failed step counts at least one failure, and a test step without totals is a
/// failure.
fn settle(work: &Work, counted: Option<Totals>, outcome: Result<String, String>) -> (Totals, Result<String, String>) {
    let mut totals = counted.unwrap_or_default();
    let outcome = match outcome {
        Ok(_) if matches!(work, Work::Tests) && counted.is_none() => {
            Err("it succeeded without a line that says how many tests ran".to_owned())
        }
        Ok(_) if totals.failed > 0 => Err("it succeeded, yet names failed tests".to_owned()),
        other => other,
    };
    if outcome.is_err() {
        totals.failed = totals.failed.max(1);
    }
    (totals, outcome)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn switches_are_read() {
        assert_eq!(Options::parse(&[]), Ok(Options { fast: false, long: false }));
        assert_eq!(Options::parse(&["--long", "--fast"]), Ok(Options { fast: true, long: true }));
        assert!(Options::parse(&["--quick"]).is_err_and(|sentence| sentence.contains("`--quick`")));
    }

    #[test]
    fn a_failed_step_never_counts_as_zero_failures() {
        let counted = |passed, failed| Some(Totals { passed, failed });
        let check = |counted: Option<Totals>, ok: bool, expected: (u64, u64), success: bool| {
            let outcome = if ok { Ok(String::new()) } else { Err("why".to_owned()) };
            let (totals, outcome) = settle(&Work::Tests, counted, outcome);
            assert_eq!((totals.passed, totals.failed, outcome.is_ok()), (expected.0, expected.1, success));
        };
        check(counted(5, 0), true, (5, 0), true);
        check(counted(5, 2), false, (5, 2), false);
        // the build of one test failed, or the program was killed
        check(counted(5, 0), false, (5, 1), false);
        check(None, false, (0, 1), false);
        // a successful step without totals
        check(None, true, (0, 1), false);
        check(counted(5, 2), true, (5, 2), false);
        let (totals, outcome) = settle(&Work::Command, None, Ok(String::new()));
        assert_eq!((totals, outcome), (Totals::default(), Ok(String::new())));
    }

    #[test]
    fn the_fast_steps_are_format_lints_and_tests() {
        for nextest in [true, false] {
            let fast: Vec<_> = steps(nextest, true).iter().filter(|step| step.fast).map(|step| step.name).collect();
            assert_eq!(fast, ["tools", "format", "lints", "tests"]);
            assert_eq!(steps(nextest, true).iter().any(|step| step.name == DOC_TESTS), nextest);
        }
    }

    #[test]
    fn the_long_run_is_typed_with_its_variable() {
        let step = Step::new("tests", "cargo test", Work::Tests);
        assert_eq!(typed(&step, Options { fast: false, long: true }), "VIBROIMPACT_LONG=1 cargo test");
        assert_eq!(typed(&step, Options::default()), "cargo test");
    }
}
