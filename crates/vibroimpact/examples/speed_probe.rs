//! Scratch.
#![allow(clippy::print_stdout)]
use std::time::Instant;
use vibroimpact::{verdict::*, *};
fn main() {
    for d in [-0.95, -0.75, -0.5, -0.25, 0.0, 0.25] {
        for ib in [0.6, 0.9, 1.11, 1.3, 1.8, 2.5] {
            let osc = Oscillator::from_inverse_beta(ib, d, 0.5).unwrap();
            let t = Instant::now();
            let c = attractors(&osc, 20, 1, &SettleOptions::default());
            let v: Vec<String> =
                c.by_share().iter().map(|f| format!("{} {:.2}", f.verdict.label(), c.share(f))).collect();
            println!("{d} {ib}: {} [{:.1} ms]", v.join(", "), t.elapsed().as_secs_f64() * 1e3);
        }
    }
    for (beta, gap, eps, z, x, v) in [
        (1e-6, 0.5, 0.5, 0.0, 0.0, 0.0),
        (1e6, 0.5, 0.5, 0.0, 0.0, 0.0),
        (1e-6, 1.5, 0.5, 0.0, 0.0, 0.0),
        (1e-6, 0.5, 0.5, 0.1, 0.0, 0.0),
        (1e6, 0.0, 0.5, 0.0, 0.0, 0.0),
        (1e6, 1e-13, 0.5, 0.0, 0.0, 0.0),
        (1.0, 1e12, 0.5, 0.0, 0.0, 0.0),
        (1.5, 1e12, 0.5, 0.0, 0.0, 0.0),
        (0.9, 1.0, 0.5, 0.0, 0.0, 1e9),
        (0.9, -1e12, 0.5, 0.0, -1e12, 0.0),
        (0.9, -0.5, 1.0, 0.0, -0.5, 0.0),
        (0.9, -0.5, 0.9999, 0.0, -0.5, 0.0),
        (0.9, 1.0, 0.5, 1e-9, 0.0, 0.0),
        (0.9, 7.0, 0.5, 1e-9, 0.0, 3.0),
        (0.9, 0.5, 0.5, 1e3, 0.0, 0.0),
        (0.9, 0.5, 0.5, 1e9, 0.0, 1e9),
        (1e-12, 0.5, 0.5, 0.0, 0.0, 0.0),
        (1e300, 0.5, 0.5, 0.0, 0.0, 0.0),
        (1e-300, 0.5, 0.5, 0.0, 0.0, 0.0),
        (0.9, 1e300, 0.5, 0.0, 0.0, 1e300),
        (1e-6, -0.5, 0.5, 0.0, -0.5, 0.0),
        (1e-3, 0.999, 0.9, 0.0, -0.5, 0.0),
        (1e6, -1e-3, 0.5, 0.0, -0.5, 0.0),
        (1e6, -0.5, 0.5, 0.0, -0.5, 1.0),
        (1.0, 1.0, 0.0, 0.0, 0.0, 0.0),
        (1.3f64.recip(), 0.3, 0.0, 0.0, 0.0, 0.0),
        (0.9, 0.9999999, 0.5, 0.0, 0.0, 0.0),
        (0.9, 1.0, 0.0, 0.0, 0.0, 0.0),
        (0.9, -1.0, 0.5, 0.0, -1.0, 0.0),
    ] {
        let osc = Oscillator::new(beta, gap, eps).unwrap().with_damping(z).unwrap();
        let t = Instant::now();
        let s = settle(&osc, Start::new(&osc, x, v, 0.0).unwrap(), &SettleOptions::default());
        let text = format!("{:?}", s.verdict);
        println!(
            "beta {beta:e} gap {gap:e} eps {eps} z {z:e} v {v:e}: {} imp {} [{:.1} ms] {}",
            s.verdict.label(),
            s.impacts,
            t.elapsed().as_secs_f64() * 1e3,
            &text[..text.len().min(110)]
        );
    }
}
