//! Times for which a flight cannot reach a stop: proven bounds.
//!
//! Let $`y = \sigma x - \delta_\sigma \le 0`$ be the (negative) distance from a stop, $`p = \dot y`$, $`q = \ddot y`$.
//! The energy radius $`r = \sqrt{x^2 + v^2}`$ satisfies $`\dot r = (v\sin\theta - 2\zeta v^2)/r \le 1`$. So over a
//! window of length $`H`$
//!
//! $$`|x| \le r + H, \quad |v| \le V = \min\bigl(r + H,\ |v_0| + (1 + (r+H)(1+2\zeta))H\bigr),`$$
//! $$`|\ddot x| \le B_2 = 1 + (r+H) + 2\zeta V, \quad |\dddot x| \le B_3 = \beta + V + 2\zeta B_2,`$$
//! $$`|x^{(4)}| \le B_4 = \beta^2 + B_2 + 2\zeta B_3, \quad |x^{(5)}| \le B_5 = \beta^3 + B_3 + 2\zeta B_4.`$$
//!
//! These bounds hold for every $`\beta`$ and $`\zeta`$. They stay small at resonance, where bounds from the amplitudes
//! of the free and the forced part grow without limit. With
//! $`c = q + \max(0, \min(B_3 H, \dddot y_0 H + \tfrac12 B_4 H^2))`$, at most $`B_2`$, as an upper bound of $`\ddot y`$
//! in the window,
//!
//! $$`y(h) \le y + p h + \tfrac12 c h^2 \qquad (0 \le h \le H),`$$
//!
//! and as long as the right side is negative, the stop has not been reached. Near a transversal contact the first zero of
//! this bound converges to the contact quadratically and is always before it.

use super::Flight;
use crate::math::hypot;
use crate::system::Side;

/// The state of the flight relative to one stop, mirrored if it is the lower one.
#[derive(Clone, Copy)]
pub(super) struct View {
    pub(super) side: Side,
    /// Distance from the stop.
    pub(super) g: f64,
    /// Velocity, acceleration and third derivative towards the stop.
    pub(super) p: f64,
    pub(super) q: f64,
    pub(super) j: f64,
}

/// Bounds of the derivatives of `x` over a window that begins at a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) b2: f64,
    pub(super) b3: f64,
}

impl Window {
    /// The bounds over a time `span` from a state with energy radius `r` and speed `speed`.
    #[inline]
    pub(super) fn new(flight: &Flight, r: f64, speed: f64, span: f64) -> Self {
        let (beta, zeta2) = (flight.response().beta(), 2.0 * flight.response().damping());
        let reach = r + span;
        let fastest = reach.min(speed + (1.0 + reach * (1.0 + zeta2)) * span);
        let b2 = 1.0 + reach + zeta2 * fastest;
        Self { b2, b3: beta + fastest + zeta2 * b2 }
    }

    pub(super) fn b4(&self, flight: &Flight) -> f64 {
        let (beta, zeta2) = (flight.response().beta(), 2.0 * flight.response().damping());
        beta * beta + self.b2 + zeta2 * self.b3
    }

    pub(super) fn b5(&self, flight: &Flight) -> f64 {
        let (beta, zeta2) = (flight.response().beta(), 2.0 * flight.response().damping());
        beta * beta * beta + self.b3 + zeta2 * self.b4(flight)
    }
}

impl Flight {
    /// Bounds of the third derivatives of position, velocity and acceleration where the energy radius is at most `r`.
    pub(crate) fn third_derivatives(&self, r: f64) -> [f64; 3] {
        let window = Window::new(self, r, r, 0.0);
        [window.b3, window.b4(self), window.b5(self)]
    }
}

impl Flight {
    /// Bounds of $`|x|`$, $`|v|`$ and $`|a|`$ over the whole flight, however long: the amplitude of the forced
    /// oscillation $`x_p = \operatorname{Im}(Pe^{i\theta})`$, $`P = 1/(1 - \beta^2 + 2i\zeta\beta)`$, and of the free
    /// one, whose radius $`R = |(x_0 - x_p, v_0 - v_p)|`$ does not grow:
    ///
    /// $$`|x| \le R + |P|,\quad |v| \le R + \beta|P|,\quad |a| \le (1 + 2\zeta)R + \beta^2|P|.`$$
    ///
    /// They contain a margin for rounding errors. They are not finite at resonance without damping, and where the
    /// amplitude underflows.
    pub(crate) fn largest(&self) -> [f64; 3] {
        let (beta, zeta2) = (self.response().beta(), 2.0 * self.response().damping());
        let (detuning, cross) = ((1.0 - beta) * (1.0 + beta), zeta2 * beta);
        let over = 1.0 / (detuning * detuning + cross * cross);
        if over < f64::MIN_POSITIVE {
            return [f64::INFINITY; 3];
        }
        let (real, imaginary) = (detuning * over, -cross * over);
        let (x, v) = (real * self.sin + imaginary * self.cos, beta * (real * self.cos - imaginary * self.sin));
        let forced = over.sqrt();
        let free = (self.x - x) * (self.x - x) + (self.v - v) * (self.v - v);
        let margin = 1.0 + 1e-9;
        let free = free.sqrt() * margin;
        let forced = forced * margin;
        [free + forced, free + beta * forced, (1.0 + zeta2) * free + beta * beta * forced]
    }
}

/// The first positive zero of $`-g + p h + c h^2/2`$ for `g > 0`, or infinity if there is none.
#[inline]
pub(super) fn first_zero(g: f64, p: f64, c: f64) -> f64 {
    let disc = p * p + 2.0 * c * g;
    if disc < 0.0 {
        return f64::INFINITY;
    }
    let root = disc.sqrt();
    if p > 0.0 {
        2.0 * g / (p + root)
    } else if c > 0.0 {
        (root - p) / c
    } else {
        f64::INFINITY
    }
}

/// A time in which the stop at distance `g > 0` cannot be reached, from the state with velocity `p`, acceleration `q`
/// and third derivative `j` towards the stop and energy radius `r`. `reach` is the length of the window that is tried.
#[inline]
pub(super) fn safe_time(flight: &Flight, View { g, p, q, j, .. }: View, r: f64, reach: f64) -> f64 {
    let near = Window::new(flight, r, p.abs(), reach);
    // the largest y'' in the window: q + max(0, j h + B4 h^2/2)
    let rise = (reach * (j + 0.5 * near.b4(flight) * reach)).max(0.0).min(near.b3 * reach);
    let by_third = first_zero(g, p, (q + rise).min(near.b2)).min(reach);
    // the bound by the second derivative alone needs no short window; for fast forcing it gives a longer time
    let by_second = first_zero(g, p, Window::new(flight, r, p.abs(), FAR).b2).min(FAR);
    by_third.max(by_second)
}

/// Window of the bound by the second derivative alone.
const FAR: f64 = 1.0;

/// For a flight that begins on a stop: a time in which it does not return to it, with the contact at `s = 0` divided
/// out.
///
/// The bound is $`y(h)/h \le p + q h/2 + (\dddot y_0 + B_4 H) h^2/6`$; its first positive zero is returned, but at most
/// the window. At rest ($`p = 0`$) the next order is used, and so on up to the fourth. `None` means that the mass does
/// not leave the stop.
pub(super) fn leave_time(flight: &Flight, sign: f64, gap: f64, r: f64) -> Option<f64> {
    let (p, q) = (sign * flight.v, sign * flight.a);
    let (j, k) = (sign * flight.jerk(), sign * flight.snap());
    if p > 0.0 {
        return None;
    }
    let mut window = 0.5 / (1.0 + flight.fastest);
    if p < 0.0 {
        if q > 0.0 {
            // four times the time after which a constant acceleration would bring it back
            window = window.min(-8.0 * p / q);
        }
        let b4 = Window::new(flight, r, p.abs(), window).b4(flight);
        let (b, c) = (0.5 * q, (j + b4 * window) / 6.0);
        let disc = b * b - 4.0 * p * c;
        let zero = if disc < 0.0 {
            f64::INFINITY
        } else if b + disc.sqrt() > 0.0 {
            -2.0 * p / (b + disc.sqrt())
        } else {
            f64::INFINITY
        };
        return Some(zero.min(window));
    }
    if gap >= 1.0 {
        // the force never presses: g'' + 2 zeta g' + g = gap - sin >= 0 from rest keeps g >= 0 while S >= 0, which is
        // at least half a natural period, whatever the rounding errors of the derivatives are when the force is zero
        return Some(window);
    }
    if gap <= -1.0 {
        // the force never pulls, at most it is zero for a moment, as at gap -1 and phase 3 pi/2: the mass sticks for
        // ever
        return None;
    }
    let bounds = Window::new(flight, r, p.abs(), window);
    if q < 0.0 {
        // q/2 + (j + b4 H) h/6 < 0
        let c = j + bounds.b4(flight) * window;
        return Some(if c > 0.0 { (-3.0 * q / c).min(window) } else { window });
    }
    if q == 0.0 && j < 0.0 {
        return Some((-0.5 * j / bounds.b4(flight)).min(window));
    }
    if q == 0.0 && j == 0.0 && k < 0.0 {
        return Some((-0.5 * k / bounds.b5(flight)).min(window));
    }
    None
}

/// Proves that exactly one transversal contact lies within `(0, span]`, and returns `span`: the velocity towards the
/// stop stays positive, and a lower bound of `y` at `span` is beyond the stop by more than `rounding`. `None` if this
/// is not proven.
#[inline]
pub(super) fn single_contact_within(flight: &Flight, View { g, p, q, .. }: View, r: f64, rounding: f64) -> Option<f64> {
    if p <= 0.0 {
        return None;
    }
    let span = 2.0 * g / p;
    if span > FAR {
        return None;
    }
    let window = Window::new(flight, r, p.abs(), span);
    let lowest = (q - window.b3 * span).max(-window.b2);
    // y(span) >= -g + p span + lowest span^2/2 = g + lowest span^2/2
    (p + lowest * span > 0.0 && g + 0.5 * lowest * span * span > rounding).then_some(span)
}

/// The energy radius of a state.
#[inline]
pub(super) fn radius(x: f64, v: f64) -> f64 {
    let square = x * x + v * v;
    // the square overflows only for valid but very large states
    if square < 1e300 { square.sqrt() } else { hypot(x, v) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Oscillator, Start};

    /// No point of a long flight is outside, and long flights without damping come close. Near resonance, where the two
    /// amplitudes are large and cancel, the bounds are wide.
    #[test]
    fn amplitudes_bound_the_flight() {
        for (beta, zeta) in [(0.05, 0.0), (0.7, 0.02), (0.999, 0.0), (1.0, 0.0), (1.0, 0.3), (2.3, 0.0), (0.9, 1.6)] {
            let osc = Oscillator::new(beta, 900.0, 0.5).unwrap().with_damping(zeta).unwrap();
            for k in 0..20 {
                let (a, b) = (f64::from(k * 37 % 20) / 20.0, f64::from(k * 3 % 20) / 20.0);
                let flight = Flight::new(&osc, Start { x: 3.0 * a - 1.0, v: 4.0 * b - 2.0, phase: 6.0 * a * b });
                let bounds = flight.largest();
                let mut most = [0.0_f64; 3];
                for step in 0..40_000 {
                    let at = flight.at(0.01 * f64::from(step));
                    for (most, value) in most.iter_mut().zip([at.x, at.v, at.a]) {
                        *most = most.max(value.abs());
                    }
                }
                for (most, bound) in most.into_iter().zip(bounds) {
                    let resonance = beta == 1.0 && zeta == 0.0;
                    assert!(if resonance { !bound.is_finite() } else { most <= bound }, "{beta} {zeta} {most} {bound}");
                    assert!(zeta > 0.0 || (beta - 1.0).abs() < 0.01 || bound < 1.05 * most, "{beta} {most} {bound}");
                }
            }
        }
        // the amplitude of the force underflows
        let osc = Oscillator::new(1e100, 9.0, 0.5);
        assert!(
            osc.is_err() || Flight::new(&osc.unwrap(), Start { x: 0.0, v: 0.0, phase: 0.0 }).largest()[0].is_infinite()
        );
    }
}
