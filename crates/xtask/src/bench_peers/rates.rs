//! The rounds, and what they come to: medians, and ratios to the baseline of the same round.

use std::collections::BTreeMap;

use super::Options;
use super::contender::{Answer, Contender};

/// What is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Workload {
    /// The chaotic motion of the paper's point U.
    Chaos,
    /// The settled motions of point S.
    Regular,
    /// Labels for starts of point S.
    Basin,
}

impl Workload {
    pub(super) const ALL: [Self; 3] = [Self::Chaos, Self::Regular, Self::Basin];

    /// Its name on the command line.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Chaos => "chaos",
            Self::Regular => "regular",
            Self::Basin => "basin",
        }
    }

    /// What its rate is called in the answer of `vibro bench`.
    pub(super) const fn measure(self) -> &'static str {
        match self {
            Self::Chaos | Self::Regular => "impacts_per_second",
            Self::Basin => "starts_per_second",
        }
    }
}

/// One contender on one workload.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell {
    /// Median of the rates.
    pub(super) rate: f64,
    /// Median of the ratios to the baseline in the same round.
    pub(super) ratio: f64,
    /// Largest rate less smallest, over the median.
    pub(super) spread: f64,
}

/// One contender.
pub(super) struct Row {
    pub(super) name: &'static str,
    /// For each workload; `None` where it was not measured.
    pub(super) cells: [Option<Cell>; 3],
    /// Of all rounds together.
    pub(super) labels: BTreeMap<String, u64>,
    /// The largest that was measured.
    pub(super) callback_share: f64,
}

/// What the rounds came to.
pub(super) struct Rates {
    pub(super) rows: Vec<Row>,
    /// A sentence for each rate of ours that could not be measured.
    pub(super) missing: Vec<String>,
}

/// What the rounds gave for one row.
#[derive(Default)]
struct Measured {
    rates: [Vec<f64>; 3],
    labels: BTreeMap<String, u64>,
    callback_share: f64,
}

impl Measured {
    fn add(&mut self, column: usize, answer: Answer) {
        self.rates[column].push(answer.rate);
        self.callback_share = self.callback_share.max(answer.callback_share);
        for (label, count) in answer.labels {
            *self.labels.entry(label).or_default() += count;
        }
    }
}

/// Runs the rounds; the first contender is the baseline.
///
/// # Errors
/// The sentence of a peer that failed. Ours may be missing.
pub(super) fn measure(contenders: &[Contender], options: Options) -> Result<Rates, String> {
    let mut measured: BTreeMap<&str, Measured> = BTreeMap::new();
    let mut missing = Vec::new();
    let mut miss = |why: String| {
        println!("  {why}");
        if !missing.contains(&why) {
            missing.push(why);
        }
    };
    let mut ready = Vec::new();
    for contender in contenders {
        match contender.ready() {
            Ok(()) => ready.push(contender),
            Err(why) => miss(why),
        }
    }
    for round in 1..=options.rounds {
        for (column, workload) in Workload::ALL.into_iter().enumerate() {
            println!("round {round} of {}, {}", options.rounds, workload.name());
            for contender in &ready {
                let answers = match contender.run(workload, options.seconds) {
                    Ok(answers) => answers,
                    Err(why) if contender.ours => vec![Err(format!("`vibro bench` gives no answer: {why}"))],
                    Err(why) => return Err(format!("{}: {why}", contender.name())),
                };
                for (name, answer) in contender.rows.iter().zip(answers) {
                    match answer {
                        Ok(answer) => {
                            println!("  {name:30} {:>12.0} per second", answer.rate);
                            measured.entry(name).or_default().add(column, answer);
                        }
                        Err(why) => miss(why),
                    }
                }
            }
        }
    }
    Ok(Rates { rows: rows(contenders, measured), missing })
}

fn rows(contenders: &[Contender], mut measured: BTreeMap<&str, Measured>) -> Vec<Row> {
    let names = contenders.iter().flat_map(|contender| contender.rows);
    let rows: Vec<_> = names.map(|name| (*name, measured.remove(name).unwrap_or_default())).collect();
    let baseline = rows.first().map(|(_, first)| first.rates.clone()).unwrap_or_default();
    rows.into_iter()
        .map(|(name, Measured { rates, labels, callback_share })| Row {
            name,
            cells: std::array::from_fn(|column| cell(&rates[column], &baseline[column])),
            labels,
            callback_share,
        })
        .collect()
}

/// Sums up the rounds, where none is missing.
fn cell(rates: &[f64], baseline: &[f64]) -> Option<Cell> {
    if rates.is_empty() || rates.len() != baseline.len() {
        return None;
    }
    let rate = median(rates.to_vec());
    let ratio = median(rates.iter().zip(baseline).map(|(rate, base)| rate / base).collect());
    let (least, most) = rates.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), &r| (l.min(r), m.max(r)));
    Some(Cell { rate, ratio, spread: (most - least) / rate })
}

/// The middle value, or the mean of the two.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_stands_above_an_outlier() {
        assert_eq!(median(vec![3.0, 1.0, 1e9]).to_bits(), 3.0_f64.to_bits());
        assert_eq!(median(vec![4.0, 1.0, 2.0, 1e9]).to_bits(), 3.0_f64.to_bits());
    }

    #[test]
    fn ratios_are_those_of_one_round() {
        // the second round was three times slower for both
        let cell = cell(&[6.0, 2.0, 6.0], &[3.0, 1.0, 3.0]).unwrap();
        assert_eq!(cell, Cell { rate: 6.0, ratio: 2.0, spread: 4.0 / 6.0 });
    }

    #[test]
    fn a_round_that_is_missing_leaves_no_number() {
        assert_eq!(cell(&[], &[1.0]), None);
        assert_eq!(cell(&[1.0], &[1.0, 1.0]), None);
    }
}
