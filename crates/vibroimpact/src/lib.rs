//! Vibro-impact dynamics: oscillators with rigid stops, and machines with stops and friction.
//!
//! A mass on a spring, driven harmonically, strikes a rigid stop:
//!
//! $$`\ddot\xi + 2\zeta\dot\xi + \xi = \sin(\beta\tau + \varphi_0), \quad \xi \le \delta, \quad u_+ = -\varepsilon u_-.`$$
//!
//! This crate computes such motions event by event in closed form, decides and confirms which motion they settle into,
//! and finds periodic orbits, stable or not. It differs from general solvers in three ways:
//!
//! - **no impact is missed** ([`flight::first_contact`]): the search only advances over times in which contact is
//!   proven impossible;
//! - **chatter and sticking are completed** ([`contact`]): infinitely many impacts in finite time are summed with a
//!   bounded error, the mass sticks, and it is released when the force changes sign;
//! - **verdicts are confirmed** ([`verdict::settle`]): a motion is called periodic if Newton's method on its impact map
//!   has converged and the motion is captured by that cycle, chaotic if its Lyapunov exponent exceeds its error bar,
//!   free of impacts for a stated reason, and otherwise undecided.
//!
//! ```
//! use vibroimpact::{Oscillator, Start, verdict::{SettleOptions, Verdict, settle}};
//!
//! // 1/beta = 1.8, delta = 0.25, eps = 0.5: point N of the 1971 paper
//! let osc = Oscillator::from_inverse_beta(1.8, 0.25, 0.5)?;
//! let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
//! let Verdict::Periodic(cycle) = settled.verdict else { panic!("it is periodic") };
//! assert_eq!(cycle.label.to_string(), "4/1");          // four impacts in one forcing period
//! assert!(cycle.stable() && cycle.residual < 1e-13);   // Newton's method closed it to rounding
//! # Ok::<(), vibroimpact::SystemError>(())
//! ```
//!
//! # One direction of data
//!
//! [`Oscillator`] → [`Flight`](flight::Flight) → [`Contact`](flight::Contact) → [`Event`](motion::Event) →
//! [`Motion`](motion::Motion) → [`Cycle`](orbit::Cycle) → [`Verdict`](verdict::Verdict). Each arrow is one function in
//! one place; each name is a plain value that depends only on those to its left. The crate is pure: its functions
//! compute values from values, without files, threads, clocks, randomness or logging, and the bits are the same on
//! every platform ([`math`]).
//!
//! | topic | module |
//! |---|---|
//! | parameters, starts, physical units | [`system`] |
//! | the motion between impacts, the first contact | [`flight`] |
//! | impact, chatter and sticking at a stop | [`contact`] |
//! | events in order, impact map, stroboscopic map, waveforms | [`motion`] |
//! | the motion after the transient, attractors and their shares | [`verdict`] |
//! | many motions side by side | [`lanes`], [`verdict::settle_many`] |
//! | periodic orbits, stable or not | [`orbit`] |
//! | how orbits change with a parameter, and the events on the way | [`continuation`] |
//! | the border between the starts of two motions, and the saddle on it | [`edge`] |
//! | Lyapunov exponents, dimension, sections of an attractor | [`chaos`] |
//! | impact speeds, impulses, energies, amplitudes, spectrum | [`quantities`] |
//! | machines of several coordinates, with any stops and friction, and their events | [`machine`], [`events`] |
//! | what machines settle into, their cycles, branches and exponents | [`verdict::settle_machine`], [`orbit::machine::Cycle`], [`continuation::machine::Branch`], [`chaos::machine_exponents_while`] |
//! | the points of the 1971 paper | [`scenario`] |
//!
//! # Units
//!
//! All quantities are nondimensional - lengths in static deflections $`F/k`$, times in $`1/\omega_n`$ - unless a name
//! says otherwise. [`machine::Reduction`] converts those of a machine, and [`Scales`] answers to its units. Phases are in radians in $`[0, 2\pi)`$;
//! arrival speeds are positive.
//!
//! # Source
//!
//! The model, the method and the labels m/n are those of K. Fukaya and T. Irie, "On the Transient Oscillation of a
//! Vibro-Impact
//! System", Bulletin of the Faculty of Engineering, Hokkaido University 62 (1971) 31-39,
//! <https://hdl.handle.net/2115/41063>.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod arc;
pub mod chaos;
pub mod contact;
pub mod continuation;
pub mod edge;
pub mod events;
pub mod flight;
pub mod lanes;
mod lyapunov;
pub mod machine;
pub mod math;
pub mod motion;
pub mod orbit;
pub mod quantities;
pub mod regime;
pub mod scenario;
pub mod system;
pub mod verdict;

pub use orbit::Label;
pub use system::{
    Oscillator, OscillatorFamily, Parameter, ParameterPath, ParameterPlane, QuantityKind, Scales, Side, Start, Stop,
    SystemError,
};

/// The listings of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// The listing of the README of this crate is compiled and run with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct CrateReadme;
