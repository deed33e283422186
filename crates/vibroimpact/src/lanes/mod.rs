//! Many flights side by side, to the same bits as one alone.
//!
//! | idea | file |
//! |---|---|
//! | the constants of an oscillator's flights: steps instead of sines | `stride` |
//! | a step proven clear of the stops | `hull` |
//! | a step that swings close to a stop and back | `swing` |
//! | a contact found, refined, proven to be the first | `strike` |
//! | one flight from launch to contact | [`first_contact`] |
//! | where the flights of a batch are kept, and their passes | `slots` |
//! | many motions, none waiting for another | [`Batch`] |
//! | how many side by side, and on what processor | [`Width`] |
//! | steps in doubt, side by side; moving some of them to the front | `uncertain`, `compaction` |
//! | the lane types | `pack` (portable), `avx2` and `single`, `avx512`, `pair` |
//!
//! The algorithm is written once, generic over the lane type of [`math`](crate::math). A single
//! [`Motion`](crate::motion::Motion) runs on its scalar instance. Lanes and scalar agree bit for bit, because every lane
//! operation is one IEEE operation on each number by itself.

#[cfg(test)]
mod agreement;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod batch;
mod compaction;
mod flight;
mod hull;
mod pack;
#[cfg(target_arch = "x86_64")]
mod pair;
#[cfg(target_arch = "x86_64")]
mod single;
mod slots;
mod stride;
mod strike;
mod swing;
mod uncertain;
mod width;

pub use batch::{ABREAST, Batch};
pub use flight::first_contact;
pub(crate) use flight::found;
pub(crate) use stride::Stride;
pub use width::Width;
