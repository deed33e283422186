//! The response over a parameter as text.

use crate::report::branch::named;
use crate::report::words::table;
use vibroimpact_report::Units;
use vibroimpact_report::json::response::value;
use vibroimpact_report::number::short;
use vibroimpact_study::{ResponseCurves, SweptMotion};

/// The largest value of each sweep, and one row for each run of values with the same label.
pub(crate) fn text(found: &ResponseCurves, units: &Units) -> String {
    let (unit, quantity) = (units.of(found.plan.vary), found.plan.quantity);
    let (from, to) = found.plan.cut().ends;
    let name = named(found.plan.vary, units);
    let vary = found.plan.vary;
    let of = |motion: &SweptMotion| value(motion.quantities, quantity, &units.at(vary, motion.value));
    let mut text =
        format!("{} over {name} from {} to {}\n\n", quantity.description(), short(from * unit), short(to * unit));
    for (sweep, motions) in [("up", &found.up), ("down", &found.down)] {
        let most = motions.iter().filter(|motion| of(motion).is_finite()).max_by(|a, b| of(a).total_cmp(&of(b)));
        if let Some(most) = most {
            text.push_str(&format!(
                "sweep {sweep}: at most {} at {}, {}\n",
                most.quantities.map_or_else(String::new, |of| units.at(vary, most.value).text(&of, quantity)),
                short(most.value * unit),
                most.label
            ));
        }
        text.push_str(&runs(motions, unit, &of));
        text.push('\n');
    }
    let count = found.branches.len();
    let branches = if count == 1 { "1 branch".to_owned() } else { format!("{count} branches") };
    text + &format!("{branches}; --csv FILE has all points, --plot FILE.png draws them\n")
}

/// Maximum number of rows.
const MOST_ROWS: usize = 30;

/// One row for each run of values with the same label: where it is, and the range of the quantity there.
fn runs(motions: &[SweptMotion], unit: f64, of: &dyn Fn(&SweptMotion) -> f64) -> String {
    let runs: Vec<&[SweptMotion]> = motions.chunk_by(|a, b| a.label == b.label).collect();
    let heads = ["<label", "from", "to", "smallest", "largest"].map(str::to_owned);
    let row = |run: &&[SweptMotion]| {
        let values = || run.iter().map(of).filter(|value| value.is_finite());
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let ends = run.first().zip(run.last()).map_or((f64::NAN, f64::NAN), |(a, b)| (a.value * unit, b.value * unit));
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
