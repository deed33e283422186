//! The equations of a cycle of a machine with numbers of it among the unknowns: one along a branch, two along a curve.

use super::family::Family;
use crate::continuation::trace::equations::Equations;
use crate::events::StateShape;
use crate::machine::{Machine, RateGrid};
use crate::math::Lu;
use crate::orbit::{MachineFrame, MachineRing};
use core::f64::consts::TAU;

/// The equations of the cycles with the signature of a ring. The unknowns are phases and states of the events and, last, N
/// numbers of the machine.
#[derive(Clone, Debug)]
pub(crate) struct MachineEquations<const N: usize = 1> {
    pub(crate) family: Family<N>,
    /// The signature, with the unknowns with which the equations were made.
    pub(crate) ring: MachineRing,
    weights: Vec<f64>,
    /// Changes of the numbers that have the same length as a change of all phases by one radian.
    pub(crate) scales: [f64; N],
    grid: RateGrid,
}

impl<const N: usize> MachineEquations<N> {
    /// The equations for the signature of `ring`; `sizes` are the largest coordinates and velocities.
    pub(crate) fn new(
        (machine, family): (&Machine, Family<N>),
        ring: MachineRing,
        sizes: (f64, f64),
        scales: [f64; N],
    ) -> Self {
        let mut weights = weights(machine, &ring, sizes);
        weights.extend(scales.map(|scale| 1.0 / (scale * scale)));
        Self { family, ring, weights, scales, grid: RateGrid::default() }
    }

    /// The vector of unknowns of a ring and values of the numbers.
    pub(crate) fn join(machine: &Machine, ring: &MachineRing, numbers: [f64; N]) -> Vec<f64> {
        let mut w = ring.unknowns(&StateShape::of(machine));
        w.extend(numbers);
        w
    }

    /// The values of the numbers.
    pub(crate) fn numbers(w: &[f64]) -> [f64; N] {
        w.last_chunk().copied().unwrap_or([f64::NAN; N])
    }

    /// The machine and the ring that belong to these unknowns; `None` if the numbers are not allowed.
    pub(crate) fn split(&self, w: &[f64]) -> Option<(Machine, MachineRing)> {
        let (unknowns, numbers) = w.split_last_chunk()?;
        let machine = self.family.machine(*numbers)?;
        let ring = self.ring.with(&machine, unknowns);
        Some((machine, ring))
    }

    /// Adapts the weights of the unknowns of the events to the period: without forcing a change of all times by a part of the
    /// period has the same length for each period. Returns whether there is no forcing.
    pub(crate) fn weigh(&mut self, w: &[f64]) -> bool {
        if self.ring.periods > 0 {
            return false;
        }
        let count = self.weights.len() - N;
        #[allow(clippy::cast_precision_loss)] // a few dozen
        let m = self.ring.len() as f64;
        // the first unknown is the period, with another sign
        let radian = w[0] / TAU;
        let width = count / self.ring.len();
        self.weights[..count].iter_mut().step_by(width).for_each(|weight| *weight = 1.0 / (m * radian * radian));
        true
    }

    /// The residuals of the events of `ring`, whose unknowns are the first of `w`, and their derivatives in rows as long as `w`,
    /// followed by N rows of zeros.
    pub(crate) fn linearised(
        &self,
        frame: &MachineFrame<'_>,
        ring: &MachineRing,
        w: &[f64],
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        let rates = self.family.rates(Self::numbers(w), self.scales, &self.grid)?;
        let (blocks, slopes) = ring.with_numbers(frame, &rates)?;
        let length = w.len();
        let mut rows = vec![0.0; length * length];
        ring.fill(&mut rows, length, &blocks, 1.0);
        let miss = Self::stood_back(frame, ring, w, blocks.into_iter().map(|block| block.miss));
        for (k, slopes) in slopes.into_iter().enumerate() {
            for (row, slope) in slopes.into_iter().enumerate() {
                rows[row * length + length - N + k] = slope;
            }
        }
        Some((miss, rows))
    }

    /// The residuals alone.
    pub(crate) fn misses(&self, frame: &MachineFrame<'_>, ring: &MachineRing, w: &[f64]) -> Option<Vec<f64>> {
        let misses: Vec<Vec<f64>> = (0..ring.len()).map(|k| ring.miss(frame, k)).collect::<Option<_>>()?;
        Some(Self::stood_back(frame, ring, w, misses.into_iter()))
    }

    /// The residuals of the events of `ring`, with those of surfaces that do not stand back: their sizes are 0.
    fn stood_back(
        frame: &MachineFrame<'_>,
        ring: &MachineRing,
        w: &[f64],
        misses: impl Iterator<Item = Vec<f64>>,
    ) -> Vec<f64> {
        let mut miss: Vec<f64> = misses.flatten().collect();
        let (m, shape) = (ring.len(), &frame.shape);
        let width = shape.size() + 1;
        for (k, event) in ring.events.iter().enumerate() {
            for (s, _) in shape.surfaces.iter().enumerate().filter(|(_, j)| !event.back[**j]) {
                let place = 1 + 2 * shape.n + s;
                miss[((k + m - 1) % m) * width + place] -= w[k * width + place];
            }
        }
        miss
    }
}

/// The weights of the unknowns of a ring, for the largest coordinates and velocities `sizes`.
fn weights(machine: &Machine, ring: &MachineRing, sizes: (f64, f64)) -> Vec<f64> {
    #[allow(clippy::cast_precision_loss)] // a few dozen
    let m = ring.len() as f64;
    let width = StateShape::of(machine).size() + 1;
    let n = machine.n();
    let weight = |i: usize| {
        let size = match i {
            0 => 1.0,
            i if i <= n => sizes.0,
            i if i <= 2 * n => sizes.1,
            _ => sizes.0,
        };
        1.0 / (m * size * size).max(f64::MIN_POSITIVE)
    };
    (0..ring.len() * width).map(|i| weight(i % width)).collect()
}

impl<const N: usize> Equations for MachineEquations<N> {
    const SLOW: bool = true;

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    // the units of a machine are those of the user
    fn factors(&self, rows: Vec<f64>) -> Option<Lu> {
        let units: Vec<f64> = self.weights.iter().map(|weight| 1.0 / weight.sqrt()).collect();
        let (states, width) = (units.len() - N, (units.len() - N) / self.ring.len());
        // an event has a row for its guard and one for each component of the state after it
        Lu::balanced(rows, &units, |row| (row < states && row % width != 0).then(|| units[row]))
    }

    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let (machine, ring) = self.split(w)?;
        self.linearised(&MachineFrame::new(&machine), &ring, w)
    }

    fn residuals(&self, w: &[f64]) -> Option<Vec<f64>> {
        let (machine, ring) = self.split(w)?;
        self.misses(&MachineFrame::new(&machine), &ring, w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::continuation::trace::equations::correct;
    use crate::events::{Motion, Start};
    use crate::machine::{HarmonicMotion, MachineParts, Opening, StopLaw};
    use crate::orbit::machine::Cycle;
    use crate::orbit::near_returns;
    use crate::verdict::Count;

    fn machine(soft: bool) -> Machine {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.8)
            .with_link(&[1.0, -1.0], 1.1, 0.12)
            .with_link(&[0.0, 1.0], 0.9, 0.1)
            .with_frequency(0.8)
            .with_force(1, 1, 0.0, 0.9);
        let law = StopLaw::Compliant { stiffness: 20.0, damping: 0.6, preload: 0.0, opening: Opening::Force };
        Machine::new(if soft {
            parts.with_stop("stop", &[1.0, 0.0], 0.5, law)
        } else {
            parts.with_rigid_stop("stop", &[1.0, 0.0], 0.5, 0.6)
        })
        .unwrap()
    }

    /// Without forcing: the first mass is on a belt.
    fn on_belt() -> Machine {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.4)
            .with_link(&[1.0, 0.0], 1.0, 0.01)
            .with_link(&[1.0, -1.0], 0.7, 0.05)
            .with_rigid_stop("stop", &[0.0, 1.0], 0.65, 0.9)
            .with_joint("belt", &[1.0, 0.0], 0.3, 0.6, 0.15);
        Machine::new(parts).unwrap()
    }

    /// The events after which a motion is near its cycle.
    const SETTLED: usize = 2000;
    /// The forcing periods of a cycle are a part of these.
    const PERIODS: u32 = 12;

    /// The cycle near the motion from a start.
    fn settled(frame: &MachineFrame<'_>) -> Cycle {
        let mut motion = Motion::new(frame.machine, &Start::default(), frame.limits()).unwrap();
        for _ in 0..SETTLED {
            motion.step().unwrap();
            motion.take_events();
        }
        if frame.machine.period().is_some() {
            return Cycle::near(frame, motion.place(), PERIODS).unwrap();
        }
        let returns = near_returns(frame, motion, Count::Finite(1));
        returns.into_iter().find_map(|(place, time)| Cycle::returning(frame, &place, time)).unwrap()
    }

    fn misses(ring: &MachineRing, frame: &MachineFrame<'_>) -> Vec<f64> {
        (0..ring.len()).flat_map(|k| ring.miss(frame, k).unwrap()).collect()
    }

    /// The Jacobian against differences of the residuals, and Newton's method from a distant guess.
    #[test]
    fn derivatives_and_convergence() {
        for (machine, gap) in [(machine(false), 0.5), (machine(true), 0.5), (on_belt(), 0.65)] {
            let frame = MachineFrame::new(&machine);
            let cycle = settled(&frame);
            let ring = MachineRing::of(&frame, &cycle.strobes[0], (cycle.label.periods, cycle.period)).unwrap();
            let (family, _) = Family::of_path(&machine, "stop.stop.gap").unwrap();
            let equations = MachineEquations::new((&machine, family), ring.clone(), cycle.sizes, [0.5]);
            let w = MachineEquations::join(&machine, &ring, [gap]);
            let (miss, rows) = equations.at(&w).unwrap();
            assert!(miss.iter().all(|miss| miss.abs() < 1e-12), "{miss:?}");
            let length = w.len();
            for j in 0..length {
                let at = |h: f64| {
                    let mut other = w.clone();
                    other[j] += h;
                    let (machine, ring) = equations.split(&other).unwrap();
                    misses(&ring, &MachineFrame::new(&machine))
                };
                let (plus, minus) = (at(1e-5), at(-1e-5));
                for i in 0..length - 1 {
                    let difference = (plus[i] - minus[i]) / 2e-5;
                    let exact = rows[i * length + j];
                    // the size of a surface that does not stand back is 0, which `at` alone adds
                    let width = frame.shape.size() + 1;
                    if j < length - 1 && j % width > 4 && !ring.events[j / width].back[0] {
                        continue;
                    }
                    assert!((difference - exact).abs() < 1e-7 * (1.0 + exact.abs()), "{i} {j}: {difference} {exact}");
                }
            }
            // the same cycle from a guess beside it
            let guess: Vec<f64> = w.iter().enumerate().map(|(i, w)| w + 1e-3 * (1.3 * i as f64).sin()).collect();
            let mut row = vec![0.0; length];
            row[length - 1] = 1.0;
            let (found, _) = correct(&equations, &guess, &row, gap).unwrap();
            assert!(found.iter().zip(&w).all(|(a, b)| (a - b).abs() < 1e-11), "{found:?} {w:?}");
        }
    }

    /// Machines whose cycles have events of all kinds: rests and holds, stops that open by force and by position, with preload,
    /// that move, impacts at one time, a translation, coupled damping and masses.
    fn machines() -> Vec<Machine> {
        let soft = |stiffness, damping, preload, opening| StopLaw::Compliant { stiffness, damping, preload, opening };
        let moving = |mut parts: MachineParts| {
            for stop in &mut parts.stops {
                stop.motion.push(HarmonicMotion { order: 2, cos: 0.03, sin: -0.02 });
            }
            Machine::new(parts).unwrap()
        };
        let pair = || {
            let mut parts = MachineParts::new(["a", "b"])
                .with_mass(0, 1.0)
                .with_mass(1, 0.8)
                .with_link(&[1.0, -1.0], 1.1, 0.12)
                .with_link(&[0.0, 1.0], 0.9, 0.1)
                .with_frequency(0.8)
                .with_force(1, 1, 0.0, 0.9)
                .with_force(0, 2, 0.1, 0.0);
            (parts.mass[(0, 1)], parts.mass[(1, 0)]) = (0.1, 0.1);
            parts.constant[0] = 0.05;
            parts
        };
        let mut ball = MachineParts::new(["ball"])
            .with_mass(0, 1.0)
            .with_frequency(1.0)
            .with_constant(0, -1.0)
            .with_rigid_stop("table", &[-1.0], 0.0, 0.3);
        ball.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: -1.6 });
        // nothing holds them
        let free = MachineParts::new(["frame", "ball"])
            .with_mass(0, 2.0)
            .with_mass(1, 0.5)
            .with_link(&[1.0, 0.0], 0.0, 0.3)
            .with_link(&[0.0, 1.0], 0.0, 0.1)
            .with_constant(0, 0.05)
            .with_frequency(1.3)
            .with_force(0, 1, 0.0, 3.0)
            .with_rigid_stop("right", &[-1.0, 1.0], 0.3, 0.6)
            .with_rigid_stop("left", &[1.0, -1.0], 0.3, 0.6);
        vec![
            machine(false),
            machine(true),
            on_belt(),
            moving(pair().with_rigid_stop("wall", &[1.0, 0.0], 0.4, 0.6).with_rigid_stop(
                "other",
                &[-1.0, 0.2],
                0.5,
                0.3,
            )),
            moving(pair().with_stop("pad", &[1.0, -0.3], 0.3, soft(9.0, 0.7, 0.2, Opening::Position))),
            moving(pair().with_stop("pad", &[1.0, 0.0], 0.3, soft(20.0, 1.5, 0.1, Opening::Force))),
            moving(pair().with_rigid_stop("wall", &[1.0, 0.0], 0.1, 0.0)),
            moving(pair().with_rigid_stop("wall", &[1.0, 0.0], 0.4, 0.6).with_joint(
                "floor",
                &[0.0, 1.0],
                0.35,
                0.5,
                0.0,
            )),
            Machine::new(ball).unwrap(),
            Machine::new(free).unwrap(),
        ]
    }

    /// The derivatives of the residuals by each number of a machine against differences of machines with other numbers.
    #[test]
    fn derivatives_by_every_number() {
        let (mut kinds, mut compared) = (std::collections::BTreeSet::new(), 0);
        for (place, machine) in machines().into_iter().enumerate() {
            let frame = MachineFrame::new(&machine);
            let cycle = settled(&frame);
            let ring = MachineRing::of(&frame, &cycle.strobes[0], (cycle.label.periods, cycle.period)).unwrap();
            kinds.extend(
                ring.events.iter().map(|event| format!("{:?}", event.guard).split('(').next().unwrap().to_owned()),
            );
            let unknowns = ring.unknowns(&StateShape::of(&machine));
            let mut paths: Vec<String> = machine.numbers().into_iter().map(|(path, _)| path).collect();
            let names = &machine.parts().coordinates;
            if let [one, other] = names.as_slice() {
                paths.extend(["mass", "damping", "stiffness"].map(|matrix| format!("{matrix}.{one}.{other}")));
            }
            for name in names {
                paths.extend(machine.stops().iter().map(|stop| format!("stop.{}.direction.{name}", stop.name)));
                paths.extend(machine.joints().iter().map(|joint| format!("friction.{}.direction.{name}", joint.name)));
            }
            for path in paths {
                let value = machine.number(&path).unwrap();
                let (family, _) = Family::of_path(&machine, &path).unwrap();
                // without springs another stiffness is not allowed
                let Some(rates) = family.rates([value], [1.0], &RateGrid::default()) else { continue };
                let exact = ring.with_numbers(&frame, &rates[..1]).unwrap().1.remove(0);
                let at = |h: f64| {
                    let machine = family.at(value + h)?;
                    Some(misses(&ring.with(&machine, &unknowns), &MachineFrame::new(&machine)))
                };
                let h = 1e-4;
                let all = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
                let [Some(a), Some(b), Some(c), Some(d)] = all else { continue };
                for (i, exact) in exact.iter().enumerate() {
                    let difference = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
                    let close = (difference - exact).abs() < 2e-9 * (1.0 + exact.abs());
                    assert!(close, "{place} {path} {i}: {exact} is not {difference}");
                    compared += 1;
                }
            }
        }
        println!("{kinds:?} {compared}");
        assert!(compared > 2000, "{compared}");
    }
}
