use std::time::Instant;
use vibroimpact::flight::SearchLimits;
use vibroimpact::lanes::{Batch, Width};
use vibroimpact::{Start, scenario};
fn main() {
    for (name, point) in [("U", scenario::U), ("S", scenario::S)] {
        let osc = point.oscillator();
        for width in [Width::Avx2, Width::Avx512] {
            let mut batch = Batch::new(&osc, 256, width).unwrap();
            for k in 0..256 {
                batch.push(Start { x: osc.gap() - 0.01 * k as f64, v: -1.0, phase: 0.1 * k as f64 % 6.28 });
            }
            let mut best = 0.0_f64;
            let (mut impacts, mut left) = (0_usize, 0);
            let mut rounds = 0;
            for _ in 0..7 {
                let begin = Instant::now();
                let mut n = 0;
                while begin.elapsed().as_secs_f64() < 0.15 {
                    for _ in 0..50 {
                        batch.round();
                        rounds += 1;
                        n += batch.struck().len();
                        for slot in batch.rare().to_vec() {
                            left += 1;
                            batch.carefully(slot, SearchLimits::default());
                        }
                    }
                }
                impacts += n;
                best = best.max(n as f64 / begin.elapsed().as_secs_f64());
            }
            println!(
                "{name} {width:?}: {:.2} M/s; left {:.4} steps/impact {:.2}",
                best / 1e6,
                left as f64 / impacts as f64,
                rounds as f64 * 256.0 / impacts as f64
            );
        }
    }
}
