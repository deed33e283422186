//! The derivative of the state after a step by the state before it.
//!
//! An event at the zero of a guard $`h(z, t)`$ with the reset $`z_+ = R(z_-, t)`$ changes the derivative by
//!
//! $$`S = DR + \frac{(F_+ - DR\,F_- - R_t)\,h_z}{h_t + h_zF_-}`$$
//!
//! between the flows $`F_-`$ and $`F_+`$ before and after it (M. di Bernardo, C. J. Budd, A. R. Champneys and P. Kowalczyk,
//! *Piecewise-smooth Dynamical Systems*, Springer 2008, section 2.5, doi:10.1007/978-1-84628-708-4).
//!
//! Where stops are at rest afterwards, at the end of a chatter that is summed or after an impact without rebound, the derivative is that
//! of the end. The impulses act along the directions of the stops that are at rest then, and take away what differs along these, from coordinates and velocities, whatever the order of impacts.
//! With the projections $`P_x`$ and $`P_v`$ on what is left, and the damping matrix C, the rest is
//!
//! $$`\delta x_+ = P_x\,\delta x_-, \qquad \delta v_+ = P_v\,(\delta v_- + C\,(1 - P_x)\,\delta x_-),`$$
//!
//! because what dampers take from velocities depends on the way only. The rates of the guards, which are rounding errors at the end of
//! a chatter, are not needed.
//!
//! Several guards that are zero at one time each change the state by a part of $`F_+ - DR\,F_- - R_t`$, and neighbours reach
//! each of them at a time of its own, so the second term is a sum over the guards. The parts are those of each guard alone.
//! If events do not act on each other, this is exact. If they do, as two stops under one rigid bar, neighbours that reach
//! them one after another can end anywhere, and the derivative is that of the motions which keep them together: what
//! is left over is divided equally among those that act on each other.

use super::passage::Passage;
use super::place::{Place, Structures};
use crate::arc::MachineFlight;
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::{Lu, Matrix, add_scaled, dot};
use crate::regime::{ContactState, GuardKind, Normal, Orthonormal, Structure};
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
        // known derivatives and digits of gaps belong to the other state
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
        // within a regime surfaces recover on their own: coordinates do not feel them, nor they the coordinates
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
        self.flow_in(&place.unguarded_flight(normal, structure.clone()), place)
    }

    /// The rate of the state at `place`, at which a flight begins.
    pub(crate) fn flow_in(&self, flight: &MachineFlight, place: &Place) -> Vec<f64> {
        let accelerations = flight.structure.v.iter().map(|v| flight.first(v).1);
        let backs = self.surfaces.iter().map(|j| place.surfaces[*j].map_or(0.0, |of| -of.rate * of.size));
        place.v.iter().copied().chain(accelerations).chain(backs).collect()
    }
}

/// A guard that is zero at an event, and its part of the change of the flow, to first order.
#[derive(Clone, Debug)]
pub(crate) struct LinearGuard {
    /// The gradient of the guard before the event.
    pub(crate) gradient: Vec<f64>,
    /// The rate of the guard along the flow before the event.
    pub(crate) rate: f64,
    /// Its part of $`F_+ - DR\,F_- - R_t`$: the change of the state after the event per unit of time by which it is later.
    jump: Vec<f64>,
}

/// An event to first order.
#[derive(Clone, Debug)]
pub(crate) struct LinearEvent {
    /// The guards that are zero.
    pub(crate) guards: Vec<LinearGuard>,
    /// $`DR`$ and $`R_t`$.
    pub(crate) reset: Matrix,
    pub(crate) reset_rate: Vec<f64>,
    /// $`F_-`$.
    pub(crate) flow_before: Vec<f64>,
}

/// What happens at an event, apart from the states on both sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EventLaw<'a> {
    /// The structure before it, and the guards of it that are zero; the first one times the event.
    pub(crate) structure: &'a Arc<Structure>,
    pub(crate) guards: &'a [usize],
    /// The rigid stops that push, with their restitution.
    pub(crate) pushed: &'a [(usize, f64)],
    /// The number of these in each round of impacts in turn; empty if all push together.
    pub(crate) rounds: &'a [usize],
}

impl EventLaw<'_> {
    /// The value of the guard at a state.
    pub(crate) fn value(&self, normal: &Normal, at: &Place) -> f64 {
        self.value_and_rate(normal, at).0
    }

    /// The value of the guard at a state, and its rate along the flow there.
    pub(crate) fn value_and_rate(&self, normal: &Normal, at: &Place) -> (f64, f64) {
        self.value_and_rate_of(self.guards[0], normal, at)
    }

    fn value_and_rate_of(&self, guard: usize, normal: &Normal, at: &Place) -> (f64, f64) {
        let guard = &self.structure.guards[guard];
        let (value, rate) = at.unguarded_flight(normal, self.structure.clone()).first(&guard.function);
        match guard.kind {
            // the surface stands between the wall and the coordinates, and its rate is part of the gap's
            GuardKind::Gap(j) => at.surfaces[j].map_or((value, rate), |surface| {
                (value + (surface.size - surface.offset), rate - surface.rate * surface.size)
            }),
            _ => (value, rate),
        }
    }

    /// The velocities after the event.
    pub(crate) fn rebound(&self, normal: &Normal, before: &Place) -> Option<Vec<f64>> {
        let mut after = before.clone();
        let turns = before.turns(normal);
        for round in self.in_rounds() {
            // a round of impacts begins with the velocities that the one before it left
            let rate = |j: usize| after.gap(normal, &turns, j).1;
            // all rates are read before any velocity changes: the impacts of a round are at once
            let pushes: Vec<(Vec<f64>, f64)> =
                pushes(normal, round)?.into_iter().map(|(push, j)| (push, rate(j))).collect();
            pushes.iter().for_each(|(push, rate)| add_scaled(&mut after.v, *rate, push));
        }
        Some(after.v)
    }

    /// The stops that push, round after round.
    pub(super) fn in_rounds(&self) -> impl Iterator<Item = &[(usize, f64)]> {
        let all = [self.pushed.len()];
        let counts = if self.rounds.is_empty() { all.to_vec() } else { self.rounds.to_vec() };
        let mut left = self.pushed;
        counts.into_iter().map(move |count| {
            let (round, others) = left.split_at(count.min(left.len()));
            left = others;
            round
        })
    }
}

/// What each stop that pushes adds to the velocities per unit of the rate of its gap: the columns of
/// $`WG^{-1}(1 + e)`$.
fn pushes(normal: &Normal, pushed: &[(usize, f64)]) -> Option<Vec<(Vec<f64>, usize)>> {
    let count = pushed.len();
    let w: Vec<&[f64]> = pushed.iter().map(|(j, _)| normal.directions[*j].as_slice()).collect();
    // G = W^T W
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
        let next = passage.beyond(after, machine, normal, structures)?;
        let law = EventLaw {
            structure: &passage.structure,
            guards: &passage.guards,
            pushed: &passage.pushed,
            rounds: &passage.rounds,
        };
        let mut structure = |states: &[ContactState]| structures.get(machine, normal, states);
        Self::at(shape, normal, &law, before, (after, &next), &mut structure)
    }

    /// The event with this law between two states, the second one in the regime of `next`. `structure` is that of other
    /// states of the contacts.
    pub(crate) fn at(
        shape: &StateShape,
        normal: &Normal,
        law: &EventLaw<'_>,
        before: &Place,
        (after, next): (&Place, &Arc<Structure>),
        structure: &mut dyn FnMut(&[ContactState]) -> Option<Arc<Structure>>,
    ) -> Option<Self> {
        let (reset, reset_rate) = law.reset(shape, normal, before, after)?;
        let flow_before = shape.flow(law.structure, normal, before);
        let jump = law.jump(shape, normal, (before, after), (&flow_before, next), (&reset, &reset_rate));
        // one guard has the whole change
        let jumps = if law.guards.len() < 2 {
            vec![jump]
        } else {
            law.shares(shape, normal, (before, after), (&flow_before, &jump), structure)?
        };
        let mut guards = Vec::with_capacity(law.guards.len());
        for (g, jump) in law.guards.iter().zip(jumps) {
            let guard = law.structure.guards.get(*g)?;
            let mut gradient = law.structure.gradient(normal, &guard.function);
            gradient.resize(shape.size(), 0.0);
            let (_, rate) = law.value_and_rate_of(*g, normal, before);
            // a surface that stands back adds to the gap of its stop
            if let GuardKind::Gap(j) = guard.kind
                && before.surfaces[j].is_some()
                && let Some(k) = shape.surfaces.iter().position(|of| *of == j)
            {
                gradient[2 * shape.n + k] = 1.0;
            }
            guards.push(LinearGuard { gradient, rate, jump });
        }
        Some(Self { guards, reset, reset_rate, flow_before })
    }

    /// The derivative of the state after the event; `None` where a guard is only touched.
    pub(crate) fn saltation(&self) -> Option<Matrix> {
        self.derivative().map(EventDerivative::matrix)
    }

    fn derivative(&self) -> Option<EventDerivative> {
        let late = |guard: &LinearGuard| {
            // the guard is only touched: neighbours miss it or not, and the derivative grows without bound
            let crosses = guard.rate != 0.0 && guard.rate.is_finite();
            crosses.then(|| (guard.jump.iter().map(|jump| jump / guard.rate).collect(), guard.gradient.clone()))
        };
        let late = self.guards.iter().map(late).collect::<Option<_>>()?;
        Some(EventDerivative { reset: self.reset.clone(), late })
    }
}

impl EventLaw<'_> {
    /// $`F_+ - DR\,F_- - R_t`$ between two states, of which the second is in the regime of `next`. Contacts push along their
    /// directions, and beside these only dampers feel that velocities have changed. So rounding errors of forces, divided by the
    /// speed of a slow impact, do not act on what the event does not reach.
    fn jump(
        &self,
        shape: &StateShape,
        normal: &Normal,
        (before, after): (&Place, &Place),
        (flow_before, next): (&[f64], &Arc<Structure>),
        (reset, reset_rate): (&Matrix, &[f64]),
    ) -> Vec<f64> {
        // DR F_-
        let carried = reset.apply(flow_before);
        let terms = carried.iter().zip(reset_rate);
        let mut jump: Vec<f64> = shape
            .flow(next, normal, after)
            .iter()
            .zip(terms)
            .map(|(after, (carried, rate))| after - carried - rate)
            .collect();
        let guards = self.guards.iter().map(|g| self.structure.guards[*g].kind.place(before.surfaces.len()));
        let changed = (0..before.states.len()).filter(|at| before.states[*at] != after.states[*at]);
        let held = self.structure.held.iter().chain(&next.held).copied();
        let acting = self.pushed.iter().map(|(j, _)| *j).chain(guards).chain(changed).chain(held);
        let along = Orthonormal::spanning(acting.map(|at| &normal.directions[at]));
        let faster: Vec<f64> = after.v.iter().zip(&before.v).map(|(after, before)| after - before).collect();
        let mut slowed = next.damped(normal, &faster);
        along.remove(&mut slowed);
        for part in [0..shape.n, shape.n..2 * shape.n] {
            let mut beside = jump[part.clone()].to_vec();
            along.remove(&mut beside);
            add_scaled(&mut jump[part], -1.0, &beside);
        }
        add_scaled(&mut jump[shape.n..2 * shape.n], -1.0, &slowed);
        jump
    }
}

/// A sum of terms of this size, or 0 if it is a rounding error of them: divided by the speed of an impact it would act on bodies that the
/// impact does not reach.
fn unless_rounding(sum: f64, size: f64) -> f64 {
    if sum.abs() <= ROUNDED * size { 0.0 } else { sum }
}

/// What is below this part of its terms is a rounding error.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

impl EventLaw<'_> {
    /// The parts of several guards of the change of the flow, whose sum is `jump_of_all`: what each of them does alone, and an
    /// equal part of the rest of those that act on each other.
    fn shares(
        &self,
        shape: &StateShape,
        normal: &Normal,
        states: (&Place, &Place),
        (flow_before, jump_of_all): (&[f64], &[f64]),
        structure: &mut dyn FnMut(&[ContactState]) -> Option<Arc<Structure>>,
    ) -> Option<Vec<Vec<f64>>> {
        let groups = self.groups(normal, states);
        let mut shares = vec![Vec::new(); self.guards.len()];
        // each guard as if the others were not zero
        for group in &groups {
            for k in &group.guards {
                shares[*k] = self.share(shape, normal, states, (flow_before, &[*k], group), structure)?;
            }
        }
        let mut left = jump_of_all.to_vec();
        let mut sizes: Vec<f64> = jump_of_all.iter().map(|jump| jump.abs()).collect();
        for group in &groups {
            // if all act on each other, the whole change is theirs; one alone has been computed
            let mut own = match &group.guards[..] {
                _ if groups.len() == 1 => left.clone(),
                [alone] => shares[*alone].clone(),
                several => self.share(shape, normal, states, (flow_before, several, group), structure)?,
            };
            // what no group explains is left for all
            if groups.len() > 1 {
                add_scaled(&mut left, -1.0, &own);
                sizes.iter_mut().zip(&own).for_each(|(size, own)| *size += own.abs());
            } else {
                left.fill(0.0);
            }
            // what the group does together beyond what its members do alone
            group.guards.iter().for_each(|k| add_scaled(&mut own, -1.0, &shares[*k]));
            let part = 1.0 / count(&group.guards);
            group.guards.iter().for_each(|k| add_scaled(&mut shares[*k], part, &own));
        }
        left.iter_mut().zip(sizes).for_each(|(left, size)| *left = unless_rounding(*left, size));
        let part = 1.0 / count(&shares);
        shares.iter_mut().for_each(|share| add_scaled(share, part, &left));
        Some(shares)
    }

    /// The change of the flow if only these guards of a group were zero.
    fn share(
        &self,
        shape: &StateShape,
        normal: &Normal,
        (before, after): (&Place, &Place),
        (flow_before, members, group): (&[f64], &[usize], &Group),
        structure: &mut dyn FnMut(&[ContactState]) -> Option<Arc<Structure>>,
    ) -> Option<Vec<f64>> {
        let stops = before.surfaces.len();
        let contact = |k: &usize| self.structure.guards[self.guards[*k]].kind.place(stops);
        let mut contacts: Vec<usize> = members.iter().map(contact).collect();
        let others: Vec<usize> =
            (0..self.guards.len()).map(|k| contact(&k)).filter(|j| !contacts.contains(j)).collect();
        // what else changes in the group, as a joint whose sliding an impact reverses, is changed by all its guards together
        if members.len() == group.guards.len() {
            contacts.clone_from(&group.contacts);
        }
        let guards: Vec<usize> = members.iter().map(|k| self.guards[*k]).collect();
        // an impulse of another guard would be that guard's part
        let of_round = |round: &[(usize, f64)]| {
            let own = |j: &usize| group.contacts.contains(j) && !others.contains(j);
            round.iter().copied().filter(|(j, _)| own(j)).collect::<Vec<(usize, f64)>>()
        };
        let rounds = self.in_rounds().map(of_round).filter(|round| !round.is_empty());
        let rounds: Vec<Vec<(usize, f64)>> = rounds.collect();
        let counts: Vec<usize> = rounds.iter().map(Vec::len).collect();
        let own = EventLaw {
            structure: self.structure,
            guards: &guards,
            pushed: &rounds.concat(),
            rounds: if self.rounds.is_empty() { &[] } else { &counts },
        };
        // the state that these guards alone would lead to: their impulses, their new contacts
        let mut reached = before.clone();
        reached.v = own.rebound(normal, before)?;
        for contact in contacts {
            reached.states[contact] = after.states[contact];
            if contact < stops {
                reached.surfaces[contact] = after.surfaces[contact];
            }
        }
        // with these contacts alone the machine has no regime; the whole change is then divided with the rest
        let Some(next) = structure(&reached.states) else { return Some(vec![0.0; flow_before.len()]) };
        let (reset, rate) = own.reset(shape, normal, before, &reached)?;
        Some(own.jump(shape, normal, (before, &reached), (flow_before, &next), (&reset, &rate)))
    }

    /// The guards that act on each other by impulses: their directions are not at right angles, or those of contacts between them
    /// that push, hold or change are not.
    fn groups(&self, normal: &Normal, (before, after): (&Place, &Place)) -> Vec<Group> {
        let stops = before.surfaces.len();
        let guards = self.guards.iter().map(|g| self.structure.guards[*g].kind.place(stops));
        let changed = (0..before.states.len()).filter(|at| before.states[*at] != after.states[*at]);
        let between = self.pushed.iter().map(|(j, _)| *j).chain(self.structure.held.iter().copied()).chain(changed);
        let contacts: Vec<usize> = guards.chain(between).collect();
        let act = |i: usize, j: usize| {
            let (a, b) = (&normal.directions[contacts[i]], &normal.directions[contacts[j]]);
            dot(a, b).abs() > ACTING * (dot(a, a) * dot(b, b)).sqrt()
        };
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for k in 0..contacts.len() {
            // a contact joins all groups it acts on, and makes them one
            let (with, mut others): (Vec<Vec<usize>>, Vec<Vec<usize>>) =
                groups.into_iter().partition(|group| group.iter().any(|other| act(*other, k)));
            others.push(with.into_iter().flatten().chain([k]).collect());
            groups = others;
        }
        let group = |of: Vec<usize>| Group {
            contacts: of.iter().map(|k| contacts[*k]).collect(),
            guards: of.into_iter().filter(|k| *k < self.guards.len()).collect(),
        };
        groups.into_iter().map(group).filter(|group| !group.guards.is_empty()).collect()
    }
}

/// Guards that act on each other.
struct Group {
    /// Their places in the list of guards.
    guards: Vec<usize>,
    /// Their contacts and those between them.
    contacts: Vec<usize>,
}

/// Directions act on each other if the cosine between them is larger.
const ACTING: f64 = 1e-12;

#[allow(clippy::cast_precision_loss)] // guards
fn count<T>(of: &[T]) -> f64 {
    of.len() as f64
}

impl EventLaw<'_> {
    /// $`DR`$ and $`R_t`$.
    fn reset(&self, shape: &StateShape, normal: &Normal, before: &Place, after: &Place) -> Option<(Matrix, Vec<f64>)> {
        let mut reset = Matrix::identity(shape.size());
        let mut rate = vec![0.0; shape.size()];
        let turns = before.turns(normal);
        // the rounds are composed: each acts on the derivative that the one before it left
        for round in self.in_rounds() {
            self.push_all(round, normal, &turns, (&mut reset, &mut rate))?;
        }
        back_surfaces(shape, normal, (before, after), &turns, (&mut reset, &mut rate));
        Some((reset, rate))
    }

    /// One round: $`v_+ = v + WG^{-1}(1 + e)(r' - W^Tv)`$.
    fn push_all(
        &self,
        round: &[(usize, f64)],
        normal: &Normal,
        turns: &[(f64, f64)],
        (reset, rate): (&mut Matrix, &mut [f64]),
    ) -> Option<()> {
        let n = normal.n;
        let pushes = pushes(normal, round)?;
        let along = |j: usize, reset: &Matrix, rate: &[f64]| {
            // the rate of the gap is (d - r)' - w v: its derivative by the state is minus `row`, by the time
            // `late`
            let wall = normal.walls[j].derivative(&normal.rates).derivative(&normal.rates).swing(turns);
            let mut row = vec![0.0; reset.columns()];
            let mut late = wall;
            for (k, own) in normal.directions[j].iter().enumerate() {
                add_scaled(&mut row, *own, reset.row(n + k));
                late -= own * rate[n + k];
            }
            (row, late)
        };
        // all rows before any changes, as in `rebound`
        let before: Vec<(Vec<f64>, f64)> = pushes.iter().map(|(_, j)| along(*j, reset, rate)).collect();
        for ((push, _), (row, late)) in pushes.iter().zip(before) {
            for (k, push) in push.iter().enumerate() {
                add_scaled(reset.row_mut(n + k), -push, &row);
                rate[n + k] += push * late;
            }
        }
        Some(())
    }
}

/// What an event does to the surfaces of stops that open by force.
fn back_surfaces(
    shape: &StateShape,
    normal: &Normal,
    (before, after): (&Place, &Place),
    turns: &[(f64, f64)],
    (reset, rate): (&mut Matrix, &mut [f64]),
) {
    let n = shape.n;
    for (k, j) in shape.surfaces.iter().enumerate() {
        let row = 2 * n + k;
        match (before.surfaces[*j], after.surfaces[*j]) {
            // it stands back by the depth at which the stop opened
            (None, Some(_)) => {
                reset.row_mut(row)[..n].copy_from_slice(&normal.directions[*j]);
                reset[(row, row)] = 0.0;
                rate[row] = -normal.walls[*j].derivative(&normal.rates).swing(turns);
            }
            // a stop that closes loses its surface
            (_, None) => reset[(row, row)] = 0.0,
            _ => {}
        }
    }
}

/// The derivative of the state after an event by that before it, $`DR + \sum_k u_kh_k'`$ in parts, because those of slow impacts are
/// many powers of ten larger than the others.
#[derive(Clone, Debug)]
pub(crate) struct EventDerivative {
    /// $`DR`$.
    pub(crate) reset: Matrix,
    /// The change of the state for a change of each guard, and the gradient of the guard.
    pub(crate) late: Vec<(Vec<f64>, Vec<f64>)>,
}

impl EventDerivative {
    /// That of the event at the end of a step; `None` where a guard is only touched.
    pub(super) fn of(
        shape: &StateShape,
        machine: &Machine,
        normal: &Normal,
        structures: &mut Structures,
        passage: &Passage,
    ) -> Option<Self> {
        let rest = passage.beyond(passage.after.as_ref()?, machine, normal, structures)?;
        let opened = passage.opened();
        if let Some(reset) = at_rest(shape, normal, passage, (&rest, &opened)) {
            if opened.is_empty() {
                return Some(Self { reset, late: Vec::new() });
            }
            let mut held = passage.after.as_ref()?.states.clone();
            opened.iter().for_each(|j| held[*j] = ContactState::Resting);
            let held = structures.get(machine, normal, &held)?;
            return Some(Self { reset, late: vec![late_opening(shape, normal, passage, (&held, &rest))?] });
        }
        LinearEvent::of(shape, machine, normal, structures, passage)?.derivative()
    }

    /// As one matrix.
    fn matrix(mut self) -> Matrix {
        self.late.iter().for_each(|(late, gradient)| self.reset.add_outer(1.0, late, gradient));
        self.reset
    }
}

/// The derivative of the state at rest, in the structure `rest`, by that before the impact after which stops are at rest: of a chatter
/// that was summed, after which the forces opened the stops `opened`, or of an impact without rebound. `None` if another guard is zero
/// too, if a contact ends, or after a single impact if another one changes.
fn at_rest(
    shape: &StateShape,
    normal: &Normal,
    passage: &Passage,
    (rest, opened): (&Structure, &[usize]),
) -> Option<Matrix> {
    let (before, after) = (passage.before.as_ref()?, passage.after.as_ref()?);
    let rests = |j: usize| after.states[j].constrains() && !before.states[j].constrains() || opened.contains(&j);
    let guard = |g: &usize| passage.structure.guards[*g].kind;
    // of stops at one place only one rests, and keeps the others closed
    let is_kept = |j: usize| {
        let held = rest.held.iter().chain(opened).map(|at| &normal.directions[*at]);
        Orthonormal::spanning(held).beside(&normal.directions[j]).is_none()
    };
    let lands = |g: &usize| matches!(guard(g), GuardKind::Gap(j) if rests(j) || is_kept(j));
    let zero = |at: usize| passage.guards.iter().any(|g| guard(g).place(before.surfaces.len()) == at);
    let stays = before.states.iter().zip(&after.states).enumerate().all(|(at, (was, now))| match passage.rest {
        Some(_) => now.constrains() || !was.constrains(),
        None => was == now || zero(at),
    });
    if !stays || !passage.guards.iter().all(lands) {
        return None;
    }
    // a joint that holds has lost its velocity, and keeps where it is
    let (stops, joints): (Vec<usize>, Vec<usize>) =
        rest.held.iter().chain(opened).partition(|at| **at < before.surfaces.len());
    let direction = |at: &usize| &normal.directions[*at];
    let holding = Orthonormal::spanning(joints.iter().map(direction));
    let beside: Vec<Vec<f64>> = stops.iter().filter_map(|at| holding.beside(direction(at))).collect();
    let resting = Orthonormal::spanning(beside.iter());
    let n = shape.n;
    let mut result = Matrix::identity(shape.size());
    for j in 0..n {
        let mut left = vec![0.0; n];
        left[j] = 1.0;
        let mut lost = left.clone();
        resting.remove(&mut left);
        add_scaled(&mut lost, -1.0, &left);
        let mut slowed = rest.damped(normal, &lost);
        let mut kept = left.clone();
        for velocity in [&mut slowed, &mut kept] {
            resting.remove(velocity);
            holding.remove(velocity);
        }
        for i in 0..n {
            result[(i, j)] = left[i];
            result[(n + i, j)] = slowed[i];
            result[(n + i, n + j)] = kept[i];
        }
    }
    let turns = before.turns(normal);
    back_surfaces(shape, normal, (before, after), &turns, (&mut result, &mut vec![0.0; shape.size()]));
    Some(result)
}

/// The change of the state for a change of the gap that was closed last, and the gradient of this gap, where the forces open stops at the
/// end of impacts that accumulate: until they end, these stops are as good as closed, in the structure `held`, and open after it.
fn late_opening(
    shape: &StateShape,
    normal: &Normal,
    passage: &Passage,
    (held, open): (&Arc<Structure>, &Arc<Structure>),
) -> Option<(Vec<f64>, Vec<f64>)> {
    let (before, after) = (passage.before.as_ref()?, passage.after.as_ref()?);
    let guard = passage.structure.guards.get(*passage.guards.first()?)?;
    let GuardKind::Gap(j) = guard.kind else { return None };
    let (_, rate) = before.gap_and_rate(normal, &before.turns(normal), j);
    let mut gradient = passage.structure.gradient(normal, &guard.function);
    gradient.resize(shape.size(), 0.0);
    // a change h of the gap ends them later by -h/rate
    let mut late = shape.flow(open, normal, after);
    add_scaled(&mut late, -1.0, &shape.flow(held, normal, after));
    late.iter_mut().for_each(|value| *value /= rate);
    Some((late, gradient))
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
    let through = EventDerivative::of(shape, machine, normal, structures, passage)?.matrix().times(&flight);
    Some(match (&passage.rest, &passage.after) {
        (Some((rest, time)), Some(after)) => shape.transition(rest, normal, after, *time).times(&through),
        _ => through,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::{EventKind, Limits, Motion, Start};
    use crate::machine::MachineParts;

    /// The state a time `until` after the start, its derivative by the start, and the kinds of all events.
    fn flown(machine: &Machine, start: &Start, until: f64) -> Option<(Vec<f64>, Matrix, Vec<Vec<usize>>)> {
        let shape = StateShape::of(machine);
        let mut motion = Motion::new(machine, start, Limits::default()).unwrap();
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

    /// Compares the derivative of the state at a time with central differences of a step, for all coordinates and velocities of a start.
    fn compare(machine: &Machine, start: impl Fn(&[f64]) -> Start, until: f64, (step, tolerance): (f64, f64)) {
        let n = machine.n();
        let at = |change: &[f64]| flown(machine, &start(change), until).unwrap();
        let (_, derivative, _) = at(&vec![0.0; 2 * n]);
        let normal = Normal::new(machine);
        for j in 0..2 * n {
            let mut change = vec![0.0; 2 * n];
            change[j] = step;
            let plus = at(&change).0;
            change[j] = -step;
            let minus = at(&change).0;
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j % n))).collect();
            let mut direction = vec![0.0; derivative.rows()];
            direction[j / n * n..(j / n + 1) * n].copy_from_slice(&normal.to_normal(&unit));
            let exact = derivative.apply(&direction);
            for i in 0..exact.len() {
                let difference = (plus[i] - minus[i]) / (2.0 * step);
                assert!((difference - exact[i]).abs() < tolerance, "{j} {i}: {difference} {}", exact[i]);
            }
        }
    }

    /// A body between two others that come together, of which one is pulled away when the impacts have accumulated: its stop opens
    /// at the end of the collapse, so when they end changes its velocity.
    #[test]
    fn a_collapse_at_whose_end_a_stop_opens() {
        let mut parts = MachineParts::new(["a", "b", "c"]).with_mass(0, 1.0).with_mass(1, 0.8).with_mass(2, 1.2);
        parts = parts.with_constant(0, 0.3).with_constant(2, 0.5);
        parts = parts.with_rigid_stop("left", &[1.0, -1.0, 0.0], 0.1, 0.04);
        let machine = Machine::new(parts.with_rigid_stop("right", &[0.0, 1.0, -1.0], 0.12, 0.04)).unwrap();
        let until = 0.4;
        let start = |change: &[f64]| Start {
            q: change[..3].to_vec(),
            qdot: vec![1.0 + change[3], change[4], change[5] - 0.9],
            ..Start::default()
        };
        let motion = Motion::new(&machine, &start(&[0.0; 6]), Limits::default()).unwrap();
        let events: Vec<EventKind> = motion.take_while(|event| event.time < until).map(|event| event.kind).collect();
        assert_eq!(events[events.len() - 2..], [EventKind::Collapse, EventKind::Release], "{events:?}");
        compare(&machine, start, until, (1e-5, 1e-9));
    }

    /// A body strikes a wall while another one presses on it through a damper, whose force becomes a pull with the impact: this contact
    /// ends at the time of the impact, however deep it is, and its surface stands back.
    #[test]
    fn an_impact_that_ends_a_contact() {
        let pad = StopLaw::Compliant { stiffness: 15.0, damping: 0.9, preload: 0.0, opening: Opening::Force };
        let parts = MachineParts::new(["a", "b"]).with_mass(0, 1.0).with_mass(1, 0.7).with_link(&[1.0, 0.0], 2.0, 0.1);
        let parts = parts.with_rigid_stop("wall", &[-1.0, 0.0], 0.2, 0.8).with_stop("pad", &[-1.0, 1.0], 0.05, pad);
        let machine = Machine::new(parts).unwrap();
        let start = |change: &[f64]| Start {
            q: change[..2].to_vec(),
            qdot: vec![change[2] - 1.0, change[3] - 0.5],
            ..Start::default()
        };
        let motion = Motion::new(&machine, &start(&[0.0; 4]), Limits::default()).unwrap();
        let events: Vec<_> = motion.take(3).map(|event| (event.kind, event.place)).collect();
        assert_eq!(events, [(EventKind::Close, 1), (EventKind::Impact, 0), (EventKind::Open, 1)]);
        assert_eq!(flown(&machine, &start(&[0.0; 4]), 0.25).unwrap().2.len(), 2);
        compare(&machine, start, 0.25, (1e-6, 1e-8));
    }

    /// The derivative over many events against central differences, for every kind of event.
    #[test]
    fn differences() {
        let mut compared = 0;
        for case in 0..60_u32 {
            let machine = machine(case);
            let shift = f64::from(case);
            let start = |change: &[f64]| Start {
                q: vec![0.1 - 0.002 * shift + change[0], -0.05 + change[1]],
                qdot: vec![0.01 * shift + change[2], 0.1 + change[3]],
                phase: 0.1 * shift,
                ..Start::default()
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
        let start = Start { q: vec![0.1, 0.0], qdot: vec![0.3, -0.2], phase: 0.4, ..Start::default() };
        let shape = StateShape::of(&machine);
        let mut motion = Motion::new(&machine, &start, Limits::default()).unwrap();
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
