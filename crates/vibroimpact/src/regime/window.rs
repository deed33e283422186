//! A structure over windows of one length: how its state moves through one, and the Taylor series of its guards.
//!
//! The modes, the forces that drive them and the harmonics together form a state $`z`$ with $`\dot z = Az`$. So the state at
//! the end of a window, $`e^{AH}z`$, and the coefficients of a guard $`g\cdot z`$ in powers of the part of the window that
//! has passed, $`g A^k z\,H^k/k!`$, are products with numbers that are computed once.
//!
//! **Faint modes.** In a long window the fast modes are not expanded. Such a mode is the sum of its steady response to the
//! forcing, which is as slow as the forcing, and of a free part whose energy does not grow: an interval, by which the
//! guard may be lower.
//!
//! Of a mode far beyond critical damping, as that of a small mass between a spring and a damper, the free part is the sum of a
//! slow and of a fast decay, $`u = U_1 e^{-\lambda_1 s} + U_2 e^{-\lambda_2 s}`$. Only the fast one is faint: the slow one is
//! expanded.

use super::bernstein::TERMS;
use super::mode::Mode;
use super::pass::Moved;
use super::signal::Observable;
use crate::math::{hypot, sort_by};

/// Eight powers are expanded; the ninth is the remainder.
const ORDER: usize = TERMS - 1;
/// The window in radians of the fastest rate: the bound of the remainder is about 1e-4 of the motion.
pub(crate) const REACH: f64 = 1.6;
/// Each longer window leaves out modes until the fastest rate that remains is below this part of the one before.
const SLOWER: f64 = 0.7;
/// A faint mode is so many times faster than all harmonics, at least.
const FAR: f64 = 2.0;
/// From one window to the next the length grows by no more than this factor, where a fast decay is faint.
const LONGER: f64 = 8.0;

/// A structure over windows of one length.
#[derive(Clone, Debug)]
pub(crate) struct Window {
    pub(crate) length: f64,
    pub(crate) guards: Vec<GuardSeries>,
    pub(crate) faint: Vec<Faint>,
}

/// The series of a guard, and the bound of its remainder.
#[derive(Clone, Debug)]
pub(crate) struct GuardSeries {
    /// The coefficients for each element of the state.
    rows: Vec<[f64; TERMS]>,
    /// What each mode adds to the remainder per energy and per force on it, and what all harmonics add.
    weights: Vec<(f64, f64)>,
    constant: f64,
    /// What the energies of the free parts of faint modes can take away.
    faint: Vec<f64>,
}

/// A mode that is not expanded.
#[derive(Clone, Debug)]
pub(crate) struct Faint {
    mode: usize,
    k: f64,
    rates: Vec<f64>,
    /// Its steady response to each harmonic, as factors of cosine and sine.
    response: Vec<(f64, f64)>,
    /// The slow and the fast decay, if only the fast one is faint.
    decays: Option<(f64, f64)>,
}

/// What is faint in windows of one length: whole modes, and the fast decays of modes; and the fastest rate of the others and of
/// the forcing.
struct Level {
    faint: Vec<usize>,
    decaying: Vec<usize>,
    rate: f64,
}

/// The levels of windows of all useful lengths.
fn window_levels(of: Moved<'_>) -> Vec<Level> {
    // rate, mode, whether only its fast decay is left out
    let mut parts: Vec<(f64, usize, bool)> = Vec::new();
    for (i, mode) in of.modes.iter().enumerate() {
        match mode.decays.filter(|(_, fast)| *fast >= FAR * of.rate() && of.drive[i].ramp == 0.0) {
            Some((slow, _)) => parts.extend([(mode.rate, i, true), (slow, i, false)]),
            None => parts.push((mode.rate, i, false)),
        }
    }
    if !parts.iter().any(|(.., decaying)| *decaying) {
        return levels(of).into_iter().map(|(faint, rate)| Level { faint, decaying: Vec::new(), rate }).collect();
    }
    sort_by(&mut parts, |one, other| one.0.total_cmp(&other.0));
    let mut all: Vec<Level> = Vec::new();
    let mut level = Level { faint: Vec::new(), decaying: Vec::new(), rate: 0.0 };
    // from the fastest part on, one part after another is left out, until one has to stay in all windows
    loop {
        let rate = parts.last().map_or(0.0, |(rate, ..)| *rate).max(of.rate());
        let last = all.last().map_or(f64::INFINITY, |level| level.rate);
        if all.is_empty() || (rate > 0.0 && rate <= SLOWER * last) {
            // not to fall from a long window to a very short one before each event
            let mut between = last / LONGER;
            while between.is_finite() && between > SLOWER * LONGER * rate {
                let (faint, decaying) = (level.faint.clone(), level.decaying.clone());
                all.push(Level { faint, decaying, rate: between });
                between /= LONGER;
            }
            let (faint, decaying) = (level.faint.clone(), level.decaying.clone());
            all.push(Level { faint, decaying, rate });
        }
        let Some((_, i, decaying)) = parts.pop() else { break };
        let mode = &of.modes[i];
        if decaying {
            level.decaying.push(i);
        // its slow decay is expanded, not bounded; without stiffness, near the forcing or under a ramp it has no slow
        // steady response and a bounded free part
        } else if level.decaying.contains(&i)
            || mode.k <= 0.0
            || mode.omega < FAR * of.rate()
            || of.drive[i].ramp != 0.0
        {
            break;
        } else {
            level.faint.push(i);
        }
    }
    all
}

impl Moved<'_> {
    /// The functional that has the derivative of a functional of the state.
    fn derivative(&self, of: &[f64]) -> Vec<f64> {
        let mut to = vec![0.0; of.len()];
        let (at_time, at_one) = (of.len() - 2, of.len() - 1);
        let harmonics = 3 * self.modes.len();
        // time has the rate one
        to[at_one] = of[at_time];
        for (i, mode) in self.modes.iter().enumerate() {
            // y' = v and v' = q + a cos + b sin - ky - 2dv for all harmonics, read backwards: what reads v reads all of
            // these
            let (y, v, q) = (of[3 * i], of[3 * i + 1], of[3 * i + 2]);
            to[3 * i] -= mode.k * v;
            to[3 * i + 1] += y - 2.0 * mode.d * v;
            to[3 * i + 2] += v;
            to[at_one] += q * self.drive[i].ramp;
            for (h, (a, b)) in self.drive[i].harmonics.iter().enumerate() {
                to[harmonics + 2 * h] += v * a;
                to[harmonics + 2 * h + 1] += v * b;
            }
        }
        for (h, w) in self.rates.iter().enumerate() {
            // cos' = -w sin and sin' = w cos
            let (c, s) = (of[harmonics + 2 * h], of[harmonics + 2 * h + 1]);
            to[harmonics + 2 * h] += w * s;
            to[harmonics + 2 * h + 1] -= w * c;
        }
        to
    }
}

/// Windows of all useful lengths, the shortest first, in which no mode is faint.
pub(crate) fn windows(of: Moved<'_>, guards: &[&Observable]) -> Vec<Window> {
    window_levels(of).iter().map(|level| Window::new(of, guards, level)).collect()
}

/// The modes that are faint, and the fastest rate of the others and of the forcing, in windows of all useful lengths.
pub(super) fn levels(of: Moved<'_>) -> Vec<(Vec<usize>, f64)> {
    let mut order: Vec<usize> = (0..of.modes.len()).collect();
    sort_by(&mut order, |i, j| of.modes[*i].rate.total_cmp(&of.modes[*j].rate));
    let mut all = Vec::new();
    let mut last = f64::INFINITY;
    for kept in (0..=order.len()).rev() {
        if let Some(left) = order.get(kept) {
            let mode = &of.modes[*left];
            // such a mode has no steady response as slow as the forcing: it, and all slower ones, stay in every window
            if mode.k <= 0.0 || mode.omega < FAR * of.rate() || of.drive[*left].ramp != 0.0 {
                break;
            }
        }
        let rate = order[..kept].last().map_or(0.0, |i| of.modes[*i].rate).max(of.rate());
        if all.is_empty() || (rate > 0.0 && rate <= SLOWER * last) {
            last = rate;
            all.push((order[kept..].to_vec(), rate));
        }
    }
    all
}

impl Window {
    fn new(of: Moved<'_>, guards: &[&Observable], level: &Level) -> Self {
        // without any rate the guards are polynomials of low order; a window must still be finite
        let length = if level.rate > 0.0 { REACH / level.rate } else { 1.0 };
        let whole = level.faint.iter().map(|i| Faint::new(of, *i, None));
        let decaying = level.decaying.iter().map(|i| Faint::new(of, *i, of.modes[*i].decays));
        let faint: Vec<Faint> = whole.chain(decaying).collect();
        Self { length, guards: guards.iter().map(|guard| GuardSeries::new(of, guard, &faint, length)).collect(), faint }
    }

    /// Whether fast decays of modes are all that is faint in it.
    pub(crate) fn leaves_out_decays(&self) -> bool {
        !self.faint.is_empty() && self.faint.iter().all(|faint| faint.decays.is_some())
    }
}

impl GuardSeries {
    fn new(of: Moved<'_>, guard: &Observable, faint: &[Faint], length: f64) -> Self {
        let harmonics = 3 * of.modes.len();
        let is_faint = |i: usize| faint.iter().find(|faint| faint.mode == i);
        let mut row = vec![0.0; of.elements()];
        let count = of.rates.len();
        row[harmonics + 2 * count] = guard.signal.ramp;
        for (h, (a, b)) in guard.signal.harmonics.iter().enumerate() {
            (row[harmonics + 2 * h], row[harmonics + 2 * h + 1]) = (*a, *b);
        }
        // the ninth term of each harmonic
        let mut constant: f64 =
            guard.signal.harmonics.iter().zip(of.rates).map(|((a, b), w)| hypot(*a, *b) * power(w * length)).sum();
        let mut weights = vec![(0.0, 0.0); of.modes.len()];
        let mut lost = Vec::with_capacity(faint.len());
        for (i, mode) in of.modes.iter().enumerate() {
            let (a, b) = (guard.position[i], guard.velocity[i]);
            if let Some(faint) = is_faint(i) {
                // the steady response, which is as slow as the forcing, is all that is expanded of a faint mode
                row[3 * i + 2] = a / faint.k;
                for (h, (x, y)) in faint.response.iter().enumerate() {
                    let w = of.rates[h];
                    row[harmonics + 2 * h] += a * x + b * w * y;
                    row[harmonics + 2 * h + 1] += a * y - b * w * x;
                    let size = hypot(a * x, a * y) + w * hypot(b * x, b * y);
                    constant += size * power(w * length);
                }
                if let Some((slow, fast)) = faint.decays {
                    // the ninth power of the slow decay, by the energy and by the steady response
                    let ninth = (a - b * slow).abs() * power(slow * length) / (fast - slow);
                    weights[i].0 = ninth * (1.0 + fast / mode.omega);
                    let steady = faint.response.iter().zip(of.rates).map(|((x, y), w)| (w + fast) * hypot(*x, *y));
                    constant += ninth * steady.sum::<f64>();
                }
                continue;
            }
            (row[3 * i], row[3 * i + 1]) = (a, b);
            let bounds = Bounds::new(&of, i, length);
            // the ninth coefficient of the velocity is this times the tenth of the displacement
            let rate = 10.0 / length;
            let sum = |(ninth, tenth): (f64, f64)| a.abs() * ninth + b.abs() * rate * tenth;
            weights[i] = (sum(bounds.energy), sum(bounds.push));
            constant += sum(bounds.constant);
        }
        // the most that a free part takes away: the displacement is at most E/sqrt(k), the velocity at most E; of a
        // fast decay by its rate
        for faint in faint {
            let (a, b) = (guard.position[faint.mode], guard.velocity[faint.mode]);
            lost.push(match faint.decays {
                Some((_, fast)) => (a - b * fast).abs(),
                None => a.abs() / faint.k.sqrt() + b.abs(),
            });
        }
        // g A^k H^k / k!, one derivative after another
        let mut rows = vec![[0.0; TERMS]; row.len()];
        let (mut size, mut k) = (1.0, 1.0);
        for order in 0..ORDER {
            for (to, value) in rows.iter_mut().zip(&row) {
                to[order] = size * value;
            }
            row = of.derivative(&row);
            size *= length / k;
            k += 1.0;
        }
        for faint in faint {
            faint.add_slow(&mut rows, (guard.position[faint.mode], guard.velocity[faint.mode]), length);
        }
        // prescribed functions of time are rare: their elements are the last
        let used = rows.iter().rposition(|row| row.iter().any(|value| *value != 0.0)).map_or(0, |last| last + 1);
        rows.truncate(used);
        Self { rows, weights, constant, faint: lost }
    }

    /// The coefficients at a state, without the remainder, which is in the last place of none.
    pub(crate) fn at(&self, z: &[f64]) -> [f64; TERMS] {
        let mut p = [0.0; TERMS];
        for (row, z) in self.rows.iter().zip(z) {
            add(&mut p, *z, row);
        }
        p
    }

    /// The size of the terms of a coefficient.
    pub(crate) fn size(&self, z: &[f64], order: usize) -> f64 {
        self.rows.iter().zip(z).map(|(row, z)| (row[order] * z).abs()).sum()
    }

    /// A bound of the remainder over the window, for the energies of the modes.
    pub(crate) fn remainder(&self, energies: &[f64], z: &[f64]) -> f64 {
        let modes = self.weights.iter().zip(energies).zip(z.chunks_exact(3));
        self.constant + modes.map(|((weight, energy), z)| weight.0 * energy + weight.1 * z[2].abs()).sum::<f64>()
    }

    /// By how much fast decays can lower the guard within a window of this length, if they have no part in its first $`n`$
    /// derivatives.
    pub(crate) fn lowered_by_decays(&self, faint: &[Faint], z: &[f64], (n, length): (usize, f64)) -> f64 {
        let lost = self.faint.iter().zip(faint).filter_map(|(factor, faint)| {
            let (_, fast) = faint.decays?;
            // the remainder of e^{-lambda t} after n terms is at most (lambda t)^n/n!
            let (mut share, mut k) = (1.0, 1.0);
            for _ in 0..n {
                share *= fast * length / k;
                k += 1.0;
            }
            Some(factor * faint.energy(z) * share)
        });
        lost.sum()
    }

    /// By how much the guard can fall because of the free parts of modes that are faint altogether, from where it is.
    pub(crate) fn lowered_by_modes(&self, faint: &[Faint], z: &[f64]) -> f64 {
        let modes = self.faint.iter().zip(faint).filter(|(_, faint)| faint.decays.is_none());
        // from one end of their range to the other
        2.0 * modes.map(|(factor, faint)| factor * faint.energy(z)).sum::<f64>()
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

/// $`x^9/9!`$.
fn power(x: f64) -> f64 {
    let (mut product, mut k) = (1.0, 1.0);
    for _ in 0..ORDER {
        product *= x / k;
        k += 1.0;
    }
    product
}

impl Faint {
    fn new(of: Moved<'_>, mode: usize, decays: Option<(f64, f64)>) -> Self {
        let own = &of.modes[mode];
        let response = of.drive[mode].harmonics.iter().zip(of.rates).map(|(amplitudes, w)| own.steady(*w, *amplitudes));
        Self { mode, k: own.k, rates: of.rates.to_vec(), response: response.collect(), decays }
    }

    /// Adds the series of the slow decay of a mode with these factors of displacement and velocity, if only the fast one is
    /// faint: $`U_1 = (\dot u + \lambda_2u)/(\lambda_2 - \lambda_1)`$.
    fn add_slow(&self, rows: &mut [[f64; TERMS]], (a, b): (f64, f64), length: f64) {
        let Some((slow, fast)) = self.decays else { return };
        let harmonics = rows.len() - 2 - 2 * self.rates.len();
        // the factor of the decay in the guard: its velocity is minus the rate times it
        let mut c = (a - b * slow) / (fast - slow);
        for (order, k) in (0..ORDER).zip(1_u32..) {
            rows[3 * self.mode][order] += c * fast;
            rows[3 * self.mode + 1][order] += c;
            rows[3 * self.mode + 2][order] -= c * fast / self.k;
            for (h, ((x, y), w)) in self.response.iter().zip(&self.rates).enumerate() {
                rows[harmonics + 2 * h][order] -= c * (fast * x + w * y);
                rows[harmonics + 2 * h + 1][order] -= c * (fast * y - w * x);
            }
            c *= -slow * length / f64::from(k);
        }
    }

    /// $`\sqrt{\dot u^2 + ku^2}`$ of the free part $`u`$ at a state; $`|U_2|`$ if only the fast decay is faint.
    pub(crate) fn energy(&self, z: &[f64]) -> f64 {
        let harmonics = &z[z.len() - 2 - 2 * self.rates.len()..];
        let (mut u, mut rate) = (z[3 * self.mode] - z[3 * self.mode + 2] / self.k, z[3 * self.mode + 1]);
        for (h, (x, y)) in self.response.iter().enumerate() {
            let (cos, sin) = (harmonics[2 * h], harmonics[2 * h + 1]);
            u -= x * cos + y * sin;
            rate -= self.rates[h] * (y * cos - x * sin);
        }
        match self.decays {
            Some((slow, fast)) => (rate + slow * u).abs() / (fast - slow),
            None => (rate * rate + self.k * u * u).sqrt(),
        }
    }
}

/// Bounds of $`|y^{(9)}|H^9/9!`$ and $`|y^{(10)}|H^{10}/10!`$ of a mode over a window of length $`H`$, per energy at its
/// beginning, per constant force on a mode without stiffness, and by ramps and harmonics.
struct Bounds {
    energy: (f64, f64),
    push: (f64, f64),
    constant: (f64, f64),
}

impl Bounds {
    fn new(of: &Moved<'_>, i: usize, window: f64) -> Self {
        let mode = &of.modes[i];
        let ramp = of.drive[i].ramp.abs();
        // |p^(k)| window^k / k!
        let mut pushed = [0.0; ORDER];
        for ((a, b), w) in of.drive[i].harmonics.iter().zip(of.rates) {
            add_harmonic(&mut pushed, hypot(*a, *b), w * window);
        }
        pushed[0] += ramp * window;
        pushed[1] += ramp * window;
        let still = [0.0; ORDER];
        let loose = if mode.k > 0.0 { 0.0 } else { 1.0 };
        Self {
            energy: derivative_bounds(mode, window, 1.0, 0.0, &still),
            push: derivative_bounds(mode, window, 0.0, loose, &still),
            constant: derivative_bounds(mode, window, 0.0, pushed[0], &pushed),
        }
    }
}

/// Adds the bounds $`|p^{(k)}|H^k/k!`$ of a harmonic of this size that turns by `turn` over the window.
pub(crate) fn add_harmonic(pushed: &mut [f64; ORDER], mut size: f64, turn: f64) {
    let mut k = 1.0;
    for place in pushed {
        *place += size;
        size *= turn / k;
        k += 1.0;
    }
}

/// Bounds of $`|y^{(9)}|H^9/9!`$ and $`|y^{(10)}|H^{10}/10!`$, from the energy at the beginning, a bound `push` of all forces
/// and the bounds `pushed` of $`|p^{(k)}|H^k/k!`$, by
/// $`|y^{(k+2)}| \le 2d\,|y^{(k+1)}| + k\,|y^{(k)}| + |p^{(k)}|`$.
pub(crate) fn derivative_bounds(mode: &Mode, window: f64, energy: f64, push: f64, pushed: &[f64; ORDER]) -> (f64, f64) {
    let speed = energy + push * window;
    let square = window * window;
    let (mut one, mut two) = (0.0, speed * window);
    let mut three = 0.5 * square * (2.0 * mode.d * speed + mode.omega * speed + push);
    let mut k = 1.0;
    for place in &pushed[1..] {
        // from w_k, w_{k+1} to w_{k+2}
        (one, two) = (two, three);
        three = (2.0 * mode.d * window * (k + 1.0) * two + mode.k * square * one + square * place)
            / ((k + 1.0) * (k + 2.0));
        k += 1.0;
    }
    let _ = one;
    (two, three)
}

#[cfg(test)]
mod tests {
    use super::super::pass::Pass;
    use super::*;
    use crate::regime::Signal;

    /// The slow decay of a mode far beyond critical damping is expanded in long windows, and the fast one lowers the guard by no
    /// less than it moves.
    #[test]
    fn fast_decays_are_faint() {
        let rates = [0.7, 1.4];
        let mut drive = Signal::zero(0, 2);
        drive.harmonics = vec![(4e6, -1e6), (2e5, 1e5)];
        let modes = [Mode::new(5e6, 3.5e5, &rates), Mode::new(1.0, 0.05, &rates)];
        let mut gentle = drive.clone();
        gentle.harmonics = vec![(0.4, -0.1), (0.02, 0.1)];
        let drive = [drive, gentle];
        let mut guard = Observable::zero(2, 0, 2);
        (guard.position, guard.velocity) = (vec![0.8, -0.5], vec![1e-4, 0.1]);
        let of = Moved { modes: &modes, drive: &drive, rates: &rates };
        let all = windows(of, &[&guard]);
        let long = all.last().unwrap();
        assert!(all.len() > 5 && long.length > 0.1 && long.faint.len() == 1, "{} {}", all.len(), long.length);
        let mut z = vec![0.4, -0.3, 2e6, -0.2, 0.5, 0.3, 0.6, 0.8, 0.28, -0.96, 0.9, 1.0];
        // at first, and after the fast decay
        for k in 0..12 {
            let mut end = z.clone();
            Pass::new(of, long.length).pass(&mut end);
            let value = all[0].guards[0].at(&end)[0];
            let sum: f64 = long.guards[0].at(&z).iter().sum();
            let [lowered, at_end] =
                [&z, &end].map(|z| long.guards[0].lowered_by_decays(&long.faint, z, (0, long.length)));
            // the ninth power is left out
            assert!((sum - value).abs() <= at_end + 1e-4, "{k}: {sum} {value} {at_end}");
            assert!((long.guards[0].at(&z)[0] - all[0].guards[0].at(&z)[0]).abs() <= lowered * (1.0 + 1e-9) + 1e-12);
            z = end;
        }
    }

    /// The series of a guard at one state, summed at the end of the window, is its value at the state there but for its remainder; and faint modes
    /// lower it by no less than they move.
    #[test]
    fn the_series_and_the_passed_state_agree() {
        let rates = [0.7, 1.4];
        let signal = |ramp: f64, size: f64| {
            let mut signal = Signal::zero(0, 2);
            signal.ramp = ramp;
            signal.harmonics = vec![(size, -0.3 * size), (0.2, 0.1 * size)];
            signal
        };
        let modes: Vec<Mode> = [(0.0, 0.0), (0.0, 0.2), (1.0, 0.01), (2.2, 1.6), (400.0, 0.3)]
            .iter()
            .map(|(k, d)| Mode::new(*k, *d, &rates))
            .collect();
        let drive: Vec<Signal> =
            [0.1, 0.0, 0.0, 0.3, 0.0].iter().enumerate().map(|(i, ramp)| signal(*ramp, 0.4 - 0.1 * i as f64)).collect();
        let mut guard = Observable::zero(5, 0, 2);
        guard.position = vec![0.5, -0.3, 1.0, 0.7, 0.2];
        guard.velocity = vec![0.0, 0.1, 0.0, -0.2, 0.01];
        guard.signal = signal(0.2, 0.6);
        let of = Moved { modes: &modes, drive: &drive, rates: &rates };
        let all = windows(of, &[&guard]);
        assert_eq!(all.iter().map(|window| window.faint.len()).collect::<Vec<_>>(), [0, 1]);
        let mut begin: Vec<f64> = (0..of.elements()).map(|i| 0.3 - 0.07 * (i % 9) as f64).collect();
        let from = 15;
        (begin[from], begin[from + 1], begin[from + 2], begin[from + 3]) = (0.6, 0.8, 0.28, -0.96);
        (begin[from + 4], begin[from + 5]) = (0.9, 1.0);
        let exact = &all[0].guards[0];
        for _ in 0..40 {
            let mut end = begin.clone();
            Pass::new(of, all[0].length).pass(&mut end);
            let sum: f64 = exact.at(&begin).iter().sum();
            let value = exact.at(&end)[0];
            let energy = |(mode, z): (&Mode, &[f64])| {
                let shifted = if mode.k > 0.0 { z[0] - z[2] / mode.k } else { 0.0 };
                (z[1] * z[1] + mode.k * shifted * shifted).sqrt()
            };
            let energies: Vec<f64> = modes.iter().zip(begin.chunks_exact(3)).map(energy).collect();
            let remainder = exact.remainder(&energies, &begin);
            assert!((sum - value).abs() < remainder && remainder < 1e-3, "{sum} {value} {remainder}");
            // in the long window, the free part of the fast mode is within its bound
            let (long, rough) = (&all[1], &all[1].guards[0]);
            let lowered = 0.5 * rough.lowered_by_modes(&long.faint, &begin);
            assert!((rough.at(&begin)[0] - exact.at(&begin)[0]).abs() <= lowered * (1.0 + 1e-12), "{lowered}");
            begin = end;
        }
    }
}
