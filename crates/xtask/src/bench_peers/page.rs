//! `docs/performance.md`, every number of which was measured by the run that writes it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::accuracy::{Accuracy, FIRST, PERIODS, TOLERANCE};
use super::machine::Facts;
use super::rates::{Rates, Row};
use super::setup::COMPILE;
use super::{Options, notes};

/// All that the page is made of.
pub(super) struct Findings<'a> {
    pub(super) options: Options,
    pub(super) machine: &'a Facts,
    pub(super) rates: &'a Rates,
    pub(super) accuracy: &'a Accuracy,
}

/// The page.
pub(super) fn write(found: &Findings<'_>) -> String {
    let parts = [
        notes::HEAD.to_owned(),
        rates(found),
        labels(&found.rates.rows),
        accuracy(found.accuracy),
        notes::fairness(found.rates),
        machine(found),
        notes::AGAIN.to_owned(),
    ];
    parts.join("\n")
}

fn rates(found: &Findings<'_>) -> String {
    let mut text = String::from(notes::RATES);
    text.push_str("\n| | chaos, impacts/s | ratio | regular, impacts/s | ratio | basin, starts/s | ratio |\n");
    text.push_str("|---|--:|--:|--:|--:|--:|--:|\n");
    for row in &found.rates.rows {
        let cells = row.cells.iter().map(|cell| match cell {
            Some(cell) => format!("{} | {}", grouped(cell.rate), short(cell.ratio)),
            None => "- | -".to_owned(),
        });
        let _ = writeln!(text, "| {} | {} |", row.name, cells.collect::<Vec<_>>().join(" | "));
    }
    let Options { rounds, seconds, .. } = found.options;
    let _ = write!(
        text,
        "\nRates are medians of {rounds} rounds of {seconds} s each, ratios medians of the ratios to the baseline in the same \
         round.\n{}",
        spread(&found.rates.rows)
    );
    for why in &found.rates.missing {
        let _ = write!(text, "\n\nNot measured: {why}.");
    }
    text.push('\n');
    text
}

/// How far the rounds were apart.
fn spread(rows: &[Row]) -> String {
    let cells = rows.iter().flat_map(|row| row.cells.iter().flatten().map(|cell| (row.name, cell.spread)));
    cells.max_by(|a, b| a.1.total_cmp(&b.1)).map_or_else(String::new, |(name, spread)| {
        format!("The rounds of one contender were apart by up to {:.0} % of its median ({name}).", 100.0 * spread)
    })
}

fn labels(rows: &[Row]) -> String {
    let mut text = String::from(notes::LABELS);
    text.push_str("\n| | starts | 1/1 | 2/1 | other |\n|---|--:|--:|--:|--:|\n");
    for row in rows.iter().filter(|row| !row.labels.is_empty()) {
        let all: u64 = row.labels.values().sum();
        let share = |count: u64| percent(count, all);
        let of = |label: &str| row.labels.get(label).copied().unwrap_or(0);
        let (one, two) = (of("1/1"), of("2/1"));
        let _ = writeln!(
            text,
            "| {} | {all} | {} | {} | {} |",
            row.name,
            share(one),
            share(two),
            other(&row.labels, all - one - two)
        );
    }
    text
}

/// The rarer labels, by count.
fn other(labels: &BTreeMap<String, u64>, count: u64) -> String {
    if count == 0 {
        return "0".to_owned();
    }
    let rare = labels.iter().filter(|(label, _)| !matches!(label.as_str(), "1/1" | "2/1"));
    rare.map(|(label, count)| format!("{count} {label}")).collect::<Vec<_>>().join(", ")
}

fn accuracy(accuracy: &Accuracy) -> String {
    let mut text = notes::ACCURACY.replace("FIRST", &FIRST.to_string());
    text = text.replace("TOLERANCE", &format!("{TOLERANCE:e}")).replace("PERIODS", &PERIODS.to_string());
    let starts = accuracy.groups.first().map_or(0, |(_, starts, _)| *starts);
    let _ = writeln!(text, "\nWrong, of {starts} starts each:\n");
    let names: Vec<_> = accuracy.groups.iter().map(|(name, ..)| *name).collect();
    let _ = writeln!(text, "| | {} |\n|---|{}", names.join(" | "), "--:|".repeat(names.len()));
    for (name, wrong) in &accuracy.rows {
        let _ = writeln!(text, "| {name} | {} |", joined(wrong));
    }
    let impacts: Vec<_> = accuracy.groups.iter().map(|(_, _, impacts)| *impacts).collect();
    let _ = writeln!(text, "| *impacts compared* | {} |", joined(&impacts));
    text
}

fn machine(found: &Findings<'_>) -> String {
    let mut text = String::from("## Machine and versions\n\n| | |\n|---|---|\n");
    for (name, value) in found.machine {
        let _ = writeln!(text, "| {name} | {value} |");
    }
    let _ = writeln!(text, "\nThe peers in C are compiled with `{COMPILE}`, vibroimpact with `cargo build --release`.");
    text
}

fn joined(numbers: &[usize]) -> String {
    numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(" | ")
}

/// A share in per cent, or `-` of nothing.
fn percent(count: u64, all: u64) -> String {
    #[allow(clippy::cast_precision_loss)] // counts of starts
    let share = 100.0 * count as f64 / all as f64;
    if all == 0 { "-".to_owned() } else { format!("{share:.1} %") }
}

/// A rate to three digits, in groups of three.
fn grouped(rate: f64) -> String {
    if rate < 100.0 {
        return short(rate);
    }
    let unit = 10_f64.powf(rate.log10().floor() - 2.0);
    let digits = format!("{:.0}", (rate / unit).round() * unit);
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place) % 3 == 0 {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// A number to three digits.
pub(super) fn short(number: f64) -> String {
    if number <= 0.0 || !number.is_finite() {
        return "-".to_owned();
    }
    let decimals = [(100.0, 0), (10.0, 1), (1.0, 2), (0.1, 3), (0.01, 4)];
    let decimals = decimals.iter().find(|(from, _)| number >= *from).map_or(5, |(_, decimals)| *decimals);
    format!("{number:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::super::rates::Cell;
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(
            [1_234_567.0, 334_123.0, 5_997.0, 999.6, 15.58].map(grouped),
            ["1 230 000", "334 000", "6 000", "1 000", "15.6"]
        );
        assert_eq!([12.34, 1.0, 0.4567, 0.0035].map(short), ["12.3", "1.00", "0.457", "0.00350"]);
    }

    #[test]
    fn the_page_has_a_line_for_each_contender_and_names_what_is_missing() {
        let cell = Some(Cell { rate: 334_000.0, ratio: 1.0, spread: 0.07 });
        let peer = Row {
            name: "C",
            cells: [cell.clone(), cell.clone(), cell],
            labels: BTreeMap::from([("1/1".to_owned(), 3), ("stuck".to_owned(), 1)]),
            callback_share: 0.0,
        };
        let ours = Row { name: "ours", cells: [None, None, None], labels: BTreeMap::new(), callback_share: 0.0 };
        let rates = Rates { rows: vec![peer, ours], missing: vec!["no bench".to_owned()] };
        let accuracy = Accuracy { groups: vec![("N", 300, 1200)], rows: vec![("C", vec![2])] };
        let options = Options { rounds: 5, seconds: 1.0, starts: 300, quick: false };
        let machine = vec![("processor", "abacus".to_owned())];
        let page = write(&Findings { options, machine: &machine, rates: &rates, accuracy: &accuracy });
        for line in [
            "| C | 334 000 | 1.00 | 334 000 | 1.00 | 334 000 | 1.00 |",
            "| ours | - | - | - | - | - | - |",
            "Not measured: no bench.",
            "| C | 4 | 75.0 % | 0.0 % | 1 stuck |",
            "Wrong, of 300 starts each:",
            "| C | 2 |",
            "| *impacts compared* | 1200 |",
            "| processor | abacus |",
        ] {
            assert!(page.lines().any(|other| other == line), "{line}\nis not in\n{page}");
        }
    }
}
