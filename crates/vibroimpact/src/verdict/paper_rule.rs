//! The rule of the 1971 paper, eq. (11)-(12), by name: for reproduction, not for truth.
//!
//! After each impact j the smallest m is looked for with
//!
//! $$`\left|\frac{z_{j-m}}{z_j} - 1\right| < \frac{p}{100} \quad\text{and}\quad \left|\frac{u_{j-m}}{u_j} - 1\right| < \frac{p}{100},
//!   \tag{11}`$$
//!
//! $`z_j`$ the interval before impact j and $`u_j`$ its speed; then $`n = \beta(\tau_j - \tau_{j-m})/2\pi`$ (12). After 100
//! impacts without success the motion is called unstable. (The print has a stray $`-1`$ in the numerators of (11); as
//! printed the ratios could not be near 1.) The rule cannot tell a slow transient from a period, nor a limit of ever
//! gentler impacts from 1/10; [`settle`](super::settle) can.

use crate::motion::{EventKind, MAX_TOUCHES, Motion};
use crate::system::{Oscillator, Start};
use core::f64::consts::TAU;

/// The constants of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperRule {
    /// Tolerance $`p`$ in per cent. The paper leaves it open ("suitably chosen"); 0.1 here.
    pub percent: f64,
    /// Impacts after which the motion is called unstable.
    pub limit: u32,
}

impl Default for PaperRule {
    fn default() -> Self {
        Self { percent: 0.1, limit: 100 }
    }
}

/// What the rule says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaperVerdict {
    /// Settled: m impacts in n forcing periods, n as (12) gives it.
    Settled {
        /// Impacts per period.
        m: u32,
        /// Forcing periods, not rounded.
        n: f64,
        /// Impacts it took.
        impacts: u32,
    },
    /// No settling within the limit.
    Unstable,
    /// The impacts ceased.
    NoMoreImpacts,
    /// The mass came to rest on the stop, where the paper's simulation ended.
    Sticks,
}

/// Applies the paper's rule to the motion of `osc` from `start`.
///
/// ```
/// use vibroimpact::{Oscillator, Start, verdict::{PaperRule, PaperVerdict, paper_rule}};
/// // P, started as in figure 6 with a push: the fundamental motion
/// let osc = Oscillator::from_inverse_beta(0.6, 0.75, 0.5)?;
/// let verdict = paper_rule(&osc, Start::new(&osc, 0.0, 3.0, 0.0)?, PaperRule::default());
/// assert!(matches!(verdict, PaperVerdict::Settled { m: 1, n, .. } if (n - 1.0).abs() < 1e-2), "{verdict:?}");
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn paper_rule(osc: &Oscillator, start: Start, rule: PaperRule) -> PaperVerdict {
    // interval, speed and time of each impact
    let mut impacts: Vec<(f64, f64, f64)> = Vec::new();
    let (mut last, mut touches) = (0.0, 0);
    let mut motion = Motion::new(osc, start);
    while impacts.len() < rule.limit as usize {
        let Some(event) = motion.next() else {
            return PaperVerdict::NoMoreImpacts;
        };
        match event.kind {
            EventKind::Impact { velocity_before, .. } => impacts.push((event.time - last, velocity_before, event.time)),
            EventKind::Stick { .. } => return PaperVerdict::Sticks,
            EventKind::Graze { .. } if touches >= MAX_TOUCHES => return PaperVerdict::NoMoreImpacts,
            EventKind::Graze { .. } | EventKind::Release => {
                touches += 1;
                continue;
            }
        }
        (last, touches) = (event.time, 0);
        let j = impacts.len() - 1;
        let (z, u, time) = impacts[j];
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < rule.percent / 100.0;
        // the first interval starts from the initial conditions, not from an impact
        for m in 1..j {
            let (zm, um, time_m) = impacts[j - m];
            if near(zm, z) && near(um, u) {
                #[allow(clippy::cast_possible_truncation)] // below the limit
                return PaperVerdict::Settled {
                    m: m as u32,
                    n: osc.beta() * (time - time_m) / TAU,
                    impacts: j as u32 + 1,
                };
            }
        }
    }
    PaperVerdict::Unstable
}
