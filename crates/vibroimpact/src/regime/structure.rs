//! The linear structure in one regime: its modes, what drives them, and its guards.

use super::basis::{Basis, inverse};
use super::contact_state::ContactState;
use super::mode::Mode;
use super::normal::{Normal, compliant};
use super::signal::{Observable, Signal};
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::{Matrix, add_scaled, dot};

/// What a guard is; the number is the place of the stop, or of the joint among the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GuardKind {
    /// The gap of an open stop.
    Gap(usize),
    /// The depth $`-g`$ of a closed compliant stop.
    Depth(usize),
    /// The force of a closed compliant stop that cannot pull.
    Force(usize),
    /// The reaction of a stop at rest.
    Reaction(usize),
    /// What is missing to the preload of a compliant stop at rest.
    Preload(usize),
    /// The relative velocity of a joint, in the direction in which it slides.
    Sliding(usize),
    /// What is missing to the limit of a joint that holds, against sliding forward and backward.
    LimitForward(usize),
    LimitBackward(usize),
}

/// A guard: a linear function of the state that is positive as long as the regime holds.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    pub(crate) kind: GuardKind,
    pub(crate) function: Observable,
}

/// The structure in one regime.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    pub(crate) states: Vec<ContactState>,
    pub(crate) modes: Vec<Mode>,
    /// Stiffness and damping of free directions that have no modes, because damping couples nearly defective ones. Then
    /// `modes` holds bounds, and the directions themselves stand in the place of modal displacements.
    pub(crate) dense: Option<(Matrix, Matrix)>,
    /// What drives each mode.
    pub(crate) drive: Vec<Signal>,
    /// $`z = \dot y - `$ this.
    pub(crate) slip: Vec<Signal>,
    /// Mass-normalised coordinates and velocities as functions of the modes.
    pub(crate) x: Vec<Observable>,
    pub(crate) v: Vec<Observable>,
    /// Modes from the mass-normalised state: $`y = A_1x + A_2\dot x + `$ a signal, and $`z`$ alike.
    to_y: [Matrix; 2],
    to_z: [Matrix; 2],
    to_y_signal: Vec<Signal>,
    to_z_signal: Vec<Signal>,
    pub(crate) guards: Vec<Guard>,
    /// The places of the constraints: stops and, after them, joints.
    pub(crate) held: Vec<usize>,
    /// Their reactions.
    pub(crate) reactions: Vec<Observable>,
    /// The impulse of each constraint that changes its own velocity by 1 and those of the others by nothing.
    pub(crate) across: Vec<Vec<f64>>,
    /// Acceleration per unit of reaction, and rate of the damping, along each of these.
    pub(crate) mobility: Vec<(f64, f64)>,
    pub(crate) rates: Vec<f64>,
    /// What is needed for the constant force on the modes at a given position.
    rest: RestForce,
}

/// The constant force on the modes at a position, from the force on the coordinates there.
#[derive(Clone, Debug)]
struct RestForce {
    stiffness: Matrix,
    /// Constant force on each coordinate, without contacts.
    force: Vec<f64>,
    free: Matrix,
    /// What the constraints carry along.
    carried: Vec<Signal>,
    /// The closed stops.
    contacts: Vec<RestContact>,
    /// $`B_2 + 2dA_2`$ and $`A_2`$.
    push: Matrix,
    drift: Matrix,
}

/// A closed stop: its place, stiffness, constant force at gap 0, direction, and direction in the free directions.
#[derive(Clone, Debug)]
struct RestContact {
    place: usize,
    stiffness: f64,
    force: f64,
    direction: Vec<f64>,
    share: Vec<f64>,
}

/// Why a regime has no modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoStructure {
    /// The constraints depend on each other.
    Redundant,
}

impl Structure {
    pub(crate) fn new(machine: &Machine, normal: &Normal, states: &[ContactState]) -> Result<Self, NoStructure> {
        let (n, stops, joints) = (normal.n, machine.stops().len(), machine.joints().len());
        let harmonics = normal.rates.len();
        let zero = || Signal::zero(joints, harmonics);
        let rates = &normal.rates;

        // forces of joints that slide
        let (stiffness, damping) = (&normal.stiffness, &normal.damping);
        let mut force = normal.force.clone();
        for (j, joint) in machine.joints().iter().enumerate() {
            let size = match states[stops + j] {
                ContactState::Forward => joint.sliding,
                ContactState::Backward => -joint.sliding,
                _ => continue,
            };
            for (signal, factor) in force.iter_mut().zip(&normal.directions[stops + j]) {
                signal.constant -= size * factor;
            }
        }
        // closed stops, the stiffest first: their directions become the first free ones, so that a large stiffness is
        // added to few elements and hides no digits of the others
        let mut closed: Vec<Contact<'_>> = (0..stops)
            .filter(|j| states[*j] == ContactState::Closed)
            .filter_map(|j| {
                let (k, c, p) = compliant(&machine.stops()[j].law)?;
                // -lambda = k (wall - w.x) + c (wall' - w.x') - p
                let mut pushed = zero();
                pushed.add(k, &normal.walls[j]);
                pushed.add(c, &normal.walls[j].derivative(rates));
                pushed.constant -= p;
                Some(Contact { place: j, k, c, p, pushed, direction: &normal.directions[j] })
            })
            .collect();
        let weight = |contact: &Contact<'_>| contact.k * dot(contact.direction, contact.direction);
        closed.sort_by(|one, other| weight(other).total_cmp(&weight(one)));

        // constraints w.x = wall(t), or the set point and the way of the belt: x = x_c(t) + N eta
        let held: Vec<usize> = (0..states.len()).filter(|place| states[*place].constrains()).collect();
        let directions: Vec<Vec<f64>> = held.iter().map(|place| normal.directions[*place].clone()).collect();
        let along: Vec<&[f64]> = closed.iter().map(|contact| contact.direction).collect();
        let (free, shares) = complement(&directions, &along, n).ok_or(NoStructure::Redundant)?;
        let mut gram = Matrix::zeros(held.len(), held.len());
        for (i, one) in directions.iter().enumerate() {
            for (j, other) in directions.iter().enumerate() {
                gram[(i, j)] = dot(one, other);
            }
        }
        let gram = inverse(&gram).ok_or(NoStructure::Redundant)?;
        let wanted: Vec<Signal> = held
            .iter()
            .map(|place| {
                if *place < stops {
                    return normal.walls[*place].clone();
                }
                let mut point = zero();
                point.set[*place - stops] = 1.0;
                point.ramp = machine.joints()[*place - stops].belt;
                point
            })
            .collect();
        // the columns of W G^-1
        let across: Vec<Vec<f64>> = (0..held.len())
            .map(|j| {
                let mut column = vec![0.0; n];
                for (i, direction) in directions.iter().enumerate() {
                    add_scaled(&mut column, gram[(i, j)], direction);
                }
                column
            })
            .collect();
        let mut carried: Vec<Signal> = (0..n).map(|_| zero()).collect();
        for (column, signal) in across.iter().zip(&wanted) {
            for (own, factor) in carried.iter_mut().zip(column) {
                own.add(*factor, signal);
            }
        }
        let carried_rate: Vec<Signal> = carried.iter().map(|signal| signal.derivative(rates)).collect();

        // the motion in the directions that are free
        let m = free.columns();
        let turned = |a: &Matrix| {
            let both = free.transposed().times(&a.times(&free));
            let mut even = both.clone();
            for i in 0..m {
                for j in 0..m {
                    even[(i, j)] = 0.5 * (both[(i, j)] + both[(j, i)]);
                }
            }
            even
        };
        let (mut own_stiffness, mut own_damping) = (turned(stiffness), turned(damping));
        let mut pull = force.clone();
        for i in 0..n {
            for j in 0..n {
                pull[i].add(-stiffness[(i, j)], &carried[j]);
                pull[i].add(-damping[(i, j)], &carried_rate[j]);
            }
        }
        let mut on_free: Vec<Signal> = (0..m).map(|_| zero()).collect();
        for (k, signal) in on_free.iter_mut().enumerate() {
            for (i, pulled) in pull.iter().enumerate() {
                signal.add(free[(i, k)], pulled);
            }
        }
        for (contact, share) in closed.iter().zip(&shares) {
            own_stiffness.add_outer(contact.k, share, share);
            own_damping.add_outer(contact.c, share, share);
            // without what the constraints carry along already
            let mut pushed = contact.pushed.clone();
            for (i, factor) in contact.direction.iter().enumerate() {
                pushed.add(-contact.k * factor, &carried[i]);
                pushed.add(-contact.c * factor, &carried_rate[i]);
            }
            for (signal, factor) in on_free.iter_mut().zip(share) {
                signal.add(*factor, &pushed);
            }
        }
        let basis = Basis::new(&own_stiffness, &own_damping);
        let dense = basis.is_none().then(|| (own_stiffness.clone(), own_damping.clone()));
        let basis = basis.unwrap_or_else(|| Basis::identity(&own_stiffness, &own_damping));
        let applied = |matrix: &Matrix, signals: &[Signal]| -> Vec<Signal> {
            (0..matrix.rows())
                .map(|i| {
                    let mut sum = zero();
                    for (factor, signal) in matrix.row(i).iter().zip(signals) {
                        sum.add(*factor, signal);
                    }
                    sum
                })
                .collect()
        };
        // y' = z + P1, z' = -k y - 2d z + P2, so y'' + 2d y' + k y = P2 + P1' + 2d P1
        let slip = applied(&basis.a[1], &on_free);
        let mut drive = applied(&basis.b[1], &on_free);
        for (i, signal) in drive.iter_mut().enumerate() {
            signal.add(1.0, &slip[i].derivative(rates));
            signal.add(2.0 * basis.modes[i].1, &slip[i]);
        }

        // x = x_c + N (E1 y + E2 (y' - P1)), and its velocity
        let state = |from: &[Matrix; 2], carried: &[Signal]| -> Vec<Observable> {
            let (one, two) = (free.times(&from[0]), free.times(&from[1]));
            let offset = applied(&two, &slip);
            (0..n)
                .map(|i| {
                    let mut signal = carried[i].clone();
                    signal.add(-1.0, &offset[i]);
                    Observable { position: one.row(i).to_vec(), velocity: two.row(i).to_vec(), signal }
                })
                .collect()
        };
        let x = state(&basis.e, &carried);
        let v = state(&basis.v, &carried_rate);
        // and back, with xi = N' x, because x_c is orthogonal to N
        let back = free.transposed();
        let to_y = [basis.a[0].times(&back), basis.a[1].times(&back)];
        let to_z = [basis.b[0].times(&back), basis.b[1].times(&back)];
        let offset = |maps: &[Matrix; 2]| -> Vec<Signal> {
            let mut sum = applied(&maps[0], &carried);
            for (own, other) in sum.iter_mut().zip(applied(&maps[1], &carried_rate)) {
                own.add(1.0, &other);
            }
            sum
        };
        let mut push = basis.b[1].clone();
        for (i, (_, d)) in basis.modes.iter().enumerate() {
            for j in 0..m {
                push[(i, j)] += 2.0 * d * basis.a[1][(i, j)];
            }
        }
        let rest = RestForce {
            stiffness: stiffness.clone(),
            force: (0..n)
                .map(|i| (0..n).fold(force[i].constant, |sum, j| sum - damping[(i, j)] * carried_rate[j].constant))
                .collect(),
            free: free.clone(),
            contacts: closed
                .iter()
                .zip(&shares)
                .map(|(contact, share)| {
                    let along = contact.direction.iter().zip(&carried_rate).map(|(w, rate)| w * rate.constant);
                    RestContact {
                        place: contact.place,
                        stiffness: contact.k,
                        force: -contact.p - contact.c * along.sum::<f64>(),
                        direction: contact.direction.to_vec(),
                        share: share.clone(),
                    }
                })
                .collect(),
            carried: carried.clone(),
            push,
            drift: basis.a[1].clone(),
        };
        let (to_y_signal, to_z_signal) = (offset(&to_y), offset(&to_z));

        // reactions: G^-1 (W' (F - K x - C x') - wanted'')
        let reactions: Vec<Observable> = across
            .iter()
            .enumerate()
            .map(|(j, column)| {
                let mut sum = Observable::zero(m, joints, harmonics);
                let (by_x, by_v) = (stiffness.apply(column), damping.apply(column));
                for contact in &closed {
                    // the force of a closed stop, k (wall - w.x) + ..., along the column
                    let share = dot(contact.direction, column);
                    if share.abs()
                        <= 1e-15 * dot(contact.direction, contact.direction).sqrt() * dot(column, column).sqrt()
                    {
                        continue;
                    }
                    sum.signal.add(share, &contact.pushed);
                    for (i, factor) in contact.direction.iter().enumerate() {
                        sum.add(-share * contact.k * factor, &x[i]);
                        sum.add(-share * contact.c * factor, &v[i]);
                    }
                }
                for i in 0..n {
                    sum.signal.add(column[i], &force[i]);
                    sum.add(-by_x[i], &x[i]);
                    sum.add(-by_v[i], &v[i]);
                }
                for (i, signal) in wanted.iter().enumerate() {
                    sum.signal.add(-gram[(j, i)], &signal.derivative(rates).derivative(rates));
                }
                sum
            })
            .collect();

        let modes: Vec<Mode> = basis.modes.iter().map(|(k, d)| Mode::new(*k, *d, rates)).collect();
        let mut structure = Self {
            states: states.to_vec(),
            modes,
            dense,
            drive,
            slip,
            x,
            v,
            to_y,
            to_z,
            to_y_signal,
            to_z_signal,
            guards: Vec::new(),
            held,
            reactions,
            mobility: across
                .iter()
                .enumerate()
                .map(|(j, column)| {
                    let contacts = closed.iter().map(|contact| {
                        let share = dot(contact.direction, column);
                        contact.c * share * share
                    });
                    let drag = dot(column, &damping.apply(column)) + contacts.sum::<f64>();
                    (1.0 / gram[(j, j)], drag / dot(column, column))
                })
                .collect(),
            across,
            rates: rates.clone(),
            rest,
        };
        structure.guards = structure.all_guards(machine, normal);
        Ok(structure)
    }

    /// $`w\cdot x`$ and its rate.
    fn along(&self, direction: &[f64]) -> (Observable, Observable) {
        let zero = || Observable {
            position: vec![0.0; self.modes.len()],
            velocity: vec![0.0; self.modes.len()],
            signal: Signal::zero(self.x.first().map_or(0, |x| x.signal.set.len()), self.rates.len()),
        };
        let (mut place, mut rate) = (zero(), zero());
        for (i, factor) in direction.iter().enumerate() {
            place.add(*factor, &self.x[i]);
            rate.add(*factor, &self.v[i]);
        }
        (place, rate)
    }

    /// The gap of a stop, and its rate.
    pub(crate) fn gap(&self, normal: &Normal, stop: usize) -> (Observable, Observable) {
        let (place, rate) = self.along(&normal.directions[stop]);
        let wall = &normal.walls[stop];
        let difference = |signal: &Signal, of: &Observable| {
            let mut gap = Observable::zero(self.modes.len(), signal.set.len(), signal.harmonics.len());
            gap.signal.add(1.0, signal);
            gap.add(-1.0, of);
            gap
        };
        (difference(wall, &place), difference(&wall.derivative(&self.rates), &rate))
    }

    /// The force of a closed compliant stop.
    pub(crate) fn force(&self, machine: &Machine, normal: &Normal, stop: usize) -> Option<Observable> {
        let (k, c, p) = compliant(&machine.stops()[stop].law)?;
        let (gap, rate) = self.gap(normal, stop);
        let mut force = Observable::zero(gap.position.len(), gap.signal.set.len(), gap.signal.harmonics.len());
        force.add(-k, &gap);
        force.add(-c, &rate);
        force.signal.constant += p;
        Some(force)
    }

    /// The relative velocity of a joint.
    pub(crate) fn sliding(&self, machine: &Machine, normal: &Normal, joint: usize) -> Observable {
        let (_, mut rate) = self.along(&normal.directions[machine.stops().len() + joint]);
        rate.signal.constant -= machine.joints()[joint].belt;
        rate
    }

    fn reaction(&self, place: usize) -> Option<&Observable> {
        self.held.iter().position(|held| *held == place).map(|at| &self.reactions[at])
    }

    fn all_guards(&self, machine: &Machine, normal: &Normal) -> Vec<Guard> {
        let mut guards = Vec::new();
        let mut add = |kind, function| guards.push(Guard { kind, function });
        let turned = |of: &Observable, factor: f64, constant: f64| {
            let mut sum = Observable::zero(of.position.len(), of.signal.set.len(), of.signal.harmonics.len());
            sum.add(factor, of);
            sum.signal.constant += constant;
            sum
        };
        for (j, stop) in machine.stops().iter().enumerate() {
            match (self.states[j], &stop.law) {
                (ContactState::Closed, StopLaw::Compliant { opening, damping, preload, .. }) => {
                    // without damper and preload both are zero together
                    if *opening == Opening::Position || *preload > 0.0 || *damping == 0.0 {
                        add(GuardKind::Depth(j), turned(&self.gap(normal, j).0, -1.0, 0.0));
                    }
                    if *opening == Opening::Force && (*damping > 0.0) {
                        add(
                            GuardKind::Force(j),
                            self.force(machine, normal, j).unwrap_or_else(|| turned(&self.x[0], 0.0, 1.0)),
                        );
                    }
                }
                (ContactState::Resting, law) => {
                    if let Some(reaction) = self.reaction(j) {
                        add(GuardKind::Reaction(j), reaction.clone());
                        if let StopLaw::Compliant { preload, .. } = law {
                            add(GuardKind::Preload(j), turned(reaction, -1.0, *preload));
                        }
                    }
                }
                _ => add(GuardKind::Gap(j), self.gap(normal, j).0),
            }
        }
        for (j, joint) in machine.joints().iter().enumerate() {
            let place = machine.stops().len() + j;
            match self.states[place] {
                ContactState::Forward => add(GuardKind::Sliding(j), self.sliding(machine, normal, j)),
                ContactState::Backward => {
                    add(GuardKind::Sliding(j), turned(&self.sliding(machine, normal, j), -1.0, 0.0));
                }
                _ => {
                    if let Some(reaction) = self.reaction(place) {
                        // a positive force holds it against sliding forward
                        add(GuardKind::LimitForward(j), turned(reaction, -1.0, joint.limit));
                        add(GuardKind::LimitBackward(j), turned(reaction, 1.0, joint.limit));
                    }
                }
            }
        }
        guards
    }

    /// The constant force on each mode at the position `x`, less that of its own stiffness there: the force that remains if
    /// modal displacements are counted from there. `gap` is the gap of a closed stop with its wall at its mean place. The
    /// difference is formed in the coordinates, where nothing cancels: a stiff stop at gap 0 pushes with exactly nothing.
    ///
    /// `turns` are sine and cosine of the harmonics there. Harmonics of walls and of what they carry along are counted from
    /// their mean, as they are in what drives the modes.
    pub(crate) fn rest_force(
        &self,
        x: &[f64],
        v: &[f64],
        turns: &[(f64, f64)],
        gap: impl Fn(usize) -> f64,
    ) -> Vec<f64> {
        let rest = &self.rest;
        let swing = |signal: &Signal| {
            signal.harmonics.iter().zip(turns).map(|((a, b), (sin, cos))| a * cos + b * sin).sum::<f64>()
        };
        let swung: Vec<f64> = rest.carried.iter().map(swing).collect();
        let mean: Vec<f64> = x.iter().zip(&swung).map(|(x, swung)| x - swung).collect();
        let pulled = rest.stiffness.apply(&mean);
        let left: Vec<f64> = rest.force.iter().zip(&pulled).map(|(force, pulled)| force - pulled).collect();
        let mut on_free = rest.free.apply_transposed(&left);
        for contact in &rest.contacts {
            let gap = gap(contact.place) + dot(&contact.direction, &swung);
            add_scaled(&mut on_free, contact.stiffness * gap + contact.force, &contact.share);
        }
        let mut push = rest.push.apply(&on_free);
        if self.dense.is_none() {
            let drift = rest.drift.apply(&rest.free.apply_transposed(v));
            for (i, mode) in self.modes.iter().enumerate() {
                // and the rate of a ramp in $`P_1`$
                push[i] += self.slip[i].ramp - mode.k * drift[i];
            }
        }
        push
    }

    /// The modal state from the mass-normalised one at the beginning of a flight; `at` is the value of a signal there.
    pub(crate) fn modal(&self, x: &[f64], v: &[f64], at: impl Fn(&Signal) -> f64) -> (Vec<f64>, Vec<f64>) {
        let of = |maps: &[Matrix; 2], signals: &[Signal]| -> Vec<f64> {
            (0..self.modes.len()).map(|i| dot(maps[0].row(i), x) + dot(maps[1].row(i), v) - at(&signals[i])).collect()
        };
        let y = of(&self.to_y, &self.to_y_signal);
        let z = of(&self.to_z, &self.to_z_signal);
        let rate = z.iter().zip(&self.slip).map(|(z, slip)| z + at(slip)).collect();
        (y, rate)
    }
}

/// A closed stop.
struct Contact<'a> {
    place: usize,
    k: f64,
    c: f64,
    p: f64,
    /// Its force on the direction at x = 0.
    pushed: Signal,
    direction: &'a [f64],
}

/// An orthonormal basis of what is orthogonal to all directions `held`, as columns, the first of them along the
/// directions `along`; and the components of these directions in it, with exact zeros. `None` if the directions `held`
/// depend on each other.
fn complement(held: &[Vec<f64>], along: &[&[f64]], n: usize) -> Option<(Matrix, Vec<Vec<f64>>)> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(n);
    // twice, so that the result is orthogonal to rounding
    let project = |basis: &[Vec<f64>], vector: &mut Vec<f64>| {
        for _ in 0..2 {
            for known in basis {
                let part = dot(known, vector);
                add_scaled(vector, -part, known);
            }
        }
        dot(vector, vector).sqrt()
    };
    let unit = |vector: &[f64], size: f64| -> Vec<f64> { vector.iter().map(|x| x / size).collect() };
    for direction in held {
        let mut vector = unit(direction, dot(direction, direction).sqrt());
        let rest = project(&basis, &mut vector);
        if rest < 1e-9 {
            return None;
        }
        basis.push(unit(&vector, rest));
    }
    let first = basis.len();
    let mut reached = Vec::with_capacity(along.len());
    for direction in along {
        let size = dot(direction, direction).sqrt();
        let mut vector = unit(direction, size);
        let rest = project(&basis, &mut vector);
        if rest > 1e-12 && basis.len() < n {
            basis.push(unit(&vector, rest));
        }
        reached.push(basis.len());
    }
    let mut left: Vec<usize> = (0..n).collect();
    while basis.len() < n {
        // the unit vector that is farthest from what is spanned already
        let mut best = (0.0, 0, Vec::new());
        for (place, i) in left.iter().enumerate() {
            let mut vector = vec![0.0; n];
            vector[*i] = 1.0;
            let rest = project(&basis, &mut vector);
            if rest > best.0 * (1.0 + 1e-9) {
                best = (rest, place, vector);
            }
        }
        left.remove(best.1);
        basis.push(unit(&best.2, best.0));
    }
    let mut columns = Matrix::zeros(n, n - first);
    for (j, vector) in basis[first..].iter().enumerate() {
        for (i, x) in vector.iter().enumerate() {
            columns[(i, j)] = *x;
        }
    }
    let share = |direction: &[f64], end: usize| {
        let mut share = vec![0.0; n - first];
        for (value, vector) in share.iter_mut().zip(&basis[first..end]) {
            *value = dot(direction, vector);
        }
        share
    };
    let shares = along.iter().zip(reached).map(|(direction, end)| share(direction, end)).collect();
    Some((columns, shares))
}
