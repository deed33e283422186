//! How the state of a structure moves through a time of one length.
//!
//! The modes, the forces that drive them and the harmonics together form a state $`z`$ with $`\dot z = Az`$: displacement,
//! velocity and force of each mode, cosine and sine of each harmonic, the time, and one. The state at the end of a time
//! $`H`$, $`e^{AH}z`$, is a product with numbers that are computed once.

use super::mode::{Mode, Turned};
use super::signal::Signal;
use crate::math::sin_cos;

/// What moves a structure: its modes, the forces on them and the harmonics.
#[derive(Clone, Copy)]
pub(crate) struct Moved<'a> {
    pub(crate) modes: &'a [Mode],
    pub(crate) drive: &'a [Signal],
    pub(crate) rates: &'a [f64],
}

impl Moved<'_> {
    /// Number of elements of the state.
    pub(crate) const fn elements(&self) -> usize {
        3 * self.modes.len() + 2 * self.rates.len() + 2
    }

    /// The fastest rate of the forcing.
    pub(super) fn rate(&self) -> f64 {
        self.rates.iter().copied().fold(0.0, f64::max)
    }
}

/// How a structure moves through a time of one length.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pub(crate) length: f64,
    steps: Vec<Step>,
    /// Mode after mode, for each harmonic: displacement from cosine and sine, velocity from cosine and sine.
    forced: Vec<[f64; 4]>,
    /// Sine and cosine of the turn of each harmonic.
    turns: Vec<(f64, f64)>,
    ramps: Vec<[f64; 3]>,
}

/// How a mode moves.
#[derive(Clone, Copy, Debug)]
struct Step {
    c: f64,
    s: f64,
    ks: f64,
    s_rate: f64,
    step: f64,
}

impl Pass {
    pub(super) fn new(of: Moved<'_>, length: f64) -> Self {
        let (mut steps, mut forced, mut ramps) = (Vec::new(), Vec::new(), Vec::new());
        for (mode, drive) in of.modes.iter().zip(of.drive) {
            let free = mode.free(length);
            let ks = mode.k * free.s;
            steps.push(Step { c: 1.0 - free.one_minus_c, s: free.s, ks, s_rate: free.s_rate, step: free.step });
            // what a ramp adds to displacement, velocity and force
            ramps.push([drive.ramp * free.ramp, drive.ramp * free.step, drive.ramp * length]);
            for (h, ((a, b), w)) in drive.harmonics.iter().zip(of.rates).enumerate() {
                // the harmonic by the cosine and by the sine of its phase at the beginning, as in `sampled`
                let (kc, ks, _) = mode.forced(h, length, &free, &Turned::of(w * length));
                let (kc_rate, ks_rate) = (free.s - w * ks, w * kc);
                forced.push([a * kc + b * ks, b * kc - a * ks, a * kc_rate + b * ks_rate, b * kc_rate - a * ks_rate]);
            }
        }
        // then `pass` has nothing to add
        if of.drive.iter().all(|drive| drive.ramp == 0.0) {
            ramps.clear();
        }
        Self { length, steps, forced, turns: of.rates.iter().map(|w| sin_cos(w * length)).collect(), ramps }
    }

    /// The state at the end.
    #[inline(always)]
    pub(crate) fn pass(&self, z: &mut [f64]) {
        let (modes, rest) = z.split_at_mut(3 * self.steps.len());
        let (modes, _) = modes.as_chunks_mut::<3>();
        let (turns, time) = rest.split_at_mut(2 * self.turns.len());
        let (turns, _) = turns.as_chunks_mut::<2>();
        let mut rest = self.forced.as_slice();
        for ([y, v, q], step) in modes.iter_mut().zip(&self.steps) {
            let mut moved = step.c * *y + step.s * *v + step.step * *q;
            let mut rate = step.s_rate * *v - step.ks * *y + step.s * *q;
            let (forced, next) = rest.split_at(turns.len());
            rest = next;
            for ([cos, sin], f) in turns.iter().zip(forced) {
                moved += f[0] * cos + f[1] * sin;
                rate += f[2] * cos + f[3] * sin;
            }
            // both from the state before
            (*y, *v) = (moved, rate);
        }
        // after the motion under the force at the beginning: a ramp changes the force itself too
        for ([y, v, q], ramp) in modes.iter_mut().zip(&self.ramps) {
            (*y, *v, *q) = (*y + ramp[0], *v + ramp[1], *q + ramp[2]);
        }
        for ([c, s], (sin, cos)) in turns.iter_mut().zip(&self.turns) {
            (*c, *s) = (*c * cos - *s * sin, *s * cos + *c * sin);
        }
        time[0] += self.length;
    }
}
