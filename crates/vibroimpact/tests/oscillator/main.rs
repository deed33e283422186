//! The oscillator: its motions, orbits, verdicts and quantities, against closed forms, differences, fine waveforms and each other.
//!
//! | what | file |
//! |---|---|
//! | Lyapunov exponents, and sections of an attractor | `chaos` |
//! | chatter, sticking and landing on a stop | `chatter` |
//! | derivatives of flights and impacts | `derivatives` |
//! | the border between the starts of two motions | `edge` |
//! | energy and the work of the force | `energy` |
//! | the flights of a batch are those of motions alone | `lanes` |
//! | crossings, states at given times, and those in every period | `motions` |
//! | the search for periodic orbits, and known ones | `orbits` |
//! | solutions whose impact has no speed | `orbits_at_a_touch` |
//! | quantities of random attractors | `quantities` |
//! | what motions settle into | `settling` |
//! | events and verdicts of many motions at once | `side_by_side` |
//! | verdicts that were wrong once | `verdicts` |
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod chaos;
mod chatter;
mod derivatives;
mod edge;
mod energy;
mod lanes;
mod motions;
mod orbits;
mod orbits_at_a_touch;
mod quantities;
mod settling;
mod side_by_side;
mod verdicts;

/// Whether long tests run in full.
fn is_long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok_and(|value| value == "1")
}
