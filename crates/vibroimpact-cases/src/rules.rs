//! What must hold of every motion, checked after the fact on its closed form, between its events and across them.
//!
//! | rule | what is checked |
//! |---|---|
//! | [`Rule::End`] | the motion does not end by the limit of the search, by contacts without a consistent state, or by a collapse without a rigid stop; it does not stall at one time |
//! | [`Rule::Faint`] | no impact is slower than rounding errors |
//! | [`Rule::Gap`] | no rigid stop is penetrated, a compliant one only while it is closed; a stop at rest has no gap |
//! | [`Rule::Force`] | stops push, joints hold within their limits |
//! | [`Rule::Jump`] | coordinates do not jump, and no event adds energy |
//! | [`Rule::Balance`] | between events, energy changes by the work of the forces |
//! | [`Rule::Symmetry`] | what is its own image stays so |
//!
//! Gaps are followed along each stretch at the nodes of the quadrature and, where the cubic through two of them comes near
//! the stop, to the smallest one.

use crate::case::Case;
use crate::quantities::{
    compliant, contact_energy, contact_force, energy, fastest, gap, largest, power, square, surface_of,
};
use core::fmt;
use vibroimpact::events;
use vibroimpact::events::{EventKind, Limits, Motion, Sample, Stretches};
use vibroimpact::machine::{Machine, Opening, StopLaw};
use vibroimpact::regime::ContactState;

/// A rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// How the motion ends.
    End,
    /// Impacts slower than rounding.
    Faint,
    /// Gaps.
    Gap,
    /// Forces of contacts.
    Force,
    /// Events.
    Jump,
    /// Energy between events.
    Balance,
    /// Symmetry, and coordinates that stay equal.
    Symmetry,
}

impl Rule {
    /// All rules.
    pub const ALL: [Self; 7] =
        [Self::End, Self::Faint, Self::Gap, Self::Force, Self::Jump, Self::Balance, Self::Symmetry];
}

/// A rule that a motion breaks for the first time.
#[derive(Clone, Debug)]
pub struct BrokenRule {
    /// The rule.
    pub rule: Rule,
    /// The time.
    pub time: f64,
    /// What is wrong.
    pub what: String,
}

impl fmt::Display for BrokenRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} at {}: {}", self.rule, self.time, self.what)
    }
}

/// How far a motion is followed.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// The largest number of stretches between events.
    pub stretches: u32,
    /// The largest time.
    pub time: f64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { stretches: 60, time: 40.0 }
    }
}

/// Rounding errors, relative to the largest terms so far. Motions of some dozens of events have errors of some hundred
/// units in the last place; what is wrong is wrong by far more.
const ROUNDING: f64 = 1e-11;
/// An asymmetry of more than this part of coordinates or velocities breaks a symmetry, if it is not grown from rounding
/// errors by many events.
const ASYMMETRY: f64 = 1e-9;
/// Asymmetries below this part are rounding errors. Where the symmetric motion is unstable they grow with each event, and
/// it is not followed further.
const SYMMETRIC: f64 = 1e-13;
/// Speeds of impacts below this part of the largest velocity are rounding errors.
const FAINT: f64 = 1e-14;
/// So many events on one stop at one time, or stretches, are a motion that does not advance.
const STALLED: u32 = 100;
/// The largest number of intervals of the quadrature over one stretch.
const INTERVALS: f64 = 100.0;
/// Nodes and weights of Gauss and Legendre on [0, 1].
const NODES: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// The first fault against each rule of the motion of a case.
///
/// # Panics
/// If the start is invalid, which is a fault of the family.
#[must_use]
pub fn faults(case: &Case, budget: Budget) -> Vec<BrokenRule> {
    let mut follower = Follower::new(case);
    follower.events(budget);
    follower.stretches(budget);
    let mut faults = follower.faults;
    faults.sort_by_key(|fault| fault.rule);
    faults
}

struct Follower<'a> {
    case: &'a Case,
    machine: &'a Machine,
    fastest: f64,
    faults: Vec<BrokenRule>,
    /// The largest coordinate, velocity, force and energy so far.
    sizes: Sizes,
    /// The time at which the surface of a stop was left by the body, and how deep it was.
    surfaces: Vec<Option<(f64, f64)>>,
    /// The largest asymmetry so far, and that before the present event.
    asymmetry: (f64, f64),
}

#[derive(Clone, Copy, Debug, Default)]
struct Sizes {
    gap: f64,
    q: f64,
    v: f64,
    force: f64,
    energy: f64,
}

impl<'a> Follower<'a> {
    fn new(case: &'a Case) -> Self {
        let machine = &case.machine;
        let surfaces = vec![None; machine.stops().len()];
        let parts = machine.parts();
        let harmonics = parts.forces.iter().flat_map(|force| force.cos.iter().chain(&force.sin));
        let force = harmonics.chain(&parts.constant).fold(0.0_f64, |most, value| most.max(value.abs()));
        // impacts at the start may take all of this energy
        let energy = 0.5 * square(&parts.mass, &case.start.qdot);
        let sizes = Sizes { force, energy, ..Sizes::default() };
        Self { case, machine, fastest: fastest(machine), faults: Vec::new(), sizes, surfaces, asymmetry: (0.0, 0.0) }
    }

    fn fault(&mut self, rule: Rule, time: f64, what: impl FnOnce() -> String) {
        if self.faults.iter().all(|fault| fault.rule != rule) {
            self.faults.push(BrokenRule { rule, time, what: what() });
        }
    }

    fn name(&self, place: usize) -> &'a str {
        self.machine.name_of(place)
    }

    /// The rules about events alone.
    fn events(&mut self, budget: Budget) {
        let start = &self.case.start;
        let motion = Motion::new(self.machine, start, Limits::default());
        let mut motion = motion.unwrap_or_else(|why| panic!("{} {}: {why}", self.case.family, self.case.seed));
        let mut fastest = largest(&start.qdot);
        let (mut time, mut crowd) = (0.0, vec![0_u32; self.machine.stops().len() + self.machine.joints().len()]);
        let mut count = 0;
        for event in motion.by_ref() {
            count += 1;
            fastest = fastest.max(largest(&event.qdot));
            self.sizes.q = self.sizes.q.max(largest(&event.q));
            if event.kind == EventKind::Impact && event.speed <= FAINT * fastest {
                let (name, speed) = (self.name(event.place), event.speed);
                self.fault(Rule::Faint, event.time, || format!("an impact on {name} with {speed:e}"));
            }
            if event.time > time {
                crowd.fill(0);
            }
            time = event.time;
            crowd[event.place] += 1;
            if crowd[event.place] > STALLED {
                let name = self.name(event.place);
                let kind = event.kind.name();
                self.fault(Rule::End, time, || {
                    format!("more than {STALLED} events at one time on {name}, the last: {kind}")
                });
                return;
            }
            if time > budget.time || count > 4 * budget.stretches {
                break;
            }
        }
        self.sizes.v = self.sizes.v.max(fastest);
        let rigid = self.case.has_rigid_stop();
        match motion.end() {
            Some(end @ (events::End::SearchLimit | events::End::Inconsistent)) => {
                self.fault(Rule::End, motion.time(), || format!("{end:?}"));
            }
            Some(events::End::Collapse) => {
                self.fault(Rule::End, motion.time(), || {
                    format!("collapse {}", if rigid { "that is not summed" } else { "without a rigid stop" })
                });
            }
            _ => {}
        }
    }

    /// The rules about what is between events.
    fn stretches(&mut self, budget: Budget) {
        let Ok(mut stretches) = Stretches::new(self.machine, &self.case.start, Limits::default()) else {
            return;
        };
        let mut last: Option<Sample> = None;
        let mut short = 0;
        for _ in 0..budget.stretches {
            if !stretches.advance() || stretches.begin() > budget.time {
                return;
            }
            let duration = stretches.duration().min(budget.time - stretches.begin());
            short = if duration * self.fastest.max(1.0) < 1e-13 { short + 1 } else { 0 };
            if short > STALLED {
                let begin = stretches.begin();
                return self.fault(Rule::End, begin, || format!("more than {STALLED} stretches without duration"));
            }
            let Some(first) = stretches.at(0.0) else { return };
            self.grow(&first);
            self.asymmetry.1 = self.asymmetry.0;
            let held = last.as_ref().map_or(0.0, |before| self.held(before));
            self.surfaces_at(&first, last.as_ref());
            if let Some(before) = &last {
                self.jump((before, held), &first);
            }
            last = self.stretch(&mut stretches, &first, duration);
        }
    }

    fn grow(&mut self, sample: &Sample) {
        let sizes = &mut self.sizes;
        sizes.q = sizes.q.max(largest(&sample.q));
        sizes.v = sizes.v.max(largest(&sample.qdot));
        sizes.energy = sizes.energy.max(energy(self.machine, sample, 0.0).1);
        sizes.force = sizes.force.max(largest(&self.machine.parts().stiffness.apply(&sample.q)));
        for (j, stop) in self.machine.stops().iter().enumerate() {
            let gap = gap(self.machine, j, sample);
            self.sizes.gap = self.sizes.gap.max(gap.size);
            if let Some((k, c, p, _)) = compliant(&stop.law) {
                let size = k * gap.value.min(0.0).abs() + c * gap.rate.abs() + p;
                self.sizes.force = self.sizes.force.max(size);
            }
        }
    }

    /// Follows the surfaces of damped stops that the body has left by force.
    fn surfaces_at(&mut self, sample: &Sample, before: Option<&Sample>) {
        for (j, stop) in self.machine.stops().iter().enumerate() {
            let Some((_, c, _, Opening::Force)) = compliant(&stop.law) else { continue };
            let depth = -gap(self.machine, j, sample).value;
            let left = before.is_none_or(|before| before.states[j] != ContactState::Open);
            if sample.states[j] != ContactState::Open {
                self.surfaces[j] = None;
            } else if left && c > 0.0 && depth > 0.0 {
                self.surfaces[j] = Some((sample.time, depth));
            }
        }
    }

    /// How far the surface of a stop stands back.
    fn surface(&self, j: usize, time: f64) -> f64 {
        let (Some((since, depth)), Some((k, c, p, _))) = (self.surfaces[j], compliant(&self.machine.stops()[j].law))
        else {
            return 0.0;
        };
        ((depth + p / k) * (-k / c * (time - since)).exp() - p / k).max(0.0)
    }

    /// What an event may do; `held` is the energy in surfaces before it.
    fn jump(&mut self, (before, held): (&Sample, f64), after: &Sample) {
        let apart = before.q.iter().zip(&after.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if apart > 1e-9 * self.sizes.q.max(self.sizes.gap) {
            self.fault(Rule::Jump, after.time, || format!("coordinates jump by {apart:e}"));
        }
        // a frame in which all rigid stops are at rest, as that of a table that shakes
        let frequency = self.machine.parts().frequency.unwrap_or(0.0);
        let rigid: Vec<_> =
            self.machine.stops().iter().filter(|stop| matches!(stop.law, StopLaw::Rigid { .. })).collect();
        let rates: Vec<f64> = rigid.iter().map(|stop| surface_of(stop, frequency, after.phase).1).collect();
        let frame = rigid
            .iter()
            .zip(&rates)
            .find(|(_, rate)| **rate != 0.0)
            .map_or(0.0, |(stop, rate)| -rate / stop.direction.iter().sum::<f64>());
        let moves = |(stop, rate): (&&vibroimpact::machine::Stop, &f64)| {
            (rate + frame * stop.direction.iter().sum::<f64>()).abs() > 1e-14 * rate.abs()
        };
        if rigid.iter().zip(&rates).any(moves) {
            return;
        }
        let gained =
            energy(self.machine, after, frame).0 + self.held(after) - energy(self.machine, before, frame).0 - held;
        let size = self.sizes.energy.max(energy(self.machine, after, frame).1);
        if gained > 1e-10 * size {
            self.fault(Rule::Jump, after.time, || format!("an event adds the energy {gained:e} of {size:e}"));
        }
    }

    /// The energy in surfaces that stand back.
    fn held(&self, sample: &Sample) -> f64 {
        let stops = self.machine.stops().iter().enumerate();
        stops.map(|(j, stop)| contact_energy(&stop.law, self.surface(j, sample.time))).sum()
    }

    /// The rules along one stretch; returns its last state.
    fn stretch(&mut self, stretches: &mut Stretches<'_>, first: &Sample, duration: f64) -> Option<Sample> {
        let wanted = (duration * self.fastest / 0.35).ceil().max(1.0);
        let intervals = wanted.min(INTERVALS);
        let step = duration / intervals;
        let mut work = 0.0;
        let mut before = (0.0, first.clone());
        let mut k = 0.0;
        while k < intervals {
            for (node, weight) in NODES {
                let s = step * (k + node);
                let sample = stretches.at(s)?;
                work += step * weight * power(self.machine, &sample);
                self.point(&sample);
                self.between(stretches, &before, (s, &sample));
                before = (s, sample);
            }
            k += 1.0;
        }
        let last = stretches.at(duration)?;
        self.point(&last);
        self.between(stretches, &before, (duration, &last));
        if wanted <= INTERVALS {
            let change = energy(self.machine, &last, 0.0).0 - energy(self.machine, first, 0.0).0;
            let size = self.sizes.energy.max(work.abs());
            if (change - work).abs() > 1e-9 * size {
                self.fault(Rule::Balance, first.time, || {
                    format!("until {} the energy changes by {change:e}, the work is {work:e} of {size:e}", last.time)
                });
            }
        }
        Some(last)
    }

    /// The rules at one time.
    fn point(&mut self, sample: &Sample) {
        self.grow(sample);
        for j in 0..self.machine.stops().len() {
            self.gap(j, sample);
            self.force(j, sample);
        }
        let stops = self.machine.stops().len();
        for (k, joint) in self.machine.joints().iter().enumerate() {
            let force = sample.forces[stops + k].abs();
            let allowed = ROUNDING * (self.sizes.force + joint.limit);
            if sample.states[stops + k] == ContactState::Holding && force > joint.limit + allowed {
                self.fault(Rule::Force, sample.time, || format!("{} holds with {force}", joint.name));
            }
        }
        self.symmetry(sample);
    }

    fn gap(&mut self, j: usize, sample: &Sample) {
        let gap = gap(self.machine, j, sample).value;
        let allowed = ROUNDING * self.sizes.gap.max(self.sizes.q);
        let wrong = match sample.states[j] {
            ContactState::Open => -gap - self.surface(j, sample.time) > allowed,
            ContactState::Resting => gap.abs() > allowed,
            ContactState::Closed => gap > allowed,
            _ => false,
        };
        if wrong {
            let (state, name) = (sample.states[j], self.name(j));
            self.fault(Rule::Gap, sample.time, || format!("{name} is {state:?} with the gap {gap:e}"));
        }
    }

    fn force(&mut self, j: usize, sample: &Sample) {
        let law = &self.machine.stops()[j].law;
        let allowed = ROUNDING * self.sizes.force;
        let wrong = match (sample.states[j], compliant(law)) {
            (ContactState::Resting, None) => (sample.forces[j] < -allowed).then_some(sample.forces[j]),
            (ContactState::Resting, Some((_, _, preload, _))) => {
                let force = sample.forces[j];
                (force < -allowed || force > preload + allowed).then_some(force)
            }
            (ContactState::Closed, Some((k, _, _, Opening::Force))) => {
                let force = contact_force(law, &gap(self.machine, j, sample));
                let allowed = allowed + ROUNDING * k * self.sizes.gap;
                (force < -allowed).then_some(force)
            }
            _ => None,
        };
        if let Some(force) = wrong {
            let (state, name) = (sample.states[j], self.name(j));
            self.fault(Rule::Force, sample.time, || format!("{name} is {state:?} with the force {force:e}"));
        }
    }

    /// The smallest gap between two samples: where the cubic through both comes near the stop, the sample at its smallest
    /// value is looked at, and so on.
    fn between(&mut self, stretches: &mut Stretches<'_>, (a, left): &(f64, Sample), (b, right): (f64, &Sample)) {
        for j in 0..self.machine.stops().len() {
            if left.states[j] != ContactState::Open {
                continue;
            }
            let (mut a, mut b) = (*a, b);
            let (mut low, mut high) = (gap(self.machine, j, left), gap(self.machine, j, right));
            for _ in 0..40 {
                if !(low.rate < 0.0 && high.rate > 0.0 && b > a) {
                    break;
                }
                let s = a + (b - a) * (low.rate / (low.rate - high.rate)).clamp(0.05, 0.95);
                let Some(sample) = stretches.at(s) else { break };
                self.gap(j, &sample);
                let middle = gap(self.machine, j, &sample);
                // parabolas overestimate a depth that is far away
                if middle.value > 4.0 * (low.value.min(high.value)).abs() || (b - a) * self.fastest < 1e-7 {
                    break;
                }
                if middle.rate < 0.0 { (a, low) = (s, middle) } else { (b, high) = (s, middle) }
            }
        }
    }

    /// Symmetry is lost if an event, or what is before the next one, makes an asymmetry from rounding errors.
    fn symmetry(&mut self, sample: &Sample) {
        if self.asymmetry.1 > SYMMETRIC {
            return;
        }
        let case = self.case;
        // rounding errors of forces that cancel each other move bodies that nothing else moves
        let v = self.sizes.v.max(self.sizes.force * sample.time).max(f64::MIN_POSITIVE);
        let q = self.sizes.q.max(v * sample.time);
        let mut worst = 0.0_f64;
        for symmetry in &case.symmetries {
            for (vector, size) in [(&sample.q, q), (&sample.qdot, v)] {
                let image = symmetry.image(vector);
                worst = image.iter().zip(vector).fold(worst, |worst, (a, b)| worst.max((a - b).abs() / size));
            }
        }
        for (a, b) in &case.equal {
            worst = worst.max((sample.q[*a] - sample.q[*b]).abs() / q);
        }
        self.asymmetry.0 = self.asymmetry.0.max(worst);
        if worst > ASYMMETRY {
            let before = self.asymmetry.1;
            self.fault(Rule::Symmetry, sample.time, || {
                format!("an asymmetry of {worst:e}, {before:e} before the event")
            });
        }
    }
}
