//! The flight of a machine in one regime: its modes from a state, at any time.

use super::dense::{Dense, Steps};
use super::drive::Drive;
use crate::math::{dot, fit};
use crate::regime::{ClosedStop, GuardKind, Mode, Normal, Observable, RestBuffers, Signal, Structure, Turned};
use std::sync::Arc;

/// How the surface of a damped stop comes back after it has opened by force: $`s = a\,e^{-\kappa t} - b`$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Recovery {
    /// $`a`$.
    pub(crate) size: f64,
    /// $`\kappa = k/c`$.
    pub(crate) rate: f64,
    /// $`b = p/k`$.
    pub(crate) offset: f64,
}

/// The state at the beginning of a flight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Begin<'a> {
    /// Mass-normalised coordinates and velocities.
    pub(crate) x: &'a [f64],
    pub(crate) v: &'a [f64],
    /// The set points of joints that hold.
    pub(crate) set: &'a [f64],
    /// Sine and cosine of each harmonic.
    pub(crate) turns: &'a [(f64, f64)],
}

/// A stop at the beginning of a flight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GapStart {
    /// Its gap.
    pub(crate) gap: f64,
    /// The size of the terms of the gap, for its rounding error.
    pub(crate) size: f64,
    /// How far its wall is from its mean place.
    pub(crate) swing: f64,
    /// Whether the gap has more digits than the difference of wall and coordinates.
    pub(crate) sharp: bool,
}

/// What a guard is at the beginning of a flight.
#[derive(Clone, Copy, Debug)]
pub(super) struct GuardStart {
    /// Its value there.
    pub(super) value: f64,
    /// Size of the terms of this value, for its rounding error.
    pub(super) size: f64,
    /// The value less the terms of velocities and harmonics: what is added to them at any time.
    pub(super) constant: f64,
    /// How many of its derivatives, from the value on, are zero there because the flight begins on it.
    pub(super) known: usize,
    /// Whether its value has more digits than the coordinates.
    sharp: bool,
    /// The surface of its stop.
    pub(super) recovery: Option<Recovery>,
}

/// The flight of a machine from a state, in one regime.
#[derive(Clone, Debug)]
pub(crate) struct MachineFlight {
    pub(crate) structure: Arc<Structure>,
    /// Modal displacements at the beginning. All others are counted from there, so that no digits cancel.
    origin: Vec<f64>,
    /// Modal velocities at the beginning.
    pub(super) v: Vec<f64>,
    /// Mass-normalised coordinates and velocities at the beginning.
    x: Vec<f64>,
    rate: Vec<f64>,
    pub(super) drive: Drive,
    pub(super) guards: Vec<GuardStart>,
    /// The closed stops at the beginning, in the order of the structure.
    gaps: Vec<GapStart>,
    /// The amplitudes of the harmonics of the guards, turned to the phase of the beginning, guard after guard.
    harmonics: Vec<(f64, f64)>,
    /// The set points of joints that hold.
    set: Vec<f64>,
    /// Sine and cosine of each harmonic at the beginning.
    pub(super) turns: Vec<(f64, f64)>,
    rest: RestBuffers,
}

/// The modes at one time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Modes {
    /// Displacements since the beginning, and velocities.
    pub(super) moved: Vec<f64>,
    pub(super) v: Vec<f64>,
    /// The velocities gained since the beginning, of modes that are not plain: gaps have parts of them, which are as small as the gaps.
    pub(super) gained: Vec<f64>,
    /// Bounds of the rounding errors of the displacements, and of the velocities; empty if they are not known.
    pub(super) error: Vec<(f64, f64)>,
    pub(super) turned: Vec<Turned>,
    pub(super) s: f64,
    steps: Steps,
}

/// The number of Taylor coefficients that decide what a contact without velocity does: a push passes through a row of eight
/// bodies in contact within them. Nearly always the first few do.
pub(crate) const ORDERS: usize = 18;
pub(crate) const FIRST_ORDERS: usize = 4;
/// Instead of the number of derivatives that are zero, of a guard that is identically zero: it is no guard in this flight.
pub(crate) const IDLE: usize = ORDERS + 1;
/// What is below this part of the terms that it is a sum of is zero within rounding errors.
const SILENT: f64 = 1e-12;
const HALF_ULP: f64 = 0.5 * f64::EPSILON;
/// The largest number of terms of the Taylor series of a mode, and up to which turn it suffices.
const LONG_TERMS: usize = 34;
const LONG_REACH: f64 = 3.0;
const SHORT_TERMS: usize = 13;
const SHORT_REACH: f64 = 0.25;

impl MachineFlight {
    /// The flight from a mass-normalised state. `set` are the set points of joints, `turns` sine and cosine of each
    /// harmonic at the beginning, `gap` tells of the gap of a stop, and `known` how many derivatives of a guard are zero, and how
    /// its surface recovers; without it the flight has no guards, for states and rates alone.
    pub(crate) fn new(
        structure: Arc<Structure>,
        begin: Begin<'_>,
        gap: impl Fn(usize) -> GapStart,
        known: Option<impl Fn(GuardKind) -> (usize, Option<Recovery>)>,
    ) -> Self {
        let mut flight = Self {
            drive: Drive::of_structure(&structure),
            structure,
            origin: Vec::new(),
            v: Vec::new(),
            x: Vec::new(),
            rate: Vec::new(),
            guards: Vec::new(),
            gaps: Vec::new(),
            harmonics: Vec::new(),
            set: Vec::new(),
            turns: Vec::new(),
            rest: RestBuffers::default(),
        };
        flight.begin(begin, gap, known);
        flight
    }

    /// Another flight in the place of this one, in its memory; without a structure, in that of this one.
    pub(crate) fn renew(
        &mut self,
        structure: Option<Arc<Structure>>,
        begin: Begin<'_>,
        gap: impl Fn(usize) -> GapStart,
        known: impl Fn(GuardKind) -> (usize, Option<Recovery>),
    ) {
        if let Some(structure) = structure {
            self.drive.become_of(&structure);
            self.structure = structure;
        }
        self.begin(begin, gap, Some(known));
    }

    fn begin(
        &mut self,
        Begin { x, v: rate, set, turns }: Begin<'_>,
        gap: impl Fn(usize) -> GapStart,
        known: Option<impl Fn(GuardKind) -> (usize, Option<Recovery>)>,
    ) {
        let structure = &self.structure;
        let value_of = |signal: &Signal| signal.steady(set) + signal.swing(turns);
        structure.modal(x, rate, value_of, &mut self.rest, (&mut self.origin, &mut self.v));
        self.gaps.clear();
        for closed in &structure.closed {
            self.gaps.push(gap(closed.place));
        }
        let drive = &mut self.drive;
        // the harmonics drive the modes apart from this: of walls that swing the force has the mean place
        let gaps = self.gaps.iter().map(|closed| closed.gap - closed.swing);
        structure.rest_force(x, rate, turns, gaps, &mut self.rest, &mut drive.steady);
        drive.harmonics.clear();
        for signal in &structure.drive {
            drive.harmonics.extend(signal.turned(turns));
        }
        self.x.clear();
        self.x.extend_from_slice(x);
        self.rate.clear();
        self.rate.extend_from_slice(rate);
        self.set.clear();
        self.set.extend_from_slice(set);
        self.turns.clear();
        self.turns.extend_from_slice(turns);
        self.guards.clear();
        self.harmonics.clear();
        if let Some(known) = known {
            self.begin_guards(gap, known);
        }
    }

    /// The guards at the beginning, whose state is known.
    #[inline]
    fn begin_guards(
        &mut self,
        gap: impl Fn(usize) -> GapStart,
        known: impl Fn(GuardKind) -> (usize, Option<Recovery>),
    ) {
        let (structure, y, v) = (&self.structure, &self.origin, &self.v);
        let (set, turns) = (&self.set, &self.turns);
        let value_of = |signal: &Signal| signal.steady(set) + signal.swing(turns);
        for guard in &structure.guards {
            let (known, recovery) = known(guard.kind);
            let function = &guard.function;
            let mut moving = function.signal.swing(turns);
            let mut sharp = false;
            self.harmonics.extend(function.signal.turned(turns));
            // the value at the beginning; what is `moving` in it is counted from there later on
            let (mut sum, mut size);
            if let GuardKind::Gap(j) = guard.kind {
                // coordinates can have more digits of a small gap than modes, which share those of the whole motion; one that is
                // zero has all of them
                (sum, size) = (0.0, function.signal.constant.abs() + moving.abs());
                if known == 0 {
                    let start = gap(j);
                    (sum, size, sharp) = (start.gap, start.size, start.sharp);
                }
                // with plain modes a gap has no part in velocities
                if !structure.plain {
                    moving += dot(&function.velocity, v);
                }
            } else {
                (sum, size) = (function.signal.steady(set) + moving, function.signal.constant.abs());
                for ((a, y), (b, v)) in function.position.iter().zip(y).zip(function.velocity.iter().zip(v)) {
                    let (one, two) = (a * y, b * v);
                    sum += one + two;
                    moving += two;
                    size += one.abs() + two.abs();
                }
                for (a, b) in function.signal.turned(turns) {
                    size += a.abs() + b.abs();
                }
            }
            if let Some(surface) = recovery {
                // the wall stands back by the part of the surface that has not yet recovered
                sum += surface.size - surface.offset;
                size += surface.size + surface.offset;
            }
            if known == 0
                && let GuardKind::Depth(j) | GuardKind::Force(j) = guard.kind
                && let Some(at) = structure.closed.iter().position(|closed| closed.place == j)
                && self.gaps[at].sharp
            {
                let ClosedStop { law: (stiffness, damping, preload), rate, .. } = &structure.closed[at];
                // a sharp gap has more digits than the modes, and so has what the stop's law makes of it
                let depth = -self.gaps[at].gap;
                let rate = || dot(&rate.position, y) + dot(&rate.velocity, v) + value_of(&rate.signal);
                let is_force = matches!(guard.kind, GuardKind::Force(_));
                sum = if is_force { preload + stiffness * depth - damping * rate() } else { depth };
            }
            // a guard on which the flight begins is exactly zero: a rounding error would be an event at once; one that stays zero is
            // kept away from it
            let (value, known) = match known {
                0 => (sum, 0),
                IDLE => (size + 1.0, 0),
                _ => (0.0, known),
            };
            self.guards.push(GuardStart { value, size, constant: value - moving, known, sharp, recovery });
        }
    }

    /// A guard at the beginning, and the size of its terms.
    pub(crate) fn start_of_guard(&self, guard: usize) -> (f64, f64) {
        (self.guards[guard].value, self.guards[guard].size)
    }

    /// Whether the flight begins on this guard, or with a value of it that has more digits than the coordinates.
    pub(crate) fn begins_exactly(&self, guard: usize) -> bool {
        let start = &self.guards[guard];
        start.known > 0 || start.sharp
    }

    /// The amplitudes of the harmonics of a guard, turned to the phase of the beginning.
    pub(super) fn harmonics(&self, guard: usize) -> &[(f64, f64)] {
        let count = self.drive.rates.len();
        &self.harmonics[guard * count..(guard + 1) * count]
    }

    /// The structure and what drives it, if it has no modes.
    pub(super) fn dense(&self) -> Option<Dense<'_>> {
        let (stiffness, damping) = self.structure.dense.as_ref()?;
        Some(Dense { stiffness, damping, drive: &self.drive, rate: self.structure.fastest() })
    }

    /// The state of the modes and harmonics at the beginning: see `Pass`.
    #[inline]
    pub(super) fn state_of_modes(&self, z: &mut Vec<f64>) {
        let count = 3 * self.v.len();
        fit(z, count + 2 * self.turns.len() + 2);
        let (modes, rest) = z.split_at_mut(count);
        let ((modes, _), (turns, time)) = (modes.as_chunks_mut::<3>(), rest.split_at_mut(2 * self.turns.len()));
        for (mode, (v, q)) in modes.iter_mut().zip(self.v.iter().zip(&self.drive.steady)) {
            *mode = [0.0, *v, *q];
        }
        for (turn, (sin, cos)) in turns.as_chunks_mut::<2>().0.iter_mut().zip(&self.turns) {
            *turn = [*cos, *sin];
        }
        (time[0], time[1]) = (0.0, 1.0);
    }

    /// Turns the harmonics of modes at a time, if coordinates or gaps of closed stops depend on them.
    pub(super) fn turn(&self, s: f64, modes: &mut Modes) {
        modes.turned.clear();
        if self.structure.swings {
            modes.turned.extend(self.structure.rates.iter().map(|rate| Turned::of(rate * s)));
        }
    }

    /// The modes a time `s` after the beginning.
    pub(crate) fn at(&self, s: f64, modes: &mut Modes) {
        modes.s = s;
        modes.turned.clear();
        modes.turned.extend(self.structure.rates.iter().map(|rate| Turned::of(rate * s)));
        modes.moved.clear();
        modes.v.clear();
        modes.gained.clear();
        modes.error.clear();
        if let Some(dense) = self.dense() {
            let (moved, v, error) = dense.at(&self.v, s, &mut modes.steps);
            modes.error.extend(self.structure.modes.iter().map(|mode| (error, error * mode.rate.max(1e-300))));
            (modes.moved, modes.v) = (moved, v);
            self.gain(modes);
            return;
        }
        // the series gives the same here; this only saves its work
        if s == 0.0 {
            modes.moved.resize(self.v.len(), 0.0);
            modes.error.resize(self.v.len(), (0.0, 0.0));
            modes.v.extend_from_slice(&self.v);
            self.gain(modes);
            return;
        }
        // the orders of the harmonics are sorted: the last is the fastest, and the series must resolve it too
        let fastest = self.structure.rates.last().copied().unwrap_or(0.0);
        for (i, mode) in self.structure.modes.iter().enumerate() {
            let turn = s * mode.rate.max(fastest);
            let (moved, gained, v, error) = if turn < SHORT_REACH {
                // the last term is below rounding
                let terms = if turn < 1e-3 {
                    6
                } else if turn < 0.03 {
                    9
                } else {
                    SHORT_TERMS
                };
                self.by_series(i, s, terms)
            } else if turn < LONG_REACH && self.slow(i) {
                self.by_series(i, s, LONG_TERMS)
            } else {
                let (moved, v, error) = self.by_response(i, mode, s, &modes.turned);
                (moved, v - self.v[i], v, error)
            };
            modes.moved.push(moved);
            modes.v.push(v);
            if !self.structure.plain {
                modes.gained.push(gained);
            }
            modes.error.push(error);
        }
    }

    /// What the velocities of the modes have gained, by their difference.
    pub(super) fn gain(&self, modes: &mut Modes) {
        modes.gained.clear();
        if !self.structure.plain {
            modes.gained.extend(modes.v.iter().zip(&self.v).map(|(now, before)| now - before));
        }
    }

    /// Whether a mode begins so slowly that the closed form would lose digits of its displacement.
    fn slow(&self, i: usize) -> bool {
        let push: f64 =
            self.drive.of(i).iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>() + self.drive.steady[i].abs();
        let mode = &self.structure.modes[i];
        self.v[i].abs() * mode.rate < 0.125 * push
    }

    fn by_response(&self, i: usize, mode: &Mode, s: f64, turned: &[Turned]) -> (f64, f64, (f64, f64)) {
        let free = mode.free(s);
        let v = self.v[i];
        let (p0, p1) = (self.drive.steady[i], self.drive.ramp[i]);
        // y = v S + p_0 I_1 + p_1 I_2 and its rate, with I_1' = S and I_2' = I_1 (see `mode`)
        let mut moved = v * free.s;
        let mut rate = v * free.s_rate + p0 * free.s;
        let (mut size, mut size_of_rate) = ((v * free.s).abs(), (v * free.s_rate).abs() + (p0 * free.s).abs());
        let mut angle = free.angle * (v.abs() + p0.abs() * s.min(1.0 / mode.rate.max(1e-300))) * free.s.abs().min(s);
        moved += p0 * free.step;
        size += p0.abs() * free.step.abs();
        if p1 != 0.0 {
            moved += p1 * free.ramp;
            rate += p1 * free.step;
            size_of_rate += (p1 * free.step).abs();
            size += p1.abs() * free.ramp.abs() + (p1 / mode.k.max(1e-300)).abs().min(p1.abs() * s * s) * s;
        }
        // the rates of the convolutions of S with cosine and sine are S - w K_s and w K_c
        for (h, (a, b)) in self.drive.of(i).iter().enumerate() {
            if *a == 0.0 && *b == 0.0 {
                continue;
            }
            let w = self.structure.rates[h];
            let (kc, ks, terms) = mode.forced(h, s, &free, &turned[h]);
            moved += a * kc + b * ks;
            rate += a * (free.s - w * ks) + b * (w * kc);
            size += (a.abs() + b.abs()) * terms;
            size_of_rate += (a.abs() + b.abs()) * (free.s.abs() + w * terms);
        }
        if mode.omega > 0.0 {
            angle += free.angle * v.abs() / mode.omega;
        }
        let error = HALF_ULP * (5.0 * size + angle + moved.abs());
        // where the fast decay has passed, a velocity is much smaller than its displacement times the fastest rate
        let of_rate = match mode.decays {
            Some((slow, _)) => HALF_ULP * (8.0 + slow * s) * size_of_rate,
            None => error * mode.rate.max(1e-300),
        };
        (moved, rate, (error, of_rate))
    }

    fn by_series(&self, i: usize, s: f64, terms: usize) -> (f64, f64, f64, (f64, f64)) {
        let mut c = [0.0; LONG_TERMS + 2];
        self.coefficients(i, 0.0, self.v[i], 0.0, self.drive.of(i), &mut c[..terms + 2]);
        let (mut y, mut v, mut size) = (0.0, 0.0, 0.0);
        let mut real = f64::from(u32::try_from(terms + 1).unwrap_or(0));
        // Horner's scheme from the highest power down; the power 0 is left out, because displacements begin at zero,
        // and one factor `s` comes at the end
        for k in (2..terms + 2).rev() {
            y = y * s + c[k];
            size = size * s + c[k].abs();
            v = v * s + real * c[k];
            real -= 1.0;
        }
        // what is gained, before the first velocity takes its digits
        let gained = v * s;
        (y, v, size) = (y * s + c[1], gained + c[1], size * s + c[1].abs());
        let error = HALF_ULP * 4.0 * size * s;
        (y * s, gained, v, (error, error * self.structure.modes[i].rate.max(1e-300)))
    }

    /// The Taylor coefficients $`y^{(k)}/k!`$ of a mode at a state a time `s` after the beginning; `harmonics` are turned to
    /// this time.
    pub(super) fn coefficients(&self, i: usize, y: f64, v: f64, s: f64, harmonics: &[(f64, f64)], c: &mut [f64]) {
        let mode = &self.structure.modes[i];
        let terms = c.len();
        (c[0], c[1]) = (y, v);
        self.drive.coefficients(i, s, harmonics, c);
        let mut k = 0.0;
        // `c` has the coefficients of what drives the mode; y'' + 2dy' + ky = q gives those of the mode, two powers
        // later
        for j in 2..terms {
            c[j] = (c[j] - 2.0 * mode.d * (k + 1.0) * c[j - 1] - mode.k * c[j - 2]) / ((k + 1.0) * (k + 2.0));
            k += 1.0;
        }
    }

    /// What drives a mode at the time of the modes.
    fn push(&self, i: usize, modes: &Modes) -> f64 {
        let push = self.drive.steady[i] + self.drive.ramp[i] * modes.s;
        let harmonics = self.drive.of(i).iter().zip(&modes.turned);
        harmonics.fold(push, |push, ((a, b), turned)| push + (a * turned.cos + b * turned.sin))
    }

    /// The acceleration of a mode that is pushed with `push`.
    fn acceleration(&self, i: usize, push: f64, y: &[f64], v: &[f64]) -> f64 {
        match &self.structure.dense {
            Some((stiffness, damping)) => push - dot(damping.row(i), v) - dot(stiffness.row(i), y),
            None => {
                let mode = &self.structure.modes[i];
                push - 2.0 * mode.d * v[i] - mode.k * y[i]
            }
        }
    }

    /// Moves the modes on by a time so short that its third power is nothing beside rounding.
    pub(super) fn advance(&self, s: f64, modes: &mut Modes) {
        for i in 0..modes.moved.len() {
            let push = self.push(i, modes);
            let mode = &self.structure.modes[i];
            // the equation of motion at the beginning of the step; the displacement is exact to second order with it
            let a = push - 2.0 * mode.d * modes.v[i] - mode.k * modes.moved[i];
            modes.moved[i] += (modes.v[i] + 0.5 * a * s) * s;
            modes.v[i] += a * s;
            if let Some(gained) = modes.gained.get_mut(i) {
                *gained += a * s;
            }
        }
        for (turned, w) in modes.turned.iter_mut().zip(&self.drive.rates) {
            // near the beginning the versine is small and needs its second order; for sine and cosine that is below
            // rounding
            let angle = w * s;
            turned.versine += angle * (turned.sin + 0.5 * angle * turned.cos);
            (turned.sin, turned.cos) = (turned.sin + angle * turned.cos, turned.cos - angle * turned.sin);
        }
    }

    /// The value of a guard, its rate, and a bound of its rounding error.
    pub(crate) fn guard(&self, g: usize, modes: &Modes) -> (f64, f64, f64) {
        let (function, start) = (&self.structure.guards[g].function, &self.guards[g]);
        // the value at the beginning and what each term has gained since: so no digits of a small guard cancel
        let mut value = start.value;
        let mut rate = function.signal.ramp;
        value += function.signal.ramp * modes.s;
        // in halves of an ulp, until the bound is returned
        let mut error = if start.known > 0 { 0.0 } else { start.size };
        for i in 0..modes.moved.len() {
            let (a, b) = (function.position[i], function.velocity[i]);
            if a != 0.0 {
                let moved = a * modes.moved[i];
                value += moved;
                rate += a * modes.v[i];
                error += moved.abs() + (a * modes.error[i].0).abs() * (1.0 / HALF_ULP);
            }
            if b != 0.0 {
                let known = modes.gained.get(i);
                let gained = known.map_or_else(|| modes.v[i] - self.v[i], |gained| *gained);
                value += b * gained;
                rate += b * self.acceleration(i, self.push(i, modes), &modes.moved, &modes.v);
                let size = known.map_or_else(|| modes.v[i].abs() + self.v[i].abs(), |gained| gained.abs());
                error += b.abs() * (size + modes.error[i].1 / HALF_ULP);
            }
        }
        // a cosine has moved by minus its versine: the difference of two cosines would lose digits over short times
        for ((a, b), (turned, w)) in self.harmonics(g).iter().zip(modes.turned.iter().zip(&self.structure.rates)) {
            value += b * turned.sin - a * turned.versine;
            rate += w * (b * turned.cos - a * turned.sin);
            error += (a.abs() + b.abs()) * w * modes.s * 0.5 + (b * turned.sin).abs() + (a * turned.versine).abs();
        }
        // a(e^{-kappa s} - 1) is what the surface has recovered
        if let Some(surface) = start.recovery {
            let (kept, loss) = crate::system::decay(surface.rate * modes.s);
            value -= surface.size * loss;
            rate -= surface.rate * surface.size * kept;
            error += surface.size * loss;
        }
        (value, rate, 2.0 * HALF_ULP * error)
    }

    /// The value and the rate of a linear function of the state at the beginning.
    pub(crate) fn first(&self, of: &Observable) -> (f64, f64) {
        let signal = &of.signal;
        let mut value = signal.steady(&self.set) + signal.swing(&self.turns);
        // turned to the phase of the beginning, the rate of a harmonic is its sine's amplitude times w, its value the
        // cosine's
        let rates = signal.turned(&self.turns).zip(&self.structure.rates);
        let mut rate = rates.fold(signal.ramp, |sum, ((_, b), w)| sum + w * b);
        let unmoved = vec![0.0; self.v.len()];
        for i in 0..self.v.len() {
            let push = self.drive.of(i).iter().fold(self.drive.steady[i], |sum, (a, _)| sum + a);
            let a = self.acceleration(i, push, &unmoved, &self.v);
            value += of.position[i] * self.origin[i] + of.velocity[i] * self.v[i];
            rate += of.position[i] * self.v[i] + of.velocity[i] * a;
        }
        (value, rate)
    }

    /// The Taylor coefficients of a linear function of the state at the beginning, each with the size of its terms.
    pub(crate) fn taylor<const N: usize>(&self, of: &Observable) -> [(f64, f64); N] {
        let mut result = [(0.0, 0.0); N];
        let (mut c, mut size) = (vec![0.0; N + 1], vec![0.0; N + 1]);
        let mut dense = Vec::new();
        if let Some(equations) = self.dense() {
            equations.coefficients(&vec![0.0; self.v.len()], &self.v, 0.0, N + 1, &mut dense);
        }
        let real = |k: usize| f64::from(u32::try_from(k).unwrap_or(0));
        for i in 0..self.v.len() {
            let (alpha, beta) = (of.position[i], of.velocity[i]);
            c.fill(0.0);
            if dense.is_empty() {
                self.coefficients(i, 0.0, self.v[i], 0.0, self.drive.of(i), &mut c);
            } else {
                c.copy_from_slice(&dense[i * (N + 1)..(i + 1) * (N + 1)]);
            }
            // the series counts from the beginning, the function from where the modal displacements are zero
            c[0] = self.origin[i];
            // bounds of the derivatives: forces that cancel in equilibrium have rounding errors of their sizes
            let (rate, push) =
                (self.rate_of(i), self.push_size(i) + (self.structure.modes[i].k * self.origin[i]).abs());
            size.fill(0.0);
            (size[0], size[1]) = (c[0].abs(), self.v[i].abs());
            let mut derivative = rate * size[1] + push;
            let mut factorial = 1.0;
            for (k, size) in size.iter_mut().enumerate().skip(2) {
                factorial *= real(k);
                *size = derivative / factorial;
                derivative *= rate;
            }
            // by the displacement, and by the velocity, whose coefficients are one power lower
            for (k, (value, sum)) in result.iter_mut().enumerate() {
                let next = beta * real(k + 1);
                *value += alpha * c[k] + next * c[k + 1];
                *sum += alpha.abs() * size[k] + next.abs() * size[k + 1];
            }
        }
        let signal = &of.signal;
        result[0].0 += signal.steady(&self.set);
        result[0].1 += signal.steady(&self.set).abs();
        result[1].0 += signal.ramp;
        result[1].1 += signal.ramp.abs();
        for ((a, b), w) in signal.turned(&self.turns).zip(&self.structure.rates) {
            let (mut now, mut next, mut size) = (a, w * b, a.abs() + b.abs());
            for (k, sum) in result.iter_mut().enumerate() {
                sum.0 += now;
                sum.1 += size;
                // the second derivative of a harmonic is -w^2 times it
                (now, next) = (next, -w * w * now / (real(k + 1) * real(k + 2)));
                size *= w / real(k + 1);
            }
        }
        result
    }

    /// For how long all guards are positive of which more than `most` derivatives are zero at the beginning: as long as their
    /// first term is at least twice the sum of all others. 0 if there are none.
    pub(super) fn quiet_time(&self, most: usize) -> f64 {
        let late = |g: &usize| self.guards[*g].known > most && self.guards[*g].recovery.is_none();
        let times = (0..self.guards.len()).filter(late).map(|g| {
            let known = self.guards[g].known;
            let terms = self.taylor::<ORDERS>(&self.structure.guards[g].function);
            let Some(first) = terms.get(known).map(|(value, _)| *value) else { return 0.0 };
            let others = |time: f64| terms[known + 1..].iter().rev().fold(0.0, |sum, (_, size)| (sum + size) * time);
            // half of the first term is kept: the guard stays positive even if all others have the worst sign
            let mut time = self.shortest();
            while others(time) > 0.5 * first && time > 0.0 {
                time *= 0.5;
            }
            time
        });
        times.reduce(f64::min).unwrap_or(0.0)
    }

    /// The fastest rate of a mode and of what drives it.
    fn rate_of(&self, i: usize) -> f64 {
        let own = if self.structure.dense.is_some() { self.structure.fastest() } else { self.structure.modes[i].rate };
        self.structure.rates.last().map_or(own, |last| own.max(*last))
    }

    /// The size of the forces that move a mode.
    fn push_size(&self, i: usize) -> f64 {
        self.drive.of(i).iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>() + self.drive.steady[i].abs()
    }

    /// The time in which the fastest motion turns by a radian; any time without one.
    fn shortest(&self) -> f64 {
        let rate = self.structure.fastest();
        if rate > 0.0 { 1.0 / rate } else { 1.0 }
    }

    /// How far a mode moves in a time, nearly.
    fn swing_size(&self, i: usize, time: f64) -> f64 {
        (self.v[i].abs() + self.push_size(i) * time + self.drive.ramp[i].abs() * time * time) * time
    }

    /// By how much a linear function of the state changes, nearly.
    fn change_size(&self, of: &Observable) -> f64 {
        let time = self.shortest();
        let signal = of.signal.harmonics.iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>();
        let modes = (0..self.v.len()).map(|i| {
            let swing = self.swing_size(i, time);
            of.position[i].abs() * swing + of.velocity[i].abs() * swing / time
        });
        signal + of.signal.ramp.abs() * time + modes.sum::<f64>()
    }

    /// Whether the reaction of a constraint is zero for the whole flight, within rounding errors of the forces on the machine.
    pub(crate) fn presses_never(&self, normal: &Normal, held: usize) -> bool {
        self.first(&self.structure.reactions[held]).0.abs() <= self.silence(normal, held)
            && self.presses_evenly(normal, held)
    }

    /// Whether it keeps its value for the whole flight.
    pub(crate) fn presses_evenly(&self, normal: &Normal, held: usize) -> bool {
        self.change_size(&self.structure.reactions[held]) <= self.silence(normal, held)
    }

    /// The rounding error of a reaction.
    fn silence(&self, normal: &Normal, held: usize) -> f64 {
        // a bound of all forces on the machine in a radian of its fastest motion: what is small beside it is rounding
        let (x, v) = (dot(&self.x, &self.x).sqrt(), dot(&self.rate, &self.rate).sqrt());
        let time = self.shortest();
        let moved: f64 = (0..self.v.len()).map(|i| self.swing_size(i, time)).sum();
        let of = |signal: &Signal| {
            signal.constant.abs() + signal.harmonics.iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>()
        };
        let forces = normal.force.iter().map(of).sum::<f64>()
            + normal.stiffness.largest() * (x + moved)
            + normal.damping.largest() * (v + moved / time);
        let column = &self.structure.across[held];
        SILENT * forces * dot(column, column).sqrt()
    }

    /// Whether a gap keeps its value for the whole flight, within rounding errors of the motion.
    pub(crate) fn opens_never(&self, normal: &Normal, stop: usize) -> bool {
        let (gap, _) = self.structure.gap(normal, stop);
        self.change_size(&gap) <= SILENT * self.way_size(normal, stop)
    }

    /// Whether the velocity of a joint keeps its value for the whole flight, within rounding errors of the motion.
    pub(crate) fn slides_never(&self, normal: &Normal, (place, sliding): (usize, &Observable)) -> bool {
        self.change_size(sliding) <= SILENT * self.way_size(normal, place) / self.shortest()
    }

    /// How far the structure moves along a stop or joint in a short time if nothing holds it, and walls move.
    fn way_size(&self, normal: &Normal, place: usize) -> f64 {
        let (w, time) = (&normal.directions[place], self.shortest());
        let moved: f64 = (0..self.v.len()).map(|i| self.swing_size(i, time)).sum();
        let walls = normal.walls.iter().flat_map(|wall| &wall.harmonics).map(|(a, b)| a.abs() + b.abs()).sum::<f64>();
        dot(w, w).sqrt() * moved + walls
    }

    /// The size of the terms of a linear function of the state at the beginning.
    pub(crate) fn size(&self, of: &Observable) -> f64 {
        let signal = of.signal.harmonics.iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>();
        let modes =
            (0..self.v.len()).map(|i| (of.position[i] * self.origin[i]).abs() + (of.velocity[i] * self.v[i]).abs());
        of.signal.steady(&self.set).abs() + signal + modes.sum::<f64>()
    }

    /// The same, and how far it moves while the fastest mode turns by a radian: where a coordinate passes through zero, its rounding
    /// error is relative to that.
    pub(crate) fn size_in_motion(&self, of: &Observable) -> f64 {
        let time = if self.structure.fastest() > 0.0 { self.shortest() } else { 0.0 };
        let way = of.position.iter().zip(&self.v).map(|(a, v)| (a * v).abs()).sum::<f64>();
        self.size(of) + way * time
    }

    /// Mass-normalised coordinates and velocities at a time, from the modes there.
    pub(crate) fn state(&self, modes: &Modes, x: &mut Vec<f64>, v: &mut Vec<f64>) {
        if self.structure.plain && !self.structure.carries {
            // coordinates are combinations of displacements alone, and velocities of velocities
            fit(x, self.x.len());
            fit(v, self.rate.len());
            for ((x, begin), of) in x.iter_mut().zip(&self.x).zip(&self.structure.x) {
                *x = begin + dot(&of.position, &modes.moved);
            }
            for ((v, begin), of) in v.iter_mut().zip(&self.rate).zip(&self.structure.v) {
                let gained = of.velocity.iter().zip(modes.v.iter().zip(&self.v));
                *v = begin + gained.fold(0.0, |sum, (factor, (now, before))| sum + factor * (now - before));
            }
            return;
        }
        let evaluate = |all: &[Observable], begin: &[f64], to: &mut Vec<f64>| {
            to.clear();
            to.extend(all.iter().zip(begin).map(|(of, begin)| begin + self.moved(of, modes)));
        };
        evaluate(&self.structure.x, &self.x, x);
        evaluate(&self.structure.v, &self.rate, v);
    }

    /// The gaps of the closed stops at a time, from the modes there: each stop with its gap.
    pub(crate) fn closed_gaps(&self, modes: &Modes) -> impl Iterator<Item = (usize, f64)> {
        let closed = self.structure.closed.iter().zip(&self.gaps);
        closed.map(|(closed, begin)| (closed.place, begin.gap + self.moved(&closed.gap, modes)))
    }

    /// How much a linear function of the state has changed since the beginning, from the modes now.
    fn moved(&self, of: &Observable, modes: &Modes) -> f64 {
        let mut moved = of.signal.ramp * modes.s;
        for ((a, b), turned) in of.signal.turned(&self.turns).zip(&modes.turned) {
            moved += b * turned.sin - a * turned.versine;
        }
        for i in 0..modes.moved.len() {
            let gained = modes.gained.get(i).map_or_else(|| modes.v[i] - self.v[i], |gained| *gained);
            moved += of.position[i] * modes.moved[i] + of.velocity[i] * gained;
        }
        moved
    }

    /// Mass-normalised accelerations at a time, from the modes there; `own` receives those of the modes.
    pub(crate) fn accelerations(&self, modes: &Modes, own: &mut Vec<f64>, to: &mut Vec<f64>) {
        let count = modes.moved.len();
        own.clear();
        own.extend((0..count).map(|i| self.acceleration(i, self.push(i, modes), &modes.moved, &modes.v)));
        to.clear();
        to.extend(self.structure.v.iter().map(|of| {
            let mut sum = of.signal.ramp;
            let turned = modes.turned.iter().zip(&self.structure.rates);
            for ((a, b), (turned, w)) in of.signal.turned(&self.turns).zip(turned) {
                sum += w * (b * turned.cos - a * turned.sin);
            }
            for (i, own) in own.iter().enumerate() {
                sum += of.position[i] * modes.v[i] + of.velocity[i] * own;
            }
            sum
        }));
    }

    /// Sine and cosine of each harmonic of the forcing at a time, from the modes there.
    pub(crate) fn turns_at(&self, modes: &Modes, to: &mut Vec<(f64, f64)>) {
        to.clear();
        to.extend(
            self.turns
                .iter()
                .zip(&modes.turned)
                .map(|((sin, cos), turned)| (sin * turned.cos + cos * turned.sin, cos * turned.cos - sin * turned.sin)),
        );
    }
}
