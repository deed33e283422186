//! The units of an oscillator.

/// The nondimensional units of an oscillator in those of a machine or a body: SI units where its numbers are.
///
/// $$`x_{st} = \frac{F}{k},\quad \omega_n = \sqrt{k/m},\quad \xi = \frac{x}{x_{st}},\quad \tau = \omega_n t`$$
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// One unit of length, $`F/k`$.
    pub length: f64,
    /// One unit of time, $`1/\omega_n`$.
    pub time: f64,
    /// One unit of mass, the moving mass.
    pub mass: f64,
}

impl Scales {
    /// One unit of velocity.
    #[must_use]
    pub fn velocity(&self) -> f64 {
        self.length / self.time
    }
}
