//! Where the simple orbits are stable, from theory: which points of the plane have a stable, possible orbit of a label.
//!
//! One impact in n forcing periods has a closed form ([`one_impact`]). For m impacts in one period Newton's method is
//! followed from node to node of a grid, from the orbits that settling found: a node is inside when the orbit of a
//! neighbour leads to a stable orbit of the same label there. Between an inner and an outer node the border is found by
//! bisection, the orbit being carried along.

use crate::contour::{Nodes, bisect, outlines};
use crate::{EPS, Error, Run};
use vibroimpact::motion::ImpactState;
use vibroimpact::orbit::{one_impact, shoot};
use vibroimpact::verdict::Count;
use vibroimpact::{Label, Oscillator};
use vibroimpact_study::tiles;

/// The region of a label.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    pub(crate) label: Label,
    pub(crate) outlines: Vec<Vec<(f64, f64)>>,
    /// Its part of the window.
    pub(crate) area: f64,
    /// The mean gap over it, and the lowest and highest.
    pub(crate) mean_gap: f64,
    pub(crate) gaps: (f64, f64),
    /// The grid it was found on and, where Newton's method followed it, the orbit at each node.
    nodes: Nodes,
    states: Vec<Option<ImpactState>>,
}

impl Region {
    /// Whether a stable, possible orbit of this label is known at the point itself.
    pub(crate) fn holds(&self, inverse_beta: f64, gap: f64) -> bool {
        if self.label.impacts == Label::new(1, 1).impacts {
            return closed_at((inverse_beta, gap), self.label);
        }
        let k = self.nodes.nearest(inverse_beta, gap);
        core::iter::once(k)
            .chain(self.nodes.neighbours(k))
            .filter_map(|node| self.states.get(node).copied().flatten())
            .any(|guess| followed_at((inverse_beta, gap), self.label, guess).is_some())
    }
}

/// An orbit some run settled into: where, and one of its impacts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seed {
    pub(crate) label: Label,
    pub(crate) at: (f64, f64),
    pub(crate) state: ImpactState,
}

/// The regions of these labels in the window, in the order asked for.
pub(crate) fn regions(run: &Run<'_>, nodes: &Nodes, labels: &[Label], seeds: &[Seed]) -> Result<Vec<Region>, Error> {
    run.stage("figure 4: regions from theory", labels.len() as u64)?;
    let parts = tiles(labels.len() as u64, 1, run.control, |range, tick| {
        let mut found = Vec::new();
        for k in range {
            #[allow(clippy::cast_possible_truncation)] // a handful
            let label = labels[k as usize];
            let stopped = || run.control.stop.load(std::sync::atomic::Ordering::Relaxed);
            found.push(if label.impacts == Label::new(1, 1).impacts {
                closed(nodes, label, stopped)
            } else {
                followed(nodes, label, seeds, stopped)
            });
            tick();
        }
        found
    })?;
    Ok(parts.into_iter().flatten().collect())
}

fn system((inverse_beta, gap): (f64, f64)) -> Option<Oscillator> {
    Oscillator::from_inverse_beta(inverse_beta, gap, EPS).ok()
}

fn closed_at(at: (f64, f64), label: Label) -> bool {
    system(at)
        .is_some_and(|osc| one_impact(&osc, label.periods).iter().any(|orbit| orbit.physical && orbit.cycle.stable()))
}

fn followed_at(at: (f64, f64), label: Label, guess: ImpactState) -> Option<ImpactState> {
    let Count::Finite(m) = label.impacts else {
        return None;
    };
    let cycle = shoot(&system(at)?, guess, m, label.periods).ok()?;
    (cycle.label == label && cycle.stable()).then(|| cycle.points[0].state)
}

/// One impact in n periods.
fn closed(nodes: &Nodes, label: Label, stopped: impl Fn() -> bool) -> Region {
    let ask = |x: f64, gap: f64| !stopped() && closed_at((x, gap), label);
    let inside: Vec<bool> = (0..nodes.count()).map(|k| ask(nodes.at(k).0, nodes.at(k).1)).collect();
    let lines = outlines(nodes, &inside, |a, b| bisect(nodes.at(a), nodes.at(b), ask));
    region(nodes, label, (&inside, Vec::new()), lines)
}

/// How often a node is tried from different neighbours before it counts as outside.
const TRIES: u8 = 3;

/// m impacts in n periods, by Newton's method from node to node.
fn followed(nodes: &Nodes, label: Label, seeds: &[Seed], stopped: impl Fn() -> bool) -> Region {
    let orbit = |at, guess| followed_at(at, label, guess);
    let mut states: Vec<Option<ImpactState>> = vec![None; nodes.count()];
    let mut tries = vec![0_u8; nodes.count()];
    let mut front: std::collections::VecDeque<(usize, ImpactState)> = seeds
        .iter()
        .filter(|seed| seed.label == label)
        .map(|seed| (nodes.nearest(seed.at.0, seed.at.1), seed.state))
        .collect();
    while let Some((k, guess)) = front.pop_front() {
        if states[k].is_some() || tries[k] >= TRIES || stopped() {
            continue;
        }
        tries[k] += 1;
        let Some(state) = orbit(nodes.at(k), guess) else {
            continue;
        };
        states[k] = Some(state);
        front.extend(nodes.neighbours(k).map(|next| (next, state)));
    }
    let inside: Vec<bool> = states.iter().map(Option::is_some).collect();
    let lines = outlines(nodes, &inside, |a, b| {
        let mut last = states[a];
        bisect(nodes.at(a), nodes.at(b), |x, gap| {
            let next = last.and_then(|guess| orbit((x, gap), guess));
            last = next.or(last);
            next.is_some()
        })
    });
    region(nodes, label, (&inside, states), lines)
}

/// The measures of a region, over the nodes with a gap that is not negative.
fn region(
    nodes: &Nodes,
    label: Label,
    (inside, states): (&[bool], Vec<Option<ImpactState>>),
    outlines: Vec<Vec<(f64, f64)>>,
) -> Region {
    let (mut count, mut total, mut sum) = (0.0, 0.0, 0.0);
    let mut gaps = (f64::INFINITY, f64::NEG_INFINITY);
    for (k, inside) in inside.iter().enumerate() {
        let gap = nodes.at(k).1;
        if gap < 0.0 {
            continue;
        }
        total += 1.0;
        if *inside {
            count += 1.0;
            sum += gap;
            gaps = (gaps.0.min(gap), gaps.1.max(gap));
        }
    }
    Region { label, outlines, area: count / total, mean_gap: sum / count, gaps, nodes: *nodes, states }
}
