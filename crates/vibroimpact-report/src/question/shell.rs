//! A command line as typed in a shell.

use super::{command, number};
use crate::figure::coloured::{Coloured, Of};
use crate::figure::overlay::{Layer, Overlay};
use crate::scene::View;
use vibroimpact_study::{Plan, Study, Task};

/// A word in the form in which a shell reads it unchanged.
#[must_use]
pub fn quoted(word: &str) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"/._-+:=@%,".contains(&b);
    if !word.is_empty() && word.bytes().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// The command line for a plan: its [`command`] or, for a study that no flags can express, lines that write the plan
/// into a file and call `vibro run`. `None` for a size of tiles in a task without a grid, and for an invalid plan.
#[must_use]
pub fn shell_line(plan: &Plan) -> Option<String> {
    if let Some(words) = command(plan) {
        return Some(words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" "));
    }
    let text = serde_json::to_string(plan).ok().filter(|_| Study::new(plan).is_ok())?;
    Some(format!("echo {} > plan.json && vibro run plan.json", quoted(&text)))
}

/// The same, with a figure of one view of the motion into which a start settles. For other tasks as [`shell_line`].
#[must_use]
pub fn shell_line_showing(plan: &Plan, view: View) -> Option<String> {
    let line = shell_line(plan)?;
    if !matches!(plan.task, Task::Settle { .. }) {
        return Some(line);
    }
    let name = view.name();
    let show = if view == View::default() { String::new() } else { format!(" --show {name}") };
    Some(format!("{line}{show} --plot {name}.svg"))
}

/// The same, with a figure in the colours of a quantity if one is given, and with what can be seen over a map. `None` for a
/// plan that no flags can express.
#[must_use]
pub fn shell_line_figure(plan: &Plan, coloured: Option<&Coloured>, overlay: &Overlay) -> Option<String> {
    let mut words = command(plan)?;
    if let Some(Coloured { field, of, range }) = coloured {
        words.extend(["--colour".to_owned(), field.replace('_', "-")]);
        if *of != Of::default() {
            words.extend(["--of".to_owned(), of.name().to_owned()]);
        }
        if let Some((low, high)) = range {
            words.extend(["--colour-range".to_owned(), format!("{}:{}", number(*low), number(*high))]);
        }
    }
    words.extend(over(&overlay.visible(plan, coloured.is_some()).ok()?, coloured.is_some()));
    words.extend(["--plot".to_owned(), format!("{}.svg", words[1])]);
    Some(words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" "))
}

/// The flags for what lies over a map.
fn over(overlay: &Overlay, coloured: bool) -> Vec<String> {
    let names: Vec<&str> = overlay.layers.iter().map(|layer| layer.name()).collect();
    let usual: &[Layer] = if coloured { &[] } else { &[Layer::Stripes] };
    let mut words = Vec::new();
    if overlay.layers != usual {
        words.extend(["--layers".to_owned(), if names.is_empty() { "none".to_owned() } else { names.join(",") }]);
    }
    if let Some([x, y]) = overlay.mark {
        words.extend(["--mark".to_owned(), format!("{},{}", number(x), number(y))]);
    }
    if let Some([x0, y0, x1, y1]) = overlay.line {
        let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(number);
        words.extend(["--line".to_owned(), format!("{x0},{y0}:{x1},{y1}")]);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_reads_the_word() {
        assert_eq!(quoted("/a/b-c_1.zarr"), "/a/b-c_1.zarr");
        assert_eq!(quoted("it's a plan.toml"), r"'it'\''s a plan.toml'");
        assert_eq!(quoted(""), "''");
    }

    #[test]
    fn a_study_without_flags_is_run_from_its_plan() {
        let text = r#"{"version":1,"system":{"inverse_beta":1.3,"gap":1.0,"restitution":0.5,"damping":0.0},"task":{"lyapunov":{"axes":[{"vary":"gap","over":[1.0]}],"start":{"v":0.0,"phase":0.0},"impacts":1000,"transient":100}}}"#;
        let plan: Plan = serde_json::from_str(text).unwrap();
        assert_eq!(shell_line(&plan).unwrap(), format!("echo '{text}' > plan.json && vibro run plan.json"));
    }
}
