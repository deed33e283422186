//! A settled motion, and the verdict of the rule of the 1971 paper.

use super::Document;
use super::motion::MotionFields;
use crate::Asked;
use serde::Serialize;
use vibroimpact::verdict::{PaperRule, PaperVerdict, Settled};
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::Plan;

/// The fields of `vibro settle`.
#[derive(Serialize)]
struct SettleFields {
    motion: MotionFields,
    impacts_followed: u64,
    time_followed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper_rule: Option<PaperAnswer>,
}

#[derive(Serialize)]
struct PaperAnswer {
    percent: f64,
    limit: u32,
    verdict: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    label: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts: Option<u32>,
}

/// The object of `vibro settle`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    (osc, start): (&Oscillator, &Start),
    settled: &Settled,
    paper: Option<(PaperRule, PaperVerdict)>,
) -> impl Serialize + use<'a> {
    let units = &asked.units;
    let answer = SettleFields {
        motion: MotionFields::new(&settled.verdict, osc, units).after(settled.transient, units),
        impacts_followed: settled.impacts,
        time_followed: settled.time * units.time(),
        paper_rule: paper.map(|(rule, verdict)| PaperAnswer::new(rule, verdict)),
    };
    Document::new(asked, osc, plan, answer).start(start, units)
}

impl PaperAnswer {
    fn new(rule: PaperRule, verdict: PaperVerdict) -> Self {
        let bare =
            Self { percent: rule.percent, limit: rule.limit, verdict: "unstable", label: None, n: None, impacts: None };
        match verdict {
            PaperVerdict::Settled { m, n, impacts } => Self {
                verdict: "settled",
                label: Some(format!("{m}/{}", n.round())),
                n: Some(n),
                impacts: Some(impacts),
                ..bare
            },
            PaperVerdict::Unstable => bare,
            PaperVerdict::NoMoreImpacts => Self { verdict: "no_more_impacts", ..bare },
            PaperVerdict::Sticks => Self { verdict: "sticks", ..bare },
        }
    }
}
