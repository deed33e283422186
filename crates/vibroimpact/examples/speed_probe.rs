//! Scratch.
use std::time::Instant;
use vibroimpact::{scenario, verdict::*};
fn main() {
    for p in scenario::PAPER {
        let osc = p.oscillator();
        let t = Instant::now();
        let mut c = Census::default();
        let mut imp = 0;
        let mut worst = (0.0, 0);
        for i in 0..200 {
            let s = scattered_starts(&osc, StartBox::natural(&osc), 1, i);
            let t1 = Instant::now();
            let r = settle(&osc, s, &SettleOptions::default());
            imp += r.impacts;
            c.add(&r.verdict);
            let e = t1.elapsed().as_secs_f64();
            if e > worst.0 {
                worst = (e, i);
            }
        }
        println!(
            "{} {:.3} s, {imp} impacts, worst {worst:?}",
            p.name,
            t.elapsed().as_secs_f64()
        );
        for f in c.by_share() {
            println!("   {} {:.3}", f.verdict.label(), c.share(f));
        }
    }
}
