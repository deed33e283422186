//! The numbers of passed and failed tests, read from the summary lines of the test programs.
//!
//! | program | line |
//! |---|---|
//! | nextest | `Summary [   0.012s] 5 tests run: 4 passed (1 slow), 1 failed, 0 skipped` |
//! | libtest, doc tests | `test result: ok. 4 passed; 0 failed; 1 ignored; ...` |
//! | pytest | `==== 4 passed, 1 failed, 2 skipped in 0.05s ====` |
//!
//! A line counts only if it begins as above, without indentation except that of nextest. When a test fails, nextest
//! repeats the output of the test program with indentation, including its `test result:` line, which would count the
//! failure twice.

use std::ops::AddAssign;

/// Tests that passed and failed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Totals {
    pub(crate) passed: u64,
    pub(crate) failed: u64,
}

impl AddAssign for Totals {
    fn add_assign(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
    }
}

/// The totals in a line without colours; `None` if the line is not a summary.
pub(crate) fn in_line(line: &str) -> Option<Totals> {
    let line = line.trim_end();
    nextest(line.trim_start()).or_else(|| libtest(line)).or_else(|| pytest(line))
}

/// A line that states why a step ran no test, in a form that [`in_line`] reads.
pub(crate) fn skipped(why: &str) -> String {
    format!("test result: skipped, {why}. 0 passed; 0 failed")
}

fn nextest(line: &str) -> Option<Totals> {
    let (_, after) = line.strip_prefix("Summary [")?.split_once(']')?;
    let (run, counts) = after.split_once(':')?;
    if !run.ends_with("tests run") && !run.ends_with("test run") {
        return None;
    }
    Some(count(&without_brackets(counts), ','))
}

fn libtest(line: &str) -> Option<Totals> {
    let (_, counts) = line.strip_prefix("test result: ")?.split_once(". ")?;
    Some(count(counts, ';'))
}

fn pytest(line: &str) -> Option<Totals> {
    if line.starts_with(' ') {
        return None;
    }
    let (counts, seconds) = line.trim_matches(['=', ' ']).rsplit_once(" in ")?;
    // after a minute pytest adds the time in another form: `75.20s (0:01:15)`
    let seconds = seconds.split_once(" (").map_or(seconds, |(seconds, _)| seconds);
    seconds.strip_suffix('s')?.parse::<f64>().ok()?;
    let reads = |part: &str| {
        let mut words = part.split_whitespace();
        words.next().is_some_and(|number| number.parse::<u64>().is_ok())
            && words.next().is_some()
            && words.next().is_none()
    };
    counts.split(',').all(reads).then(|| count(counts, ','))
}

/// Adds up parts such as `4 passed`. Skipped, ignored and filtered tests are not counted.
fn count(counts: &str, separator: char) -> Totals {
    let mut totals = Totals::default();
    for part in counts.split(separator) {
        let Some((number, word)) = part.trim().split_once(' ') else {
            continue;
        };
        let Ok(number) = number.parse::<u64>() else {
            continue;
        };
        match word.trim() {
            "passed" => totals.passed += number,
            "failed" | "exec failed" | "timed out" | "error" | "errors" => totals.failed += number,
            _ => {}
        }
    }
    totals
}

/// The text without parts in round brackets, which are not nested.
fn without_brackets(text: &str) -> String {
    text.split('(').map(|part| part.split_once(')').map_or(part, |(_, after)| after)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_skipped_counts_as_nothing() {
        assert_eq!(in_line(&skipped("there is no server")), Some(Totals::default()));
    }

    fn check(line: &str, expected: Option<(u64, u64)>) {
        let expected = expected.map(|(passed, failed)| Totals { passed, failed });
        assert_eq!(in_line(line), expected, "{line}");
    }

    #[test]
    fn nextest_lines() {
        check("     Summary [   0.012s] 5 tests run: 5 passed, 0 skipped", Some((5, 0)));
        check("     Summary [   0.012s] 1 test run: 1 passed, 3 skipped", Some((1, 0)));
        check("Summary [ 61.0s] 9 tests run: 7 passed (1 slow, 2 leaky), 2 failed, 0 skipped", Some((7, 2)));
        check("Summary [ 1.0s] 5/7 tests run: 3 passed, 1 failed, 1 timed out, 0 skipped", Some((3, 2)));
        check("Summary [ 1.0s] 2 tests run: 1 passed, 1 exec failed, 0 skipped", Some((1, 1)));
        check("Summary [ 0.0s] 0 tests run: 0 passed, 4 skipped", Some((0, 0)));
    }

    #[test]
    fn libtest_lines() {
        check(
            "test result: ok. 4 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s",
            Some((4, 0)),
        );
        check(
            "test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.01s",
            Some((3, 2)),
        );
    }

    #[test]
    fn pytest_lines() {
        check("========= 4 passed, 1 failed, 2 skipped in 0.05s =========", Some((4, 1)));
        check("12 passed in 3.20s", Some((12, 0)));
        check("===== 1 failed, 2 passed, 1 error in 75.20s (0:01:15) =====", Some((2, 2)));
    }

    #[test]
    fn other_lines_are_no_summary() {
        for line in [
            "",
            "    Finished `test` profile [optimized] target(s) in 0.05s",
            "        PASS [   0.004s] vibroimpact phase::tests::wraps",
            "test phase::wraps ... ok",
            "running 3 tests",
            // nextest repeats the output of a failed test in this form
            "    test result: FAILED. 0 passed; 1 failed; 0 ignored; 0 measured; 1 filtered out; finished in 0.07s",
            "    ========= 1 failed in 0.05s =========",
            "the summary was: test result: ok. 4 passed; 0 failed",
            "     Running unittests src/lib.rs in 3s",
            "Summary [ 0.1s] nothing",
        ] {
            check(line, None);
        }
    }
}
