//! What becomes of a flight in the long run: its steady response, and bounds of the transient that remains.
//!
//! With modes each has its own. Without ([`dense`](super::dense)) all free directions have one energy
//! $`E^2 = \dot\delta^2 + \delta\cdot K\delta`$ of the difference $`\delta`$ from the steady motion, which does not grow, so
//!
//! $$`|\alpha\cdot\delta + \beta\cdot\dot\delta| \le E\,\sqrt{\alpha\cdot K^+\alpha + \beta^2}.`$$
//!
//! Directions $`N`$ without stiffness are not part of it. In those that are damped, with $`S = N'CN`$, the sum
//! $`N'\dot\delta + N'C\delta`$ is constant, which expresses the displacement along them by the other directions and the
//! velocities. In those without damping the motion is uniform, or uniformly accelerated.

use super::flight::{MachineFlight, Modes};
use super::harmonic_sum::Harmonic;
use crate::math::{Lu, Matrix, add_scaled, dot, symmetric_eigen};

/// A direction without stiffness is not seen by a guard whose factor for it is less than this part of its size: the factor is a
/// rounding error, and the guard does not see how far the structure moves as a whole.
const UNSEEN: f64 = 1e-13;
/// Eigenvalues below this part of the largest are 0.
const NOTHING: f64 = 64.0 * f64::EPSILON;
/// A response larger by this than far from a resonance is no bound of anything.
const RESONANT: f64 = 1e10;

/// What a guard becomes from a time on: a constant, harmonics, a transient within bounds, and a drift since then.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlook {
    pub(super) constant: f64,
    /// The sizes of all terms, for rounding errors.
    pub(super) size: f64,
    pub(super) harmonics: Vec<Harmonic>,
    /// The bound of the transient.
    pub(super) transient: f64,
    pub(super) drift: f64,
    pub(super) acceleration: f64,
}

impl Outlook {
    /// Adds a factor times a number to the constant.
    fn add(&mut self, factor: f64, number: f64) {
        self.constant += factor * number;
        self.size += (factor * number).abs();
    }
}

/// The steady response of a flight and the bounds of its transient at a time.
pub(super) enum Steady {
    Modes(Vec<SteadyMode>),
    Whole(Box<SteadyWhole>),
}

impl Steady {
    /// That of a flight at the time of `modes`; `None` if it grows.
    pub(super) fn of(flight: &MachineFlight, modes: &Modes) -> Option<Self> {
        match &flight.structure.dense {
            Some((stiffness, damping)) => {
                Some(Self::Whole(Box::new(SteadyWhole::of(flight, (stiffness, damping), modes)?)))
            }
            None => {
                (0..flight.v.len()).map(|i| SteadyMode::of(flight, i, modes)).collect::<Option<_>>().map(Self::Modes)
            }
        }
    }

    /// Adds what $`\alpha\cdot y + \beta\cdot\dot y`$ becomes to an outlook with all harmonics, where displacements are counted
    /// from the beginning of the flight. `sizes` are those of the factors of directions without stiffness.
    pub(super) fn add_to(&self, (alpha, beta): (&[f64], &[f64]), sizes: &[f64], rates: &[f64], outlook: &mut Outlook) {
        match self {
            Self::Modes(modes) => {
                let factors = alpha.iter().zip(beta);
                for ((of, (alpha, beta)), size) in modes.iter().zip(factors).zip(sizes) {
                    let alpha = if of.free && alpha.abs() <= UNSEEN * size { 0.0 } else { *alpha };
                    of.add_to((alpha, *beta), rates, outlook);
                }
            }
            Self::Whole(whole) => whole.add_to((alpha, beta), rates, outlook),
        }
    }
}

/// The steady response of a mode, and bounds of what remains of its transient: of the displacement and the velocity.
pub(super) struct SteadyMode {
    /// Whether it has no stiffness.
    free: bool,
    middle: f64,
    waves: Vec<(f64, f64)>,
    swing: f64,
    speed: f64,
    drift: f64,
    /// Of a free body under a constant force.
    acceleration: f64,
}

impl SteadyMode {
    /// The steady response of a mode and the bounds of its transient at the time of `modes`; `None` if it grows.
    fn of(flight: &MachineFlight, i: usize, modes: &Modes) -> Option<Self> {
        let mode = &flight.structure.modes[i];
        let push = flight.drive.steady[i];
        // under a force that grows there is no steady motion
        if flight.drive.ramp[i] != 0.0 {
            return None;
        }
        let mut middle = if mode.k > 0.0 { push / mode.k } else { 0.0 };
        let (mut y, mut v) = (modes.moved[i] - middle, modes.v[i]);
        let mut waves = Vec::with_capacity(flight.structure.rates.len());
        // displacement and velocity less those of the steady response: the transient is what is left
        for (((a, b), w), turned) in flight.drive.of(i).iter().zip(&flight.structure.rates).zip(&modes.turned) {
            if *a == 0.0 && *b == 0.0 {
                waves.push((0.0, 0.0));
                continue;
            }
            let (c, d) = mode.steady(*w, (*a, *b));
            let size = c.abs() + d.abs();
            // also where the response is NaN, as at a resonance without damping
            if size.is_nan() || size >= RESONANT * (a.abs() + b.abs()) / (mode.k + w * w) {
                return None;
            }
            y -= c * turned.cos + d * turned.sin;
            v -= w * (d * turned.cos - c * turned.sin);
            waves.push((c, d));
        }
        let mut drift = 0.0;
        // the energy of the transient does not grow: its root bounds the speed, and over the frequency the displacement
        let (swing, speed) = if mode.k > 0.0 {
            let energy = (v * v + mode.k * y * y).sqrt();
            (energy / mode.omega, energy)
        } else if mode.d > 0.0 {
            // it comes within this distance of the motion in which the damper balances the constant force
            (middle, drift) = (y, push / (2.0 * mode.d));
            v -= drift;
            (v.abs() / (2.0 * mode.d), v.abs())
        // nothing holds or brakes it: it is its own steady motion, with no transient
        } else {
            (middle, drift) = (y, v);
            (0.0, 0.0)
        };
        let acceleration = if mode.k == 0.0 && mode.d == 0.0 { push } else { 0.0 };
        Some(Self { free: mode.k == 0.0, middle, waves, swing, speed, drift, acceleration })
    }

    fn add_to(&self, (alpha, beta): (f64, f64), rates: &[f64], outlook: &mut Outlook) {
        outlook.add(alpha, self.middle);
        outlook.add(beta, self.drift);
        outlook.drift += alpha * self.drift + beta * self.acceleration;
        outlook.acceleration += alpha * self.acceleration;
        outlook.transient += (alpha * self.swing).abs() + (beta * self.speed).abs();
        add_waves(&mut outlook.harmonics, (alpha, beta), self.waves.iter().copied(), rates);
    }
}

/// Adds $`\alpha y + \beta\dot y`$ of these waves to harmonics.
fn add_waves(to: &mut [Harmonic], (alpha, beta): (f64, f64), waves: impl Iterator<Item = (f64, f64)>, rates: &[f64]) {
    // the derivative of a cos wt + b sin wt is wb cos wt - wa sin wt
    for ((sum, (a, b)), w) in to.iter_mut().zip(waves).zip(rates) {
        sum.cos += alpha * a + beta * w * b;
        sum.sin += alpha * b - beta * w * a;
    }
}

/// The steady response of a structure without modes, and the energy of what remains of its transient.
pub(super) struct SteadyWhole {
    /// Stiffness and shape of each direction with stiffness.
    stiff: Vec<(f64, Vec<f64>)>,
    damped: Vec<DampedFree>,
    undamped: Vec<Free>,
    /// The displacement under the constant force.
    middle: Vec<f64>,
    /// The amplitudes of cosine and sine, harmonic after harmonic.
    waves: Vec<(Vec<f64>, Vec<f64>)>,
    energy: f64,
}

/// A direction without stiffness, and the motion along it.
struct Free {
    shape: Vec<f64>,
    place: f64,
    drift: f64,
    acceleration: f64,
}

/// A direction with a damper and without stiffness: where it comes to, less its drift, and the drift.
struct DampedFree {
    free: Free,
    /// Its damping, and the force of all dampers at a unit of velocity along it.
    damping: f64,
    drag: Vec<f64>,
}

impl SteadyWhole {
    fn of(flight: &MachineFlight, (stiffness, damping): (&Matrix, &Matrix), modes: &Modes) -> Option<Self> {
        let (drive, rates) = (&flight.drive, &flight.structure.rates);
        let push = &drive.steady;
        let m = push.len();
        if drive.ramp.iter().any(|ramp| *ramp != 0.0) {
            return None;
        }
        // the eigenvalues are sorted: those that are zero come first
        let (values, shapes) = symmetric_eigen(stiffness);
        let without =
            |values: &[f64], of: &Matrix| values.iter().take_while(|value| **value <= NOTHING * of.largest()).count();
        let count = without(&values, stiffness);
        let stiff: Vec<(f64, Vec<f64>)> = (count..m).map(|i| (values[i], shapes.column(i))).collect();
        // directions without stiffness, turned so that damping does not couple them
        let free: Vec<Vec<f64>> = (0..count).map(|i| shapes.column(i)).collect();
        // N'CN, whose eigenvectors decouple the free directions
        let mut own = Matrix::zeros(count, count);
        for (i, one) in free.iter().enumerate() {
            let dragged = damping.apply(one);
            for (j, other) in free.iter().enumerate() {
                own[(i, j)] = dot(&dragged, other);
            }
        }
        let (drags, turns) = symmetric_eigen(&own.symmetrised());
        let resting = drags.iter().take_while(|drag| **drag <= NOTHING * damping.largest()).count();
        let turned = |k: usize| {
            let mut shape = vec![0.0; m];
            free.iter().enumerate().for_each(|(i, one)| add_scaled(&mut shape, turns[(i, k)], one));
            shape
        };

        // what springs must hold in the steady motion: the force less what accelerates or drags free directions
        let mut remaining = push.clone();
        let (mut place, mut v) = (modes.moved.clone(), modes.v.clone());
        let mut waves = Vec::with_capacity(rates.len());
        for ((h, w), of) in rates.iter().enumerate().zip(&modes.turned) {
            // the amplitudes are stored mode after mode: those of one harmonic stand as far apart as there are
            // harmonics
            let forces = drive.harmonics.iter().skip(h).step_by(rates.len());
            let (cos, sin): (Vec<f64>, Vec<f64>) = forces.copied().unzip();
            let (c, d) = response((stiffness, damping), *w, (cos, sin))?;
            // less the steady response, as for single modes
            add_scaled(&mut place, -of.cos, &c);
            add_scaled(&mut place, -of.sin, &d);
            add_scaled(&mut v, -w * of.cos, &d);
            add_scaled(&mut v, w * of.sin, &c);
            waves.push((c, d));
        }
        let mut undamped: Vec<Free> = Vec::new();
        for shape in (0..resting).map(turned) {
            // without spring and damper the force along it only accelerates
            let acceleration = dot(&shape, push);
            add_scaled(&mut remaining, -acceleration, &shape);
            undamped.push(Free { place: 0.0, drift: 0.0, acceleration, shape });
        }
        let mut damped: Vec<DampedFree> = Vec::new();
        for (k, damping_along) in drags.iter().enumerate().take(count).skip(resting) {
            let shape = turned(k);
            let drag = damping.apply(&shape);
            // the drift in which the damper balances the force; its drag on other directions is part of what springs
            // hold
            let drift = dot(&shape, push) / damping_along;
            add_scaled(&mut remaining, -drift, &drag);
            add_scaled(&mut v, -drift, &shape);
            let free = Free { place: 0.0, drift, acceleration: 0.0, shape };
            damped.push(DampedFree { free, damping: *damping_along, drag });
        }
        // the pseudo-inverse of the stiffness, which sees no free direction
        let mut middle = vec![0.0; m];
        for (k, shape) in &stiff {
            add_scaled(&mut middle, dot(shape, &remaining) / k, shape);
        }
        add_scaled(&mut place, -1.0, &middle);
        for own in &mut undamped {
            (own.place, own.drift) = (dot(&own.shape, &place), dot(&own.shape, &v));
            add_scaled(&mut v, -own.drift, &own.shape);
        }
        for own in &mut damped {
            // where it comes to rest, by the sum that stays constant (see above), when velocities and strains have died
            // out
            own.free.place = (dot(&own.free.shape, &v) + dot(&own.drag, &place)) / own.damping;
        }
        let strained: f64 = stiff.iter().map(|(k, shape)| k * dot(shape, &place) * dot(shape, &place)).sum();
        let energy = (dot(&v, &v) + strained).sqrt();
        Some(Self { stiff, damped, undamped, middle, waves, energy })
    }

    fn add_to(&self, (alpha, beta): (&[f64], &[f64]), rates: &[f64], outlook: &mut Outlook) {
        let size = dot(alpha, alpha).sqrt();
        let seen = |shape: &[f64]| {
            let factor = dot(alpha, shape);
            if factor.abs() <= UNSEEN * size { 0.0 } else { factor }
        };
        for (factor, middle) in alpha.iter().zip(&self.middle) {
            outlook.add(*factor, *middle);
        }
        let (mut by_place, mut by_rate) = (alpha.to_vec(), beta.to_vec());
        let damped = self.damped.iter().map(|own| (&own.free, Some((own.damping, &own.drag))));
        for (free, damper) in damped.chain(self.undamped.iter().map(|free| (free, None))) {
            let (alpha, beta) = (seen(&free.shape), dot(beta, &free.shape));
            outlook.add(alpha, free.place);
            outlook.add(beta, free.drift);
            outlook.drift += alpha * free.drift + beta * free.acceleration;
            outlook.acceleration += alpha * free.acceleration;
            if let Some((damping, drag)) = damper {
                // the displacement along it by velocities and the other displacements
                add_scaled(&mut by_rate, -alpha / damping, &free.shape);
                add_scaled(&mut by_place, -alpha / damping, drag);
            }
        }
        // the bound by the energy (see above), with K^+ by its
        // eigenvectors
        let strain = |shape: &[f64]| dot(shape, &by_place);
        let strained: f64 = self.stiff.iter().map(|(k, shape)| strain(shape) * strain(shape) / k).sum();
        outlook.transient += self.energy * (strained + dot(&by_rate, &by_rate)).sqrt();
        let along = |of: &[f64]| self.waves.iter().map(|(c, d)| (dot(of, c), dot(of, d))).collect::<Vec<_>>();
        add_waves(&mut outlook.harmonics, (1.0, 0.0), along(alpha).into_iter(), rates);
        add_waves(&mut outlook.harmonics, (0.0, 1.0), along(beta).into_iter(), rates);
    }
}

/// The steady response of $`\ddot\xi + C\dot\xi + K\xi`$ to $`a\cos wt + b\sin wt`$, as amplitudes of cosine and sine; `None` at
/// a resonance without damping.
fn response(
    (stiffness, damping): (&Matrix, &Matrix),
    w: f64,
    (cos, sin): (Vec<f64>, Vec<f64>),
) -> Option<(Vec<f64>, Vec<f64>)> {
    let m = cos.len();
    let push: f64 = cos.iter().chain(&sin).map(|force| force.abs()).sum();
    if push == 0.0 {
        return Some((vec![0.0; m], vec![0.0; m]));
    }
    // (K - w^2) c + w C d = a and (K - w^2) d - w C c = b as one system of equations
    let mut system = Matrix::zeros(2 * m, 2 * m);
    for i in 0..m {
        for j in 0..m {
            let own = stiffness[(i, j)] - if i == j { w * w } else { 0.0 };
            (system[(i, j)], system[(m + i, m + j)]) = (own, own);
            (system[(i, m + j)], system[(m + i, j)]) = (w * damping[(i, j)], -w * damping[(i, j)]);
        }
    }
    let mut both: Vec<f64> = cos.into_iter().chain(sin).collect();
    Lu::new(system.values().to_vec(), 2 * m)?.solve(&mut both);
    // a singular system can pass the elimination by rounding errors: then its solution is far too large
    let size: f64 = both.iter().map(|x| x.abs()).sum();
    let far = RESONANT * push / (stiffness.largest() + w * w);
    let d = both.split_off(m);
    (size < far).then_some((both, d))
}
