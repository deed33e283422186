//! The Lyapunov exponents of a chaotic motion, with their error bars.
//!
//!     cargo run --release -p vibroimpact --example lyapunov
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

use vibroimpact::chaos::{ExponentOptions, exponents};
use vibroimpact::{Oscillator, Start, SystemError};

fn main() -> Result<(), SystemError> {
    let osc = Oscillator::from_inverse_beta(1.11, 3.0, 0.5)?;
    let found = exponents(&osc, Start::at_rest(&osc), &ExponentOptions::new(20_000, 1_000));
    println!("the motion is {}", found.motion.label());
    for (name, measured) in ["larger", "smaller"].into_iter().zip(found.exponents) {
        println!("{name} exponent {:.4} +- {:.4} per unit of time", measured.value, measured.error);
    }
    // an identity: the exponents add up to what impacts and damping take away
    println!("their sum {:.6}, and by the identity {:.6}", found.sum.value, found.identity);
    Ok(())
}
