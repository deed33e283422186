//! The rule of the 1971 paper, eq. (11)-(12). It is provided to reproduce the paper and is not reliable.
//!
//! After each impact j the rule searches for the smallest m with
//!
//! $$`\left|\frac{z_{j-m}}{z_j} - 1\right| < \frac{p}{100} \quad\text{and}\quad \left|\frac{u_{j-m}}{u_j} - 1\right| < \frac{p}{100},
//!   \tag{11}`$$
//!
//! where $`z_j`$ is the interval before impact j and $`u_j`$ its speed. Then $`n = \beta(\tau_j - \tau_{j-m})/2\pi`$
//! (12). After 100 impacts without success the motion is called unstable. (The printed paper has an extra $`-1`$ in the
//! numerators of (11), with which the ratios could not be near 1.) The rule does not distinguish a slow transient from
//! a period, nor a limit of ever gentler impacts from 1/10; [`settle`](super::settle) does.

use crate::motion::{EventKind, MAX_TOUCHES, Motion};
use crate::system::{Oscillator, Start};
use core::f64::consts::TAU;

/// The constants of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperRule {
    /// Tolerance $`p`$ in per cent. The paper does not state it ("suitably chosen"); the default is 0.1.
    pub percent: f64,
    /// The number of impacts after which the motion is called unstable.
    pub limit: u32,
}

impl Default for PaperRule {
    fn default() -> Self {
        Self { percent: 0.1, limit: 100 }
    }
}

/// The result of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaperVerdict {
    /// Settled: m impacts in n forcing periods, with n from (12).
    Settled {
        /// Impacts per period.
        m: u32,
        /// Forcing periods, not rounded.
        n: f64,
        /// The number of impacts until the rule was satisfied.
        impacts: u32,
    },
    /// The rule was not satisfied within the limit.
    Unstable,
    /// There are no more impacts.
    NoMoreImpacts,
    /// The mass sticks; the simulation of the paper ended there.
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
        // m < j: the first interval begins at the initial conditions and not at an impact
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
