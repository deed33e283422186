//! A prescribed function of time: a constant, a ramp and harmonics of the forcing.

/// $`c + \sum_j u_j a_j + rs + \sum_h (A_h\cos h\theta + B_h\sin h\theta)`$, with the set points $`a_j`$ of joints that hold
/// and the time $`s`$ since the beginning of the flight.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Signal {
    /// The constant $`c`$.
    pub(crate) constant: f64,
    /// The rate $`r`$ of the ramp.
    pub(crate) ramp: f64,
    /// The factors $`u_j`$ of the set points.
    pub(crate) set: Vec<f64>,
    /// The amplitudes of each harmonic.
    pub(crate) harmonics: Vec<(f64, f64)>,
}

impl Signal {
    /// Zero, for this number of joints and of harmonics.
    pub(crate) fn zero(joints: usize, harmonics: usize) -> Self {
        Self { constant: 0.0, ramp: 0.0, set: vec![0.0; joints], harmonics: vec![(0.0, 0.0); harmonics] }
    }

    /// Whether it is zero at all times.
    pub(crate) fn is_zero(&self) -> bool {
        self.constant == 0.0
            && self.ramp == 0.0
            && self.set.iter().all(|factor| *factor == 0.0)
            && self.harmonics.iter().all(|pair| *pair == (0.0, 0.0))
    }

    /// Whether it changes with time.
    pub(crate) fn moves(&self) -> bool {
        self.ramp != 0.0 || self.harmonics.iter().any(|pair| *pair != (0.0, 0.0))
    }

    /// Adds a multiple of another one.
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        self.constant += factor * other.constant;
        self.ramp += factor * other.ramp;
        for (own, theirs) in self.set.iter_mut().zip(&other.set) {
            *own += factor * theirs;
        }
        for (own, theirs) in self.harmonics.iter_mut().zip(&other.harmonics) {
            own.0 += factor * theirs.0;
            own.1 += factor * theirs.1;
        }
    }

    /// The derivative with respect to time; `rates` are the angular frequencies of the harmonics.
    pub(crate) fn derivative(&self, rates: &[f64]) -> Self {
        // a cos + b sin has the rate w b cos - w a sin
        let harmonics = self.harmonics.iter().zip(rates).map(|((cos, sin), rate)| (rate * sin, -rate * cos)).collect();
        Self { constant: self.ramp, ramp: 0.0, set: vec![0.0; self.set.len()], harmonics }
    }

    /// The harmonics at a time with these sines and cosines of each.
    pub(crate) fn swing(&self, turns: &[(f64, f64)]) -> f64 {
        self.harmonics.iter().zip(turns).fold(0.0, |sum, ((a, b), (sin, cos))| sum + (a * cos + b * sin))
    }

    /// The amplitudes of each harmonic, as functions of the time since then.
    pub(crate) fn turned<'a>(&'a self, turns: &'a [(f64, f64)]) -> impl Iterator<Item = (f64, f64)> + 'a {
        turned(&self.harmonics, turns.iter().copied())
    }

    /// The constant part for these set points.
    pub(crate) fn steady(&self, set: &[f64]) -> f64 {
        self.set.iter().zip(set).fold(self.constant, |sum, (factor, point)| sum + factor * point)
    }
}

/// A linear function of the state and of time: $`\alpha\cdot y + \beta\cdot\dot y + `$ a signal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Observable {
    /// Factors of the modal displacements.
    pub(crate) position: Vec<f64>,
    /// Factors of the modal velocities.
    pub(crate) velocity: Vec<f64>,
    /// The prescribed part.
    pub(crate) signal: Signal,
}

impl Observable {
    /// Zero, for this number of modes.
    pub(crate) fn zero(modes: usize, joints: usize, harmonics: usize) -> Self {
        Self { position: vec![0.0; modes], velocity: vec![0.0; modes], signal: Signal::zero(joints, harmonics) }
    }

    /// A multiple of it.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let signal = &self.signal;
        let mut scaled = Self::zero(self.position.len(), signal.set.len(), signal.harmonics.len());
        scaled.add(factor, self);
        scaled
    }

    /// Adds a multiple of another one.
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        if factor == 0.0 {
            return;
        }
        crate::math::add_scaled(&mut self.position, factor, &other.position);
        crate::math::add_scaled(&mut self.velocity, factor, &other.velocity);
        self.signal.add(factor, &other.signal);
    }
}

/// Harmonics as functions of the time since another one, which has these sines and cosines of each.
pub(crate) fn turned<'a>(
    harmonics: &'a [(f64, f64)],
    turns: impl Iterator<Item = (f64, f64)> + 'a,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    harmonics.iter().zip(turns).map(|((a, b), (sin, cos))| (a * cos + b * sin, b * cos - a * sin))
}
