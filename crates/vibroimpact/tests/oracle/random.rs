//! Random oscillators and starts, over all ranges, the same on every machine.

use super::case::Case;
use core::f64::consts::TAU;
use vibroimpact::Side;

/// `SplitMix64` (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195).
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// Stream number `index` of a named family.
    pub(crate) fn new(family: u64, index: u64) -> Self {
        let mut seed = Self(family.wrapping_mul(0xd134_2543_de82_ef95) ^ index);
        Self(seed.next())
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    #[allow(clippy::cast_precision_loss)] // 53 bits fit
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * 2_f64.powi(-53)
    }

    pub(crate) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// $10^e$ with `e` uniform.
    pub(crate) fn decade(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.uniform(low, high))
    }

    pub(crate) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    pub(crate) fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        let n = of.len() as u64;
        of[usize::try_from(self.next() % n).expect("an index")]
    }

    /// Draws until there is one.
    pub(crate) fn until<T>(&mut self, draw: impl Fn(&mut Self) -> Option<T>) -> T {
        loop {
            if let Some(drawn) = draw(self) {
                return drawn;
            }
        }
    }

    pub(crate) fn phase(&mut self) -> f64 {
        if self.chance(0.03) { 0.0 } else { (TAU * self.unit()).min(TAU.next_down()) }
    }

    /// Frequency ratios: the whole range, resonance and its neighbourhood, whole-number and paper ratios.
    pub(crate) fn beta(&mut self) -> f64 {
        const SPECIAL: [f64; 15] = [
            1.0,
            1.0 + 1e-3,
            1.0 - 1e-3,
            1.0 + 1e-6,
            1.0 - 1e-6,
            1.0 + 1e-9,
            1.0 - 1e-9,
            1.0 + 1e-12,
            1.0 - 1e-12,
            2.0,
            4.0,
            0.5,
            1.0 / 0.7,
            1.0 / 0.6,
            1.0 / 1.11,
        ];
        if self.chance(0.5) { self.decade(-2.0, 2.0) } else { self.one_of(&SPECIAL) }
    }

    pub(crate) fn damping(&mut self) -> f64 {
        match self.next() % 20 {
            0..14 => 0.0,
            14..18 => self.decade(-6.0, 0.477),
            18 => 1.0,
            _ => 1.0 + self.sign() * self.decade(-15.5, -1.0),
        }
    }

    pub(crate) fn gap(&mut self) -> f64 {
        match self.next() % 10 {
            0..7 => self.uniform(-3.0, 5.0),
            7 | 8 => self.one_of(&[0.0, -0.95, -0.5, 1.0]),
            _ => self.sign() * self.decade(-15.0, -1.0),
        }
    }

    /// A whole question.
    pub(crate) fn case(&mut self) -> Case {
        loop {
            let (beta, zeta, gap) = (self.beta(), self.damping(), self.gap());
            let second = self.chance(0.15).then(|| self.decade(-3.0, 0.7) - gap);
            if second.is_some_and(|second| gap + second <= 0.0) {
                continue;
            }
            let bare = Case { beta, zeta, gap, second, x: gap, v: 0.0, phase: self.phase(), release: None };
            let case = match self.next() % 100 {
                0..60 => self.on_stop(bare),
                60..62 => self.let_go(bare),
                62..68 => self.beside_stop(bare),
                _ => self.free(bare),
            };
            if let Some(case) = case {
                return case;
            }
        }
    }

    /// On a stop and leaving; a third of them against a force into the stop, as chattering does.
    fn on_stop(&mut self, bare: Case) -> Option<Case> {
        let lower = bare.second.filter(|_| self.chance(0.5));
        let (sign, x) = lower.map_or((1.0, bare.gap), |second| (-1.0, -second));
        let mut case = Case { x, v: -sign * self.decade(-9.0, 1.0), ..bare };
        if self.chance(0.33) {
            for _ in 0..20 {
                if sign * (case.phase.sin() - case.x) > 0.0 {
                    break;
                }
                case.phase = self.phase();
            }
        }
        if self.chance(0.02) {
            // at rest: it leaves under the force or stays, but not so that rounding decides
            case.v = 0.0;
            if (case.phase.sin() - case.x).abs() < 1e-9 {
                return None;
            }
        }
        Some(case)
    }

    /// Released from a stop: the force towards it has just vanished.
    fn let_go(&mut self, bare: Case) -> Option<Case> {
        let (side, x) = match bare.second {
            Some(second) if self.chance(0.5) => (Side::Lower, -second),
            _ => (Side::Upper, bare.gap),
        };
        if x.abs() > 0.99 {
            return None;
        }
        // the force falls through the level of the upper stop, rises through that of the lower one
        let rising = x.asin();
        let phase = match side {
            Side::Upper => core::f64::consts::PI - rising,
            Side::Lower => rising.rem_euclid(TAU),
        };
        (phase < TAU).then_some(Case { x, v: 0.0, phase, release: Some(side), ..bare })
    }

    /// A few units in the last place, or a little more, short of a stop.
    fn beside_stop(&mut self, bare: Case) -> Option<Case> {
        let mut x = bare.gap;
        if self.chance(0.5) {
            for _ in 0..=self.next() % 3 {
                x = x.next_down();
            }
        } else {
            x -= self.decade(-14.0, -3.0);
        }
        let v = if self.chance(0.1) { 0.0 } else { self.sign() * self.decade(-9.0, 1.0) };
        allowed(Case { x, v, ..bare })
    }

    /// Anywhere.
    fn free(&mut self, bare: Case) -> Option<Case> {
        let depth = if self.chance(0.5) { self.decade(-6.0, 0.7) } else { self.uniform(0.0, 5.0) };
        let x = if self.chance(0.1) { 0.0 } else { bare.gap - depth };
        let v = if self.chance(0.1) { 0.0 } else { self.sign() * self.decade(-6.0, 1.0) };
        allowed(Case { x, v, ..bare })
    }
}

/// The case, where its start is strictly between the stops, by more than the oracle's last place.
fn allowed(case: Case) -> Option<Case> {
    (case.gap - case.x > 1e-60 && case.second.is_none_or(|gap| case.x > -gap)).then_some(case)
}
