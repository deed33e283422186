//! x
use vibroimpact::flight::{Contact, Flight, SearchLimits, first_contact};
use vibroimpact::{Oscillator, Start, lanes};
fn main() {
    for (beta, gap) in [(1.7, 0.3), (0.9, 3.0), (0.77, 0.75), (0.6, 1.0),(1.111, 0.5), (1.3, -0.4)] {
        let osc = Oscillator::new(beta, gap, 1.0).unwrap();
        let (mut n, mut sum, mut sq, mut gsum, mut gsq) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut csum, mut csq) = (0.0, 0.0);
        for k in 0..200000 {
            let start = Start { x: gap, v: -0.2 - 3.0 * ((k as f64 * 0.618034) % 1.0), phase: (k as f64 * 0.7548) % 6.28 };
            let flight = Flight::new(&osc, start);
            let a = lanes::first_contact(&osc, &flight, SearchLimits::default());
            let c = first_contact(&osc, &flight, SearchLimits::default());
            if let (Contact::Impact { time, velocity, .. }, Contact::Impact { time: t2, velocity: v2, .. }) = (a, c) {
                let p = flight.at(time);
                let de = velocity - p.v;
                n += 1.0;
                sum += de;
                sq += de * de;
                let g = -p.displacement;
                gsum += g;
                gsq += g * g;
                let q = flight.at(t2);
                csum += v2 - q.v - q.displacement*0.0;
                csq += (v2 - q.v) * (v2 - q.v);
            }
        }
        println!("beta {beta} gap {gap}: dv mean {:.2e} rms {:.2e}; g mean {:.2e} rms {:.2e}; careful dv mean {:.2e} rms {:.2e} n {n}", sum / n, (sq / n).sqrt(), gsum / n, (gsq / n).sqrt(), csum / n, (csq / n).sqrt());
    }
}
