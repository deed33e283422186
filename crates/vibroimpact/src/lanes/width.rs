//! The number of flights side by side, and the choice of instructions by processor.

use super::pack::Pack;
use super::slots::{Lists, Slots};
use super::systems::{Each, One, Systems};
use super::uncertain::SEGMENT;
use crate::math::Lane;

#[cfg(target_arch = "x86_64")]
use super::avx2::Four;
#[cfg(target_arch = "x86_64")]
use super::avx512::Eight;
#[cfg(target_arch = "x86_64")]
use super::pair::Pair;
#[cfg(target_arch = "x86_64")]
use super::single::EightSingle;

/// The number of flights side by side. The results have the same bits for all widths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// Four, in the vector instructions of the target at compile time.
    Portable,
    /// Sixteen in four registers of four numbers; needs AVX2, BMI1, BMI2 and POPCNT.
    Avx2,
    /// Sixteen in two registers of eight numbers; needs AVX-512 (F, DQ, VL).
    Avx512,
}

impl Width {
    /// All widths, whether this machine has them or not.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// Whether this machine has the instructions.
    #[must_use]
    pub fn available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => {
                std::arch::is_x86_feature_detected!("avx2")
                    && std::arch::is_x86_feature_detected!("bmi1")
                    && std::arch::is_x86_feature_detected!("bmi2")
                    && std::arch::is_x86_feature_detected!("popcnt")
            }
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                Self::Avx2.available()
                    && std::arch::is_x86_feature_detected!("avx512f")
                    && std::arch::is_x86_feature_detected!("avx512dq")
                    && std::arch::is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// The fastest width that this machine has.
    #[must_use]
    pub fn best() -> Self {
        [Self::Avx512, Self::Avx2].into_iter().find(|width| width.available()).unwrap_or(Self::Portable)
    }

    /// Does a task in lanes of double precision.
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self {
            #[cfg(target_arch = "x86_64")]
            // available() has asked the processor
            #[allow(unsafe_code)]
            Self::Avx2 if self.available() => unsafe { run_avx2(task) },
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            Self::Avx512 if self.available() => unsafe { run_avx512(task) },
            _ => task.run::<Pack<f64, 4>>(),
        }
    }

    /// Whether lanes with another system in each slot are faster than one motion after another: a map takes a tenth to a
    /// sixth less time with AVX-512, and more time with narrower registers.
    pub(crate) fn suits_each(self) -> bool {
        self == Self::Avx512 && self.available()
    }

    /// Takes one step of every flight, and processes the contacts that it leads to.
    pub(super) fn round(self, slots: &mut Slots, systems: &One, lists: &mut Lists) {
        for segment in 0..slots.count.div_ceil(SEGMENT) {
            match self {
                #[cfg(target_arch = "x86_64")]
                // available() has asked the processor
                Self::Avx2 if self.available() => {
                    #[allow(unsafe_code)]
                    unsafe {
                        march_avx2(segment, slots, systems, lists);
                        strike_avx2(slots, systems, lists);
                        look_closer_avx2(slots, systems, lists);
                    }
                }
                #[cfg(target_arch = "x86_64")]
                Self::Avx512 if self.available() => {
                    #[allow(unsafe_code)]
                    unsafe {
                        round_avx512(segment, slots, systems, lists);
                    }
                }
                _ => {
                    slots.march::<Pack<f32, 4>>(segment, systems, lists);
                    slots.strike::<Pack<f64, 4>, _>(systems, lists);
                    slots.look_closer::<Pack<f64, 4>>(systems, lists);
                }
            }
        }
    }
}

/// The same where each slot has a system of its own, if the width [suits](Width::suits_each) them.
#[cfg_attr(not(target_arch = "x86_64"), allow(unused_variables))]
pub(super) fn round_of_each(slots: &mut Slots, systems: &Each, lists: &mut Lists) {
    #[cfg(target_arch = "x86_64")]
    if Width::Avx512.available() {
        for segment in 0..slots.count.div_ceil(SEGMENT) {
            // available() has asked the processor
            #[allow(unsafe_code)]
            unsafe {
                round_avx512(segment, slots, systems, lists);
            }
        }
    }
}

/// Something that is computed in lanes of any type. Lane types have 4 or 16 numbers.
pub(crate) trait Task {
    /// The result.
    type Output;
    /// Computes it; must be inlined, so that it is compiled for the processor's instructions.
    fn run<L: Lane>(self) -> Self::Output;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt")]
fn run_avx2<T: Task>(task: T) -> T::Output {
    task.run::<Pair<Pair<Four>>>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,bmi1,bmi2,popcnt")]
fn run_avx512<T: Task>(task: T) -> T::Output {
    task.run::<Pair<Eight>>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt")]
fn march_avx2(segment: usize, slots: &mut Slots, systems: &One, lists: &mut Lists) {
    slots.march::<Pair<EightSingle>>(segment, systems, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt")]
fn strike_avx2(slots: &mut Slots, systems: &One, lists: &mut Lists) {
    slots.strike::<Pair<Pair<Four>>, _>(systems, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt")]
fn look_closer_avx2(slots: &mut Slots, systems: &One, lists: &mut Lists) {
    slots.look_closer::<Pair<Four>>(systems, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,bmi1,bmi2,popcnt")]
fn round_avx512(segment: usize, slots: &mut Slots, systems: &impl Systems, lists: &mut Lists) {
    march_avx512(segment, slots, systems, lists);
    strike_avx512(slots, systems, lists);
    look_closer_avx512(slots, systems, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,bmi1,bmi2,popcnt")]
fn march_avx512(segment: usize, slots: &mut Slots, systems: &impl Systems, lists: &mut Lists) {
    slots.march::<Pair<EightSingle>>(segment, systems, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,bmi1,bmi2,popcnt")]
fn strike_avx512(slots: &mut Slots, systems: &impl Systems, lists: &mut Lists) {
    slots.strike::<Pair<Eight>, _>(systems, lists);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,bmi1,bmi2,popcnt")]
fn look_closer_avx512(slots: &mut Slots, systems: &impl Systems, lists: &mut Lists) {
    slots.look_closer::<Eight>(systems, lists);
}
