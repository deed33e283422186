//! Many motions followed side by side: the same events and verdicts as one after another, for all lanes.

use vibroimpact::flight::SearchLimits;
use vibroimpact::lanes::{Batch, Width};
use vibroimpact::motion::{End, Event, EventKind, EventRecorder, Motion, record_events};
use vibroimpact::verdict::{
    Census, Counted, Ending, KnownAttractors, SettleOptions, Settlement, StartBox, scattered_starts, settle,
    settle_each, settle_many,
};
use vibroimpact::{Oscillator, Start, scenario};

const EVENTS: usize = 150;

/// The first events of each motion, and the end of those that have fewer.
#[derive(Debug, Default, PartialEq)]
struct Kept {
    events: Vec<Vec<Event>>,
    ends: Vec<Option<Option<End>>>,
}

impl Kept {
    fn new(count: usize) -> Self {
        Self { events: vec![Vec::new(); count], ends: vec![None; count] }
    }
}

impl EventRecorder for Kept {
    fn event(&mut self, motion: usize, event: &Event) -> bool {
        self.events[motion].push(*event);
        self.events[motion].len() < EVENTS
    }
    fn end(&mut self, motion: usize, end: Option<End>) {
        self.ends[motion] = Some(end);
    }
    fn stopping(&mut self) -> bool {
        false
    }
}

/// 1/beta, gap, restitution, damping, and the gap of a second stop.
type Parameters = (f64, f64, f64, f64, Option<f64>);

/// With chatter, sticking, preload, both extremes of the restitution, and systems that the lanes do not follow.
const FEW: [Parameters; 8] = [
    (1.11, -0.5, 0.5, 0.0, None),
    (0.4, -0.95, 0.9, 0.05, None),
    (1.3, 0.75, 0.0, 0.0, None),
    (2.0, 0.4, 1.0, 0.0, None),
    (1.0, 0.0, 0.7, 0.3, None),
    (0.9, 0.4, 0.6, 0.02, Some(0.5)),
    (0.002, 0.4, 0.6, 0.0, None),
    (1.7, -2.0, 0.5, 0.1, None),
];

/// With grazing contacts, and motions that never reach a stop again.
const MORE: [Parameters; 6] = [
    (1.3, -0.2, 0.0, 0.1, None),
    (2.0, 0.4, 1.0, 0.01, Some(0.3)),
    (0.5, 3.0, 0.5, 0.0, None),
    (1.9, 2.5, 0.8, 0.02, None),
    (1.913_7, 6.0, 0.8, 0.0, None),
    (1.7, 0.1, 0.3, 0.0, Some(0.05)),
];

/// The points of the paper, and these.
fn systems(others: impl IntoIterator<Item = Parameters>) -> Vec<Oscillator> {
    let mut systems: Vec<Oscillator> = scenario::PAPER.iter().map(scenario::Scenario::oscillator).collect();
    for (inverse, gap, eps, damping, lower) in others {
        let mut osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(damping).unwrap();
        if let Some(gap) = lower {
            osc = osc.with_second_stop(gap, 0.8).unwrap();
        }
        systems.push(osc);
    }
    systems
}

/// Scattered starts, and some at rest on a stop, whose flights begin with a grazing contact or sticking.
fn starts(osc: &Oscillator) -> Vec<Start> {
    let area = StartBox::natural(osc);
    let resting = |k: usize| Start { x: osc.gap(), v: 0.0, phase: 0.37 * k as f64 };
    (0..70).map(|k| if k % 7 == 3 { resting(k) } else { scattered_starts(osc, area, 3, k as u64) }).collect()
}

#[test]
fn the_same_as_one_after_another() {
    let (mut kinds, mut ends) = ([0; 4], [0; 4]);
    for (limits, count) in
        [(SearchLimits::default(), 70), (SearchLimits { periods: 20.0, ..SearchLimits::default() }, 33)]
    {
        for osc in systems(FEW.into_iter().chain(MORE)) {
            let starts = &starts(&osc)[..count];
            let mut expected = Kept::new(count);
            for (number, start) in starts.iter().enumerate() {
                let mut motion = Motion::with_limits(&osc, *start, limits);
                expected.events[number] = motion.by_ref().take(EVENTS).collect();
                if expected.events[number].len() < EVENTS {
                    expected.ends[number] = Some(motion.end());
                }
            }
            for event in expected.events.iter().flatten() {
                kinds[match event.kind {
                    EventKind::Impact { .. } => 0,
                    EventKind::Graze { .. } => 1,
                    EventKind::Stick { .. } => 2,
                    EventKind::Release => 3,
                }] += 1;
            }
            for end in &expected.ends {
                ends[match end {
                    None => 0,
                    Some(Some(End::Never(_))) => 1,
                    Some(Some(End::NoneFor(_))) => 2,
                    Some(Some(End::Stuck(_)) | None) => 3,
                }] += 1;
            }
            for width in Width::ALL.into_iter().filter(|width| width.available()) {
                let mut got = Kept::new(count);
                record_events(&osc, starts, limits, width, &mut got);
                assert_eq!(got, expected, "{osc:?} {width:?}");
            }
        }
    }
    assert!(kinds.iter().chain(&ends).all(|count| *count >= 5), "{kinds:?} {ends:?}");
}

/// Scattered starts, with the trapping regions of a survey.
#[test]
fn scattered() {
    let osc = scenario::S.oscillator();
    let (area, options) = (StartBox::natural(&osc), SettleOptions::default());
    let start = |k: u64| scattered_starts(&osc, area, 5, k);
    let survey = KnownAttractors::survey(&osc, (0..10).map(start), &options);
    let got = settle_many(&osc, 100..2600, &start, &survey, &options, Width::best(), &|| false);
    let mut census = Census::default();
    let cells = (100..2600).map(|k| census.add(&settle(&osc, start(k), &options).verdict));
    assert!(cells.eq(got.cells.iter().map(|cell| *cell as usize)));
    assert_eq!(got.motions, census.motions());
}

/// As one start after another, for all lanes, trapping regions and parts.
#[test]
fn the_same_as_one_by_one() {
    let options = SettleOptions { max_impacts: 3000, chaos_over: 1000, max_steps: 200_000, ..SettleOptions::default() };
    for osc in systems(FEW) {
        let area = StartBox::natural(&osc);
        let start = |k: u64| scattered_starts(&osc, area, 3, k);
        let mut census = Census::default();
        let mut expected = Settlement::default();
        for settled in (0..60).map(|k| settle(&osc, start(k), &options)) {
            expected.cells.push(u32::try_from(census.add(&settled.verdict)).unwrap());
            let impacts = u32::try_from(settled.impacts).unwrap();
            expected.endings.push(Ending { reason: settled.verdict.reason(), impacts });
        }
        expected.motions = census.motions().to_vec();
        let reasons = |of: &Settlement| of.endings.iter().map(|ending| ending.reason).collect::<Vec<_>>();
        let none = KnownAttractors::default();
        let survey = KnownAttractors::survey(&osc, (100..110).map(start), &options);
        for width in Width::ALL.into_iter().filter(|width| width.available()) {
            for survey in [&none, &survey] {
                let got = settle_many(&osc, 0..60, &start, survey, &options, width, &|| false);
                assert_eq!(reasons(&got), reasons(&expected), "{osc:?} {width:?}");
                if *survey != none {
                    // a motion that a trapping region has captured is not followed to the end
                    let mut shorter = got.endings.iter().zip(&expected.endings);
                    assert!(shorter.all(|(got, whole)| got.impacts <= whole.impacts), "{osc:?} {width:?}");
                }
                let endings = if *survey == none { got.endings.clone() } else { expected.endings.clone() };
                let tails = Vec::new(); // not kept for motions side by side
                assert!(got.tails.iter().all(Vec::is_empty) || Batch::new(&osc, 1, width).is_none(), "{osc:?}");
                assert_eq!(Settlement { endings, tails, ..got }, expected, "{osc:?} {width:?}");
                // a small number is followed one by one
                let few = settle_many(&osc, 0..20, &start, survey, &options, width, &|| false);
                assert_eq!(few.cells, expected.cells[..20], "{osc:?} {width:?}");
            }
        }
    }
}

/// With all kinds of systems, several of some, and numbers of starts from 0 to more than a few.
fn counted() -> Vec<Counted> {
    let mut all: Vec<Oscillator> = Vec::new();
    for point in scenario::PAPER {
        let osc = point.oscillator();
        all.extend([osc, osc.with_damping(0.02).unwrap(), osc.with_second_stop(3.0, 0.8).unwrap()]);
    }
    for (inverse, gap, eps, damping) in [
        (1.11, -0.5, 0.5, 0.0),
        (0.4, -0.95, 0.9, 0.05),
        (1.3, 0.75, 0.0, 0.0),
        (1.0, 0.0, 0.7, 0.3),
        (1.0, 0.4, 0.7, 0.0),
        (0.002, 0.4, 0.6, 0.0),
        (0.35, 0.4, 0.6, 0.0),
        (2.6, 0.4, 0.6, 0.0),
        (1.12, 3.0, 0.5, 0.0),
        (1.10, 3.0, 0.5, 0.0),
    ] {
        all.push(Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(damping).unwrap());
    }
    // whose motions settle slowly or never
    for (inverse, gap, eps) in [(1.11, 1.83, 0.5), (1.7, 0.1, 0.93), (1.85, 1.125, 0.5), (0.9, 0.3, 0.95)] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap();
        all.extend([osc, osc.with_damping(0.001).unwrap(), osc.with_second_stop(0.8, 0.9).unwrap()]);
    }
    let counts = [3, 1, 5, 0, 4, 40, 2, 30, 12].into_iter().cycle();
    all.into_iter().zip(counts).collect()
}

/// The verdicts, numbers of impacts and tails of each system do not depend on the systems beside it, nor on the width
/// of the lanes, in which motions are followed on after 64 impacts.
#[test]
fn system_by_system() {
    const LONG: u32 = 64;
    let options = SettleOptions { max_impacts: 6000, chaos_over: 4000, max_steps: 200_000, ..SettleOptions::default() };
    let systems = counted();
    let areas: Vec<StartBox> = systems.iter().map(|(osc, _)| StartBox::natural(osc)).collect();
    let mut kinds = std::collections::BTreeMap::new();
    for seed in [3, 4] {
        let start = |system: usize, k: u64| scattered_starts(&systems[system].0, areas[system], seed, k);
        let none = KnownAttractors::default();
        let alone = |system: usize| {
            let (osc, count) = systems[system];
            settle_many(&osc, 0..count, &|k| start(system, k), &none, &options, Width::Portable, &|| false)
        };
        let expected: Vec<Settlement> = (0..systems.len()).map(alone).collect();
        for (settled, (_, count)) in expected.iter().zip(&systems) {
            for (cell, ending) in settled.cells.iter().zip(&settled.endings) {
                if ending.impacts > LONG && *count < 32 {
                    let label = settled.motions[*cell as usize].verdict.label();
                    *kinds.entry(label.into_owned()).or_insert(0) += 1;
                }
            }
        }
        for width in Width::ALL.into_iter().filter(|width| width.available()) {
            for part in [0..systems.len(), 0..9, 5..systems.len()] {
                let mut left: Vec<usize> = part.clone().collect();
                let of = |k: usize, index: u64| start(part.start + k, index);
                let ended = settle_each(&systems[part.clone()], &of, &options, true, width, &mut |k, got| {
                    assert_eq!(got, expected[part.start + k], "{width:?} {:?}", systems[part.start + k]);
                    left.retain(|system| *system != part.start + k);
                    false
                });
                assert!(ended && left.is_empty(), "{left:?}");
            }
        }
        let mut count = 0;
        let ended = settle_each(&systems, &start, &options, false, Width::best(), &mut |_, _| {
            count += 1;
            count == 7
        });
        assert!(!ended && count == 7, "{count}");
    }
    // motions of all kinds were followed on
    let least = [("chaotic", 30), ("2/2", 50), ("6/2", 50), ("3/2", 5), ("0", 10), ("inf/1", 3)];
    assert!(least.iter().all(|(label, least)| kinds.get(*label).is_some_and(|count| count >= least)), "{kinds:?}");
}
