//! A structure at equal steps of the time: its guards there, bounds of what they do between, and their series over a step.
//!
//! Each mode is the sum of its steady response to the forcing and of a free part $`u`$, whose energy
//! $`E = \sqrt{\dot u^2 + ku^2}`$ does not grow, so $`|u^{(j)}| \le E\,r^{j-1}`$ with the rate $`r = \sqrt k + 2d`$. Hence a
//! bound $`B`$ of the second derivative of a guard, which lies no more than $`Bh^2/8`$ below the line between two samples.
//! A mode too near to a resonance has no steady response; its energy grows by at most the size of the force per unit of time.
//!
//! Guards at all steps of a span are products of the state with one table. In longer spans fast modes are faint (see
//! `window`).
//!
//! The search for a crossing is compiled for vectors of two and of four numbers; what it calls is inlined into both copies.

use super::pass::{Moved, Pass};
use super::signal::Observable;
use super::window::levels;
use crate::math::{fit, hypot};

/// Number of samples of a span.
pub(crate) const SAMPLES: usize = 16;
/// Number of powers in the series of a mode; a guard has one less.
pub(crate) const POWERS: usize = 13;
/// A step in radians of the fastest rate.
const STEP: f64 = 0.25;
/// A bound of the first derivative beyond the series of a guard, over its factorial, in parts of $`Bh^2`$:
/// $`12\,(rh)^{10}/12!`$.
pub(crate) const REST: f64 = 3e-14;
/// A steady response larger than the static one by more than this factor is near a resonance.
const RESONANT: f64 = 8.0;

/// A structure at equal steps of the time.
#[derive(Clone, Debug)]
pub(crate) struct Sampled {
    pub(crate) parts: Vec<Part>,
    /// Whether the energy of a free part can grow and bend a guard.
    pub(crate) grows: bool,
    /// Spans of all useful lengths, the shortest first, in which no mode is faint.
    pub(crate) spans: Vec<Span>,
    /// The series of the modes over a step of the shortest span, mode after mode: by displacement, velocity, force, and
    /// cosine and sine of each harmonic.
    series: Vec<[f64; POWERS]>,
    pub(crate) guards: Vec<GuardParts>,
}

/// What is needed for the energy of the free part of a mode.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    k: f64,
    /// The steady response to each harmonic, as factors of cosine and sine of displacement and velocity.
    response: Vec<[f64; 4]>,
    /// By how much the energy grows at most per unit of time, without that by a constant force on a loose mode.
    growth: f64,
    /// 1 for a mode without stiffness.
    loose: f64,
}

/// A span of steps of one length.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    pub(crate) step: f64,
    /// How the state moves through 1, 2, ... steps.
    passes: Vec<Pass>,
    pub(crate) guards: Vec<GuardSamples>,
}

/// What an element of the state adds to the samples of a guard. Rows that begin within a line of the cache would make every
/// second load of four numbers read two lines.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Row([f64; SAMPLES]);

/// A guard in a span.
#[derive(Clone, Debug)]
pub(crate) struct GuardSamples {
    /// Its samples for each element of the state.
    rows: Vec<Row>,
    /// What each mode adds per energy of its free part: to the bound of the second derivative, and to what faint modes can take away.
    bend: Vec<[f64; 2]>,
    /// What each mode without stiffness adds per force.
    bend_of_push: Vec<(usize, f64)>,
    constant: f64,
}

/// A guard: the factors of its modes, and the sizes of its terms for rounding errors.
#[derive(Clone, Debug)]
pub(crate) struct GuardParts {
    /// The modes with factors of displacement and velocity.
    factors: Vec<(usize, f64, f64)>,
    /// Its own harmonics over a step, by cosine and sine of each.
    harmonics: Vec<[f64; POWERS]>,
    /// The sizes of its terms per energy and per force.
    sizes: Vec<[f64; 2]>,
    loose: Vec<(usize, f64, f64)>,
    swing: f64,
}

impl Sampled {
    /// `None` without any rate, or where a ramp drives a mode or moves a guard.
    pub(super) fn new(of: Moved<'_>, guards: &[&Observable]) -> Option<Self> {
        // the tables leave out time and one, which only ramps need
        let ramps = of.drive.iter().chain(guards.iter().map(|guard| &guard.signal)).any(|signal| signal.ramp != 0.0);
        let levels = levels(of, false);
        let fastest = levels.first().map_or(0.0, |level| level.rate);
        if ramps || of.modes.is_empty() || fastest <= 0.0 {
            return None;
        }
        let parts: Vec<Part> = (0..of.modes.len()).map(|i| Part::new(of, i)).collect();
        let step = STEP / fastest;
        Some(Self {
            grows: parts.iter().zip(of.modes).any(|(part, mode)| part.growth + part.loose * mode.d > 0.0),
            spans: levels
                .iter()
                .map(|level| Span::new(of, guards, (&parts, &level.faint), STEP / level.rate))
                .collect(),
            series: (0..of.modes.len()).flat_map(|i| series(of, i, step)).collect(),
            guards: guards.iter().map(|guard| GuardParts::new(of, &parts, guard, step)).collect(),
            parts,
        })
    }

    /// The energies of the free parts of all modes at a state.
    #[inline(always)]
    pub(crate) fn energies(&self, z: &[f64], to: &mut Vec<f64>) {
        let (modes, turns) = z.split_at(3 * self.parts.len());
        let ((modes, _), (turns, _)) = (modes.as_chunks::<3>(), turns.as_chunks::<2>());
        fit(to, modes.len());
        for (to, (part, [y, v, q])) in to.iter_mut().zip(self.parts.iter().zip(modes)) {
            // the free part: less the equilibrium under the constant force and less the steady response
            let (mut u, mut rate) = (y - if part.k > 0.0 { q / part.k } else { 0.0 }, *v);
            for (r, [cos, sin]) in part.response.iter().zip(turns) {
                u -= r[0] * cos + r[1] * sin;
                rate -= r[2] * cos + r[3] * sin;
            }
            *to = (rate * rate + part.k * u * u).sqrt();
        }
    }

    /// Bounds of the energies a time `s` later.
    #[inline(always)]
    pub(crate) fn grown(&self, energies: &[f64], z: &[f64], s: f64, to: &mut Vec<f64>) {
        let (modes, _) = z.as_chunks::<3>();
        fit(to, energies.len());
        for (to, ((energy, part), mode)) in to.iter_mut().zip(energies.iter().zip(&self.parts).zip(modes)) {
            *to = energy + (part.growth + part.loose * mode[2].abs()) * s;
        }
    }

    /// The series of all modes over a step of the shortest span from a state.
    #[inline(always)]
    pub(crate) fn expand(&self, z: &[f64], to: &mut Vec<[f64; POWERS]>) {
        let (modes, turns) = z.split_at(3 * self.parts.len());
        let (modes, _) = modes.as_chunks::<3>();
        // time and one have no rows
        let turns = &turns[..turns.len() - 2];
        fit(to, modes.len());
        let mut rest = self.series.as_slice();
        for (mode, to) in modes.iter().zip(to) {
            let (own, next) = rest.split_at(3 + turns.len());
            let (free, forced) = own.split_at(3);
            rest = next;
            let mut sum = [0.0; POWERS];
            for (z, row) in mode.iter().zip(free) {
                add(&mut sum, *z, row);
            }
            for (z, row) in turns.iter().zip(forced) {
                add(&mut sum, *z, row);
            }
            *to = sum;
        }
    }
}

impl Part {
    fn new(of: Moved<'_>, i: usize) -> Self {
        let mode = &of.modes[i];
        let harmonics = || of.drive[i].harmonics.iter().zip(of.rates);
        // the factors of cosine and sine, of the displacement and, by its derivative, of the velocity
        let response: Vec<[f64; 4]> = harmonics()
            .map(|(force, w)| {
                // without a force the formula would give 0/0 at a resonance without damping
                let (x, y) = if *force == (0.0, 0.0) { (0.0, 0.0) } else { mode.steady(*w, *force) };
                [x, y, w * y, -w * x]
            })
            .collect();
        let size = |((a, b), _): (&(f64, f64), &f64)| hypot(*a, *b);
        let near = |(r, (force, w)): (&[f64; 4], (&(f64, f64), &f64))| {
            // the response without the resonance: held by the spring or, beyond it, by the mass
            let fixed = size((force, w)) / mode.k.max(w * w);
            let steady = hypot(r[0], r[1]);
            steady.is_nan() || steady > RESONANT * fixed
        };
        let loose = if mode.k > 0.0 { 0.0 } else { 1.0 };
        // near a resonance the whole force counts as one that feeds the energy of the free part
        if response.iter().zip(harmonics()).any(near) {
            let growth = harmonics().map(size).sum();
            return Self { k: mode.k, response: vec![[0.0; 4]; response.len()], growth, loose };
        }
        Self { k: mode.k, response, growth: 0.0, loose }
    }
}

impl Span {
    fn new(of: Moved<'_>, guards: &[&Observable], (parts, faint): (&[Part], &[usize]), step: f64) -> Self {
        let mut real = 0.0;
        let passes: Vec<Pass> = (1..SAMPLES)
            .map(|_| {
                real += 1.0;
                Pass::new(of, real * step)
            })
            .collect();
        let guards = guards.iter().map(|guard| GuardSamples::new(of, guard, (parts, faint), &passes)).collect();
        Self { step, passes, guards }
    }

    /// The state after a number of steps, at least one and less than [`SAMPLES`].
    #[inline(always)]
    pub(crate) fn pass(&self, steps: usize, z: &mut [f64]) {
        self.passes[steps - 1].pass(z);
    }
}

impl GuardSamples {
    fn new(of: Moved<'_>, guard: &Observable, (parts, faint): (&[Part], &[usize]), passes: &[Pass]) -> Self {
        // the functional of the state that is the guard; its products with the propagators are the table
        let first = 3 * of.modes.len();
        let mut row = vec![0.0; of.elements()];
        let mut waves = guard.signal.harmonics.clone();
        for (h, (a, b)) in guard.signal.harmonics.iter().enumerate() {
            (row[first + 2 * h], row[first + 2 * h + 1]) = (*a, *b);
        }
        let fastest = of.modes.iter().map(|mode| mode.rate).fold(of.rate(), f64::max);
        let mut samples =
            Self { rows: Vec::new(), bend: vec![[0.0; 2]; parts.len()], bend_of_push: Vec::new(), constant: 0.0 };
        for (i, (part, mode)) in parts.iter().zip(of.modes).enumerate() {
            let (a, b) = (guard.position[i], guard.velocity[i]);
            let is_faint = faint.contains(&i);
            // `waves` are the guard's harmonics with the steady responses: their bend does not depend on the free parts
            for (h, (wave, r)) in waves.iter_mut().zip(&part.response).enumerate() {
                let (cos, sin) = (a * r[0] + b * r[2], a * r[1] + b * r[3]);
                (wave.0, wave.1) = (wave.0 + cos, wave.1 + sin);
                if is_faint {
                    row[first + 2 * h] += cos;
                    row[first + 2 * h + 1] += sin;
                }
            }
            // of a faint mode the row has the steady response only; the energy bounds what the free part takes away
            if is_faint {
                row[3 * i + 2] = a / part.k;
                samples.bend[i][1] = a.abs() / mode.omega + b.abs();
                continue;
            }
            (row[3 * i], row[3 * i + 1]) = (a, b);
            // by |u''| <= Er for the displacement and |u'''| <= Er^2 for the velocity
            samples.bend[i][0] = (a.abs() + b.abs() * mode.rate) * mode.rate;
            // a force beside the steady response bends u'' by its size, and u''' by its rate and by the mode's
            samples.constant += (a.abs() + 2.0 * b.abs() * fastest) * part.growth;
            if part.loose > 0.0 {
                samples.bend_of_push.push((i, a.abs() + b.abs() * mode.rate));
            }
        }
        samples.constant += waves.iter().zip(of.rates).map(|((a, b), w)| w * w * hypot(*a, *b)).sum::<f64>();
        // the zeros at the end of the row cost nothing
        let used = row.iter().rposition(|value| *value != 0.0).map_or(0, |last| last + 1);
        // a column for each element of the state: the guard of a unit of it after 0, 1, 2, ... steps
        samples.rows = (0..of.elements() - 2)
            .map(|element| {
                let mut of_element = [0.0; SAMPLES];
                for (j, value) in of_element.iter_mut().enumerate() {
                    let mut z = vec![0.0; row.len()];
                    z[element] = 1.0;
                    if j > 0 {
                        passes[j - 1].pass(&mut z);
                    }
                    *value = crate::math::dot(&row[..used], &z[..used]);
                }
                Row(of_element)
            })
            .collect();
        samples
    }

    /// The samples from a state on, with `constant` added.
    #[inline(always)]
    pub(crate) fn at(&self, z: &[f64], constant: f64, to: &mut [f64; SAMPLES]) {
        let mut samples = [constant; SAMPLES];
        for (row, z) in self.rows.iter().zip(z) {
            add(&mut samples, *z, &row.0);
        }
        *to = samples;
    }

    /// A bound of the second derivative, and of what faint modes can take away, for energies of the free parts.
    #[inline(always)]
    pub(crate) fn bend(&self, energies: &[f64], z: &[f64]) -> (f64, f64) {
        let (mut bend, mut lowered) = (self.constant, 0.0);
        for (factor, energy) in self.bend.iter().zip(energies) {
            bend += factor[0] * energy;
            lowered += factor[1] * energy;
        }
        for (i, factor) in &self.bend_of_push {
            bend += factor * z[3 * i + 2].abs();
        }
        (bend, lowered)
    }
}

impl GuardParts {
    fn new(of: Moved<'_>, parts: &[Part], guard: &Observable, step: f64) -> Self {
        let mut own = Self {
            factors: Vec::new(),
            harmonics: Vec::new(),
            sizes: vec![[0.0; 2]; parts.len()],
            loose: Vec::new(),
            swing: guard.signal.harmonics.iter().map(|(a, b)| hypot(*a, *b)).sum(),
        };
        for (i, (part, mode)) in parts.iter().zip(of.modes).enumerate() {
            let (a, b) = (guard.position[i], guard.velocity[i]);
            if a != 0.0 || b != 0.0 {
                own.factors.push((i, a, b / step));
            }
            own.swing +=
                part.response.iter().map(|r| a.abs() * hypot(r[0], r[1]) + b.abs() * hypot(r[2], r[3])).sum::<f64>();
            // displacements and velocities are counted from the beginning: they differ by at most twice their
            // amplitudes
            let (a, b) = (2.0 * a.abs(), 2.0 * b.abs());
            if mode.k > 0.0 {
                own.sizes[i] = [a / mode.omega + b, a / mode.k + b / mode.omega];
            } else {
                own.loose.push((i, a, b));
            }
        }
        // the rows of a guard without harmonics would add nothing
        for ((a, b), w) in guard.signal.harmonics.iter().zip(of.rates).filter(|_| guard.signal.moves()) {
            // a cos (theta + ws) + b sin (theta + ws) by cos theta and by sin theta at the beginning of the
            // step
            own.harmonics.extend([harmonic((*a, *b), w * step), harmonic((*b, -a), w * step)]);
        }
        own
    }

    /// The size of its terms within a time `s` of the beginning `z` of a flight.
    #[inline(always)]
    pub(crate) fn size(&self, energies: &[f64], z: &[f64], s: f64) -> f64 {
        let mut size = self.swing;
        let (modes, _) = z.as_chunks::<3>();
        for ((factor, energy), mode) in self.sizes.iter().zip(energies).zip(modes) {
            size += factor[0] * energy + factor[1] * mode[2].abs();
        }
        for (i, a, b) in &self.loose {
            // a free body: its speed grows with the force
            let gained = s * z[3 * i + 2].abs();
            size += a * s * (energies[*i] + gained) + b * (energies[*i] + gained);
        }
        size
    }

    /// Its series over a step of the shortest span, without its constant part, from those of the modes; `turns` are cosine and
    /// sine of each harmonic.
    #[inline(always)]
    pub(crate) fn series(&self, modes: &[[f64; POWERS]], turns: &[f64]) -> [f64; POWERS - 1] {
        let mut sum = [0.0; POWERS];
        for (row, turn) in self.harmonics.iter().zip(turns) {
            add(&mut sum, *turn, row);
        }
        for (i, a, b) in &self.factors {
            let mode = &modes[*i];
            add(&mut sum, *a, mode);
            // the series of the velocity is the derivative; its last coefficient is not known, so a guard has one less
            if *b != 0.0 {
                let mut k = 0.0;
                for (sum, c) in sum.iter_mut().zip(&mode[1..]) {
                    k += 1.0;
                    *sum += b * k * c;
                }
            }
        }
        let mut guard = [0.0; POWERS - 1];
        guard.copy_from_slice(&sum[..POWERS - 1]);
        guard
    }
}

/// Adds a multiple of a row.
#[inline(always)]
#[allow(clippy::needless_range_loop)] // arrays of one length, so that vector instructions are used
fn add<const N: usize>(sum: &mut [f64; N], factor: f64, row: &[f64; N]) {
    for k in 0..N {
        sum[k] += factor * row[k];
    }
}

/// The Taylor coefficients of $`a\cos ws + b\sin ws`$ over a step in which it turns by `turn`.
fn harmonic((a, b): (f64, f64), turn: f64) -> [f64; POWERS] {
    let mut c = [0.0; POWERS];
    let (mut now, mut next, mut k) = (a, turn * b, 1.0);
    // the second derivative is -w^2 times the function: each coefficient from that two before
    for value in &mut c {
        *value = now;
        (now, next) = (next, -turn * turn * now / (k * (k + 1.0)));
        k += 1.0;
    }
    c
}

/// The Taylor coefficients of a mode over a step, by each element of the state that moves it.
fn series(of: Moved<'_>, i: usize, step: f64) -> Vec<[f64; POWERS]> {
    let mode = &of.modes[i];
    let moved = |y: f64, v: f64, push: &[f64; POWERS]| {
        let mut c = [0.0; POWERS];
        (c[0], c[1]) = (y, v * step);
        let mut k = 0.0;
        for j in 2..POWERS {
            // y'' + 2dy' + ky = q, power by power, in parts of the step
            let pull = 2.0 * mode.d * step * (k + 1.0) * c[j - 1] + mode.k * step * step * c[j - 2];
            c[j] = (push[j - 2] * step * step - pull) / ((k + 1.0) * (k + 2.0));
            k += 1.0;
        }
        c
    };
    let none = [0.0; POWERS];
    let mut constant = none;
    constant[0] = 1.0;
    // in the order of the state: displacement, velocity, force
    let mut rows = vec![moved(1.0, 0.0, &none), moved(0.0, 1.0, &none), moved(0.0, 0.0, &constant)];
    for ((a, b), w) in of.drive[i].harmonics.iter().zip(of.rates) {
        for force in [(*a, *b), (*b, -*a)] {
            rows.push(moved(0.0, 0.0, &harmonic(force, w * step)));
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::regime::mode::Mode;
    use crate::regime::signal::Signal;

    /// Samples are values of the guard at states that have passed; the series over a step leads from one to the next; no
    /// second difference is beyond the bound, and faint modes lower the guard by no less than they move.
    #[test]
    fn samples_series_and_bounds_agree() {
        let rates = [0.7, 1.4];
        let signal = |size: f64| {
            let mut signal = Signal::zero(0, 2);
            signal.harmonics = vec![(size, -0.3 * size), (0.2, 0.1 * size)];
            signal
        };
        // the third is resonant
        let modes: Vec<Mode> = [(0.0, 0.0), (0.0, 0.2), (1.96, 0.0), (2.2, 1.6), (400.0, 0.3)]
            .iter()
            .map(|(k, d)| Mode::new(*k, *d, &rates))
            .collect();
        let drive: Vec<Signal> = (0..5).map(|i| signal(0.4 - 0.1 * f64::from(i))).collect();
        let mut guard = Observable::zero(5, 0, 2);
        guard.position = vec![0.5, -0.3, 1.0, 0.7, 0.2];
        guard.velocity = vec![0.0, 0.1, 0.0, -0.2, 0.01];
        guard.signal = signal(0.6);
        let of = Moved { modes: &modes, drive: &drive, rates: &rates };
        let sampled = Sampled::new(of, &[&guard]).unwrap();
        assert_eq!(sampled.spans.len(), 2);
        assert!(sampled.grows && sampled.parts[2].growth > 0.0 && sampled.parts[3].growth == 0.0);
        let mut begin: Vec<f64> =
            (0..of.elements()).map(|i| 0.3 - 0.07 * [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0][i % 9]).collect();
        (begin[15], begin[16], begin[17], begin[18]) = (0.6, 0.8, 0.28, -0.96);
        let value = |span: &Span, z: &[f64]| {
            let mut samples = [0.0; SAMPLES];
            span.guards[0].at(z, 0.0, &mut samples);
            samples
        };
        let (mut first, mut energies, mut series) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..60 {
            sampled.energies(&begin, &mut first);
            for (level, span) in sampled.spans.iter().enumerate() {
                let samples = value(span, &begin);
                sampled.grown(&first, &begin, 15.0 * span.step, &mut energies);
                let (bend, lowered) = span.guards[0].bend(&energies, &begin);
                for j in 1..SAMPLES {
                    let mut there = begin.clone();
                    span.pass(j, &mut there);
                    assert!((value(span, &there)[0] - samples[j]).abs() < 1e-13 * (1.0 + samples[j].abs()));
                    assert!(
                        (value(&sampled.spans[0], &there)[0] - samples[j]).abs() <= lowered + 1e-13,
                        "level {level}"
                    );
                    if j + 1 < SAMPLES {
                        let second = samples[j - 1] - 2.0 * samples[j] + samples[j + 1];
                        assert!(second.abs() <= bend * span.step * span.step + 1e-13, "{second} {bend}");
                    }
                }
            }
            sampled.expand(&begin, &mut series);
            let c = sampled.guards[0].series(&series, &begin[15..19]);
            let samples = value(&sampled.spans[0], &begin);
            assert!((c[0] - samples[0]).abs() < 1e-14 && (c.iter().sum::<f64>() - samples[1]).abs() < 1e-14);
            sampled.spans[1].pass(7, &mut begin);
        }
    }
}
