//! The constants of the flights of an oscillator, which do not depend on the flight.
//!
//! A flight is followed in steps of one length $`h`$. Over a step the state $`(x, v, \sin\theta, \cos\theta)`$ is
//! multiplied by a constant matrix: the propagator of [`Response`](crate::flight::Response) at $`h`$ and the rotation
//! by $`\beta h`$. So no sine is evaluated, and no formula divides by $`1 - \beta^2`$. These steps are taken in single
//! precision and only show over which times there is no contact: the hull of each keeps a margin for the rounding
//! errors ([`hull`](super::hull)), and a contact uses them only for its first guess. In double precision, with damping,
//! the state at any time is computed with two propagators. The one at the nearest whole step is applied to the launch,
//! and then the one over the rest, at most half a step, whose four functions
//!
//! $$`1 - C(t),\quad S(t),\quad K_c(t),\quad K_s(t) \qquad (|t| \le h/2)`$$
//!
//! are power series with coefficients from $`y^{(k+2)} = f^{(k)} - y^{(k)} - 2\zeta y^{(k+1)}`$. The step satisfies
//! $`\mu h \le 3/2`$, $`\mu = \max(\beta, 1 + 2\zeta)`$, so nine terms of each parity leave an error below $`2^{-60}`$.

use super::constants::{Constants, ROUGH};
use crate::flight::Response;
use crate::math::{Lane, Mask, Numbers};
use crate::system::{Oscillator, Side, UndampedForm};

/// The number of step lengths, each half of the one before. If the shortest does not suffice, the flight is left to the
/// careful search.
pub(super) const LEVELS: usize = 16;
/// The largest number of whole steps after which a flight is left to the careful search, which decides flights that may
/// last for ever.
pub(super) const NODES: u32 = 64;
/// This number of whole steps. Without damping that search finds the end of a long flight in few steps.
pub(super) const fn nodes(damped: bool) -> u32 {
    if damped { NODES } else { NODES / 2 }
}

/// The number of terms of each parity of the series.
pub(super) const TERMS: usize = 9;
/// The largest $`\mu h`$ of a step. On longer steps the first guess too often misses an arc that rises above a stop and
/// returns. With damping, the series over half a step would lose digits.
const LONGEST: f64 = 1.5;
/// Shorter steps save no time (forcing or damping a hundred times faster than the oscillator).
const SHORTEST: f64 = 1.0 / 64.0;
/// Steps are multiples of this, so that multiples of a step are exact.
const GRAIN: f64 = 1.0 / 1024.0;

/// The constants of one step length.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pace<L> {
    pub(super) h: L,
    c: L,
    s: L,
    kc: L,
    ks: L,
    s_rate: L,
    ks_rate: L,
    kc_rate: L,
    cos: L,
    sin: L,
    pub(super) scale: HullScale<L>,
}

/// The multiples of the step length for the coefficients of the hull.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct HullScale<L> {
    /// h/6.
    pub(super) sixth: L,
    /// h^2/30.
    pub(super) thirtieth: L,
    /// 2h/5.
    pub(super) two_fifths: L,
    /// h^2/20.
    pub(super) twentieth: L,
    /// The error coefficient is `error + error_rate * (|x| + |v|)`.
    pub(super) error: L,
    pub(super) error_rate: L,
}

/// The coefficients of one of the four functions, by parity: `even` in powers of t^2 from t^2 on, `odd` from t on (for
/// K from t^3 on).
#[derive(Clone, Copy, Debug)]
struct Coefficients {
    even: [f64; TERMS],
    odd: [f64; TERMS],
}

/// The coefficients of one index of both parities of the four functions.
pub(super) type Terms = [f64; 8];

/// The propagator over a time, as eight columns: 1 - C, C, S, S', Kc, Ks, and sin and cos of beta t.
pub(super) type Row<L> = [L; 8];

/// The constants of the flights of an oscillator.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stride {
    pub(super) constants: Constants<f64>,
    /// The same in single precision.
    pub(super) roughly: Constants<f32>,
    /// The constants of a whole step.
    pub(super) pace: Pace<f64>,
    /// The same in single precision.
    pub(super) rough: Pace<f32>,
    /// The series of 1 - C, S, Kc and Ks.
    series: [Coefficients; 4],
    /// The closed form without damping.
    pub(super) form: UndampedForm<f64>,
    response: Response,
}

/// The propagator without damping by the closed form.
#[inline(always)]
fn closed<L: Lane>(form: &UndampedForm<L>, time: L) -> Row<L> {
    let p = form.at(time);
    [p.one_minus_c, p.c, p.s, p.c, p.kc, p.ks, p.sin_turn, p.cos_turn]
}

/// The propagator without damping over whole steps.
#[inline(always)]
pub(super) fn closed_at_node<L: Lane>(form: &UndampedForm<L>, time: L) -> Row<L> {
    let p = form.exact(time);
    [p.one_minus_c, p.c, p.s, p.c, p.kc, p.ks, p.sin_turn, p.cos_turn]
}

/// The greatest of the rates of an oscillator.
fn fastest(osc: &Oscillator) -> f64 {
    osc.beta().max(1.0 + 2.0 * osc.damping())
}

/// The length of a whole step of an oscillator; `None` if the lanes cannot follow its flights.
pub(super) fn whole_step(osc: &Oscillator) -> Option<f64> {
    let h = (LONGEST / fastest(osc) / GRAIN).floor() * GRAIN;
    let mut stops = [Side::Upper, Side::Lower].into_iter().filter_map(|side| osc.stop(side));
    (h >= SHORTEST && stops.all(|stop| stop.restitution != 0.0 && stop.gap.abs() <= FAR)).then_some(h)
}

/// The longest flight whose end the lanes can find, with whole steps of length `h`.
pub(super) fn longest(damped: bool, h: f64) -> f64 {
    f64::from(nodes(damped) + 3) * h
}

impl Stride {
    /// The constants for `osc`; `None` if the lanes cannot follow its flights, and all of them need the careful search.
    pub(crate) fn new(osc: &Oscillator) -> Option<Self> {
        let h = whole_step(osc)?;
        let (beta, drag) = (osc.beta(), 2.0 * osc.damping());
        let (upper, lower) = (osc.stop(Side::Upper)?, osc.stop(Side::Lower));
        let bound = sixth_derivative(beta, drag);
        let response = *osc.response();
        let pace = Pace::new(&response, h, bound);
        // h^6/6!, the factor of the sixth derivative in the hull
        let power = h * h * h * h * h * h / 720.0;
        let force = beta * beta * (1.0 + beta * beta);
        // a stop that is not there is infinitely far: the same operations, and no contact
        let gap = [upper.gap, lower.map_or(f64::INFINITY, |stop| stop.gap)];
        let constants = Constants {
            two_stops: lower.is_some(),
            damped: drag != 0.0,
            beta,
            drag,
            gap,
            bulk: gap.map(|gap| 1.0 + gap.abs()),
            restitution: [upper.restitution, lower.map_or(0.0, |stop| stop.restitution)],
            h,
            margin_rate: ROUGH / h,
            shortest: 1.0 / fastest(osc),
            bound,
            sixth: [power * (1.0 + force), power * force],
        };
        Some(Self {
            constants,
            roughly: constants.each(|x| Numbers::splat(*x)),
            pace,
            rough: pace.each(|x| Numbers::splat(*x)),
            series: series(beta, drag),
            form: response.undamped_form(),
            response,
        })
    }

    /// The longest flight whose end the lanes can find.
    pub(super) fn longest(&self) -> f64 {
        longest(self.constants.damped, self.constants.h)
    }

    /// The propagator over a time of either sign, at most half a step, by the series.
    #[inline(always)]
    pub(super) fn by_series<L: Lane>(&self, t: L) -> Row<L> {
        let Constants { damped, beta, drag, .. } = self.constants;
        let (z, zz) = (t * t, (t * t) * (t * t));
        let mut sums = [[L::splat(0.0); 2]; 4];
        let mut n = 0;
        while n < 4 {
            let Coefficients { even, odd } = &self.series[n];
            // without damping the function 1 - C and Kc are even, the others odd
            if damped || n % 2 == 0 {
                sums[n][0] = sum(even, z, zz);
            }
            if damped || n % 2 == 1 {
                sums[n][1] = sum(odd, z, zz);
            }
            n += 1;
        }
        of_sums(sums, (damped, L::splat(beta), L::splat(drag)), (t, z, zz))
    }

    /// The coefficients of the series, as [`series_of_each`] takes them.
    pub(super) fn terms(&self) -> [Terms; TERMS] {
        let mut terms = [[0.0; 8]; TERMS];
        for (n, Coefficients { even, odd }) in self.series.iter().enumerate() {
            for (k, terms) in terms.iter_mut().enumerate() {
                (terms[2 * n], terms[2 * n + 1]) = (even[k], odd[k]);
            }
        }
        terms
    }
}

/// The propagator over a time `t` from the sums of the series of its functions, of both parities in powers of
/// `z` $`= t^2`$.
#[inline(always)]
fn of_sums<L: Lane>(sums: [[L; 2]; 4], (damped, beta, drag): (bool, L, L), (t, z, zz): (L, L, L)) -> Row<L> {
    let one = L::splat(1.0);
    // two factors keep the digits near resonance, where 1 - beta^2 is small
    let detuning = (one - beta) * (one + beta);
    let [[free_c, free_c_odd], [free_s_even, free_s], [forced_c, forced_c_odd], [forced_s_even, forced_s]] = sums;
    let (mut omc, mut s) = (z * free_c, t * free_s);
    let (mut kc, mut ks) = (z * forced_c, t * (z * forced_s));
    if damped {
        let zt = z * t;
        omc = omc + zt * free_c_odd;
        s = s + z * free_s_even;
        kc = kc + zt * forced_c_odd;
        ks = ks + zz * forced_s_even;
    }
    let c = one - omc;
    // S' = C - 2 zeta S
    let s_rate = c - drag * s;
    // cos and sin of beta t follow from K'' + 2 zeta K' + K = e^{i beta t}
    let cross = drag * beta;
    let (cos, sin) = if damped {
        (c + detuning * kc - cross * ks, beta * s + detuning * ks + cross * kc)
    } else {
        (c + detuning * kc, beta * s + detuning * ks)
    };
    [omc, c, s, s_rate, kc, ks, sin, cos]
}

/// The propagator over a time of either sign, at most half a step, of another oscillator in each lane: that with this
/// number in a list of all [`Stride::terms`].
#[inline(always)]
pub(super) fn series_of_each<L: Lane>(
    terms: &[Terms],
    numbers: &[u32; WIDEST],
    &Constants { damped, beta, drag, .. }: &Constants<L>,
    t: L,
) -> Row<L> {
    let (z, zz) = (t * t, (t * t) * (t * t));
    // the sums of all eight series at once, each as in `sum`
    let (sixth, seventh) = (terms_of::<L>(terms, numbers, 6), terms_of::<L>(terms, numbers, 7));
    let eighth = terms_of::<L>(terms, numbers, 8);
    let mut sums: [L; 8] = sixth;
    let mut n = 0;
    while n < 8 {
        sums[n] = (sixth[n] + seventh[n] * z) + eighth[n] * zz;
        n += 1;
    }
    let mut k = 6;
    while k > 0 {
        k -= 2;
        let (one, next) = (terms_of::<L>(terms, numbers, k), terms_of::<L>(terms, numbers, k + 1));
        n = 0;
        while n < 8 {
            sums[n] = (one[n] + next[n] * z) + zz * sums[n];
            n += 1;
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    of_sums([[a, b], [c, d], [e, f], [g, h]], (damped, beta, drag), (t, z, zz))
}

/// The coefficients of one index of the oscillators with these numbers.
#[inline(always)]
fn terms_of<L: Lane>(terms: &[Terms], numbers: &[u32; WIDEST], k: usize) -> [L; 8] {
    let mut at = [0; WIDEST];
    let mut lane = 0;
    while lane < L::WIDTH {
        #[allow(clippy::cast_possible_truncation)] // nine terms
        let row = numbers[lane] * TERMS as u32 + k as u32;
        at[lane] = row;
        lane += 1;
    }
    L::rows(terms, &at)
}

/// The propagators that are not needed in every step.
pub(super) trait Propagators<L: Lane> {
    /// The propagator over `k` whole steps.
    fn node(&self, k: L) -> Row<L>;
    /// The propagator over a time of either sign, at most half a step.
    fn rest(&self, t: L) -> Row<L>;
    /// The closed form without damping, and the length of a whole step.
    fn form(&self) -> (UndampedForm<L>, L);
    /// The propagator without damping over any time from 0 on, accurate to the last bits: by the series over the first
    /// half step, where differences are small, otherwise by the closed form.
    #[inline(always)]
    fn whole(&self, time: L) -> Row<L> {
        let (form, h) = self.form();
        let mut row = closed(&form, time);
        let early = time.less(L::splat(0.5) * h);
        if early.bits() != 0 {
            let series = self.rest(time);
            let mut k = 0;
            while k < row.len() {
                // in most rounds no lane needs the series
                row[k] = L::choose(early, series[k], row[k]);
                k += 1;
            }
        }
        row
    }
}

/// Halved steps.
pub(super) trait Halvings {
    /// The constants of a step halved `level` times.
    fn pace(&self, level: usize) -> Pace<f64>;
}

/// A single motion computes them when it needs them.
impl Propagators<f64> for Stride {
    #[inline]
    fn node(&self, k: f64) -> Row<f64> {
        let p = self.response.at(k * self.constants.h);
        [p.one_minus_c, p.c, p.s, p.s_rate, p.kc, p.ks, p.sin_turn, p.cos_turn]
    }
    #[inline]
    fn rest(&self, t: f64) -> Row<f64> {
        self.by_series(t)
    }
    #[inline]
    fn form(&self) -> (UndampedForm<f64>, f64) {
        (self.form, self.constants.h)
    }
}

impl Halvings for Stride {
    fn pace(&self, level: usize) -> Pace<f64> {
        let mut h = self.constants.h;
        for _ in 0..level {
            // halving is exact: the nodes of all levels are the same numbers
            h *= 0.5;
        }
        Pace::new(&self.response, h, self.constants.bound)
    }
}

/// A batch computes them once, as a table.
#[derive(Clone, Debug)]
pub(super) struct Table {
    nodes: Vec<Row<f64>>,
}

impl Table {
    pub(super) fn new(stride: &Stride) -> Self {
        let mut k = -1.0;
        let rows = core::iter::repeat_with(|| {
            k += 1.0;
            stride.node(k)
        });
        // up to those of `longest`
        Self { nodes: rows.take(nodes(stride.constants.damped) as usize + 4).collect() }
    }

    /// The propagators over these numbers of whole steps.
    #[inline(always)]
    pub(super) fn node<L: Lane>(&self, k: L) -> Row<L> {
        #[allow(clippy::cast_possible_truncation)] // a few dozen
        let last = self.nodes.len() as u32 - 1;
        L::rows(&self.nodes, &indices(k, last))
    }
}

/// The numbers of whole steps of the lanes as indices up to `last`; invalid guesses of a contact, in lanes that are not
/// used, are numbers beyond these.
#[inline(always)]
pub(super) fn indices<L: Lane>(k: L, last: u32) -> [u32; WIDEST] {
    let mut numbers = [0.0; WIDEST];
    k.store(&mut numbers);
    let mut which = [0; WIDEST];
    for (which, k) in which.iter_mut().zip(numbers) {
        // the conversion saturates
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let k = k as u32;
        *which = k.min(last);
    }
    which
}

/// The largest width of a lane type; arrays are padded to a multiple of it.
pub(super) const WIDEST: usize = 16;
/// Oscillators with a stop further away than this need the careful search, whose bounds are relative.
const FAR: f64 = 1e6;

impl<L: Numbers> HullScale<L> {
    /// The multiples of a step of any length.
    #[inline(always)]
    pub(super) fn new(h: L, [rest, rate]: [L; 2]) -> Self {
        let hh = h * h;
        let power = hh * hh * hh * L::splat(1.0 / 14400.0);
        let error_rate = rate * power;
        Self {
            sixth: h * L::splat(1.0 / 6.0),
            thirtieth: hh * L::splat(1.0 / 30.0),
            two_fifths: h * L::splat(0.4),
            twentieth: hh * L::splat(0.05),
            // |x| + |v| increases by at most the length of the window
            error: rest * power + error_rate * h,
            error_rate,
        }
    }
}

impl Pace<f64> {
    fn new(response: &Response, h: f64, bound: [f64; 2]) -> Self {
        let (p, beta) = (response.at(h), response.beta());
        Self {
            h,
            c: p.c,
            s: p.s,
            kc: p.kc,
            ks: p.ks,
            s_rate: p.s_rate,
            // K' = S + i beta K
            ks_rate: p.s - beta * p.ks,
            kc_rate: beta * p.kc,
            cos: p.cos_turn,
            sin: p.sin_turn,
            scale: HullScale::new(h, bound),
        }
    }
}

impl<N> Pace<N> {
    /// The same with another representation of each number.
    #[inline(always)]
    pub(super) fn each<M>(&self, mut f: impl FnMut(&N) -> M) -> Pace<M> {
        let scale = &self.scale;
        Pace {
            h: f(&self.h),
            c: f(&self.c),
            s: f(&self.s),
            kc: f(&self.kc),
            ks: f(&self.ks),
            s_rate: f(&self.s_rate),
            ks_rate: f(&self.ks_rate),
            kc_rate: f(&self.kc_rate),
            cos: f(&self.cos),
            sin: f(&self.sin),
            scale: HullScale {
                sixth: f(&scale.sixth),
                thirtieth: f(&scale.thirtieth),
                two_fifths: f(&scale.two_fifths),
                twentieth: f(&scale.twentieth),
                error: f(&scale.error),
                error_rate: f(&scale.error_rate),
            },
        }
    }
}

impl<N: Copy> Pace<N> {
    /// As a row.
    pub(super) const fn row(&self) -> [N; 16] {
        let Self { h, c, s, kc, ks, s_rate, ks_rate, kc_rate, cos, sin, scale } = *self;
        let HullScale { sixth, thirtieth, two_fifths, twentieth, error, error_rate } = scale;
        [
            h, c, s, kc, ks, s_rate, ks_rate, kc_rate, cos, sin, sixth, thirtieth, two_fifths, twentieth, error,
            error_rate,
        ]
    }

    /// From a row.
    #[inline(always)]
    pub(super) const fn of_row(row: [N; 16]) -> Self {
        let [h, c, s, kc, ks, s_rate, ks_rate, kc_rate, cos, sin, sixth, thirtieth, two_fifths, twentieth, error, rate] =
            row;
        let scale = HullScale { sixth, thirtieth, two_fifths, twentieth, error, error_rate: rate };
        Self { h, c, s, kc, ks, s_rate, ks_rate, kc_rate, cos, sin, scale }
    }
}

/// A state of a flight.
#[derive(Clone, Copy, Debug)]
pub(super) struct State<L> {
    /// Time since the launch.
    pub(super) s: L,
    pub(super) x: L,
    pub(super) v: L,
    pub(super) sin: L,
    pub(super) cos: L,
}

impl<L: Numbers> Pace<L> {
    /// The state one step later.
    #[inline(always)]
    pub(super) fn step(&self, from: State<L>) -> State<L> {
        let State { s, x, v, sin, cos } = from;
        State {
            s: s + self.h,
            x: (self.c * x + self.s * v) + (self.kc * sin + self.ks * cos),
            v: (self.s_rate * v - self.s * x) + (self.ks_rate * sin + self.kc_rate * cos),
            sin: sin * self.cos + cos * self.sin,
            cos: cos * self.cos - sin * self.sin,
        }
    }
}

/// The sum of one parity, in pairs, so that neighbouring terms are independent.
#[inline(always)]
fn sum<L: Lane>(c: &[f64; TERMS], z: L, zz: L) -> L {
    let first = L::splat(c[0]) + L::splat(c[1]) * z;
    let second = L::splat(c[2]) + L::splat(c[3]) * z;
    let third = L::splat(c[4]) + L::splat(c[5]) * z;
    let fourth = (L::splat(c[6]) + L::splat(c[7]) * z) + L::splat(c[8]) * zz;
    first + zz * (second + zz * (third + zz * fourth))
}

impl State<f64> {
    /// In single precision; times of whole steps stay exact.
    pub(super) fn rough(&self) -> State<f32> {
        State {
            s: Numbers::splat(self.s),
            x: Numbers::splat(self.x),
            v: Numbers::splat(self.v),
            sin: Numbers::splat(self.sin),
            cos: Numbers::splat(self.cos),
        }
    }
}

/// A bound of the sixth derivative, $`B_6 = p + q R`$, where $`R`$ bounds the energy radius in the window. It is the
/// recursion of `flight/bounds.rs` with $`|v| \le R`$.
fn sixth_derivative(beta: f64, drag: f64) -> [f64; 2] {
    let derivatives = |r: f64| {
        let (mut before, mut b, mut force) = (r, 1.0 + r + drag * r, 1.0);
        for _ in 0..4 {
            force *= beta;
            // the derivative k + 2 by the two before it and the force, each by its bound
            (before, b) = (b, force + before + drag * b);
        }
        b
    };
    // rounded up
    let rest = derivatives(0.0);
    [rest * (1.0 + 1e-12), (derivatives(1.0) - rest) * (1.0 + 1e-12)]
}

/// 1/k! for each index k.
const OVER_FACTORIAL: [f64; 2 * TERMS + 4] = {
    let mut over = [1.0; 2 * TERMS + 4];
    let (mut k, mut factorial) = (1, 1.0);
    while k < over.len() {
        factorial *= k as f64;
        over[k] = 1.0 / factorial;
        k += 1;
    }
    over
};

/// The four series, from $`y^{(k+2)} = f^{(k)} - y^{(k)} - 2\zeta y^{(k+1)}`$, where $`f^{(k)}`$ are the derivatives of
/// $`\cos\beta t`$ and $`\sin\beta t`$ at 0.
fn series(beta: f64, drag: f64) -> [Coefficients; 4] {
    let mut c = [[0.0; 4]; 2 * TERMS + 4];
    let (mut y, mut rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]);
    let (mut force, mut slope) = ([0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, beta]);
    let square = beta * beta;
    for (c, over) in c.iter_mut().zip(OVER_FACTORIAL).skip(2) {
        for n in 0..4 {
            // from the equation of motion, differentiated once more each time
            (y[n], rate[n]) = (rate[n], force[n] - y[n] - drag * rate[n]);
            (force[n], slope[n]) = (slope[n], -square * force[n]);
            c[n] = rate[n] * over;
        }
    }
    c[1] = [0.0, 1.0, 0.0, 0.0];
    let pick = |n: usize, even: usize, odd: usize, sign: f64| Coefficients {
        even: core::array::from_fn(|k| sign * c[even + 2 * k][n]),
        odd: core::array::from_fn(|k| sign * c[odd + 2 * k][n]),
    };
    // 1 - C has the coefficients of -C from t^2 on
    [pick(0, 2, 3, -1.0), pick(1, 2, 1, 1.0), pick(2, 2, 3, 1.0), pick(3, 4, 3, 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_of_a_step_is_the_response() {
        for (beta, zeta) in [(0.9, 0.0), (1.0, 0.0), (1.0 + 1e-9, 0.0), (0.3, 0.1), (3.0, 0.7), (1.3, 1.5)] {
            let osc = Oscillator::new(beta, 1.0, 0.5).unwrap().with_damping(zeta).unwrap();
            let stride = Stride::new(&osc).unwrap();
            for k in -8_i32..=8 {
                let t = 0.5 * stride.pace.h * f64::from(k) / 8.0;
                let [omc, c, s, s_rate, kc, ks, sin, cos] = stride.by_series(t);
                if t < 0.0 {
                    assert!((omc + c - 1.0).abs() < 1e-16 && (sin * sin + cos * cos - 1.0).abs() < 1e-15);
                    continue;
                }
                let p = osc.response().at(t);
                for (got, want) in [
                    (omc, p.one_minus_c),
                    (c, p.c),
                    (s, p.s),
                    (s_rate, p.s_rate),
                    (kc, p.kc),
                    (ks, p.ks),
                    (sin, p.sin_turn),
                    (cos, p.cos_turn),
                ] {
                    // the closed form itself loses digits of the small functions, because its terms are of the size of
                    // t
                    let close = 4e-16 * t.max(want.abs());
                    assert!((got - want).abs() <= close, "beta {beta} zeta {zeta} t {t}: {got} {want}");
                }
            }
        }
    }

    #[test]
    fn steps_compose() {
        let osc = Oscillator::new(0.8, 1.0, 0.5).unwrap().with_damping(0.05).unwrap();
        let stride = Stride::new(&osc).unwrap();
        let mut state = State { s: 0.0, x: 0.3, v: -1.2, sin: 0.6, cos: 0.8 };
        for level in [0, 1, 1, 2, 3, 0] {
            state = stride.pace(level).step(state);
        }
        let p = osc.response().at(state.s);
        let x = 0.3 * p.c - 1.2 * p.s + 0.6 * p.kc + 0.8 * p.ks;
        assert!((state.x - x).abs() < 1e-14, "{} {x}", state.x);
    }
}
