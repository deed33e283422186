//! The starts of the accuracy table: random ones at the paper's points, and ones whose first approach only just touches.

use std::f64::consts::TAU;

/// An undamped oscillator with restitution 0.5, and where its motion begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    pub(super) inverse_beta: f64,
    pub(super) gap: f64,
    pub(super) x: f64,
    pub(super) v: f64,
    pub(super) phase: f64,
}

/// Restitution of all of them.
pub(super) const RESTITUTION: f64 = 0.5;

impl Start {
    /// The line of the file of starts.
    pub(super) fn line(&self) -> String {
        let Self { inverse_beta, gap, x, v, phase } = self;
        format!("{inverse_beta:?} {gap:?} {RESTITUTION:?} {x:?} {v:?} {phase:?}")
    }

    /// Position and velocity of the flight without a stop.
    fn flight(&self, s: f64) -> (f64, f64) {
        let beta = 1.0 / self.inverse_beta;
        let f = 1.0 / ((1.0 - beta) * (1.0 + beta));
        let (a, b) = (self.x - f * self.phase.sin(), self.v - f * beta * self.phase.cos());
        let (sin, cos) = s.sin_cos();
        let (forced_sin, forced_cos) = (beta * s + self.phase).sin_cos();
        (a * cos + b * sin + f * forced_sin, b * cos - a * sin + f * beta * forced_cos)
    }
}

/// A row of the table.
pub(super) struct Group {
    pub(super) name: &'static str,
    pub(super) starts: Vec<Start>,
}

/// The points of the paper: letter, 1/beta, gap.
const POINTS: [(&str, f64, f64); 7] = [
    ("N", 1.8, 0.25),
    ("P", 0.6, 0.75),
    ("Q", 0.7, 2.5),
    ("R", 1.7, 2.25),
    ("S", 1.3, 0.75),
    ("T", 1.11, 2.0),
    ("U", 1.11, 3.0),
];

/// So many starts for each point, and as many near grazing; the same ones each time.
pub(super) fn groups(number: usize) -> Vec<Group> {
    let mut random = SplitMix(1971);
    let mut groups: Vec<Group> = POINTS
        .iter()
        .map(|&(name, inverse_beta, gap)| {
            let starts = (0..number).map(|_| anywhere(&mut random, inverse_beta, gap)).collect();
            Group { name, starts }
        })
        .collect();
    let mut starts = Vec::with_capacity(number);
    while starts.len() < number {
        starts.extend(near_grazing(&mut random));
    }
    groups.push(Group { name: "near grazing", starts });
    groups
}

fn anywhere(random: &mut SplitMix, inverse_beta: f64, gap: f64) -> Start {
    let x = random.between(-4.0, gap);
    Start { inverse_beta, gap, x, v: random.between(-4.0, 4.0), phase: random.between(0.0, TAU) }
}

/// A start at the frequency of T and U whose first maximum lies 1e-6 to 1e-4 beyond the stop, which is put there.
fn near_grazing(random: &mut SplitMix) -> Option<Start> {
    let start = anywhere(random, 1.11, 1.0);
    let depth = 10_f64.powf(random.between(-6.0, -4.0));
    let top = first_maximum(&start)?;
    // a gap like those of T and U, and a start well short of it
    let height = start.flight(top).0;
    ((1.5..3.5).contains(&height) && start.x < height - 0.1).then_some(Start { gap: height - depth, ..start })
}

/// The time of the first local maximum of the flight, within two forcing periods.
fn first_maximum(start: &Start) -> Option<f64> {
    const STEP: f64 = 0.01;
    let rises = |s: f64| start.flight(s).1 > 0.0;
    let steps = (0..1400).map(|k| STEP * f64::from(k));
    let mut low = steps.clone().zip(steps.skip(1)).find(|&(a, b)| rises(a) && !rises(b))?.0;
    let mut high = low + STEP;
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if rises(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

/// Random numbers that are the same everywhere: `SplitMix64` of Steele, Lea and Flood,
/// <https://doi.org/10.1145/2660193.2660195>.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        #[allow(clippy::cast_precision_loss)] // 53 bits
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_start_is_short_of_its_stop_and_can_be_made_again() {
        let groups = groups(20);
        assert_eq!(groups.len(), 8);
        assert!(groups.iter().all(|group| group.starts.len() == 20));
        assert!(groups.iter().flat_map(|group| &group.starts).all(|start| start.x < start.gap));
        assert_eq!(super::groups(20)[3].starts, groups[3].starts);
    }

    #[test]
    fn near_grazing_is_what_it_says() {
        let groups = groups(20);
        for start in &groups[7].starts {
            let top = first_maximum(start).unwrap();
            let depth = start.flight(top).0 - start.gap;
            assert!((9e-7..=1.1e-4).contains(&depth), "{start:?} {depth}");
            // nothing before the maximum is as high
            assert!((0..100).all(|k| start.flight(top * f64::from(k) / 100.0).0 <= start.gap + depth));
        }
    }

    #[test]
    fn a_line_gives_the_numbers_back() {
        let start = groups(1)[0].starts[0];
        let numbers: Vec<f64> = start.line().split(' ').map(|word| word.parse().unwrap()).collect();
        assert_eq!(numbers, [start.inverse_beta, start.gap, RESTITUTION, start.x, start.v, start.phase]);
    }
}
