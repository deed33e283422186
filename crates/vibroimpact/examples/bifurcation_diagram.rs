//! An orbit diagram as CSV: impact velocities after the transient, over the gap.
//!
//!     cargo run --release -p vibroimpact --example bifurcation_diagram > gap.csv
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::{Oscillator, Start, SystemError};

fn main() -> Result<(), SystemError> {
    println!("gap,velocity");
    for k in 0..200 {
        let gap = 1.5 + 0.01 * f64::from(k);
        let osc = Oscillator::from_inverse_beta(1.11, gap, 0.5)?;
        let speeds = Motion::new(&osc, Start::at_rest(&osc)).filter_map(|event| match event.kind {
            EventKind::Impact { velocity_before, .. } => Some(velocity_before.abs()),
            _ => None,
        });
        for speed in speeds.skip(500).take(20) {
            println!("{gap:.2},{speed}");
        }
    }
    Ok(())
}
