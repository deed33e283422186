//! Regions of machines: against the events of branches and against single motions.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::curves::hammer;
use vibroimpact::Label;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction, Region, RegionKind, RegionOptions,
    machine::{Branch, Family, Plane},
};
use vibroimpact::orbit::{find_machine_while, machine::Cycle};
use vibroimpact::verdict::{SettleOptions, Verdict, scattered_machine_starts, settle_machine};

const RANGES: (core::ops::RangeInclusive<f64>, core::ops::RangeInclusive<f64>) = (0.95..=1.25, 0.35..=0.65);

fn region(label: Label, kind: RegionKind) -> Region {
    let plane = Plane::new(hammer, RANGES);
    let options = RegionOptions { grid: (6, 6), ..RegionOptions::default() };
    plane.region_while(label, kind, options, &|| true).unwrap()
}

/// The stable cycles to which some starts lead.
fn stable(at: (f64, f64)) -> Vec<Cycle> {
    let machine = hammer(at.0, at.1).unwrap();
    let verdicts = (0..6).map(|k| {
        let start = scattered_machine_starts(&machine, 3, k);
        settle_machine(&machine, &start, &SettleOptions::default()).unwrap().verdict
    });
    verdicts.filter_map(|verdict| if let Verdict::Periodic(cycle) = verdict { Some(cycle) } else { None }).collect()
}

/// 2/1 ends at a fold where the frequency grows: the branch finds it to rounding.
#[test]
fn the_edge_is_the_event_of_the_branch() {
    let found = region(Label::new(2, 1), RegionKind::Existence);
    assert!(found.unresolved.is_empty(), "{:?}", found.unresolved);
    for gap in [0.41, 0.5, 0.58] {
        let cycle = stable((0.97, gap)).into_iter().find(|cycle| cycle.label == Label::new(2, 1)).unwrap();
        let family = Family::new(move |frequency| hammer(frequency, gap));
        let branch = Branch::new((&family, 0.97), &cycle, &(0.95..=1.25), Direction::Up, BranchOptions::default());
        let fold = branch.unwrap().find(|point| point.event == Some(BranchEvent::Fold)).unwrap().value;
        let near = 1e-3 * 0.25 * 0.3;
        assert!(found.contains((fold - near, gap)) && !found.contains((fold + near, gap)), "{fold} {gap}");
    }
}

/// Whether a search from many starts at this point alone finds a stable cycle with the label.
fn has_stable(label: Label, (frequency, gap): (f64, f64)) -> bool {
    let machine = hammer(frequency, gap).unwrap();
    let starts = (0..48).map(|k| scattered_machine_starts(&machine, 5, k));
    find_machine_while(&machine, label, starts, &|| true).unwrap().iter().any(Cycle::stable)
}

/// Wherever motions settle into 1/1 or 2/1, or a search finds it stable, and nowhere else.
#[test]
fn settled_motions_lie_in_regions_of_stability() {
    let labels = [Label::new(1, 1), Label::new(2, 1)];
    let regions = labels.map(|label| region(label, RegionKind::Stability));
    for k in 0..25 {
        let at = (0.952 + 0.296 * (0.7549 * f64::from(k)).fract(), 0.352 + 0.296 * (0.5698 * f64::from(k)).fract());
        let settled = stable(at);
        for (label, region) in labels.iter().zip(&regions) {
            let reached = settled.iter().any(|cycle| cycle.label == *label) || has_stable(*label, at);
            assert_eq!(reached, region.contains(at), "{label} {at:?}");
        }
    }
}
