//! What drives the modes during a flight: constants, ramps and harmonics, turned to the phase of its beginning.

use crate::regime::Structure;

/// What drives the modes of a flight.
#[derive(Clone, Debug, Default)]
pub(super) struct Drive {
    /// The constant part for each mode.
    pub(super) steady: Vec<f64>,
    /// The rate of a ramp for each mode.
    pub(super) ramp: Vec<f64>,
    /// The amplitudes of cosine and sine of the time, mode after mode.
    pub(super) harmonics: Vec<(f64, f64)>,
    /// The angular frequencies of the harmonics.
    pub(super) rates: Vec<f64>,
}

impl Drive {
    /// What drives the modes of a structure, without what depends on the beginning of a flight.
    pub(super) fn of_structure(structure: &Structure) -> Self {
        let mut drive = Self::default();
        drive.become_of(structure);
        drive
    }

    /// The same in the place of that of another structure.
    pub(super) fn become_of(&mut self, structure: &Structure) {
        self.ramp.clear();
        self.ramp.extend(structure.drive.iter().map(|signal| signal.ramp));
        self.rates.clone_from(&structure.rates);
    }

    /// The amplitudes of one mode.
    pub(super) fn of(&self, mode: usize) -> &[(f64, f64)] {
        let count = self.rates.len();
        &self.harmonics[mode * count..(mode + 1) * count]
    }

    /// The Taylor coefficients of what drives a mode at a time `s`, in the places of `c` that they determine; `harmonics`
    /// are turned to this time.
    pub(super) fn coefficients(&self, mode: usize, s: f64, harmonics: &[(f64, f64)], c: &mut [f64]) {
        let terms = c.len();
        // the coefficient of a power stands where it enters that of the mode, two powers later
        c[2..].fill(0.0);
        c[2] += self.steady[mode] + self.ramp[mode] * s;
        if terms > 3 {
            c[3] += self.ramp[mode];
        }
        for ((a, b), w) in harmonics.iter().zip(&self.rates) {
            if *a == 0.0 && *b == 0.0 {
                continue;
            }
            let (mut now, mut next, mut k) = (*a, w * b, 1.0);
            for place in &mut c[2..] {
                *place += now;
                // coefficients of the harmonic: the one after next is -w^2 / (k (k + 1)) times this one
                (now, next) = (next, -w * w * now / (k * (k + 1.0)));
                k += 1.0;
            }
        }
    }
}
