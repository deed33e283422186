//! An oscillator written as a machine of one coordinate moves as the oscillator: events, verdicts and branches of the same
//! 500 random systems with one or two stops, any restitution and damping.

#![allow(clippy::unwrap_used, reason = "a test")]

mod branches;
mod events;
mod reduced;
mod reduced_branches;
mod verdicts;

use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::{Oscillator, Side, Start};

/// Many small vectors are allocated for each event.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const SYSTEMS: usize = 500;

/// The random systems.
fn systems() -> impl Iterator<Item = System> {
    let mut numbers = Random(1971);
    (0..SYSTEMS).map(move |_| random(&mut numbers))
}

/// Every fifth of them, or with `VIBROIMPACT_LONG=1` all: for what takes long.
fn some() -> impl Iterator<Item = System> {
    systems().step_by(if is_long() { 1 } else { 5 })
}

fn is_long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok_and(|value| value == "1")
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / 2.0_f64.powi(32)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn one_in(&mut self, n: f64) -> bool {
        self.unit() * n < 1.0
    }

    fn restitution(&mut self) -> f64 {
        if self.one_in(6.0) {
            0.0
        } else if self.one_in(6.0) {
            1.0
        } else {
            self.unit()
        }
    }
}

#[derive(Clone)]
struct System {
    oscillator: Oscillator,
    start: Start,
    text: String,
}

fn random(random: &mut Random) -> System {
    let beta = (random.within(0.05_f64.ln(), 20.0_f64.ln())).exp();
    let (gap, restitution) = (random.within(-1.0, 5.0), random.restitution());
    let damping = if random.one_in(3.0) { 0.0 } else { random.within(0.0, 1.5) };
    let mut oscillator = Oscillator::new(beta, gap, restitution).unwrap().with_damping(damping).unwrap();
    let mut lowest = gap - 4.0;
    let mut text = format!("beta {beta} gap {gap} restitution {restitution} damping {damping}");
    if random.one_in(2.0) {
        let (lower, other) = (random.within(-gap.min(4.0) + 0.05, 5.0), random.restitution());
        oscillator = oscillator.with_second_stop(lower, other).unwrap();
        lowest = -lower;
        text += &format!(" lower {lower} restitution {other}");
    }
    let start = Start {
        x: random.within(lowest, gap),
        v: random.within(-4.0, 4.0),
        phase: random.within(0.0, core::f64::consts::TAU),
    };
    System { oscillator, start, text: format!("{text} from {start:?}") }
}

impl System {
    fn machine(&self) -> Machine {
        let of = &self.oscillator;
        let mut parts = MachineParts::new(["x"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 2.0 * of.damping())
            .with_frequency(of.beta())
            .with_force(0, 1, 0.0, 1.0);
        for (side, stop) in of.stops() {
            let name = if side == Side::Upper { "upper" } else { "lower" };
            parts = parts.with_rigid_stop(name, &[side.sign()], stop.gap, stop.restitution);
        }
        Machine::new(parts).unwrap()
    }

    fn machine_start(&self) -> vibroimpact::events::Start {
        vibroimpact::events::Start {
            q: vec![self.start.x],
            qdot: vec![self.start.v],
            phase: self.start.phase,
            ..Default::default()
        }
    }
}
