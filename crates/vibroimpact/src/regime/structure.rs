//! The linear structure in one regime: its modes, what drives them, and its guards.

use super::basis::{Basis, inverse};
use super::closed_stop::{ClosedStop, less_motion};
use super::complement::{complement, independent};
use super::contact_state::ContactState;
use super::mode::Mode;
use super::normal::{Normal, compliant};
use super::pass::Moved;
use super::refined::refined;
use super::rest_force::{RestBuffers, RestContact, RestForce};
use super::sampled::Sampled;
use super::signal::{Observable, Signal};
use super::window::{Window, windows};
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::{Matrix, add_scaled, dot, sort_by, sort_by_key};
use std::sync::OnceLock;

/// A gap that changes by less than this part of the motion along its direction does not change.
const STILL: f64 = 1e-12;

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

impl GuardKind {
    /// The stop of a guard, or the joint, counted after the stops.
    pub(crate) const fn place(self, stops: usize) -> usize {
        match self {
            Self::Gap(j) | Self::Depth(j) | Self::Force(j) | Self::Reaction(j) | Self::Preload(j) => j,
            Self::Sliding(joint) | Self::LimitForward(joint) | Self::LimitBackward(joint) => stops + joint,
        }
    }
}

/// A guard: a linear function of the state that is positive as long as the regime holds.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    pub(crate) kind: GuardKind,
    pub(crate) function: Observable,
    /// Whether it is the gap of a rigid stop: its zero is an impact.
    pub(crate) strikes: bool,
}

/// A joint that holds along with a constraint and shares its load.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharing {
    /// The joint, counted after the stops.
    pub(crate) place: usize,
    /// The constraint.
    pub(crate) held: usize,
    /// Whether its direction is that of the constraint, 1, or the opposite one, -1.
    pub(crate) side: f64,
}

/// The structure in one regime.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    pub(super) states: Vec<ContactState>,
    /// Number of joints.
    pub(super) joints: usize,
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
    pub(super) to_y: [Matrix; 2],
    pub(super) to_z: [Matrix; 2],
    /// The same maps from coordinates and velocities in the free directions, which are the product of this matrix with those
    /// of the machine.
    back: Matrix,
    from_free: [[Matrix; 2]; 2],
    pub(super) to_y_signal: Vec<Signal>,
    pub(super) to_z_signal: Vec<Signal>,
    pub(crate) guards: Vec<Guard>,
    /// The closed stops.
    pub(crate) closed: Vec<ClosedStop>,
    /// The places of the constraints that do not depend on those before them: stops and, after them, joints.
    pub(crate) held: Vec<usize>,
    /// Their reactions.
    pub(crate) reactions: Vec<Observable>,
    /// The impulse of each constraint that changes its own velocity by 1 and those of the others by nothing.
    pub(crate) across: Vec<Vec<f64>>,
    /// The limits of joints that hold along with each constraint, in units of its reaction.
    pub(crate) shared: Vec<f64>,
    /// These joints.
    pub(crate) sharing: Vec<Sharing>,
    /// Acceleration per unit of reaction, and rate of the damping, along each of these.
    pub(crate) mobility: Vec<(f64, f64)>,
    pub(crate) rates: Vec<f64>,
    /// What is needed for the constant force on the modes at a given position.
    rest: RestForce,
    /// Whether modal displacements are combinations of coordinates alone, and modal velocities of velocities alone: no damping
    /// couples modes, and no constraint moves.
    pub(crate) plain: bool,
    /// The reactions as functions of the mass-normalised state.
    pressing: Vec<Pressing>,
    /// What the search for zeros of guards uses, built when one is searched for: equations of cycles search for none.
    windows: OnceLock<Vec<Window>>,
    sampled: OnceLock<Option<Sampled>>,
    /// Whether coordinates and velocities have prescribed parts.
    pub(crate) carries: bool,
    /// Whether these have or gaps of closed stops.
    pub(crate) swings: bool,
    /// The fastest rate of the free motion and of the forcing.
    fastest: f64,
}

/// A mode whose stiffness is less than this part of the largest one moves freely.
const SOFT: f64 = 1e-12;

impl Structure {
    /// `None` if the constraints depend on each other.
    pub(crate) fn new(machine: &Machine, normal: &Normal, states: &[ContactState]) -> Option<Self> {
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
        sort_by(&mut closed, |one, other| weight(other).total_cmp(&weight(one)));

        // constraints w.x = wall(t), or the set point and the way of the belt: x = x_c(t) + N eta
        // those that bear a load come first, and contacts without force only where they are free
        let mut constraints: Vec<usize> = (0..states.len()).filter(|place| states[*place].constrains()).collect();
        sort_by_key(&mut constraints, |place| (states[*place] == ContactState::Touching, idles(machine, *place)));
        let bearing = independent(constraints.iter().map(|place| normal.directions[*place].as_slice()));
        let held: Vec<usize> = bearing.iter().map(|at| constraints[*at]).collect();
        let directions: Vec<Vec<f64>> = held.iter().map(|place| normal.directions[*place].clone()).collect();
        // joints that hold along with another constraint share its load: their limits add to its range
        let (mut shared, mut sharing) = (vec![0.0; held.len()], Vec::new());
        for place in constraints.iter().filter(|place| !held.contains(place)) {
            if states[*place] == ContactState::Resting {
                return None;
            }
            if states[*place] == ContactState::Holding
                && let Some((at, ratio)) = parallel(&directions, &normal.directions[*place])
            {
                shared[at] += ratio.abs() * machine.joints()[*place - stops].limit;
                sharing.push(Sharing { place: *place, held: at, side: ratio.signum() });
            }
        }
        let along: Vec<&[f64]> = closed.iter().map(|contact| contact.direction).collect();
        let (free, shares) = complement(&directions, &along, n)?;
        let mut gram = Matrix::zeros(held.len(), held.len());
        for (i, one) in directions.iter().enumerate() {
            for (j, other) in directions.iter().enumerate() {
                gram[(i, j)] = dot(one, other);
            }
        }
        let gram = inverse(&gram)?;
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
        let turned = |a: &Matrix| free.transposed().times(&a.times(&free)).symmetrised();
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
        let basis = Basis::new(&own_stiffness, &own_damping).map(|basis| {
            // without coupling the shapes come from rotations, which keep the digits of small components
            let refined = if basis.coupled { refined(&basis, &own_stiffness, &own_damping) } else { None };
            refined.unwrap_or(basis)
        });
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
                        stiffness: contact.k,
                        force: -contact.p - contact.c * along.sum::<f64>(),
                        direction: contact.direction.to_vec(),
                        push: push.apply(share),
                    }
                })
                .collect(),
            carried: carried.clone(),
            carries: carried.iter().any(Signal::moves),
            push_of_force: push.times(&free.transposed()),
            drift: basis.a[1].clone(),
            drifts: basis.a[1].largest() > 0.0,
        };
        let (to_y_signal, to_z_signal) = (offset(&to_y), offset(&to_z));
        let closed_stops = closed.iter().zip(&shares).map(|(contact, share)| {
            // the wall, without what the constraints carry along
            let prescribed = |wall: &Signal, carried: &[Signal]| {
                let mut signal = wall.clone();
                for (factor, carried) in contact.direction.iter().zip(carried) {
                    signal.add(-factor, carried);
                }
                signal
            };
            let wall = &normal.walls[contact.place];
            let (place, rate) = (prescribed(wall, &carried), prescribed(&wall.derivative(rates), &carried_rate));
            ClosedStop {
                place: contact.place,
                law: (contact.k, contact.c, contact.p),
                gap: less_motion(place, share, &basis.e, &slip),
                rate: less_motion(rate, share, &basis.v, &slip),
            }
        });
        let closed_stops: Vec<ClosedStop> = closed_stops.collect();

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
            joints,
            modes,
            dense,
            drive,
            slip,
            x,
            v,
            to_y,
            to_z,
            back,
            from_free: [basis.a, basis.b],
            to_y_signal,
            to_z_signal,
            guards: Vec::new(),
            closed: closed_stops,
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
            shared,
            sharing,
            rates: rates.clone(),
            rest,
            plain: false,
            pressing: Vec::new(),
            windows: OnceLock::new(),
            sampled: OnceLock::new(),
            carries: false,
            swings: false,
            fastest: 0.0,
        };
        let still = |signals: &[Signal]| signals.iter().all(Signal::is_zero);
        structure.plain = structure.to_y[1].largest() == 0.0
            && structure.to_z[0].largest() == 0.0
            && still(&structure.to_y_signal)
            && still(&structure.to_z_signal)
            && still(&structure.slip);
        structure.carries = structure.x.iter().chain(&structure.v).any(|of| of.signal.moves());
        structure.swings = structure.carries || structure.closed.iter().any(|closed| closed.gap.signal.moves());
        structure.pressing = structure.reactions.iter().map(|reaction| structure.pressing(reaction)).collect();
        structure.fastest =
            structure.modes.iter().map(|mode| mode.rate).fold(rates.last().copied().unwrap_or(0.0), f64::max);
        structure.guards = structure.all_guards(machine, normal);
        Some(structure)
    }

    /// Windows of useful lengths, the shortest first; none without modes.
    pub(crate) fn windows(&self) -> &[Window] {
        self.windows.get_or_init(|| self.tables(windows).unwrap_or_default())
    }

    /// Its guards at equal steps, if plain crossings can be found by them.
    pub(crate) fn sampled(&self) -> Option<&Sampled> {
        self.sampled.get_or_init(|| self.tables(Sampled::new).flatten()).as_ref()
    }

    /// Tables of all guards; `None` without modes.
    fn tables<T>(&self, of: impl Fn(Moved<'_>, &[&Observable]) -> T) -> Option<T> {
        let moved = Moved { modes: &self.modes, drive: &self.drive, rates: &self.rates };
        let guards: Vec<&Observable> = self.guards.iter().map(|guard| &guard.function).collect();
        self.dense.is_none().then(|| of(moved, &guards))
    }

    /// The states of stops and, after them, joints in it.
    pub(crate) fn states(&self) -> &[ContactState] {
        &self.states
    }

    /// Whether stops and joints have these states in it.
    pub(crate) fn is_in(&self, states: &[ContactState]) -> bool {
        self.states == states
    }

    /// Whether nothing can move.
    pub(crate) const fn is_still(&self) -> bool {
        self.modes.is_empty()
    }

    /// The fastest rate of the free motion and of the forcing.
    pub(crate) const fn fastest(&self) -> f64 {
        self.fastest
    }

    /// The slowest rate of the modes with stiffness; `None` if there is none.
    pub(crate) fn slowest(&self) -> Option<f64> {
        let stiff = |least: f64| self.modes.iter().map(|mode| mode.k).filter(move |k| *k > least);
        let least = SOFT * stiff(0.0).fold(0.0, f64::max);
        stiff(least).min_by(f64::total_cmp).map(f64::sqrt)
    }

    /// $`w\cdot x`$ and its rate.
    fn along(&self, direction: &[f64]) -> (Observable, Observable) {
        let zero = || Observable::zero(self.modes.len(), self.joints, self.rates.len());
        let (mut place, mut rate) = (zero(), zero());
        for (i, factor) in direction.iter().enumerate() {
            place.add(*factor, &self.x[i]);
            rate.add(*factor, &self.v[i]);
        }
        (place, rate)
    }

    /// The gap of a stop, and its rate.
    pub(crate) fn gap(&self, normal: &Normal, stop: usize) -> (Observable, Observable) {
        if let Some(closed) = self.closed.iter().find(|closed| closed.place == stop) {
            return (closed.gap.clone(), closed.rate.clone());
        }
        let (place, rate) = self.along(&normal.directions[stop]);
        let wall = &normal.walls[stop];
        let difference = |signal: &Signal, of: &Observable| {
            let mut gap = of.scaled(-1.0);
            gap.signal.add(1.0, signal);
            gap
        };
        (difference(wall, &place), difference(&wall.derivative(&self.rates), &rate))
    }

    /// The force of a closed compliant stop.
    pub(crate) fn force(&self, machine: &Machine, normal: &Normal, stop: usize) -> Option<Observable> {
        let (k, c, p) = compliant(&machine.stops()[stop].law)?;
        let (gap, rate) = self.gap(normal, stop);
        let mut force = gap.scaled(-k);
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

    /// The reaction of a constraint, and what joints that hold along with it can bear besides; `None` if other
    /// constraints bear its load.
    pub(crate) fn reaction(&self, place: usize) -> Option<(&Observable, f64)> {
        self.held.iter().position(|held| *held == place).map(|at| (&self.reactions[at], self.shared[at]))
    }

    /// Whether a gap, or the velocity of a joint, can change beyond rounding errors: not where constraints hold it already. `along`
    /// are those of the coordinates, and `wall` what else moves.
    fn changes(&self, of: &Observable, w: &[f64], (along, wall): (&[Observable], Option<&Signal>)) -> bool {
        let still = |of: &[f64]| of.iter().all(|factor| factor.abs() <= STILL * dot(w, w).sqrt());
        let size = |signal: &Signal| signal.harmonics.iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>();
        let swing = wall.map_or(0.0, size) + dot(w, w).sqrt() * along.iter().map(|of| size(&of.signal)).sum::<f64>();
        !(still(&of.position) && still(&of.velocity) && of.signal.ramp == 0.0 && size(&of.signal) <= STILL * swing)
    }

    fn all_guards(&self, machine: &Machine, normal: &Normal) -> Vec<Guard> {
        let mut guards = Vec::new();
        let rigid = |j: usize| matches!(machine.stops()[j].law, StopLaw::Rigid { .. });
        let mut add = |kind, function| {
            let strikes = matches!(kind, GuardKind::Gap(j) if rigid(j));
            guards.push(Guard { kind, function, strikes });
        };
        let moves = |j: usize| {
            let (gap, _) = self.gap(normal, j);
            self.changes(&gap, &normal.directions[j], (&self.x, Some(&normal.walls[j])))
        };
        let missing = |limit: f64, of: Observable| {
            let mut sum = of;
            sum.signal.constant += limit;
            sum
        };
        for (j, stop) in machine.stops().iter().enumerate() {
            match (self.states[j], &stop.law) {
                (ContactState::Closed, StopLaw::Compliant { opening, damping, preload, .. }) => {
                    // without damper and preload both are zero together
                    let depth = *opening == Opening::Position || *preload > 0.0 || *damping == 0.0;
                    if depth && moves(j) {
                        add(GuardKind::Depth(j), self.gap(normal, j).0.scaled(-1.0));
                    }
                    if *opening == Opening::Force
                        && *damping > 0.0
                        && let Some(force) = self.force(machine, normal, j)
                    {
                        add(GuardKind::Force(j), force);
                    }
                }
                (ContactState::Resting, law) => {
                    if let Some((reaction, shared)) = self.reaction(j) {
                        add(GuardKind::Reaction(j), missing(shared, reaction.clone()));
                        if let StopLaw::Compliant { preload, .. } = law {
                            add(GuardKind::Preload(j), missing(*preload + shared, reaction.scaled(-1.0)));
                        }
                    }
                }
                (ContactState::Touching, _) => {}
                _ if !moves(j) => {}
                _ => add(GuardKind::Gap(j), self.gap(normal, j).0),
            }
        }
        for (j, joint) in machine.joints().iter().enumerate() {
            let place = machine.stops().len() + j;
            match self.states[place] {
                ContactState::Forward | ContactState::Backward => {
                    let sliding = self.sliding(machine, normal, j);
                    // a joint that other constraints hold has the force of sliding as long as they do
                    if self.changes(&sliding, &normal.directions[place], (&self.v, None)) {
                        let sign = if self.states[place] == ContactState::Forward { 1.0 } else { -1.0 };
                        add(GuardKind::Sliding(j), sliding.scaled(sign));
                    }
                }
                _ => {
                    if let Some((reaction, shared)) = self.reaction(place) {
                        // a positive force holds it against sliding forward
                        add(GuardKind::LimitForward(j), missing(joint.limit + shared, reaction.scaled(-1.0)));
                        add(GuardKind::LimitBackward(j), missing(joint.limit + shared, reaction.clone()));
                    }
                }
            }
        }
        guards
    }

    /// The constant force on each mode at the position `x`, less that of its own stiffness there: the force that remains if
    /// modal displacements are counted from there. `gaps` are those of the closed stops,
    /// `turns` are sine and cosine of the harmonics there.
    pub(crate) fn rest_force(
        &self,
        x: &[f64],
        v: &[f64],
        turns: &[(f64, f64)],
        gaps: impl Iterator<Item = f64>,
        buffers: &mut RestBuffers,
        force: &mut Vec<f64>,
    ) {
        let drift = self.rest.at(x, v, turns, gaps, buffers, force);
        if self.dense.is_none() {
            if !self.plain {
                for (push, slip) in force.iter_mut().zip(&self.slip) {
                    // the rate of a ramp in $`P_1`$
                    *push += slip.ramp;
                }
            }
            for ((push, drift), mode) in force.iter_mut().zip(drift).zip(&self.modes) {
                *push -= mode.k * drift;
            }
        }
    }

    /// The modal displacements and velocities from the mass-normalised state at the beginning of a flight; `at` is the value
    /// of a signal there.
    pub(crate) fn modal(
        &self,
        x: &[f64],
        v: &[f64],
        at: impl Fn(&Signal) -> f64,
        buffers: &mut RestBuffers,
        (y, rate): (&mut Vec<f64>, &mut Vec<f64>),
    ) {
        if self.plain {
            self.to_y[0].apply_into(x, y);
            self.to_z[1].apply_into(v, rate);
            return;
        }
        // both from the same velocities in the free directions as the constant force of `rest_force`: where they have rounding
        // errors, it is as if the machine had these velocities, and no force is left that a stiff damper would make of them
        let [free, free_rate] = &mut buffers.free;
        self.back.apply_into(x, free);
        self.back.apply_into(v, free_rate);
        let of = |maps: &[Matrix; 2], signals: &[Signal], i: usize| {
            dot(maps[0].row(i), free) + dot(maps[1].row(i), free_rate) - at(&signals[i])
        };
        y.clear();
        rate.clear();
        let modes = 0..self.modes.len();
        y.extend(modes.clone().map(|i| of(&self.from_free[0], &self.to_y_signal, i)));
        rate.extend(modes.map(|i| of(&self.from_free[1], &self.to_z_signal, i) + at(&self.slip[i])));
    }

    /// A linear function of the modes as one of the mass-normalised state.
    fn pressing(&self, of: &Observable) -> Pressing {
        let n = self.x.len();
        let mut pressing = Pressing { x: vec![0.0; n], v: vec![0.0; n], signal: of.signal.clone() };
        for i in 0..self.modes.len() {
            let (a, b) = (of.position[i], of.velocity[i]);
            add_scaled(&mut pressing.x, a, self.to_y[0].row(i));
            add_scaled(&mut pressing.v, a, self.to_y[1].row(i));
            add_scaled(&mut pressing.x, b, self.to_z[0].row(i));
            add_scaled(&mut pressing.v, b, self.to_z[1].row(i));
            pressing.signal.add(-a, &self.to_y_signal[i]);
            pressing.signal.add(-b, &self.to_z_signal[i]);
            pressing.signal.add(b, &self.slip[i]);
        }
        pressing
    }

    /// A reaction at a mass-normalised state, if no joint holds, to rounding of its terms; `turns` are sine and cosine of the
    /// harmonics.
    pub(crate) fn reaction_at(&self, held: usize, x: &[f64], v: &[f64], turns: &[(f64, f64)]) -> f64 {
        let Pressing { x: by_x, v: by_v, signal } = &self.pressing[held];
        signal.constant + signal.swing(turns) + dot(by_x, x) + dot(by_v, v)
    }
}

/// The direction to which another one is parallel, and its multiple of it.
fn parallel(directions: &[Vec<f64>], other: &[f64]) -> Option<(usize, f64)> {
    directions.iter().enumerate().find_map(|(at, direction)| {
        let one = core::iter::once(direction.as_slice());
        let depends = independent(one.chain(core::iter::once(other))).len() == 1;
        depends.then(|| (at, dot(other, direction) / dot(direction, direction)))
    })
}

/// A linear function of the mass-normalised state.
#[derive(Clone, Debug)]
struct Pressing {
    x: Vec<f64>,
    v: Vec<f64>,
    signal: Signal,
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

/// Whether a constraint can be without load: not a preloaded stop. Of constraints that depend on each other those that cannot
/// come first.
pub(crate) fn idles(machine: &Machine, place: usize) -> bool {
    machine.stops().get(place).is_none_or(|stop| compliant(&stop.law).is_none())
}
