//! Scratch: impacts per second of the scalar path at U and S.
use std::time::Instant;
use vibroimpact::{flight::*, *};
fn main() {
    for (ib, gap) in [(1.11, 3.0), (1.3, 0.75), (1.8, 0.25)] {
        let osc = Oscillator::from_inverse_beta(ib, gap, 0.5).unwrap();
        let mut st = Start::at_rest(&osc);
        let t = Instant::now();
        let n = 1_000_000;
        let mut last = [0.0; 3];
        for _ in 0..n {
            let f = Flight::new(&osc, st);
            match first_contact(&osc, &f, SearchLimits::default()) {
                Contact::Impact { time, velocity, .. } => {
                    st = Start { x: gap, v: -0.5 * velocity, phase: f.phase_at(time) };
                    last = [time, velocity, st.phase];
                }
                other => { println!("{other:?}"); break; }
            }
        }
        println!("{ib} {gap}: {:.3} M/s {last:?}", n as f64 / t.elapsed().as_secs_f64() / 1e6);
    }
}
