//! Where a machine is: state, phase, and what its stops and joints do.

use crate::arc::{Begin, GapStart, MachineFlight, Modes, Recovery};
use crate::machine::{Machine, StopLaw};
use crate::math::{dot, fit, sin_cos};
use crate::regime::{ContactState, GuardKind, Normal, Structure, compliant};
use crate::system::phase;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The structures of the regimes that a motion has visited.
#[derive(Clone, Debug, Default)]
pub(crate) struct Structures {
    all: BTreeMap<Vec<ContactState>, Option<Arc<Structure>>>,
    /// The last ones, between which most motions alternate.
    last: [Option<Arc<Structure>>; 3],
}

impl Structures {
    /// The structure with these states of stops and joints; `None` if its constraints depend on each other.
    pub(crate) fn get(
        &mut self,
        machine: &Machine,
        normal: &Normal,
        states: &[ContactState],
    ) -> Option<Arc<Structure>> {
        // a few comparisons instead of a search in the tree
        if let Some(known) = self.last.iter().flatten().find(|last| last.is_in(states)) {
            return Some(known.clone());
        }
        let made = self.all.get(states).cloned();
        let made = made.unwrap_or_else(|| {
            let made = Structure::new(machine, normal, states).map(Arc::new);
            self.all.insert(states.to_vec(), made.clone());
            made
        });
        self.last.rotate_right(1);
        self.last[0].clone_from(&made);
        made
    }

    /// Takes over those of another motion.
    pub(crate) fn join(&mut self, other: &Self) {
        for (states, structure) in &other.all {
            if !self.all.contains_key(states) {
                self.all.insert(states.clone(), structure.clone());
            }
        }
    }
}

/// The surface of a damped stop that has opened by force at this depth; `None` for any other stop.
pub(crate) fn standing_back(law: &StopLaw, depth: f64) -> Option<Recovery> {
    let (stiffness, damping, preload) = compliant(law)?;
    // the spring pushes on beyond the place at which the preload holds it
    let offset = preload / stiffness;
    (damping > 0.0).then(|| Recovery { size: depth + offset, rate: stiffness / damping, offset })
}

/// A gap is kept if its error is below this part of it.
const SHARP: f64 = 1e-6;
/// A surface that is slower than the body by more than this part does not leave it where their force ends.
const TAKEN_OFF: f64 = 1e-9;

/// Vectors for the beginning of a flight, which are used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    /// Sine and cosine of all harmonics at a phase.
    turns: Vec<(f64, f64)>,
    phase: Option<f64>,
    set: Vec<f64>,
    pub(super) v: Vec<f64>,
}

impl Scratch {
    /// Sine and cosine of all harmonics at a place, computed once for a phase.
    pub(super) fn turns_at(&mut self, place: &Place, normal: &Normal) -> &[(f64, f64)] {
        // a phase is the same to the last bit where nothing has moved
        if self.phase != Some(place.phase) {
            place.turns_into(normal, &mut self.turns);
            self.phase = Some(place.phase);
        }
        &self.turns
    }
}

/// A gap with more digits than the coordinates leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SharpGap {
    pub(crate) stop: usize,
    pub(crate) gap: f64,
    /// The size to which its rounding error is relative.
    pub(crate) size: f64,
}

impl SharpGap {
    const fn of_closed((stop, gap): (usize, f64)) -> Self {
        Self { stop, gap, size: gap.abs() }
    }
}

/// The state of a machine at one time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Place {
    /// Mass-normalised coordinates and velocities.
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) phase: f64,
    pub(crate) states: Vec<ContactState>,
    /// The surfaces of stops that have opened by force.
    pub(crate) surfaces: Vec<Option<Recovery>>,
    /// How many derivatives of a guard are zero now.
    pub(crate) known: Vec<(GuardKind, usize)>,
    /// The gaps of stops that were closed in the last flight, or have closed on their surface, and small ones of open stops after a short
    /// flight. They have more digits than the coordinates leave: a stiff stop is closed by little, and its force is as accurate as
    /// its gap; the impacts of a chatter come as accurately as the gaps are known that are left between them.
    pub(crate) gaps: Vec<SharpGap>,
}

impl Place {
    /// Sine and cosine of all harmonics.
    pub(crate) fn turns(&self, normal: &Normal) -> Vec<(f64, f64)> {
        let mut turns = Vec::new();
        self.turns_into(normal, &mut turns);
        turns
    }

    fn turns_into(&self, normal: &Normal, turns: &mut Vec<(f64, f64)>) {
        // a product must be reduced to one turn again; the phase itself is
        let phase = |order: f64| if order == 1.0 { self.phase } else { phase::wrap(order * self.phase) };
        turns.clear();
        turns.extend(normal.orders.iter().map(|order| sin_cos(phase(*order))));
    }

    /// The flight from here in the regime of `structure`.
    pub(crate) fn flight(&self, normal: &Normal, structure: Arc<Structure>) -> MachineFlight {
        let mut scratch = Scratch::default();
        let (begin, gap, known) = self.begin(normal, &mut scratch);
        MachineFlight::new(structure, begin, gap, Some(known))
    }

    /// The same without its guards, for states and rates alone.
    pub(crate) fn unguarded_flight(&self, normal: &Normal, structure: Arc<Structure>) -> MachineFlight {
        let mut scratch = Scratch::default();
        let (begin, gap, _) = self.begin(normal, &mut scratch);
        MachineFlight::new(structure, begin, gap, None::<fn(GuardKind) -> (usize, Option<Recovery>)>)
    }

    /// The same in the place of another flight; without a structure, in the regime of that.
    pub(super) fn fly(
        &self,
        normal: &Normal,
        structure: Option<Arc<Structure>>,
        flight: &mut MachineFlight,
        scratch: &mut Scratch,
    ) {
        let (begin, gap, known) = self.begin(normal, scratch);
        flight.renew(structure, begin, gap, known);
    }

    /// The state here, each gap, how many derivatives of each guard are zero, and the surfaces.
    #[inline(always)] // a copy of what it returns takes time
    #[allow(clippy::type_complexity)] // closures have no other name
    fn begin<'a>(
        &'a self,
        normal: &'a Normal,
        scratch: &'a mut Scratch,
    ) -> (Begin<'a>, impl Fn(usize) -> GapStart + 'a, impl Fn(GuardKind) -> (usize, Option<Recovery>) + 'a) {
        // the time restarts with each flight, and the set points of joints that hold on a moving belt with it
        let stops = self.surfaces.len();
        scratch.turns_at(self, normal);
        let Scratch { turns, set, .. } = scratch;
        let joints = &self.states[stops..];
        fit(set, joints.len());
        for ((point, state), direction) in set.iter_mut().zip(joints).zip(&normal.directions[stops..]) {
            *point = if *state == ContactState::Holding { dot(direction, &self.x) } else { 0.0 };
        }
        let turns: &'a [(f64, f64)] = turns;
        let gap = move |stop: usize| {
            // where the stop has just closed its gap is exactly 0
            let at_zero = self.known.iter().any(|(kind, _)| *kind == GuardKind::Depth(stop));
            let closed = SharpGap { stop, gap: 0.0, size: 0.0 };
            let sharp = if at_zero { Some(closed) } else { self.sharp(stop) };
            let (w, wall) = (&normal.directions[stop], &normal.walls[stop]);
            let swing = wall.swing(turns);
            if let Some(SharpGap { gap, size, .. }) = sharp {
                return GapStart { gap, size, swing, sharp: true };
            }
            let (mut way, mut size) = (0.0, wall.constant.abs() + swing.abs());
            for (w, x) in w.iter().zip(&self.x) {
                way += w * x;
                size += (w * x).abs();
            }
            GapStart { gap: wall.constant + swing - way, size, swing, sharp: false }
        };
        let known = move |kind| {
            let known = self.known.iter().find(|(of, _)| *of == kind).map_or(0, |(_, count)| *count);
            let surface = if let GuardKind::Gap(stop) = kind { self.surfaces[stop] } else { None };
            (known, surface)
        };
        (Begin { x: &self.x, v: &self.v, set, turns }, gap, known)
    }

    /// Moves to a time `s` after the beginning of a flight that began here, whose modes are these then; `frequency` is that
    /// of the forcing.
    pub(crate) fn move_along(&mut self, flight: &MachineFlight, (modes, s): (&Modes, f64), frequency: Option<f64>) {
        flight.state(modes, &mut self.x, &mut self.v);
        self.gaps.clear();
        self.gaps.extend(flight.closed_gaps(modes).map(SharpGap::of_closed));
        for surface in &mut self.surfaces {
            if let Some(Recovery { size, rate, .. }) = surface {
                *size *= crate::system::decay(*rate * s).0;
            }
            // a surface that has come back to rounding, or to its holder, is the stop itself
            if surface.is_some_and(|surface| surface.size <= surface.offset || surface.size < 1e-300) {
                *surface = None;
            }
        }
        if let Some(frequency) = frequency {
            self.phase = phase::advance(self.phase, frequency, s);
        }
        if s > 0.0 {
            self.known.clear();
        } else {
            // another event at the same time: what is zero stays zero, but a force may jump
            for (kind, count) in &mut self.known {
                *count = (*count).min(if matches!(kind, GuardKind::Sliding(_)) { 1 } else { 2 });
            }
        }
    }

    /// Closes exactly the contacts on which the structure rests, and stops the joints that hold: all at once.
    pub(super) fn close_rests(&mut self, machine: &Machine, normal: &Normal) {
        let stops = machine.stops().len();
        let turns = self.turns(normal);
        let (mut gaps, mut rates) = (Vec::new(), Vec::new());
        for at in (0..self.states.len()).filter(|at| self.states[*at].constrains()) {
            if at < stops {
                let (gap, rate) = self.gap_and_rate(normal, &turns, at);
                gaps.push((at, gap));
                rates.push((at, rate));
            } else {
                rates.push((at, -self.sliding(machine, normal, at - stops).0));
            }
        }
        normal.move_by(&gaps, &mut self.x);
        normal.move_by(&rates, &mut self.v);
    }

    /// Opens a compliant stop with this law at the zero of a guard, where it has this gap and rate.
    pub(super) fn open(&mut self, law: &StopLaw, kind: GuardKind, j: usize, (gap, rate): (f64, f64)) {
        self.states[j] = ContactState::Open;
        let mut known = 1;
        if let GuardKind::Force(_) = kind {
            // the force depends on the gap: the one with all digits
            let depth = -self.sharp_gap(j).unwrap_or(gap);
            if depth > 0.0 {
                self.surfaces[j] = standing_back(law, depth);
                // the surface leaves the body with the velocity of the body, unless an impact elsewhere takes it off
                let slower = |surface: Recovery| rate - surface.rate * surface.size > TAKEN_OFF * rate.abs();
                known = if self.surfaces[j].is_some_and(slower) { 1 } else { 2 };
            }
        }
        self.note(GuardKind::Gap(j), known);
    }

    /// Closes a compliant stop which the body has reached; `false` if it has reached the surface that has not come back.
    pub(super) fn close(&mut self, j: usize) -> bool {
        self.states[j] = ContactState::Closed;
        let surface = self.surfaces[j].take();
        match surface {
            // the stop is deep already
            Some(Recovery { size, offset, .. }) => {
                self.gaps.retain(|of| of.stop != j);
                self.gaps.push(SharpGap::of_closed((j, offset - size)));
            }
            None => self.note(GuardKind::Depth(j), 1),
        }
        surface.is_none()
    }

    /// Keeps the small gaps of open stops at the end of a short flight, whose modes are these and which ends with these guards. A
    /// gap that began as zero or with all digits has them still, where the coordinates have the rounding errors of their size.
    pub(super) fn keep_gaps(&mut self, normal: &Normal, flight: &MachineFlight, (modes, ends): (&Modes, &[usize])) {
        for (g, guard) in flight.structure.guards.iter().enumerate() {
            let GuardKind::Gap(stop) = guard.kind else { continue };
            if ends.contains(&g) || self.surfaces[stop].is_some() {
                continue;
            }
            let (gap, _, error) = flight.guard(g, modes);
            if gap > 0.0 && error < SHARP * gap {
                let terms = normal.directions[stop].iter().zip(&self.x).map(|(w, x)| (w * x).abs()).sum::<f64>();
                if error < 0.1 * f64::EPSILON * (normal.walls[stop].constant.abs() + terms) {
                    self.gaps.push(SharpGap { stop, gap, size: error / f64::EPSILON });
                }
            }
        }
    }

    /// A gap with more digits than the coordinates leave.
    pub(super) fn sharp_gap(&self, stop: usize) -> Option<f64> {
        self.sharp(stop).map(|of| of.gap)
    }

    fn sharp(&self, stop: usize) -> Option<SharpGap> {
        self.gaps.iter().find(|of| of.stop == stop).copied()
    }

    /// Notes how many derivatives of a guard are zero now.
    pub(super) fn note(&mut self, kind: GuardKind, count: usize) {
        self.known.retain(|(of, _)| *of != kind);
        self.known.push((kind, count));
    }

    /// Forgets what does not hold after a jump of the velocities: gaps and depths stay zero, rates do not.
    pub(super) fn jolt(&mut self) {
        self.known.retain_mut(|(kind, count)| {
            *count = 1;
            matches!(kind, GuardKind::Gap(_) | GuardKind::Depth(_))
        });
    }

    /// The gap of a stop, its rate, and the sizes of the terms of both. `turns` are sine and cosine of all harmonics.
    pub(crate) fn gap(&self, normal: &Normal, turns: &[(f64, f64)], stop: usize) -> (f64, f64, f64, f64) {
        let (w, wall) = (&normal.directions[stop], &normal.walls[stop]);
        let wall_rate: f64 = wall.turned(turns).zip(&normal.rates).map(|((_, b), rate)| rate * b).sum();
        let wall = wall.constant + wall.swing(turns);
        let size = |x: &[f64]| w.iter().zip(x).map(|(w, x)| (w * x).abs()).sum::<f64>();
        (
            wall - dot(w, &self.x),
            wall_rate - dot(w, &self.v),
            wall.abs() + size(&self.x),
            wall_rate.abs() + size(&self.v),
        )
    }

    /// The gap of a stop and its rate alone.
    #[inline]
    pub(super) fn gap_and_rate(&self, normal: &Normal, turns: &[(f64, f64)], stop: usize) -> (f64, f64) {
        let (w, wall) = (&normal.directions[stop], &normal.walls[stop]);
        let (mut gap, mut rate) = (wall.constant, 0.0);
        for (((a, b), (sin, cos)), w) in wall.harmonics.iter().zip(turns).zip(&normal.rates) {
            gap += a * cos + b * sin;
            rate += w * (b * cos - a * sin);
        }
        (gap - dot(w, &self.x), rate - dot(w, &self.v))
    }

    /// The relative velocity of a joint, and the size to which its rounding error is relative: velocities are rounded as
    /// parts of the whole motion, so this is that of all of them.
    pub(crate) fn sliding(&self, machine: &Machine, normal: &Normal, joint: usize) -> (f64, f64) {
        let w = &normal.directions[machine.stops().len() + joint];
        let belt = machine.joints()[joint].belt;
        (dot(w, &self.v) - belt, belt.abs() + (dot(w, w) * dot(&self.v, &self.v)).sqrt())
    }

    /// The direction in which a joint slides; `None` if its velocity is no more than a `part` of its size, or of another one.
    pub(super) fn slides(
        &self,
        machine: &Machine,
        normal: &Normal,
        joint: usize,
        (part, other): (f64, f64),
    ) -> Option<ContactState> {
        let (speed, size) = self.sliding(machine, normal, joint);
        let direction = if speed > 0.0 { ContactState::Forward } else { ContactState::Backward };
        (speed.abs() > part * size.max(other)).then_some(direction)
    }
}
