//! The response over a parameter as text.

use crate::report::words::table;
use vibroimpact_report::number::short;
use vibroimpact_report::response::ResponseView;
use vibroimpact_study::ResponseRow;

/// The largest value of each sweep, and one row for each run of values with the same label; `name` is what varies, in words.
pub(crate) fn text(view: &ResponseView<'_>, name: &str) -> String {
    let (found, (from, to)) = (view.found, view.ends());
    let mut text = format!("{} over {name} from {} to {}\n\n", view.quantity, short(from), short(to));
    for (sweep, rows) in [("up", &found.up), ("down", &found.down)] {
        let finite = rows.iter().filter(|row| view.shown(row).is_finite());
        if let Some(most) = finite.max_by(|a, b| view.shown(a).total_cmp(&view.shown(b))) {
            let (value, at) = (view.text(most), short(view.parameter(most)));
            text.push_str(&format!("sweep {sweep}: at most {value} at {at}, {}\n", most.label));
        }
        text.push_str(&runs(rows, view));
        text.push('\n');
    }
    let count = found.branches.len();
    let branches = if count == 1 { "1 branch".to_owned() } else { format!("{count} branches") };
    text + &format!("{branches}; --csv FILE has all points, --plot FILE.png draws them\n")
}

/// Maximum number of rows.
const MOST_ROWS: usize = 30;

/// One row for each run of values with the same label: where it is, and the range of the quantity there.
fn runs(rows: &[ResponseRow], view: &ResponseView<'_>) -> String {
    let runs: Vec<&[ResponseRow]> = rows.chunk_by(|a, b| a.label == b.label).collect();
    let heads = ["<label", "from", "to", "smallest", "largest"].map(str::to_owned);
    let row = |run: &&[ResponseRow]| {
        let values = || run.iter().map(|row| view.shown(row)).filter(|value| value.is_finite());
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let ends =
            run.first().zip(run.last()).map_or((f64::NAN, f64::NAN), |(a, b)| (view.parameter(a), view.parameter(b)));
        let value = |value: f64| if value.is_finite() { short(value) } else { "-".to_owned() };
        vec![
            run.first().map_or_else(String::new, |m| m.label.clone()),
            short(ends.0),
            short(ends.1),
            value(low),
            value(high),
        ]
    };
    let shown: Vec<Vec<String>> = runs.iter().take(MOST_ROWS).map(row).collect();
    let mut text = table(&heads, &shown);
    if runs.len() > MOST_ROWS {
        text.push_str(&format!("  ... and {} more\n", runs.len() - MOST_ROWS));
    }
    text
}
