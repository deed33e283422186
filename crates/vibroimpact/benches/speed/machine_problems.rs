//! The machines that are measured, with a start each: `benches/peers/python/machine_problems.py` has the same numbers.

use vibroimpact::events::Start;
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};

/// A machine that is measured.
pub(crate) struct Problem {
    pub(crate) name: &'static str,
    pub(crate) machine: Machine,
    pub(crate) start: Start,
}

/// Wave numbers of a clamped-free beam: cos k cosh k = -1.
const WAVE_NUMBERS: [f64; 6] = [
    1.875_104_068_711_961,
    4.694_091_132_974_175,
    7.854_757_438_237_613,
    10.995_540_734_875_467,
    14.137_168_391_046_47,
    17.278_759_532_088_237,
];

/// Two bodies on springs, the first of which strikes a rigid wall: irregular.
pub(crate) fn chain() -> Problem {
    let parts = MachineParts::new(["body", "shoe"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, -1.0], 1.0, 0.03)
        .with_link(&[0.0, 1.0], 1.0, 0.03)
        .with_frequency(1.8)
        .with_force(1, 1, 0.0, 1.0)
        .with_rigid_stop("wall", &[1.0, 0.0], 0.2, 0.8);
    problem("chain", parts, &[-0.5, 0.1])
}

/// A mass on a spring that strikes a stiff elastic stop: chaotic.
pub(crate) fn soft() -> Problem {
    let law = StopLaw::Compliant { stiffness: 40.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.04)
        .with_frequency(2.7)
        .with_force(0, 1, 0.0, 1.0)
        .with_stop("stop", &[1.0], 0.0, law);
    problem("soft", parts, &[-0.5])
}

/// A cantilever of this many modes on a shaken base, whose tip strikes a rigid stop.
pub(crate) fn beam(modes: usize) -> Problem {
    let names: Vec<String> = (1..=modes).map(|k| format!("mode{k}")).collect();
    let mut parts = MachineParts::new(names).with_frequency(1.3);
    let mut direction = vec![0.0; modes];
    for (i, tip) in direction.iter_mut().enumerate() {
        let odd = f64::from(u32::try_from(i).unwrap_or(0)) + 0.5;
        // beyond the table the wave number is (i + 1/2) pi to rounding
        let k = WAVE_NUMBERS.get(i).copied().unwrap_or(core::f64::consts::PI * odd);
        let omega = (k / WAVE_NUMBERS[0]).powi(2);
        let mut own = vec![0.0; modes];
        own[i] = 1.0;
        parts = parts.with_mass(i, 1.0).with_link(&own, omega * omega, 0.02 * omega);
        // shapes with unit mass are 2 at the tip with alternating signs; the mean of a shape is 2 (sin k + sinh k) ... / k
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let (sinh, cosh) = (k.sinh(), k.cosh());
        let sigma = (cosh + k.cos()) / (sinh + k.sin());
        *tip = 2.0 * sign;
        parts = parts.with_force(i, 1, 0.0, 0.5 * 2.0 * sigma / k);
    }
    problem("beam", parts.with_rigid_stop("stop", &direction, 0.5, 0.95), &[])
}

/// A free ball between two walls, which move with different harmonics.
pub(crate) fn ball() -> Problem {
    let mut parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_frequency(1.0)
        .with_rigid_stop("left", &[-1.0], 1.0, 0.9)
        .with_rigid_stop("right", &[1.0], 1.0, 0.9);
    parts.stops[0].motion = vec![HarmonicMotion { order: 1, cos: 0.0, sin: -0.3 }];
    parts.stops[1].motion =
        vec![HarmonicMotion { order: 1, cos: 0.2, sin: 0.0 }, HarmonicMotion { order: 2, cos: 0.0, sin: 0.1 }];
    let mut problem = problem("ball", parts, &[0.1]);
    problem.start.qdot = vec![0.9];
    problem
}

fn problem(name: &'static str, parts: MachineParts, q: &[f64]) -> Problem {
    let machine = Machine::new(parts).expect("a legal machine");
    Problem { name, machine, start: Start { q: q.to_vec(), ..Start::default() } }
}

/// All, with beams of 2, 6 and 12 modes.
pub(crate) fn all() -> Vec<Problem> {
    let named = |name: &'static str, problem: Problem| Problem { name, ..problem };
    vec![chain(), soft(), named("beam, 2 modes", beam(2)), beam(6), named("beam, 12 modes", beam(12)), ball()]
}
