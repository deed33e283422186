//! What was probably meant by a text that is not a range.

use super::number::numbers;

/// Number of values in a range that is proposed.
const PROPOSED: u64 = 41;
/// Maximum number of values that is proposed for a step.
const MOST: f64 = 1e6;

/// The hint for a text that is not `A:B:N`: the range that was probably meant.
///
/// ```
/// let hint = vibroimpact_study::typed::range_hint("15:25");
/// assert!(hint.contains("15:25:41 is 41 values from 15 to 25"));
/// ```
#[must_use]
pub fn range_hint(given: &str) -> String {
    known(given).unwrap_or_else(|| "0.4:2:33 is 33 values from 0.4 to 2, both included".to_owned())
}

fn known(given: &str) -> Option<String> {
    let text = given.trim();
    let (text, log) = text.strip_suffix(":log").map_or((text, ""), |rest| (rest, ":log"));
    match numbers(text)?.as_slice() {
        [a, b] => Some(format!(
            "the number of values is missing: {a}:{b}:{PROPOSED}{log} is {PROPOSED} values from {a} to {b}, both included"
        )),
        [a, b, n] if n.fract() == 0.0 && *n >= 1.0 => Some(format!("write {a}:{b}:{n}{log}")),
        [a, b, step] if *step > 0.0 && *step <= (b - a).abs() => {
            let steps = ((b - a) / step).abs().round().max(1.0);
            (steps < MOST).then(|| {
                let width = (b - a).abs() / steps;
                format!(
                    "the third number is how many values there are, not their distance: {a}:{b}:{} has the distance {width}",
                    steps + 1.0
                )
            })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::range_hint as hint;

    #[test]
    fn the_range_that_was_probably_meant() {
        for (text, said) in [
            ("15:25", "15:25:41 is 41 values from 15 to 25"),
            ("15-25", "15:25:41 is"),
            ("-1--0.5", "-1:-0.5:41 is"),
            ("15..25", "15:25:41 is"),
            ("15 to 25", "15:25:41 is"),
            ("[15,25]", "15:25:41 is"),
            ("(15, 25)", "15:25:41 is"),
            ("[15:25:11]", "write 15:25:11"),
            ("1e-3-1e-2", "0.001:0.01:41 is"),
            ("1:100:log", "1:100:41:log is"),
            ("0,5:1,5:11", "write 0.5:1.5:11"),
            ("10%:50%:5", "write 0.1:0.5:5"),
            ("15:25:0.5", "15:25:21 has the distance 0.5"),
            ("25:15:0.5", "25:15:21 has the distance 0.5"),
            ("0:1:0.3", "0:1:4 has the distance 0.333"),
        ] {
            assert!(hint(text).contains(said), "{text}: {}", hint(text));
        }
        for text in ["", "a", "1", "a:2:3", "1:2:3:4", "0:1:-3", "nan:1:3", "0:1:1e-300", "1:1:0.5", ":"] {
            assert!(hint(text).contains("0.4:2:33 is 33 values"), "{text}: {}", hint(text));
        }
    }
}
