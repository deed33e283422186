//! How many flights are flown side by side, and the one place where the processor is asked.

use super::pack::Pack;
use super::pair::Pair;
use super::slots::{Lists, Slots};
use super::stride::{Stride, Table};
use crate::math::Lane;

#[cfg(target_arch = "x86_64")]
use super::avx2::Four;

/// How many flights are flown side by side. The results are the same bits for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// One after another: what the others are compared with.
    Scalar,
    /// Four, in whatever vectors the target has at compile time.
    Portable,
    /// Eight as two registers of four; needs AVX2.
    Avx2,
    /// Eight in a register; needs AVX-512.
    Avx512,
}

impl Width {
    /// All of them, whether this machine has them or not.
    pub const ALL: [Self; 4] = [Self::Scalar, Self::Portable, Self::Avx2, Self::Avx512];

    /// Whether this machine has it.
    #[must_use]
    pub fn available(self) -> bool {
        match self {
            Self::Scalar | Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => std::arch::is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512dq")
            }
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// The fastest this machine has.
    #[must_use]
    pub fn best() -> Self {
        if Self::Avx2.available() { Self::Avx2 } else { Self::Portable }
    }

    /// One step of every flight, and the strikes it leads to.
    pub(super) fn round(self, slots: &mut Slots, stride: &Stride, table: &Table, lists: &mut Lists) {
        match self {
            Self::Scalar => round::<f64, f64>(slots, stride, table, lists),
            #[cfg(target_arch = "x86_64")]
            // the processor was asked
            Self::Avx2 if self.available() => {
                #[allow(unsafe_code)]
                unsafe {
                    avx2(slots, stride, table, lists);
                }
            }
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if self.available() => {
                #[allow(unsafe_code)]
                unsafe {
                    avx512(slots, stride, table, lists);
                }
            }
            _ => round::<Pack<4>, Pack<4>>(slots, stride, table, lists),
        }
    }
}

#[inline(always)]
fn round<L: Lane, Narrow: Lane>(slots: &mut Slots, stride: &Stride, table: &Table, lists: &mut Lists) {
    slots.march::<L>(stride, lists);
    slots.strike::<L, Narrow>(stride, table, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(slots: &mut Slots, stride: &Stride, table: &Table, lists: &mut Lists) {
    round::<Pair<Four>, Four>(slots, stride, table, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn avx512(slots: &mut Slots, stride: &Stride, table: &Table, lists: &mut Lists) {
    round::<Pack<8>, Pack<8>>(slots, stride, table, lists);
}
