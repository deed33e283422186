//! Quantities of a motion: impact speeds, impulses, energies, displacements, the spectrum.
//!
//! They come from the closed form of each flight and are right to rounding. Impacts are sums; work, loss in the damper
//! and mean squares are integrals ([`FlightIntegrals`](crate::flight::FlightIntegrals)); extremes miss no maximum
//! ([`Extremes`](crate::flight::Extremes)).
//!
//! | idea | file |
//! |---|---|
//! | the quantities by name, with their kinds | [`Quantity`], [`QuantityKind`](crate::system::QuantityKind) |
//! | a part of a motion: a flight, an impact, the rest of a chatter, an interval of sticking | [`Segment`] |
//! | the sums over the parts of a motion, and the quantities from them | [`Tally`], [`Quantities`] |
//! | the parts of a cycle, and its quantities | [`of_cycle`], [`cycle_segments`] |
//! | the quantities of a verdict, and of the way from a start | [`of_verdict`], [`of_transient`] |
//! | error bars of the means of a chaotic motion | [`errors_of_verdict`] |
//! | means from sums, of an oscillator and of the parts of a machine | `sums` |
//! | what is particular to machines | [`machine`] |
//! | amplitudes and phases of the harmonics of a cycle | [`harmonics`] |

mod cycle;
mod errors;
mod harmonic;
pub mod machine;
mod quantity;
mod segment;
mod sums;
mod tally;
mod verdict;

pub use crate::lyapunov::MEASURED_IMPACTS;
pub use cycle::{cycle_segments, of_cycle};
pub use errors::errors_of_verdict;
pub use harmonic::{Harmonic, harmonics};
pub use machine::{
    machine_cycle_quantities, machine_quantities, machine_quantity, machine_quantity_paths, machine_response_quantity,
};
pub use quantity::Quantity;
pub use segment::Segment;
pub use tally::{Quantities, Tally};
pub use verdict::{of_arrivals, of_transient, of_verdict, of_verdict_only};
