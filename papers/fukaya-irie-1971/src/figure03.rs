//! Figure 3: the flow chart, flight by flight until the rule (11)-(12) finds a period or 100 impacts have passed; and
//! the reliability of this rule for each start on the grid of figure 4.

use crate::claims::{Agreement, Section};
use crate::folder::Csv;
use crate::grid::Grid;
use crate::{Error, Run, looks};
use std::collections::BTreeMap;
use vibroimpact::verdict::{PaperRule, PaperVerdict};

pub(crate) fn run(run: &mut Run<'_>, grid: &Grid) -> Result<(), Error> {
    run.stage("figure 3: the paper's rule", 0)?;
    let pairs: Vec<(&str, String)> = grid
        .points
        .iter()
        .flat_map(|point| &point.starts)
        .map(|(ours, rule)| (ours.as_str(), in_words(rule)))
        .collect();
    let mut table: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for (ours, rule) in &pairs {
        *table.entry((ours, rule)).or_default() += 1;
    }
    let mut csv = Csv::new(
        "Figure 3: starts of figure 4's grid by our verdict and by the paper's rule (11)-(12) with p = 0.1 % and 100 impacts",
        "verdict,paper_rule,starts",
    );
    for ((ours, rule), starts) in &table {
        csv.row(&[ours, rule, starts]);
    }
    run.folder.write("figure-03.csv", csv.bytes())?;

    let tally = |kind: &dyn Fn(&str) -> bool| -> (usize, usize) {
        let of: Vec<_> = pairs.iter().filter(|(ours, _)| kind(ours)).collect();
        (of.iter().filter(|(ours, rule)| same(ours, rule)).count(), of.len())
    };
    let simple = |label: &str| ["1/1", "2/1", "3/1", "1/2", "1/3"].contains(&label);
    let all = tally(&|_| true);
    let few = tally(&simple);
    let none = tally(&|label| label == "0");
    let chaotic = tally(&|label| label == "chaotic");
    let others = tally(&|label| !simple(label) && label != "0" && label != "chaotic");
    let part = |(same, all): (usize, usize)| format!("{same} of {all} ({})", looks::percent(looks::ratio(same, all)));
    let invented = pairs.iter().filter(|(ours, rule)| *ours == "0" && rule.contains('/')).count();
    let in_chaos = pairs.iter().filter(|(ours, rule)| *ours == "chaotic" && rule.contains('/')).count();
    let multiple: Vec<_> = pairs.iter().filter(|(ours, rule)| repeated(ours, rule)).collect();
    let doubled = multiple.iter().filter(|(ours, rule)| *ours == "1/1" && rule == "2/2").count();
    let mut section = Section::new(
        "Figure 3. The method and its rule",
        "The paper's flow chart: fly to the next impact, set time back to zero and advance the phase, test for a period with \
         (11)-(12), repeat; 100 impacts without a period count as unstable. The tolerance p is left open there; 0.1 % is \
         used here. Both the rule and our verdict were applied to every start of figure 4's grid.",
    );
    section.files = vec!["figure-03.csv".into()];
    section.claim(
        "3",
        "whether a motion has settled, and into which m/n, is told by the rule (11)-(12) within 100 impacts",
        format!(
            "the rule gives our verdict for {} of the starts: for 1/1, 2/1, 3/1, 1/2 and 1/3 in {}, for other periodic \
             motions in {}, for motions that cease to strike in {}, for chaotic ones in {}",
            part(all),
            part(few),
            part(others),
            part(none),
            part(chaotic)
        ),
        Agreement::of(looks::ratio(all.0, all.1) > 0.95, looks::ratio(few.0, few.1) > 0.8),
    );
    section.claim(
        "3",
        "what meets the rule is a periodic motion",
        format!(
            "not always, as p = 0.1 % takes it: it names a period for {} whose impacts only grow ever gentler (to us: no \
             impact), for {} that are chaotic, where two impacts come within p by chance, and a multiple of the period, while \
             the transient still swings, for {}, {doubled} of them 2/2 for 1/1",
            looks::count(invented, "start"),
            looks::count(in_chaos, "start"),
            looks::count(multiple.len(), "start")
        ),
        Agreement::of(invented + in_chaos + multiple.len() == 0, few.0 > 0),
    );
    run.report.sections.push(section);
    Ok(())
}

/// The verdict of the rule as a label, `unstable`, `none` or `sticks`.
pub(crate) fn in_words(rule: &PaperVerdict) -> String {
    match rule {
        PaperVerdict::Settled { m, n, .. } => format!("{m}/{n:.0}"),
        PaperVerdict::Unstable => "unstable".into(),
        PaperVerdict::NoMoreImpacts => "none".into(),
        PaperVerdict::Sticks => "sticks".into(),
    }
}

/// Whether the verdict of the rule is equivalent to our label.
fn same(ours: &str, rule: &str) -> bool {
    match ours {
        "0" => rule == "none",
        "chaotic" => rule == "unstable",
        "stuck" => rule == "sticks",
        label if label.starts_with("inf/") => rule == "sticks",
        label => rule == label,
    }
}

/// Whether the m/n of the rule is our motion counted over several periods.
fn repeated(ours: &str, rule: &str) -> bool {
    match (looks::numbers(ours), looks::numbers(rule)) {
        (Some((m, n)), Some((km, kn))) => km > m && km.is_multiple_of(m) && km / m * n == kn,
        _ => false,
    }
}

/// The rule with a tolerance in per cent.
pub(crate) fn with_tolerance(percent: f64) -> PaperRule {
    PaperRule { percent, ..PaperRule::default() }
}
