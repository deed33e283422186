//! The contact of a free mass with a spring and a damper, in closed form.
//!
//! A mass $`m`$ reaches the contact with the speed $`v`$; its depth obeys $`m\ddot y + c\dot y + ky = 0`$, $`y(0) = 0`$,
//! $`\dot y(0) = v`$. With $`\omega_0 = \sqrt{k/m}`$, $`\zeta = c/(2\sqrt{km})`$ and
//!
//! $$`A(\zeta) = \frac{\arccos\zeta}{\sqrt{1-\zeta^2}} = \frac{\operatorname{arcosh}\zeta}{\sqrt{\zeta^2-1}}, \qquad A(1) = 1,`$$
//!
//! the depth is largest at $`\omega_0 t = A`$, where it is $`(v/\omega_0)e^{-\zeta A}`$. A contact that opens when its force
//! falls to zero does so at $`\omega_0 t = 2A`$, with the restitution $`e^{-2\zeta A}`$ and at the depth
//! $`2\zeta\,(v/\omega_0)\,e^{-2\zeta A}`$; one that opens at depth 0 does so at $`\omega_0 t = \pi/\sqrt{1-\zeta^2}`$,
//! with $`e^{-\pi\zeta/\sqrt{1-\zeta^2}}`$, if $`\zeta < 1`$ and else never. The force $`c\dot y + ky`$ is largest at
//! $`\omega_0 t = (3\arccos\zeta - \pi)/\sqrt{1-\zeta^2}`$ if $`\zeta < \tfrac12`$, where it is $`v\sqrt{km}\,e^{-\zeta\omega_0 t}`$, and else
//! at once, $`cv`$ (T. Schwager and T. Pöschel, "Coefficient of restitution and linear-dashpot model revisited",
//! Granular Matter 9 (2007) 465-469, doi:10.1007/s10035-007-0065-z).

use super::{Fault, MachineError, Opening};
use crate::math::{atan2, exp, exp_m1, ln, ln_1p};
use core::f64::consts::PI;

/// A larger damping ratio gives no smaller restitution that a double can tell from 0.
const LARGEST_RATIO: f64 = 1e154;

/// A contact with a spring and a damper in parallel, and the mass that strikes it. Units are any consistent ones.
///
/// ```
/// use vibroimpact::machine::{Opening, SpringDamper};
/// let contact = SpringDamper::with_restitution(2.0, 800.0, 0.6, Opening::Force)?;
/// assert!((contact.restitution() - 0.6).abs() < 1e-15);
/// assert!(contact.residual_depth(1.5) > 0.0); // its surface stands back when it opens
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDamper {
    mass: f64,
    stiffness: f64,
    damping: f64,
    opening: Opening,
}

/// A number that must be positive. Products of two of them are finite.
fn positive(name: &str, value: f64) -> Result<f64, MachineError> {
    let fault = || Fault::Range { value, range: "1e-100 to 1e100" };
    if (1e-100..=1e100).contains(&value) { Ok(value) } else { Err(MachineError::new(name, fault())) }
}

/// $`1 - \zeta^2`$, and the root of its absolute value.
fn root(ratio: f64) -> (f64, f64) {
    let square = (1.0 - ratio) * (1.0 + ratio);
    // the square of a larger ratio may be infinite, and its root is the ratio to rounding
    (square, if ratio > 1e10 { ratio } else { square.abs().sqrt() })
}

/// A(ζ) of the formulas of this file.
fn angle(ratio: f64) -> f64 {
    let (square, root) = root(ratio);
    if root == 0.0 {
        1.0
    } else if square > 0.0 {
        atan2(root, ratio) / root
    } else {
        ln_1p((ratio - 1.0) + root) / root
    }
}

/// The restitution of a contact with a damping ratio.
fn restitution(ratio: f64, opening: Opening) -> f64 {
    match opening {
        Opening::Force => exp(-2.0 * ratio * angle(ratio)),
        Opening::Position if ratio >= 1.0 => 0.0,
        Opening::Position => exp(-PI * ratio / root(ratio).1),
    }
}

impl SpringDamper {
    /// The contact of a mass with this stiffness and damping.
    ///
    /// # Errors
    /// [`MachineError`] for a mass or stiffness that is not positive, or a damping that is negative; none may be infinite.
    pub fn new(mass: f64, stiffness: f64, damping: f64, opening: Opening) -> Result<Self, MachineError> {
        let (mass, stiffness) = (positive("mass", mass)?, positive("stiffness", stiffness)?);
        if !(0.0..=1e100).contains(&damping) {
            let fault = Fault::Range { value: damping, range: "0 to 1e100" };
            return Err(MachineError::new("damping", fault));
        }
        Ok(Self { mass, stiffness, damping, opening })
    }

    /// The contact of a mass with this stiffness and damping ratio.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_damping_ratio(mass: f64, stiffness: f64, ratio: f64, opening: Opening) -> Result<Self, MachineError> {
        Self::new(mass, stiffness, 2.0 * ratio * (stiffness * mass).sqrt(), opening)
    }

    /// The contact of a mass with this stiffness that has this restitution.
    ///
    /// # Errors
    /// The same for mass and stiffness, and for a restitution outside 0 to 1 or 0: a contact of restitution 0 never opens.
    pub fn with_restitution(mass: f64, stiffness: f64, wanted: f64, opening: Opening) -> Result<Self, MachineError> {
        if !(wanted > 0.0 && wanted <= 1.0) {
            let fault = Fault::Range { value: wanted, range: "0 < value <= 1" };
            return Err(MachineError::new("restitution", fault));
        }
        let loss = -ln(wanted);
        let ratio = match opening {
            Opening::Position => loss / crate::math::hypot(PI, loss),
            // the restitution falls with the damping ratio
            Opening::Force if loss == 0.0 => 0.0,
            Opening::Force => {
                crate::math::root::border(0.0, LARGEST_RATIO.min(1.0 / wanted), |ratio| {
                    restitution(ratio, opening) > wanted
                })
                .1
            }
        };
        Self::with_damping_ratio(mass, stiffness, ratio, opening)
    }

    /// The mass.
    #[must_use]
    pub const fn mass(&self) -> f64 {
        self.mass
    }

    /// The stiffness $`k`$.
    #[must_use]
    pub const fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// The damping $`c`$.
    #[must_use]
    pub const fn damping(&self) -> f64 {
        self.damping
    }

    /// When it opens.
    #[must_use]
    pub const fn opening(&self) -> Opening {
        self.opening
    }

    /// The damping ratio $`\zeta = c/(2\sqrt{km})`$.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        self.damping / (2.0 * (self.stiffness * self.mass).sqrt())
    }

    /// The frequency $`\omega_0 = \sqrt{k/m}`$ of the mass on the spring, in radians per unit of time.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    /// The quotient of the speeds of separation and of approach, for any speed; 0 if it never opens.
    #[must_use]
    pub fn restitution(&self) -> f64 {
        restitution(self.damping_ratio(), self.opening)
    }

    /// The time from closing to opening, for any speed; infinite if it never opens.
    #[must_use]
    pub fn contact_time(&self) -> f64 {
        let ratio = self.damping_ratio();
        let turned = match self.opening {
            Opening::Force => 2.0 * angle(ratio),
            Opening::Position if ratio >= 1.0 => f64::INFINITY,
            Opening::Position => PI / root(ratio).1,
        };
        turned / self.frequency()
    }

    /// The largest depth after an approach at this speed.
    #[must_use]
    pub fn deepest(&self, speed: f64) -> f64 {
        let ratio = self.damping_ratio();
        speed / self.frequency() * exp(-ratio * angle(ratio))
    }

    /// The largest force after an approach at this speed.
    #[must_use]
    pub fn peak_force(&self, speed: f64) -> f64 {
        let ratio = self.damping_ratio();
        if ratio >= 0.5 {
            return self.damping * speed;
        }
        let (_, root) = root(ratio);
        let turned = (3.0 * atan2(root, ratio) - PI) / root;
        speed * (self.stiffness * self.mass).sqrt() * exp(-ratio * turned)
    }

    /// The depth at which it opens after an approach at this speed, where its surface stands back and recovers; 0 of a
    /// contact that opens at depth 0.
    #[must_use]
    pub fn residual_depth(&self, speed: f64) -> f64 {
        match self.opening {
            Opening::Force => 2.0 * self.damping_ratio() * speed / self.frequency() * self.restitution(),
            Opening::Position => 0.0,
        }
    }

    /// Depth and force at a time after the approach at this speed, as if it did not open.
    #[must_use]
    pub fn at(&self, speed: f64, time: f64) -> (f64, f64) {
        let ratio = self.damping_ratio();
        let ((square, root), turned) = (root(ratio), self.frequency() * time);
        // e^(-ζ t) sin(√ t)/√ and e^(-ζ t) cos(√ t), with the hyperbolic functions beyond critical damping
        let (sine, cosine) = if root * turned < 1e-9 {
            let decay = exp(-ratio * turned);
            (decay * turned, decay)
        } else if square > 0.0 {
            let (sine, cosine) = crate::math::sin_cos(root * turned);
            let decay = exp(-ratio * turned);
            (decay * sine / root, decay * cosine)
        } else {
            // the difference of two exponentials that may be close
            let (slow, apart) = (exp(-turned / (ratio + root)), -exp_m1(-2.0 * root * turned));
            (0.5 * slow * apart / root, 0.5 * slow * (2.0 - apart))
        };
        let depth = speed / self.frequency() * sine;
        let rate = speed * (cosine - ratio * sine);
        (depth, self.stiffness * depth + self.damping * rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contacts() -> impl Iterator<Item = SpringDamper> {
        let ratios = [0.0, 1e-9, 0.1, 0.3, 0.499, 0.5, 0.7, 0.999, 1.0, 1.000_000_1, 1.5, 8.0, 1e6];
        let openings = [Opening::Force, Opening::Position];
        ratios.into_iter().flat_map(move |ratio| {
            openings.map(|opening| SpringDamper::new(2.0, 18.0, 2.0 * ratio * 6.0, opening).unwrap())
        })
    }

    /// The formulas beside the motion that they are of: force or depth is zero at the opening, nothing before is deeper or has
    /// more force, and the speed there is the restitution times that of the approach.
    #[test]
    fn the_motion_has_these_times_depths_and_forces() {
        let speed = 0.7;
        for contact in contacts() {
            let time = contact.contact_time();
            if time.is_infinite() {
                continue;
            }
            let samples: Vec<(f64, f64)> =
                (0..=4000).map(|k| contact.at(speed, time * f64::from(k) / 4000.0)).collect();
            let most = |of: fn(&(f64, f64)) -> f64| samples.iter().map(of).fold(0.0, f64::max);
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-5 * (a.abs() + b.abs());
            assert!(close(most(|s| s.0), contact.deepest(speed)), "{contact:?}");
            assert!(close(most(|s| s.1), contact.peak_force(speed)), "{contact:?}");
            let (depth, force) = contact.at(speed, time);
            let zero = if contact.opening() == Opening::Force { force / contact.peak_force(speed) } else { depth };
            assert!(zero.abs() < 1e-14, "{contact:?} {zero}");
            assert!((depth - contact.residual_depth(speed)).abs() < 1e-15, "{contact:?}");
            let h = 1e-6;
            let rate = (contact.at(speed, time + h).0 - contact.at(speed, time - h).0) / (2.0 * h);
            assert!((-rate / speed - contact.restitution()).abs() < 1e-9, "{contact:?} {rate}");
        }
    }

    #[test]
    fn a_restitution_gives_the_damping_that_has_it() {
        for opening in [Opening::Force, Opening::Position] {
            for wanted in [1.0, 0.999_999, 0.9, 0.5, 0.135_335_283_236_612_7, 0.1, 1e-3, 1e-12] {
                let contact = SpringDamper::with_restitution(2.0, 50.0, wanted, opening).unwrap();
                let given = contact.restitution();
                assert!((given / wanted - 1.0).abs() < 1e-12, "{opening:?} {wanted} {given}");
            }
            for refused in [0.0, -0.1, 1.1, f64::NAN] {
                assert!(SpringDamper::with_restitution(2.0, 50.0, refused, opening).is_err());
            }
        }
        let extreme = SpringDamper::new(1e-100, 1e-100, 1e100, Opening::Force).unwrap();
        assert!(extreme.restitution() == 0.0 && extreme.peak_force(1.0) == 1e100 && extreme.deepest(1.0) >= 0.0);
        assert!(SpringDamper::new(0.0, 1.0, 0.0, Opening::Force).is_err());
        assert!(SpringDamper::new(1.0, 1.0, -1.0, Opening::Force).is_err());
    }
}
