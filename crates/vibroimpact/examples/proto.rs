//! x
use std::time::Instant;
use vibroimpact::flight::SearchLimits;
use vibroimpact::lanes::{Batch, Width};
use vibroimpact::{Start, scenario};
fn main() {
    let fixed = std::env::args().nth(1);
    for (name, point) in [("U", scenario::U), ("S", scenario::S)] {
        if fixed.as_ref().is_some_and(|f| f != name) {
            continue;
        }
        let osc = point.oscillator();
        for width in [Width::Avx2, Width::Avx512].into_iter().filter(|w| w.available()) {
            let mut batch = Batch::new(&osc, 256, width).unwrap();
            for k in 0..256 {
                batch.push(Start { x: osc.gap() - 0.01 * k as f64, v: -1.0, phase: 0.1 * k as f64 % 6.28 });
            }
            if fixed.is_some() {
                let mut n = 0;
                for _ in 0..2000 {
                    batch.round();
                    n += batch.struck().len();
                    for s in batch.rare().to_vec() {
                        batch.carefully(s, SearchLimits::default());
                    }
                }
                println!("{name} {n}");
                return;
            }
            let mut best = 0.0_f64;
            for _ in 0..7 {
                let begin = Instant::now();
                let mut n = 0;
                while begin.elapsed().as_secs_f64() < 0.15 {
                    for _ in 0..50 {
                        batch.round();
                        n += batch.struck().len();
                        for slot in batch.rare().to_vec() {
                            batch.carefully(slot, SearchLimits::default());
                        }
                    }
                }
                best = best.max(n as f64 / begin.elapsed().as_secs_f64());
            }
            println!("{name} {width:?}: {:.2}", best / 1e6);
        }
    }
}
