//! The derivative of the state after a step by the state before it.
//!
//! An event at the zero of a guard $`h(z, t)`$ with the reset $`z_+ = R(z_-, t)`$ changes the derivative by
//!
//! $$`S = DR + \frac{(F_+ - DR\,F_- - R_t)\,h_z}{h_t + h_zF_-}`$$
//!
//! between the flows $`F_-`$ and $`F_+`$ before and after it (M. di Bernardo, C. J. Budd, A. R. Champneys and P. Kowalczyk,
//! *Piecewise-smooth Dynamical Systems*, Springer 2008, section 2.5, doi:10.1007/978-1-84628-708-4). A chatter that is
//! summed has the derivative of an impact without rebound.

use super::passage::Passage;
use super::place::{Place, Structures};
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::{Lu, Matrix, add_scaled, dot};
use crate::regime::{GuardKind, Normal, Structure};
use std::sync::Arc;

/// What the state of a machine consists of: mass-normalised coordinates, velocities, and the surfaces of damped stops that
/// open by force.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StateShape {
    pub(crate) n: usize,
    /// The stops whose surfaces can stand back.
    pub(crate) surfaces: Vec<usize>,
}

impl StateShape {
    pub(crate) fn of(machine: &Machine) -> Self {
        let back = |law: &StopLaw| matches!(law, StopLaw::Compliant { damping, opening: Opening::Force, .. } if *damping > 0.0);
        let stops = machine.stops().iter().enumerate();
        Self { n: machine.n(), surfaces: stops.filter(|(_, stop)| back(&stop.law)).map(|(j, _)| j).collect() }
    }

    /// The number of its components.
    pub(crate) fn size(&self) -> usize {
        2 * self.n + self.surfaces.len()
    }

    /// The components of a state.
    pub(crate) fn values(&self, place: &Place) -> Vec<f64> {
        let backs = self.surfaces.iter().map(|j| place.surfaces[*j].map_or(0.0, |surface| surface.size));
        place.x.iter().chain(&place.v).copied().chain(backs).collect()
    }

    /// The state with these components, in the same regime and at the same phase, between events.
    pub(crate) fn with_values(&self, place: &Place, values: &[f64]) -> Place {
        let mut other = Place { known: Vec::new(), gaps: Vec::new(), ..place.clone() };
        other.x.copy_from_slice(&values[..self.n]);
        other.v.copy_from_slice(&values[self.n..2 * self.n]);
        for (k, j) in self.surfaces.iter().enumerate() {
            if let Some(surface) = &mut other.surfaces[*j] {
                surface.size = values[2 * self.n + k];
            }
        }
        other
    }

    /// The derivative of the state a time `s` later in one regime by the state at `place`.
    pub(crate) fn transition(&self, structure: &Structure, normal: &Normal, place: &Place, s: f64) -> Matrix {
        let inner = structure.transition(normal, s);
        let mut whole = Matrix::zeros(self.size(), self.size());
        for i in 0..2 * self.n {
            whole.row_mut(i)[..2 * self.n].copy_from_slice(inner.row(i));
        }
        for (k, j) in self.surfaces.iter().enumerate() {
            let kept = place.surfaces[*j].map_or(0.0, |surface| crate::system::decay(surface.rate * s).0);
            whole[(2 * self.n + k, 2 * self.n + k)] = kept;
        }
        whole
    }

    /// The rate of the state at `place`, in the regime of `structure`.
    pub(crate) fn flow(&self, structure: &Arc<Structure>, normal: &Normal, place: &Place) -> Vec<f64> {
        let flight = place.flight(normal, structure.clone());
        let accelerations = structure.v.iter().map(|v| flight.first(v).1);
        let backs = self.surfaces.iter().map(|j| place.surfaces[*j].map_or(0.0, |of| -of.rate * of.size));
        place.v.iter().copied().chain(accelerations).chain(backs).collect()
    }
}

/// An event to first order.
#[derive(Clone, Debug)]
pub(crate) struct LinearEvent {
    /// The gradient of the guard before the event.
    pub(crate) gradient: Vec<f64>,
    /// The rate of the guard along the flow before the event.
    pub(crate) rate: f64,
    /// $`DR`$ and $`R_t`$.
    pub(crate) reset: Matrix,
    pub(crate) reset_rate: Vec<f64>,
    /// $`F_-`$ and $`F_+`$.
    pub(crate) flow_before: Vec<f64>,
    pub(crate) flow_after: Vec<f64>,
}

/// What happens at an event, apart from the states on both sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EventLaw<'a> {
    /// The structure before it, and the guard of it that is zero.
    pub(crate) structure: &'a Arc<Structure>,
    pub(crate) guard: usize,
    /// The rigid stops that push, with their restitution.
    pub(crate) pushed: &'a [(usize, f64)],
}

impl EventLaw<'_> {
    /// The value of the guard at a state.
    pub(crate) fn value(&self, normal: &Normal, at: &Place) -> f64 {
        self.value_and_rate(normal, at).0
    }

    /// The value of the guard at a state, and its rate along the flow there.
    pub(crate) fn value_and_rate(&self, normal: &Normal, at: &Place) -> (f64, f64) {
        let guard = &self.structure.guards[self.guard];
        let (value, rate) = at.flight(normal, self.structure.clone()).first(&guard.function);
        match guard.kind {
            GuardKind::Gap(j) => at.surfaces[j].map_or((value, rate), |surface| {
                (value + (surface.size - surface.offset), rate - surface.rate * surface.size)
            }),
            _ => (value, rate),
        }
    }

    /// The velocities after the event.
    pub(crate) fn rebound(&self, normal: &Normal, before: &Place) -> Option<Vec<f64>> {
        let mut after = before.v.clone();
        let turns = before.turns(normal);
        for (push, j) in pushes(normal, self.pushed)? {
            let rate = before.gap(normal, &turns, j).1;
            add_scaled(&mut after, rate, &push);
        }
        Some(after)
    }
}

/// What each stop that pushes adds to the velocities per unit of the rate of its gap: the columns of
/// $`WG^{-1}(1 + e)`$.
fn pushes(normal: &Normal, pushed: &[(usize, f64)]) -> Option<Vec<(Vec<f64>, usize)>> {
    let count = pushed.len();
    let w: Vec<&[f64]> = pushed.iter().map(|(j, _)| normal.directions[*j].as_slice()).collect();
    let gram = w.iter().flat_map(|a| w.iter().map(|b| dot(a, b))).collect();
    let lu = Lu::new(gram, count)?;
    Some(
        pushed
            .iter()
            .enumerate()
            .map(|(i, (j, e))| {
                let mut shares = vec![0.0; count];
                shares[i] = 1.0 + e;
                lu.solve(&mut shares);
                let mut push = vec![0.0; normal.n];
                for (w, share) in w.iter().zip(&shares) {
                    add_scaled(&mut push, *share, w);
                }
                (push, *j)
            })
            .collect(),
    )
}

impl LinearEvent {
    /// The event of a step; `None` if the step ends without one, or if the state after it is not consistent.
    pub(crate) fn of(
        shape: &StateShape,
        machine: &Machine,
        normal: &Normal,
        structures: &mut Structures,
        passage: &Passage,
    ) -> Option<Self> {
        let (before, after) = (passage.before.as_ref()?, passage.after.as_ref()?);
        let next = match &passage.rest {
            Some((rest, _)) => rest.clone(),
            None => structures.get(machine, normal, &after.states)?,
        };
        let law = EventLaw { structure: &passage.structure, guard: *passage.guards.first()?, pushed: &passage.pushed };
        Self::at(shape, normal, &law, before, (after, &next))
    }

    /// The event with this law between two states, the second one in the regime of `next`.
    pub(crate) fn at(
        shape: &StateShape,
        normal: &Normal,
        law: &EventLaw<'_>,
        before: &Place,
        (after, next): (&Place, &Arc<Structure>),
    ) -> Option<Self> {
        let guard = law.structure.guards.get(law.guard)?;
        let mut gradient = law.structure.gradient(normal, &guard.function);
        gradient.resize(shape.size(), 0.0);
        let (_, rate) = law.value_and_rate(normal, before);
        if let GuardKind::Gap(j) = guard.kind
            && before.surfaces[j].is_some()
            && let Some(k) = shape.surfaces.iter().position(|of| *of == j)
        {
            gradient[2 * shape.n + k] = 1.0;
        }
        let (reset, reset_rate) = reset(shape, normal, law.pushed, before, after)?;
        Some(Self {
            gradient,
            rate,
            reset,
            reset_rate,
            flow_before: shape.flow(law.structure, normal, before),
            flow_after: shape.flow(next, normal, after),
        })
    }

    /// $`F_+ - DR\,F_- - R_t`$: the change of the state after the event per unit of time by which the event is later.
    pub(crate) fn jump(&self) -> Vec<f64> {
        let carried = self.reset.apply(&self.flow_before);
        let after = self.flow_after.iter().zip(carried.iter().zip(&self.reset_rate));
        after.map(|(after, (carried, rate))| after - carried - rate).collect()
    }

    /// The derivative of the state after the event; `None` where the guard is only touched.
    pub(crate) fn saltation(&self) -> Option<Matrix> {
        if self.rate == 0.0 || !self.rate.is_finite() {
            return None;
        }
        let mut result = self.reset.clone();
        result.add_outer(1.0 / self.rate, &self.jump(), &self.gradient);
        Some(result)
    }
}

/// $`DR`$ and $`R_t`$.
fn reset(
    shape: &StateShape,
    normal: &Normal,
    pushed: &[(usize, f64)],
    before: &Place,
    after: &Place,
) -> Option<(Matrix, Vec<f64>)> {
    let (n, size) = (shape.n, shape.size());
    let turns = before.turns(normal);
    let mut reset = Matrix::identity(size);
    let mut rate = vec![0.0; size];
    if !pushed.is_empty() {
        // v+ = v + W G^-1 (1 + e) (wall' - W' v)
        for (push, j) in pushes(normal, pushed)? {
            let wall = normal.walls[j].derivative(&normal.rates).derivative(&normal.rates).swing(&turns);
            for row in 0..n {
                for (k, own) in normal.directions[j].iter().enumerate() {
                    reset[(n + row, n + k)] -= push[row] * own;
                }
                rate[n + row] += push[row] * wall;
            }
        }
    }
    for (k, j) in shape.surfaces.iter().enumerate() {
        let row = 2 * n + k;
        match (before.surfaces[*j], after.surfaces[*j]) {
            // it stands back by the depth at which the stop opened
            (None, Some(_)) => {
                reset.row_mut(row)[..n].copy_from_slice(&normal.directions[*j]);
                reset[(row, row)] = 0.0;
                rate[row] = -normal.walls[*j].derivative(&normal.rates).swing(&turns);
            }
            (_, None) => reset[(row, row)] = 0.0,
            _ => {}
        }
    }
    Some((reset, rate))
}

/// The derivative of the state at the end of a step by the state at `begin`, its beginning; `None` where a guard is only
/// touched.
pub(crate) fn step_derivative(
    shape: &StateShape,
    machine: &Machine,
    normal: &Normal,
    structures: &mut Structures,
    begin: &Place,
    passage: &Passage,
) -> Option<Matrix> {
    let flight = shape.transition(&passage.structure, normal, begin, passage.duration);
    if passage.guards.is_empty() {
        return Some(flight);
    }
    let event = LinearEvent::of(shape, machine, normal, structures, passage)?;
    let through = event.saltation()?.times(&flight);
    Some(match (&passage.rest, &passage.after) {
        (Some((rest, time)), Some(after)) => shape.transition(rest, normal, after, *time).times(&through),
        _ => through,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::{MachineLimits, MachineMotion, MachineStart};
    use crate::machine::MachineParts;

    /// The state a time `until` after the start, its derivative by the start, and the kinds of all events.
    fn flown(machine: &Machine, start: &MachineStart, until: f64) -> Option<(Vec<f64>, Matrix, Vec<Vec<usize>>)> {
        let shape = StateShape::of(machine);
        let mut motion = MachineMotion::new(machine, start, MachineLimits::default()).unwrap();
        let normal = motion.normal().clone();
        let mut structures = Structures::default();
        let mut derivative = Matrix::identity(shape.size());
        let mut kinds = Vec::new();
        loop {
            let begin = motion.place().clone();
            let now = motion.time();
            let passage = motion.step()?;
            if now + passage.time() > until {
                let left = until - now;
                assert!(left <= passage.duration);
                let flight = begin.flight(&normal, passage.structure.clone());
                let mut end = begin.clone();
                let mut modes = crate::arc::Modes::default();
                flight.at(left, &mut modes);
                end.move_along(&flight, (&modes, left), machine.parts().frequency);
                let last = shape.transition(&passage.structure, &normal, &begin, left);
                return Some((shape.values(&end), last.times(&derivative), kinds));
            }
            let own = step_derivative(&shape, machine, &normal, &mut structures, &begin, &passage)?;
            derivative = own.times(&derivative);
            kinds.push(passage.guards.clone());
        }
    }

    fn machine(case: u32) -> Machine {
        let mut parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.7)
            .with_link(&[1.0, -1.0], 1.3, 0.08)
            .with_link(&[0.0, 1.0], 0.6, 0.05)
            .with_frequency(0.9)
            .with_force(1, 1, 0.7, 0.9)
            .with_force(0, 2, 0.3, 0.0);
        let soft = |stiffness, damping, preload, opening| StopLaw::Compliant { stiffness, damping, preload, opening };
        parts = match case % 5 {
            0 => parts.with_rigid_stop("wall", &[1.0, 0.0], 0.4, 0.7),
            1 => parts.with_stop("pad", &[1.0, 0.0], 0.3, soft(15.0, 0.9, 0.0, Opening::Force)),
            2 => parts.with_stop("pad", &[1.0, -1.0], 0.2, soft(9.0, 0.4, 0.3, Opening::Position)),
            3 => parts.with_joint("floor", &[0.0, 1.0], 0.15, 0.25, 0.1),
            _ => parts.with_rigid_stop("wall", &[1.0, 0.0], 0.4, 0.0).with_rigid_stop("other", &[0.0, -1.0], 0.3, 0.5),
        };
        if let Some(stop) = parts.stops.first_mut() {
            stop.motion.push(crate::machine::HarmonicMotion { order: 1, cos: 0.05, sin: 0.02 });
        }
        Machine::new(parts).unwrap()
    }

    /// The derivative over many events against central differences, for every kind of event.
    #[test]
    fn differences() {
        let mut compared = 0;
        for case in 0..60_u32 {
            let machine = machine(case);
            let shift = f64::from(case);
            let start = |change: &[f64]| MachineStart {
                q: vec![0.1 - 0.002 * shift + change[0], -0.05 + change[1]],
                qdot: vec![0.01 * shift + change[2], 0.1 + change[3]],
                phase: 0.1 * shift,
            };
            let until = 3.0 + 0.21 * shift;
            let Some((_, derivative, kinds)) = flown(&machine, &start(&[0.0; 4]), until) else { continue };
            let normal = Normal::new(&machine);
            for j in 0..4 {
                // smaller than the last rebounds of a chatter
                let h = if case % 5 == 4 { 1e-9 } else { 1e-6 };
                let mut change = [0.0; 4];
                change[j] = h;
                let Some((plus, _, one)) = flown(&machine, &start(&change), until) else { continue };
                change[j] = -h;
                let Some((minus, _, two)) = flown(&machine, &start(&change), until) else { continue };
                if one != kinds || two != kinds {
                    continue;
                }
                let (mut x, mut v) = (vec![0.0; 2], vec![0.0; 2]);
                if j < 2 {
                    x[j] = 1.0;
                } else {
                    v[j - 2] = 1.0;
                }
                let mut direction = normal.to_normal(&x);
                direction.extend(normal.to_normal(&v));
                direction.resize(derivative.rows(), 0.0);
                let exact = derivative.apply(&direction);
                let scale = derivative.largest().max(1.0);
                for i in 0..exact.len() {
                    let difference = (plus[i] - minus[i]) / (2.0 * h);
                    assert!(
                        (difference - exact[i]).abs() < 3e-6 * scale * scale,
                        "case {case} {j} {i}: {difference} {} {kinds:?}",
                        exact[i]
                    );
                    compared += 1;
                }
            }
        }
        assert!(compared > 700, "{compared}");
    }

    /// A rigid impact changes the volume of states by the square of the restitution, damping by its trace.
    #[test]
    fn volumes() {
        let machine = machine(0);
        let start = MachineStart { q: vec![0.1, 0.0], qdot: vec![0.3, -0.2], phase: 0.4 };
        let shape = StateShape::of(&machine);
        let mut motion = MachineMotion::new(&machine, &start, MachineLimits::default()).unwrap();
        let normal = motion.normal().clone();
        let trace = normal.damping[(0, 0)] + normal.damping[(1, 1)];
        let mut structures = Structures::default();
        for _ in 0..200 {
            let begin = motion.place().clone();
            let passage = motion.step().unwrap();
            let own = step_derivative(&shape, &machine, &normal, &mut structures, &begin, &passage).unwrap();
            let found = Lu::new(own.values().to_vec(), own.rows()).map_or(0.0, |lu| lu.determinant().abs());
            let expected = if passage.rest.is_some() || !passage.structure.held.is_empty() {
                0.0
            } else {
                0.49 * (-trace * passage.duration).exp()
            };
            // an impact of a chatter is shorter than its own rounding allows
            assert!((found - expected).abs() < 1e-9 * (1.0 + expected / passage.duration), "{found} {expected}");
        }
    }
}
