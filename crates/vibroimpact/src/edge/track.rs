//! Edge tracking: bisection between two starts that lead to different motions, and then along the motion on their border.
//!
//! Of two states close to each other one leads to the first motion and the other does not, so the border passes between them.
//! Both are followed until they are [`WIDE`] apart, and the way between them is bisected again. So the pair stays on the border
//! for any time, although the motion there is unstable (J. D. Skufca, J. A. Yorke and B. Eckhardt, "Edge of chaos in a parallel
//! shear flow", Phys. Rev. Lett. 96 (2006) 174101, doi:10.1103/PhysRevLett.96.174101). Where it comes back close to an earlier state,
//! Newton's method is tried: the cycle to which the motion on the border leads is the saddle between the motions beside it.

use crate::machine::MachineError;
use crate::system::phase;
use crate::verdict::{SettleOptions, System, Verdict};
use core::f64::consts::TAU;
use core::fmt::Debug;
use thiserror::Error;

/// A pair this close, relative to the size of the motion, is not bisected further: its motions part long after this.
const NARROW: f64 = 1e-10;
/// A pair that is farther apart is bisected again: up to here its way is straight to the accuracy of a guess.
const WIDE: f64 = 1e-6;
/// A pair that is farther apart after a lap is between two sides of an event.
const BROKEN: f64 = 1e-3;
/// Parts of a lap by which such a pair is followed further.
const PARTS: u32 = 16;
/// The largest number of halvings of a way; 53 halve it down to neighbouring numbers.
const HALVINGS: u32 = 60;
/// A return that misses by less is a guess of a cycle.
const NEAR: f64 = 1e-3;
/// A cycle may be farther from a state than the state from its return, by this factor: the less, the nearer the multipliers are to 1.
const FAR: f64 = 100.0;
/// The most laps of a cycle that is looked for.
const LONGEST: u32 = 24;
/// States whose phases differ by less have the same phase.
const SAME_PHASE: f64 = 1e-9;
/// Motions that differ by less are the same.
const SAME: f64 = 1e-6;

/// A system on whose border between two motions a motion can be followed: an [`Oscillator`](crate::Oscillator) or a
/// [`Machine`](crate::machine::Machine).
pub trait Bordered: System {
    /// A state from which a motion starts.
    type Start: Clone + Debug + PartialEq;

    /// The time of a lap: the period of the forcing, or without forcing that of the slowest free oscillation.
    fn lap(&self) -> f64;

    /// The state a part of the way from one state to another. Phases are those of the first; both must have the same.
    fn between(&self, from: &Self::Start, to: &Self::Start, part: f64) -> Self::Start;

    /// The phase of a state.
    fn phase(&self, start: &Self::Start) -> f64;

    /// The state after a time, with the phase that the forcing has then; `None` if the motion is not known so far.
    fn after(&self, start: &Self::Start, at: (f64, f64)) -> Option<Self::Start>;

    /// The distance of two states of one phase, relative to their sizes; infinite where other stops are closed or other joints hold.
    fn distance(&self, one: &Self::Start, other: &Self::Start) -> f64;

    /// The verdict on the motion from a start, until `go_on` returns false.
    ///
    /// # Errors
    /// [`EdgeError::Refused`] for a start that is not allowed, and [`EdgeError::Stopped`].
    fn verdict(
        &self,
        start: &Self::Start,
        options: &SettleOptions,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Verdict<Self>, EdgeError>;

    /// The admissible cycles near the motion from a state: those of so many periods of the forcing, or without forcing those to
    /// which its returns to itself lead, and `laps` has no meaning.
    fn cycles_near(&self, start: &Self::Start, laps: u32) -> Vec<Self::Cycle>;

    /// Whether the system is forced, so that its cycles take whole laps.
    fn is_forced(&self) -> bool;

    /// Whether a motion on a cycle passes near a state, to within a distance relative to its size.
    fn passes(&self, cycle: &Self::Cycle, start: &Self::Start, distance: f64) -> bool;
}

/// How far the border is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeOptions {
    /// The most laps for which the motion on the border is followed; it is followed no further once the saddle is found.
    pub laps: u32,
    /// The budget of each verdict.
    pub settle: SettleOptions,
}

impl Default for EdgeOptions {
    /// 200 laps.
    fn default() -> Self {
        Self { laps: 200, settle: SettleOptions::default() }
    }
}

/// A state of the motion on the border.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgePoint<S: Bordered> {
    /// The time since the border was found between the two starts.
    pub time: f64,
    /// The state of the pair that leads to the first motion.
    pub state: S::Start,
    /// The distance of the pair, relative to the size of its states: the border passes between them.
    pub apart: f64,
}

/// The border between two starts, and the motion on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge<S: Bordered> {
    /// The motions on both sides of the border: that of the first start, and the one beyond the border. The latter is that of the
    /// second start, or a third motion if starts between the two lead to one.
    pub sides: [Verdict<S>; 2],
    /// Where the border crosses the way from the first start to the second: 0 at the first, 1 at the second.
    pub part: f64,
    /// The motion on the border, a point each lap; the first is at the border on the way between the two starts.
    pub track: Vec<EdgePoint<S>>,
    /// The periodic motion to which it leads; `None` if it does not come back close enough to itself within the laps, as a border that
    /// leads to a chaotic saddle, or if it leads to no cycle.
    pub saddle: Option<Verdict<S>>,
}

/// Why there is no border between two starts.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum EdgeError {
    /// Both lead to the same motion.
    #[error("both starts lead to the same motion, {0}: there is no border to find between them")]
    SameMotion(String),
    /// A start leads to no motion that is known.
    #[error("the motion from the {0} start is undecided, so it has no border; a larger budget may decide it")]
    Undecided(&'static str),
    /// The two starts have different phases.
    #[error("the starts have the phases {0} and {1}; both need the same one, because the way between them is straight")]
    Phases(f64, f64),
    /// A start is not allowed.
    #[error(transparent)]
    Refused(#[from] MachineError),
    /// `go_on` has returned false.
    #[error("the search was stopped")]
    Stopped,
}

/// The border between the motions to which two starts lead, the motion on it, and the saddle to which that leads.
///
/// ```
/// use vibroimpact::edge::{EdgeOptions, edge};
/// use vibroimpact::{Start, scenario, verdict::Stability};
/// let osc = scenario::S.oscillator();
/// let starts = [0.0, -2.0].map(|x| Start { x, v: 0.0, phase: 0.0 }); // they lead to 2/1 and to 1/1
/// let found = edge(&osc, &starts, &EdgeOptions::default())?;
/// let saddle = found.saddle.unwrap();
/// assert_eq!(saddle.stability(&osc), Some(Stability::Unstable));
/// # Ok::<(), vibroimpact::edge::EdgeError>(())
/// ```
///
/// # Errors
/// [`EdgeError`] if the starts have different phases, if both lead to the same motion, or one to none that is known.
pub fn edge<S: Bordered>(system: &S, starts: &[S::Start; 2], options: &EdgeOptions) -> Result<Edge<S>, EdgeError> {
    edge_while(system, starts, options, &|| true)
}

/// The same, but stopped when `go_on` returns false.
///
/// # Errors
/// The same, and [`EdgeError::Stopped`].
pub fn edge_while<S: Bordered>(
    system: &S,
    starts: &[S::Start; 2],
    options: &EdgeOptions,
    go_on: &dyn Fn() -> bool,
) -> Result<Edge<S>, EdgeError> {
    let phases = starts.each_ref().map(|start| system.phase(start));
    if phases[0] != phases[1] {
        return Err(EdgeError::Phases(phases[0], phases[1]));
    }
    let verdict = |start: &S::Start| system.verdict(start, &options.settle, go_on);
    let [first, other] = [verdict(&starts[0])?, verdict(&starts[1])?];
    for (name, of) in [("first", &first), ("second", &other)] {
        if matches!(of, Verdict::Undecided(_)) {
            return Err(EdgeError::Undecided(name));
        }
    }
    if first.same_as(&other, SAME) {
        return Err(EdgeError::SameMotion(first.label().into_owned()));
    }
    let mut search = Search { system, options, go_on, first, beyond: other };
    let (mut pair, part) = search.bisected(starts)?;
    let (mut track, mut time) = (Vec::new(), 0.0);
    let mut saddle = None;
    for lap in 0..=options.laps {
        let apart = system.distance(&pair[0], &pair[1]);
        track.push(EdgePoint { time, state: pair[0].clone(), apart });
        saddle = search.saddle(&track);
        if saddle.is_some() || lap == options.laps {
            break;
        }
        let Some((next, passed)) = search.later(&pair) else { break };
        (pair, time) = (next, time + passed);
        if system.distance(&pair[0], &pair[1]) > WIDE {
            pair = search.bisected(&pair)?.0;
        }
    }
    Ok(Edge { sides: [search.first, search.beyond], part, track, saddle: saddle.map(Verdict::Periodic) })
}

struct Search<'a, S: Bordered> {
    system: &'a S,
    options: &'a EdgeOptions,
    go_on: &'a dyn Fn() -> bool,
    /// The motion to which the first state of the pair leads, and that of the second.
    first: Verdict<S>,
    beyond: Verdict<S>,
}

impl<S: Bordered> Search<'_, S> {
    /// Halves the way between two states, of which the first leads to the first motion and the second does not, until they are
    /// close. Returns also the part of the way at which the first of them lies.
    fn bisected(&mut self, ends: &[S::Start; 2]) -> Result<([S::Start; 2], f64), EdgeError> {
        let [from, to] = ends;
        let (mut low, mut high) = (0.0, 1.0);
        let mut pair = [from.clone(), to.clone()];
        for _ in 0..HALVINGS {
            let part = 0.5 * (low + high);
            if self.system.distance(&pair[0], &pair[1]) <= NARROW || part <= low || part >= high {
                break;
            }
            let state = self.system.between(from, to, part);
            let verdict = self.system.verdict(&state, &self.options.settle, self.go_on)?;
            if verdict.same_as(&self.first, SAME) {
                (low, pair[0]) = (part, state);
            } else {
                (high, pair[1]) = (part, state);
                self.beyond = verdict;
            }
        }
        Ok((pair, low))
    }

    /// The pair a lap later, and the time that has passed. Where one of the two has struck a stop already and the other has not
    /// yet, they look far apart and the way between them is not near the border, so they are followed a little further.
    fn later(&self, pair: &[S::Start; 2]) -> Option<([S::Start; 2], f64)> {
        let mut nearest: Option<([S::Start; 2], f64, f64)> = None;
        for k in 0..PARTS {
            let part = f64::from(k) / f64::from(PARTS);
            let time = self.system.lap() * (1.0 + part);
            // one computation for both, so that they have one phase to the last bit; after a whole lap it is the same again
            let turned = if self.system.is_forced() { TAU * part } else { 0.0 };
            let at = (time, phase::wrap(self.system.phase(&pair[0]) + turned));
            let [Some(low), Some(high)] = pair.each_ref().map(|state| self.system.after(state, at)) else { continue };
            let apart = self.system.distance(&low, &high);
            if nearest.as_ref().is_none_or(|(.., least)| apart < *least) {
                nearest = Some(([low, high], time, apart));
            }
            if apart < BROKEN {
                break;
            }
        }
        nearest.map(|(pair, time, _)| (pair, time))
    }

    /// The cycle near the last state of the track, if that is near an earlier one.
    fn saddle(&self, track: &[EdgePoint<S>]) -> Option<S::Cycle> {
        let (last, before) = track.split_last()?;
        if !self.system.is_forced() {
            // a lap says nothing of the period: the motion itself is searched for returns, now and then because that takes long
            return track.len().is_power_of_two().then(|| self.cycle(&last.state, 0, NEAR)).flatten();
        }
        let phase = |point: &EdgePoint<S>| self.system.phase(&point.state);
        let at_phase = |point: &EdgePoint<S>| phase::difference(phase(point), phase(last)).abs() <= SAME_PHASE;
        let apart = |point: &EdgePoint<S>| self.system.distance(&point.state, &last.state);
        let earlier = before.iter().rev().zip(1..=LONGEST).filter(|(point, _)| at_phase(point));
        let returns = earlier.map(|(point, laps)| (laps, apart(point)));
        let mut near = returns.filter(|(_, apart)| *apart < NEAR);
        near.find_map(|(laps, apart)| self.cycle(&last.state, laps, FAR * apart.max(WIDE)))
    }

    /// The cycle of so many laps that passes a state to within a distance, if it is not the motion on a side of the border.
    fn cycle(&self, state: &S::Start, laps: u32, distance: f64) -> Option<S::Cycle> {
        self.system.cycles_near(state, laps).into_iter().find(|cycle| {
            let found = Verdict::Periodic(cycle.clone());
            let beside = [&self.first, &self.beyond].into_iter().any(|side| side.same_as(&found, SAME));
            // Newton's method may lead elsewhere
            !beside && self.system.passes(cycle, state, distance)
        })
    }
}
