//! The waveform of a motion as CSV: time, position, velocity.
//!
//!     cargo run -p vibroimpact --example waveform > wave.csv
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

use vibroimpact::motion::sample;
use vibroimpact::{Oscillator, Start, SystemError};

fn main() -> Result<(), SystemError> {
    let osc = Oscillator::new(0.9, 0.5, 0.7)?;
    let until = 10.0 * osc.period();
    println!("t,x,v");
    // a point every hundredth of a period, and one on each side of every impact
    for point in sample(&osc, Start::at_rest(&osc), until, osc.period() / 100.0, 100_000) {
        println!("{},{},{}", point.time, point.x, point.v);
    }
    Ok(())
}
