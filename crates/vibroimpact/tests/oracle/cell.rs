//! What can be proven of a flight between two known points of it.
//!
//! Let $y = \sigma x - \delta$ be the position past a stop, and let $y, \dot y$ be known at both ends of a cell of
//! length $h$. The cubic through these four numbers differs from $y$ by $\ddddot y(\xi)\,s^2(h-s)^2/24$, hence by at most
//! $B_4h^4/384$, and lies below the largest of its four Bernstein coefficients. If that maximum plus that error is
//! negative the cell is clear.
//!
//! When the flight begins on the stop, $y(0) = 0$ and only $s > 0$ counts: the cubic divided by $t = s/h$ is a quadratic
//! with three Bernstein coefficients, and the error divided by $t$ is at most $B_4h^4/162$; at rest on the stop the
//! division by $t^2$ leaves a line and $B_4h^4/24$.
//!
//! $B_4$: the larger of $|x|$ and $|v|$, $N$, obeys $N' \le (1+2\zeta)(N+1)$, so in the cell $N \le
//! (N_0+1)e^{(1+2\zeta)h} - 1$ (Grönwall), and the equation of motion, differentiated, gives $|\ddot x| \le B_2 = 1 +
//! (1+2\zeta)N$, $B_3 = \beta + N + 2\zeta B_2$, $B_4 = \beta^2 + B_2 + 2\zeta B_3$.
//!
//! The tests themselves run in doubles. Their roundings are relative to the four numbers they start from, and a slack
//! of sixteen such roundings is taken off every claim.

/// A stop seen from one point: position past it, velocity and acceleration towards it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) y: f64,
    pub(crate) p: f64,
    pub(crate) q: f64,
    /// How far `y` may be off beyond its own last place, and `q`.
    pub(crate) noise: f64,
    pub(crate) noise_q: f64,
}

/// Bounds on derivatives in a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    b3: f64,
    b4: f64,
}

impl Bounds {
    /// In a cell of length `h` that begins with $\max(|x|, |v|)$ = `size`.
    pub(crate) fn new(beta: f64, zeta: f64, size: f64, h: f64) -> Self {
        let rate = 1.0 + 2.0 * zeta;
        let most = (1.0 + 1e-12) * ((size + 1.0) * (rate * h).exp() - 1.0);
        let b2 = 1.0 + rate * most;
        let b3 = beta + most + 2.0 * zeta * b2;
        let b4 = beta * beta + b2 + 2.0 * zeta * b3;
        Self { b3, b4 }
    }

    /// How far the cubic may be from the flight.
    pub(crate) fn cubic_error(&self, h: f64) -> f64 {
        self.b4 * h.powi(4) / 384.0
    }
}

/// What is proven of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// No contact in it.
    Clear,
    /// Exactly one contact: short of the stop on the left, beyond it on the right, approaching throughout.
    Rises,
    /// Short of the stop at both ends, bent back throughout, with the closest point inside.
    Arch,
    /// Nothing: cut it in two.
    Cut,
}

/// Judges the cell of length `h` between `a` and `b`; `on_stop`: `a` is the beginning of a flight from this stop.
pub(crate) fn judge(a: &View, b: &View, h: f64, bounds: Bounds, on_stop: bool) -> Verdict {
    let rounding = 16.0 * f64::EPSILON * (a.y.abs() + b.y.abs() + h * (a.p.abs() + b.p.abs()));
    let slack = rounding + a.noise.max(b.noise);
    let first = a.y + h * a.p / 3.0;
    let second = b.y - h * b.p / 3.0;
    let fourth = bounds.b4 * h.powi(4);
    let clear = if !on_stop {
        a.y.max(first).max(second).max(b.y) + fourth / 384.0 + slack < 0.0
    } else if a.p < 0.0 {
        (h * a.p).max(1.5 * second).max(b.y) + fourth / 162.0 + slack < 0.0
    } else {
        (3.0 * second).max(b.y) + fourth / 24.0 + slack < 0.0
    };
    if clear {
        return Verdict::Clear;
    }
    // velocity and acceleration by their chords: error at most (second derivative) h^2/8
    let steep = bounds.b3 * h * h / 8.0;
    let bend = bounds.b4 * h * h / 8.0 + a.noise_q.max(b.noise_q);
    let speed_slack = 4.0 * f64::EPSILON * (a.p.abs() + b.p.abs()) + slack;
    let (short, b_short) = (on_stop || a.y < -a.noise, b.y < -b.noise);
    let concave = a.q.max(b.q) + bend < 0.0;
    if short && a.p.max(b.p) + steep + speed_slack < 0.0 || short && concave && a.p <= -speed_slack {
        return Verdict::Clear;
    }
    if !on_stop && short && a.p.min(b.p) - steep - speed_slack > 0.0 {
        if b.y > b.noise {
            return Verdict::Rises;
        }
        if b_short {
            return Verdict::Clear;
        }
    }
    if !on_stop && short && b_short && concave && a.p > speed_slack && b.p < -speed_slack {
        return Verdict::Arch;
    }
    Verdict::Cut
}
