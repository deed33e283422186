//! The problem that the tracer solves along a curve of a machine: its equations, and the test functions whose zeros are
//! points of codimension two or edges of the frame.

use super::beside::judge_beside;
use super::condition::{Condition, multipliers, pair};
use super::equations::CurveEquations;
use crate::continuation::curves::{CurveEvent, CurveKind};
use crate::continuation::equations::plane_tracer::PLANE_RULES;
use crate::continuation::machine::branches::{Judged, MachineEquations, judge, over_pairs};
use crate::continuation::trace::tracer::{Problem, Solution, StepRules};
use crate::machine::StopLaw;
use crate::math::{Matrix, Multiplier, dot};
use crate::orbit::{MachineFrame, MachineRing, machine::Neighbours};

/// A test function of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Watched {
    /// The distance of a number from an edge of the frame, in quarters of its range: which number, and whether it is the
    /// upper edge.
    Edge(usize, bool),
    /// Zero at a cusp.
    Bending,
    /// Half the sum of the pair on the unit circle, less this.
    Cosine(f64),
    /// Zero where another multiplier is +1,
    PlusOne,
    /// where another one is -1,
    MinusOne,
    /// or where the product of two others is 1.
    Pair,
    /// The second derivative of the gap at the touch, in units of the largest velocity and the frequency.
    Pull,
    /// The rate of the limit of a contact, in units of the size of its terms and the frequency.
    Release,
    /// The factor of the inverse of the speed in the trace of the derivative over one cycle with an impact instead of the
    /// touch.
    Trace,
}

/// The equations of a curve, what holds along it, and the test functions.
#[derive(Clone, Debug)]
pub(super) struct CurveProblem {
    pub(super) equations: CurveEquations,
    pub(super) kind: CurveKind,
    pub(super) watched: Vec<Watched>,
    /// The largest velocity.
    pub(super) speed: f64,
}

/// A solution on a curve.
pub(super) type CurveSolution = Solution<Judged>;

impl CurveProblem {
    pub(super) fn new(equations: CurveEquations, kind: CurveKind, (speed, rigid): (f64, bool)) -> Self {
        let mut watched =
            vec![Watched::Edge(0, false), Watched::Edge(0, true), Watched::Edge(1, false), Watched::Edge(1, true)];
        let others = [Watched::PlusOne, Watched::MinusOne, Watched::Pair];
        match kind {
            CurveKind::Fold => watched.extend([Watched::Bending].into_iter().chain(others)),
            CurveKind::Flip => watched.extend(others),
            CurveKind::Torus => {
                watched.extend([1.0, -1.0, -0.5, 0.0].map(Watched::Cosine));
                watched.extend([Watched::PlusOne, Watched::MinusOne]);
            }
            CurveKind::Grazing { .. } => {
                watched.extend([Watched::Pull].into_iter().chain(rigid.then_some(Watched::Trace)).chain(others));
            }
            CurveKind::Sticking { .. } | CurveKind::Holding { .. }
                if matches!(equations.condition, Condition::Limit { .. } | Condition::Chatter(_)) =>
            {
                watched.push(Watched::Release);
            }
            CurveKind::Corner { .. } | CurveKind::Sticking { .. } | CurveKind::Holding { .. } => {}
        }
        Self { equations, kind, watched, speed }
    }

    /// Adapts the condition to a solution.
    pub(super) fn renew(&mut self, w: &[f64]) {
        let renewed = self
            .equations
            .split(w)
            .and_then(|(machine, ring)| self.equations.condition.renewed(&MachineFrame::new(&machine), &ring));
        if let Some(condition) = renewed {
            self.equations.condition = condition;
        }
    }

    /// The same problem where a chatter has another number of impacts in the signature, and the solution there; `None` if
    /// its number fits.
    pub(super) fn adapted(&self, at: &CurveSolution) -> Option<(Self, Vec<f64>)> {
        let Condition::Chatter(chatter) = &self.equations.condition else { return None };
        let (machine, mut ring) = self.equations.split(&at.w)?;
        let chatter = chatter.adapted(&MachineFrame::new(&machine), &mut ring)?;
        let CurveEquations { events, ranges, .. } = &self.equations;
        let sizes = at.known.cycle.as_ref()?.sizes;
        let w = MachineEquations::join(&machine, &ring, MachineEquations::<2>::numbers(&at.w));
        let condition = Condition::Chatter(chatter);
        let events = MachineEquations::new((&machine, events.family.clone()), ring, sizes, events.scales);
        let equations = CurveEquations { events, ranges: ranges.clone(), condition };
        Some((Self { equations, ..self.clone() }, w))
    }

    /// Whether a stop is rigid and pushes back.
    pub(super) const fn rigid(law: &StopLaw) -> bool {
        matches!(law, StopLaw::Rigid { restitution } if *restitution > 0.0)
    }

    /// The multipliers that the condition does not determine.
    fn others(&self, all: &[Multiplier]) -> Vec<Multiplier> {
        let off = |to: f64| {
            let nearest = (0..all.len()).min_by(|i, j| {
                let distance = |k: usize| crate::math::hypot(all[k].re - to, all[k].im);
                distance(*i).total_cmp(&distance(*j))
            });
            nearest.into_iter().collect::<Vec<usize>>()
        };
        // the condition holds them where they are, so that a product with them would be zero on the whole curve
        let own = match &self.equations.condition {
            Condition::Singular { turn, .. } => off(*turn),
            Condition::Pair { cosine } => pair(all, *cosine).map_or_else(Vec::new, |((i, j), ..)| vec![i, j]),
            _ => Vec::new(),
        };
        (0..all.len()).filter(|k| !own.contains(k)).map(|k| all[k]).collect()
    }

    /// The value of a test function; `at` are the monodromy matrix and the multipliers.
    fn value(
        &self,
        what: Watched,
        (frame, ring): (&MachineFrame<'_>, &MachineRing),
        w: &[f64],
        at: &Option<(Matrix, Vec<Multiplier>)>,
    ) -> Option<f64> {
        let all = || at.as_ref().map(|(_, all)| all.as_slice());
        let product = |to: f64| {
            Some(self.others(all()?).iter().fold(1.0, |product, m| {
                // the factors of a pair are positive together
                let factor = if m.im == 0.0 { m.re - to } else { crate::math::hypot(m.re - to, m.im) };
                // so that a product of large multipliers stays finite
                product * factor.clamp(-1e3, 1e3)
            }))
        };
        match what {
            Watched::Edge(which, upper) => {
                let CurveEquations { events, ranges, .. } = &self.equations;
                let (value, scale) = (MachineEquations::<2>::numbers(w)[which], events.scales[which]);
                let range = if which == 0 { &ranges.0 } else { &ranges.1 };
                // positive within the frame
                Some(if upper { (range.end() - value) / scale } else { (value - range.start()) / scale })
            }
            Watched::Bending => self.equations.bending(w),
            Watched::Cosine(to) => match &self.equations.condition {
                Condition::Pair { cosine } => Some(pair(all()?, *cosine)?.2 - to),
                _ => None,
            },
            Watched::PlusOne => product(1.0),
            Watched::MinusOne => product(-1.0),
            Watched::Pair => {
                let (turn, all) = at.as_ref()?;
                Some(over_pairs(&self.others(all), ring.rounding(frame, turn)))
            }
            Watched::Pull => {
                let touch = self.equations.condition.touch()?;
                let CurveKind::Grazing { stop } = self.kind else { return None };
                let place = ring.place(touch);
                let structure = frame.structure(&place.states)?;
                let rate = structure.gap(&frame.normal, stop).1;
                let mut pull = place.unguarded_flight(&frame.normal, structure).first(&rate).1;
                // the second derivative of the surface, a kappa^2 e^{-kappa t}
                if let Some(surface) = place.surfaces[stop] {
                    pull += surface.rate * surface.rate * surface.size;
                }
                Some(pull / (frame.normal.length(stop) * self.speed * ring.frequency(frame.machine)))
            }
            Watched::Release => match &self.equations.condition {
                Condition::Limit { limit, size, .. } => {
                    Some(limit.of(frame, ring)?.rate / (size * ring.frequency(frame.machine)))
                }
                Condition::Chatter(chatter) => {
                    let frequency = ring.frequency(frame.machine);
                    Some(chatter.jerk(frame, ring)? / (self.speed * frequency * frequency))
                }
                _ => None,
            },
            Watched::Trace => {
                let touch = self.equations.condition.touch()?;
                let CurveKind::Grazing { stop } = self.kind else { return None };
                // what an impulse at the touch changes of the gap at the next touch
                let m = ring.len();
                let steps = (0..m).map(|i| ring.block(frame, (touch + i) % m)?.step);
                let direction = &frame.normal.directions[stop];
                let mut change = vec![0.0; frame.shape.size()];
                change[frame.shape.n..2 * frame.shape.n].copy_from_slice(direction);
                for step in steps {
                    change = step?.apply(&change);
                }
                let moved = dot(direction, &change[..frame.shape.n]);
                Some(moved * ring.frequency(frame.machine) / dot(direction, direction))
            }
        }
    }

    /// The event where a test function is zero, and whether the curve ends there; `None` for the edge of the frame.
    pub(super) fn event(&self, what: Watched) -> Option<(CurveEvent, bool)> {
        let stop = if let CurveKind::Grazing { stop } = self.kind { Some(stop) } else { None };
        let event = match (what, self.kind) {
            (Watched::Edge(..), _) => return None,
            (Watched::Bending, _) => CurveEvent::Cusp,
            // at a double multiplier of +1 or -1 a curve of tori ends; through the resonances 1:3 and 1:4 it goes on
            (Watched::Cosine(1.0), _) => return Some((CurveEvent::OneToOne, true)),
            (Watched::Cosine(-1.0), _) => return Some((CurveEvent::OneToTwo, true)),
            (Watched::Cosine(0.0), _) => CurveEvent::OneToFour,
            (Watched::Cosine(_), _) => CurveEvent::OneToThree,
            (Watched::PlusOne, CurveKind::Fold) => CurveEvent::OneToOne,
            (Watched::PlusOne, CurveKind::Torus) | (Watched::Pair, CurveKind::Fold) => CurveEvent::FoldTorus,
            (Watched::MinusOne, CurveKind::Flip) => CurveEvent::OneToTwo,
            (Watched::MinusOne, CurveKind::Torus) | (Watched::Pair, CurveKind::Flip) => CurveEvent::FlipTorus,
            (Watched::PlusOne, CurveKind::Grazing { .. }) => CurveEvent::FoldGrazing,
            (Watched::MinusOne, CurveKind::Grazing { .. }) => CurveEvent::FlipGrazing,
            (Watched::PlusOne | Watched::MinusOne, _) => CurveEvent::FoldFlip,
            (Watched::Pair, _) => CurveEvent::TorusGrazing,
            // beyond it the touch is no minimum of the gap
            (Watched::Pull, _) => return Some((CurveEvent::DegenerateGrazing { stop: stop? }, true)),
            (Watched::Release, CurveKind::Sticking { stop: place } | CurveKind::Holding { joint: place }) => {
                return Some((CurveEvent::DegenerateRest { place }, true));
            }
            (Watched::Release, _) => return None,
            (Watched::Trace, _) => CurveEvent::ResonantGrazing { stop: stop? },
        };
        Some((event, false))
    }
}

impl Problem for CurveProblem {
    type Known = Judged;
    type Equations = CurveEquations;

    fn equations(&self) -> &CurveEquations {
        &self.equations
    }

    fn rules(&self) -> StepRules {
        PLANE_RULES
    }

    fn tests(&self) -> usize {
        self.watched.len()
    }

    fn look(&self, w: &[f64], _tangent: &[f64]) -> Option<(Vec<f64>, Judged)> {
        let (machine, ring) = self.equations.split(w)?;
        let frame = MachineFrame::new(&machine);
        let at = multipliers(&frame, &ring);
        let values: Option<Vec<f64>> =
            self.watched.iter().map(|what| self.value(*what, (&frame, &ring), w, &at)).collect();
        let moments = self.equations.condition.moments(&frame, &ring);
        // every guard must fall to zero at its event
        let rising = (0..ring.len()).find_map(|k| {
            let event = (k + 1) % ring.len();
            let own = moments.iter().any(|moment| moment.has(event, ring.len()));
            (!own && ring.block(&frame, k).is_none_or(|block| block.late[0] >= 0.0)).then_some(event)
        });
        let neighbours = at.map_or_else(
            || Neighbours::new(Vec::new(), 0.0),
            |(turn, all)| Neighbours::new(all, ring.rounding(&frame, &turn)),
        );
        let judged = if moments.is_empty() {
            judge(&frame, &ring, (neighbours, rising))
        } else {
            judge_beside(&frame, &ring, &moments, (neighbours, rising))
        };
        Some((values?, judged))
    }

    fn test(&self, j: usize, w: &[f64], _tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64> {
        let (machine, ring) = self.equations.split(w)?;
        let frame = MachineFrame::new(&machine);
        // edges of the frame need no monodromy matrix
        let at = if matches!(self.watched[j], Watched::Edge(..)) { None } else { multipliers(&frame, &ring) };
        self.value(self.watched[j], (&frame, &ring), w, &at)
    }

    fn resolution(&self, _j: usize) -> f64 {
        RESOLUTION
    }

    fn phases(&self) -> usize {
        0
    }

    /// Adapts the condition to the solution. The weights stay with forcing.
    fn weigh(&mut self, w: &[f64]) -> bool {
        self.renew(w);
        self.equations.events.weigh(w)
    }
}

/// The resolution to which zeros of test functions are located along the step.
const RESOLUTION: f64 = 1e-13;
