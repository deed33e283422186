//! A branch of periodic orbits over the gap, with its bifurcations.
//!
//!     cargo run --release -p vibroimpact --example branch
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

use vibroimpact::continuation::{Branch, BranchOptions, Direction};
use vibroimpact::orbit::{FindOptions, find};
use vibroimpact::{Label, Oscillator, Parameter};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5)?;
    // of the orbits 1/1 the one with the fastest impact
    let orbit = find(&osc, Label::new(1, 1), FindOptions::default()).pop().ok_or("there is no orbit 1/1")?;
    let (range, options) = (0.0..=4.0, BranchOptions::default());
    let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range, Direction::Up, options)?;
    for point in branch {
        let stable = if point.cycle.stable() { "stable" } else { "unstable" };
        let event = point.event.map_or(String::new(), |event| format!(": {}", event.name()));
        println!("gap {:.6}, impact speed {:.6}, {stable}{event}", point.value, point.cycle.points[0].state.velocity);
    }
    Ok(())
}
