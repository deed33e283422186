//! The verdict on a start depends only on the system, the start and the budget: it is the same alone and in a batch.

use crate::case::Property;
use crate::system;
use crate::values::typed;
use proptest::prelude::*;
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{KnownAttractors, SettleOptions, StartBox, Verdict, scattered_starts, settle, settle_many};
use vibroimpact::{Oscillator, Start};

/// Two verdicts with cycles closer than this are the same.
const SAME: f64 = 1e-6;

/// Settles each start alone, then all of them in batches that end at `cuts`, with the cycles of a survey from the
/// starts numbered in `survey`, and compares the verdicts.
pub(crate) fn alone_as_among(
    osc: &Oscillator,
    starts: &[Start],
    options: &SettleOptions,
    (survey, cuts, width): (&[usize], &[usize], Width),
) -> Result<(), String> {
    let alone: Vec<Verdict> = starts.iter().map(|start| settle(osc, *start, options).verdict).collect();
    let survey = KnownAttractors::survey(osc, survey.iter().filter_map(|k| starts.get(*k)).copied(), options);
    let mut ends: Vec<usize> = cuts.iter().map(|cut| cut % (starts.len() + 1)).chain([0, starts.len()]).collect();
    ends.sort_unstable();
    ends.dedup();
    // a list of starts is short enough for any index type
    let start = |k: u64| starts[usize::try_from(k).unwrap_or(0)];
    for part in ends.windows(2) {
        let range = part[0] as u64..part[1] as u64;
        let found = settle_many(osc, range, &start, &survey, options, width, &|| false);
        if found.cells.len() != part[1] - part[0] {
            return Err(format!("{} of {} starts have a verdict", found.cells.len(), part[1] - part[0]));
        }
        for (k, cell) in (part[0]..part[1]).zip(&found.cells) {
            let among = &found.motions[*cell as usize].verdict;
            if !same(&alone[k], among) {
                let start = starts[k];
                return Err(format!(
                    "the start x = {}, v = {}, phase = {} is {} alone and {} among {} to {}",
                    start.x,
                    start.v,
                    start.phase,
                    told(&alone[k]),
                    told(among),
                    part[0],
                    part[1] - 1
                ));
            }
        }
    }
    Ok(())
}

fn same(a: &Verdict, b: &Verdict) -> bool {
    a.label() == b.label() && a.same_as(b, SAME)
}

fn told(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Periodic(cycle) => {
            format!("{} at phase {:?}", cycle.label, cycle.points.first().map(|point| point.state.phase))
        }
        other => other.label().into_owned(),
    }
}

/// A system, a few dozen starts, and their division into batches.
#[derive(Clone, Debug)]
pub struct StartBatch {
    system: system::SystemValues,
    seed: u64,
    count: u64,
    impacts: Option<u32>,
    survey: Vec<usize>,
    cuts: Vec<usize>,
    width: usize,
}

/// The family of batches of starts.
#[derive(Clone, Copy, Debug)]
pub struct Verdicts;

/// A system in the plane of the 1971 paper, where the motion depends most on the start.
fn plane() -> BoxedStrategy<system::SystemValues> {
    let ratio =
        prop_oneof![3 => (0.4..2.0_f64).prop_map(typed), 1 => (8..40_u32).prop_map(|n| typed(f64::from(n) * 0.05))];
    let restitution = prop_oneof![3 => Just("0.5".to_owned()), 1 => (0.0..1.0_f64).prop_map(typed)];
    (ratio, (-1.0..4.0_f64).prop_map(typed), restitution)
        .prop_map(|(ratio, gap, eps)| vec![("inverse_beta", ratio), ("gap", gap), ("restitution", eps)])
        .boxed()
}

const WIDTHS: [Width; 3] = Width::ALL;

impl Property for Verdicts {
    type Case = StartBatch;

    fn strategy(&self) -> BoxedStrategy<StartBatch> {
        let impacts = prop::option::weighted(0.8, prop::sample::select(vec![1, 20, 50, 100, 200, 200, 400, 1500]));
        let places = || prop::collection::vec(0..100_usize, 0..6);
        let system = prop_oneof![1 => system::system(), 1 => plane()];
        (system, any::<u64>(), 1..200_u64, impacts, places(), places(), 0..WIDTHS.len())
            .prop_map(|(system, seed, count, impacts, survey, cuts, width)| StartBatch {
                system,
                seed,
                count,
                impacts,
                survey,
                cuts,
                width,
            })
            .boxed()
    }

    fn describe(&self, case: &StartBatch) -> String {
        let system: Vec<String> =
            case.system.iter().map(|(name, value)| format!("--{}={value}", name.replace('_', "-"))).collect();
        format!(
            "{}; starts 0 to {} of seed {}, impacts {:?}, surveyed {:?}, cut at {:?}, {:?}",
            system.join(" "),
            case.count - 1,
            case.seed,
            case.impacts,
            case.survey,
            case.cuts,
            WIDTHS[case.width]
        )
    }

    fn check(&mut self, case: &StartBatch) -> Result<(), String> {
        let plan = crate::plan::system(&case.system);
        let Ok(Ok(osc)) = serde_json::from_value::<vibroimpact_study::SystemPlan>(plan).map(|plan| plan.oscillator())
        else {
            return Ok(());
        };
        let options = case.impacts.map_or_else(|| SettleOptions::at_most(2000), SettleOptions::at_most);
        let area = StartBox::natural(&osc);
        let starts: Vec<Start> = (0..case.count).map(|k| scattered_starts(&osc, area, case.seed, k)).collect();
        let width = Some(WIDTHS[case.width]).filter(|width| width.available()).unwrap_or(Width::Portable);
        alone_as_among(&osc, &starts, &options, (&case.survey, &case.cuts, width))
    }
}
