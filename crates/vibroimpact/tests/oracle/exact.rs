//! The flight with 256 binary places, searched cell by cell to a horizon.

use super::case::Case;
use super::cell::View;
use super::elementary::sin_cos;
use super::fixed::Fixed;
use super::search::{Cell, Curve, Found, examine};
use super::textbook::{Data, Node, Solution};
use vibroimpact::Side;

/// A flight and its stops.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exact {
    pub(crate) solution: Solution,
    beta: f64,
    zeta: f64,
    x: f64,
    /// $\sigma x_0 - \delta$ for the upper and the lower stop.
    past: [Option<Fixed>; 2],
}

/// A contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strike {
    pub(crate) side: Side,
    pub(crate) s: Fixed,
    /// Velocity and acceleration towards the stop.
    pub(crate) p: f64,
    pub(crate) q: f64,
}

/// A closest point, `past` beyond the stop (negative: short of it).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Apex {
    pub(crate) side: Side,
    pub(crate) s: Fixed,
    pub(crate) past: f64,
}

/// What happens up to a horizon.
#[derive(Clone, Debug, Default)]
pub(crate) struct Story {
    pub(crate) strike: Option<Strike>,
    /// Near misses before it, or before the horizon.
    pub(crate) touches: Vec<Apex>,
    /// Nothing but these is there up to this time.
    pub(crate) searched: f64,
}

impl Exact {
    pub(crate) fn new(case: &Case) -> Self {
        let exact = Fixed::from_f64;
        let x = exact(case.x);
        let mut force = sin_cos(exact(case.phase));
        let past = [Some(x - exact(case.gap)), case.second.map(|gap| -x - exact(gap))];
        if let Some(side) = case.release {
            // at rest on a stop that has just let go: the phase is the one at which the force vanishes, exactly; the
            // double is the nearest to it, and its rounding counts as that of a datum
            let square = Fixed::ONE - x * x;
            let cosine = square * square.inverse_sqrt();
            force = (x, if side == Side::Upper { -cosine } else { cosine });
        }
        let data = Data { beta: exact(case.beta), zeta: exact(case.zeta), x, v: exact(case.v), force };
        Self { solution: Solution::new(data), beta: case.beta, zeta: case.zeta, x: case.x, past }
    }

    /// The length of a cell.
    pub(crate) fn cell_length(&self) -> f64 {
        0.7 / (1.0 + 2.0 * self.zeta).max(self.beta.sqrt())
    }

    pub(crate) fn past(&self, node: &Node, side: Side) -> Fixed {
        match side {
            Side::Upper => self.past[0].expect("there is an upper stop") + node.d,
            Side::Lower => self.past[1].expect("asked of a stop that is there") - node.d,
        }
    }

    fn sides(&self) -> impl Iterator<Item = Side> + use<> {
        let second = self.past[1].is_some();
        [Side::Upper, Side::Lower].into_iter().filter(move |side| second || *side == Side::Upper)
    }

    /// Everything up to `horizon`; the time when the search began inside the known contact of a release.
    pub(crate) fn story(&self, horizon: f64, released: bool) -> Story {
        let h = self.cell_length();
        let step = Fixed::from_f64(h);
        let turn = self.solution.factors(step);
        let mut factors = self.solution.factors(Fixed::ZERO);
        // the amplitudes give the start back to some seventy digits only
        let start = self.solution.node(Fixed::ZERO, &factors);
        let mut a = Node { d: Fixed::ZERO, v: self.solution.data().v, ..start };
        let mut story = Story::default();
        if released {
            // y <= j s^3/6 + B4 s^4/24 < 0 until -4 j / B4, with j = -beta |cos phase| and B4 < 1 + (1 + beta)^2 + ...
            let jerk = self.beta * self.solution.data().force.1.to_f64().abs();
            let fourth = 4.0 * (1.0 + self.beta) * (1.0 + self.beta) * (1.0 + self.x.abs()) * (1.0 + self.zeta).powi(3);
            let clear = Fixed::from_f64((jerk / fourth).min(0.1));
            factors = self.solution.factors(clear);
            a = self.solution.node(clear, &factors);
        }
        let mut begin = !released;
        while a.s.to_f64() < horizon {
            factors = self.solution.advance(&factors, &turn);
            let b = self.solution.node(a.s + step, &factors);
            for side in self.sides() {
                let on_stop = begin && self.past(&a, side) == Fixed::ZERO;
                let mut found = Vec::new();
                examine(self, side, Cell { a, b, h, on_stop }, &mut found);
                for one in found {
                    match one {
                        Found::Rise { a, b, .. } => {
                            let strike = self.refine(side, &a, &b);
                            if story.strike.is_none_or(|other| (strike.s - other.s).is_negative()) {
                                story.strike = Some(strike);
                            }
                        }
                        Found::Touch { at, past } => story.touches.push(Apex { side, s: at.s, past }),
                        Found::Unresolved => {
                            let at = (a.s.to_f64(), self.view(&a, side), h);
                            panic!("sixty digits do not resolve what happens at {side:?} after {at:?}")
                        }
                    }
                }
            }
            if story.strike.is_some() {
                return story;
            }
            (a, begin) = (b, false);
            story.searched = a.s.to_f64();
        }
        story
    }

    /// The only contact between `a`, short of the stop, and `b`, beyond it, to forty digits.
    pub(crate) fn refine(&self, side: Side, a: &Node, b: &Node) -> Strike {
        let (mut low, mut high) = (a.s, b.s);
        let mut node = *a;
        for _ in 0..400 {
            let view = self.view(&node, side);
            if view.y < 0.0 {
                low = node.s;
            } else {
                high = node.s;
            }
            let step = Fixed::from_f64((-view.y / view.p).clamp(-1e3, 1e3));
            let mut next = node.s + step;
            if (next - low).is_negative() || (high - next).is_negative() {
                next = (low + high).halved(1);
            }
            let moved = (next - node.s).abs().to_f64();
            node = self.solution.at(next);
            if moved <= 1e-24 * next.to_f64() {
                break;
            }
        }
        let view = self.view(&node, side);
        Strike { side, s: node.s, p: view.p, q: view.q }
    }

    /// The root of the distance near `node`, by Newton's iteration from there.
    pub(crate) fn polish(&self, side: Side, node: &Node) -> Strike {
        let mut node = *node;
        for _ in 0..20 {
            let view = self.view(&node, side);
            let step = (-view.y / view.p).clamp(-1e-3, 1e-3);
            node = self.solution.at((node.s + Fixed::from_f64(step)).abs());
        }
        let view = self.view(&node, side);
        Strike { side, s: node.s, p: view.p, q: view.q }
    }

    /// The acceleration towards the stop.
    pub(crate) fn bend(&self, side: Side, s: Fixed) -> f64 {
        self.view(&self.solution.at(s), side).q
    }

    /// The extremum near `s`, by Newton's iteration on the velocity.
    pub(crate) fn extremum(&self, side: Side, s: Fixed) -> Option<Apex> {
        let mut node = self.solution.at(s);
        for _ in 0..60 {
            let view = self.view(&node, side);
            let step = -view.p / view.q;
            if step.is_nan() || step.abs() >= 1.0 {
                return None;
            }
            let next = node.s + Fixed::from_f64(step);
            if next.is_negative() {
                return None;
            }
            node = self.solution.at(next);
            if step.abs() <= 1e-24 * next.to_f64() {
                return Some(Apex { side, s: node.s, past: self.past(&node, side).to_f64() });
            }
        }
        None
    }
}

impl Curve for Exact {
    type Node = Node;

    fn view(&self, node: &Node, side: Side) -> View {
        let sign = side.sign();
        let noise_q =
            1e-14 * (1.0 + self.x.abs() + node.d.to_f64().abs() + (1.0 + 2.0 * self.zeta) * node.v.to_f64().abs());
        View { y: self.past(node, side).to_f64(), p: sign * node.v.to_f64(), q: sign * node.a, noise: 0.0, noise_q }
    }

    fn size(&self, node: &Node) -> f64 {
        (self.x.abs() + node.d.to_f64().abs()).max(node.v.to_f64().abs())
    }

    fn rates(&self) -> (f64, f64) {
        (self.beta, self.zeta)
    }

    fn after(&self, a: &Node, h: f64) -> Option<Node> {
        (h > 1e-40).then(|| self.solution.at(a.s + Fixed::from_f64(h)))
    }

    fn apex(&self, side: Side, a: &Node, b: &Node) -> Option<(Node, f64)> {
        // the velocity falls from positive to negative, once
        let (mut low, mut high) = (a.s, b.s);
        let mut node = *a;
        for _ in 0..400 {
            let view = self.view(&node, side);
            if view.p > 0.0 {
                low = node.s;
            } else {
                high = node.s;
            }
            let mut next = node.s + Fixed::from_f64((-view.p / view.q).clamp(-1e3, 1e3));
            if (next - low).is_negative() || (high - next).is_negative() {
                next = (low + high).halved(1);
            }
            let moved = (next - node.s).abs().to_f64();
            node = self.solution.at(next);
            // an error of 1e-30 in time is one of 1e-60 in the height of the apex
            if moved <= 1e-30 {
                break;
            }
        }
        let past = self.past(&node, side).to_f64();
        Some((node, past))
    }
}
