//! The problem that the tracer solves along a branch of a machine: its equations, and the test functions of its
//! bifurcations. Whether a solution is admissible is decided by following the motion over one period.

use super::closest::Leg;
use super::equations::MachineEquations;
use super::matched::matched;
use super::test_functions::{TestFunction, clearance, pole_sign, rate};
use crate::continuation::branches::{COARSE, RULES};
use crate::continuation::trace::tracer::{Problem, Solution, StepRules};
use crate::math::{Lu, Matrix, Multiplier, general_eigenvalues};
use crate::orbit::{
    MachineBlock, MachineFrame, MachineLap, MachineRing, RingEvent, events_of, machine::Cycle, machine::Neighbours,
};
use core::cell::OnceCell;

/// The equations of a branch with the range of the number, and the test functions of its events.
#[derive(Clone, Debug)]
pub(crate) struct MachineProblem {
    pub(crate) equations: MachineEquations,
    pub(crate) tests: Vec<TestFunction>,
    pub(crate) range: (f64, f64),
    /// The largest coordinates and velocities.
    sizes: (f64, f64),
}

/// What is known of a solution apart from its unknowns.
#[derive(Clone, Debug)]
pub(crate) struct Judged {
    /// The cycle, if the solution is admissible.
    pub(crate) cycle: Option<Cycle>,
    pub(crate) multipliers: Vec<Multiplier>,
    /// The events that the motion has, beginning with the one after event `from` of the ring.
    pub(crate) seen: Vec<RingEvent>,
    pub(crate) from: usize,
    /// An event of the ring whose guard does not fall, so that it does not happen.
    pub(crate) rising: Option<usize>,
}

impl Judged {
    pub(crate) fn physical(&self) -> bool {
        self.cycle.is_some()
    }
}

/// A solution on a branch.
pub(crate) type MachineSolution = Solution<Judged>;

/// The test functions of bifurcations, by place.
pub(crate) const PACE: usize = 0;
pub(crate) const PLUS_ONE: usize = 1;
pub(crate) const MINUS_ONE: usize = 2;
pub(crate) const TORUS: usize = 3;

/// A motion with the same events that misses its beginning by more than this is another one.
pub(crate) const CLOSED: f64 = 1e-5;

/// The most steps of a motion that is compared with a signature: so many, and so many times the events of the signature.
const MANY: usize = 1000;
const MORE: usize = 20;

/// The determinant of a matrix with `shift` added on its diagonal.
fn shifted_determinant(matrix: &Matrix, shift: f64) -> f64 {
    let mut other = matrix.clone();
    for i in 0..other.rows() {
        other[(i, i)] += shift;
    }
    Lu::new(other.values().to_vec(), other.rows()).map_or(0.0, |lu| lu.determinant())
}

/// The product over all pairs of multipliers of their product less 1: it changes its sign where a product of two is 1.
/// Without losses the multipliers are pairs whose product is 1 everywhere, and the sign of the computed difference is that of
/// its rounding error; so a pair whose product is 1 to within `rounding`, the error of the multipliers, is left out.
pub(crate) fn over_pairs(multipliers: &[Multiplier], rounding: f64) -> f64 {
    let mut torus = 1.0;
    for (i, a) in multipliers.iter().enumerate() {
        for b in &multipliers[i + 1..] {
            let (re, im) = (a.re * b.re - a.im * b.im - 1.0, a.re * b.im + a.im * b.re);
            if crate::math::hypot(re, im) <= rounding * (a.modulus() + b.modulus()) {
                continue;
            }
            // two factors that are conjugate are positive together
            let conjugate = a.im != 0.0 && b.im != 0.0 && !(a.re == b.re && a.im == -b.im);
            let factor = if im == 0.0 && !conjugate { re } else { crate::math::hypot(re, im) };
            torus *= factor.clamp(-1e3, 1e3);
        }
    }
    torus
}

impl MachineProblem {
    /// The problem of these equations; `sizes` are the largest coordinates and velocities.
    pub(crate) fn new(
        frame: &MachineFrame<'_>,
        equations: MachineEquations,
        range: (f64, f64),
        sizes: (f64, f64),
    ) -> Self {
        let tests = TestFunction::all(frame, &equations.ring);
        Self { equations, tests, range, sizes }
    }

    /// The values of the test functions of bifurcations without the first, and the multipliers; `None` where an event is only a touch.
    fn bifurcations(
        frame: &MachineFrame<'_>,
        ring: &MachineRing,
        blocks: &[MachineBlock],
    ) -> Option<([f64; 3], Neighbours)> {
        let turn = ring.monodromy(frame, blocks)?;
        let mut multipliers = general_eigenvalues(&turn)?;
        let even = if turn.rows().is_multiple_of(2) { 1.0 } else { -1.0 };
        let rounding = ring.rounding(frame, &turn);
        let torus = over_pairs(&multipliers, rounding);
        let sign = pole_sign(frame.machine, ring, blocks);
        let plus_one = even * sign * shifted_determinant(&turn, -1.0);
        multipliers.truncate(frame.multipliers());
        let minus_one = sign * shifted_determinant(&turn, 1.0);
        Some(([plus_one, minus_one, torus], Neighbours::new(multipliers, rounding)))
    }

    /// What is known of a solution, and what `with` makes of its frame, ring and blocks and of the test functions of bifurcations without
    /// the first.
    fn judged<T>(
        &self,
        w: &[f64],
        with: impl FnOnce(&MachineFrame<'_>, &MachineRing, &[MachineBlock], [f64; 3]) -> T,
    ) -> Option<(T, Judged)> {
        let (machine, ring) = self.equations.split(w)?;
        let frame = MachineFrame::new(&machine);
        let blocks = ring.blocks(&frame)?;
        // every guard must fall to zero at its event
        let rising = blocks.iter().position(|block| block.late[0] >= 0.0).map(|k| (k + 1) % ring.len());
        let (tests, neighbours) = Self::bifurcations(&frame, &ring, &blocks)?;
        Some((with(&frame, &ring, &blocks, tests), judge(&frame, &ring, (neighbours, rising))))
    }

    /// The component of a tangent along the number.
    fn pace(&self, tangent: &[f64]) -> f64 {
        tangent.last().map_or(0.0, |last| last / self.equations.scales[0])
    }
}

/// The events of a motion, with the phases since its beginning.
pub(crate) fn seen_on(lap: &MachineLap, frequency: f64) -> Vec<(f64, RingEvent)> {
    events_of(lap).into_iter().map(|(time, event, _)| (frequency * time, event)).collect()
}

/// The motion from the middle of the longest flight over one period, and the cycle if its events are those of the
/// ring.
pub(crate) fn judge(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (neighbours, rising): (Neighbours, Option<usize>),
) -> Judged {
    let multipliers = neighbours.multipliers.clone();
    let flown = || {
        let (from, begin) = ring.middle(frame)?;
        // a motion with many more events has others
        let lap = MachineLap::replay_in(frame, &begin, ring.period(frame), MANY + MORE * ring.len())?;
        Some((from, begin, lap))
    };
    let Some((from, begin, lap)) = flown() else {
        return Judged { cycle: None, multipliers, seen: Vec::new(), from: 0, rising };
    };
    let m = ring.len();
    let middle = 0.5 * (ring.theta(from) + ring.theta(from + 1));
    let wanted: Vec<(f64, &RingEvent)> =
        (1..=m).map(|i| (ring.theta(from + i) - middle, &ring.events[(from + i) % m])).collect();
    let seen = matched(&wanted, &seen_on(&lap, ring.frequency(frame.machine)));
    let alike = seen.len() == m && (0..m).all(|i| seen[i] == ring.events[(from + 1 + i) % m]);
    let residual = frame.distance(&begin, &lap.end, lap.sizes);
    let cycle = (alike && rising.is_none() && residual < CLOSED)
        .then(|| Cycle::beside(frame, (&begin, ring.periods), &lap, (residual, vec![begin.clone()]), neighbours));
    Judged { cycle, multipliers, seen, from, rising }
}

impl Problem for MachineProblem {
    type Known = Judged;
    type Equations = MachineEquations;

    fn equations(&self) -> &MachineEquations {
        &self.equations
    }

    fn rules(&self) -> StepRules {
        RULES
    }

    fn tests(&self) -> usize {
        self.tests.len()
    }

    fn look(&self, w: &[f64], tangent: &[f64]) -> Option<(Vec<f64>, Judged)> {
        self.judged(w, |frame, ring, blocks, [plus_one, minus_one, torus]| {
            let m = ring.len();
            let mut legs: Vec<OnceCell<Option<Leg<'_>>>> = Vec::new();
            legs.resize_with(m, OnceCell::new);
            let value = |test: &TestFunction| match *test {
                TestFunction::Pace => self.pace(tangent),
                TestFunction::PlusOne => plus_one,
                TestFunction::MinusOne => minus_one,
                TestFunction::Torus => torus,
                TestFunction::Rate(k) => rate(frame, ring, (k, &blocks[(k + m - 1) % m]), self.sizes.1),
                TestFunction::Clearance(leg, guard) => {
                    let leg = legs[leg].get_or_init(|| Leg::new(frame, ring, leg)).as_ref();
                    clearance(frame, leg, guard, self.sizes)
                }
            };
            self.tests.iter().map(value).collect()
        })
    }

    fn known(&self, w: &[f64]) -> Option<Judged> {
        self.judged(w, |_, _, _, _| ()).map(|((), judged)| judged)
    }

    fn test(&self, j: usize, w: &[f64], tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64> {
        let test = self.tests[j];
        if test == TestFunction::Pace {
            return Some(self.pace(&tangent()?));
        }
        let (machine, ring) = self.equations.split(w)?;
        let frame = MachineFrame::new(&machine);
        let m = ring.len();
        match test {
            TestFunction::Rate(k) => {
                Some(rate(&frame, &ring, (k, &ring.block(&frame, (k + m - 1) % m)?), self.sizes.1))
            }
            TestFunction::Clearance(leg, guard) => {
                Some(clearance(&frame, Leg::new(&frame, &ring, leg).as_ref(), guard, self.sizes))
            }
            _ => Some(Self::bifurcations(&frame, &ring, &ring.blocks(&frame)?)?.0[j - PLUS_ONE]),
        }
    }

    fn resolution(&self, j: usize) -> f64 {
        if j == PACE { COARSE } else { 1e-13 }
    }

    fn phases(&self) -> usize {
        0
    }

    fn range(&self) -> Option<(f64, f64)> {
        Some(self.range)
    }

    fn weigh(&mut self, w: &[f64]) -> bool {
        self.equations.weigh(w)
    }
}
