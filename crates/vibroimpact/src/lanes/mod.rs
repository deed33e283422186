//! Many flights side by side, with the same bits as a single flight.
//!
//! | idea | file |
//! |---|---|
//! | the constants of the flights of an oscillator: steps with a constant matrix | `stride`, `constants` |
//! | propagators that a long single motion needs again | `propagator_cache` |
//! | one oscillator for all lanes, or, with AVX-512, another one in each | `systems` |
//! | a step proven clear of the stops | `hull` |
//! | a step that comes close to a stop and turns back | `swing` |
//! | a contact that is found, refined and proven to be the first | `strike` |
//! | one flight from launch to contact | [`first_contact`] |
//! | the flights of a batch in memory, and the stages of a round | `slots` |
//! | points of one flight side by side; integrals over it; whether it exceeds an extreme | `points`, `integrals`, `extremes` |
//! | many motions that do not wait for each other | [`Batch`] |
//! | the number of flights side by side, and the choice by processor | [`Width`] |
//! | steps that are not proven clear, side by side; moving selected elements to the front | `uncertain`, `compaction` |
//! | the lane types | `pack` (portable), `avx2` and `single`, `avx512`, `pair`; the arithmetic of one register, `register` |
//!
//! The algorithm is written once, generic over the lane type of [`math`](crate::math). A single
//! [`Motion`](crate::motion::Motion) uses its scalar instance. Lanes and scalar agree bit for bit, because every lane
//! operation is one IEEE operation on each number separately.

#[cfg(test)]
mod agreement;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod batch;
mod compaction;
mod constants;
mod extremes;
mod flight;
mod hull;
mod integrals;
mod pack;
#[cfg(target_arch = "x86_64")]
mod pair;
mod points;
mod propagator_cache;
#[cfg(target_arch = "x86_64")]
mod register;
#[cfg(target_arch = "x86_64")]
mod single;
mod slots;
mod stride;
mod strike;
mod swing;
mod systems;
mod uncertain;
mod width;

pub use batch::{ABREAST, Batch};
pub(crate) use extremes::add_extremes;
pub use flight::first_contact;
pub(crate) use flight::found;
pub(crate) use integrals::add_integrals;
pub(crate) use points::Panels;
pub(crate) use propagator_cache::PropagatorCache;
pub(crate) use stride::Stride;
pub(crate) use systems::Kind;
pub(crate) use width::Task;
pub use width::Width;
