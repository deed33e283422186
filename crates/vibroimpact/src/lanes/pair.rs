//! A pair of lanes, so that there are more independent operations while a result is awaited.

use crate::math::{Lane, Mask, Numbers, Single, sin_cos_lanes};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A lane type of which two correspond to one of a single-precision type.
pub(super) trait Half: Lane {
    /// The type of single precision with twice the width.
    type Double: Single;

    /// Converts to double precision: the first half and the second half.
    fn both_widened(from: Self::Double) -> (Self, Self);
    /// Rounds two lanes to single precision.
    fn both_rounded(self, second: Self) -> Self::Double;
}

/// Two lanes of the same type.
#[derive(Clone, Copy)]
pub(super) struct Pair<T>(pub(super) T, pub(super) T);

macro_rules! both {
    ($($operation:ident $method:ident),*) => {$(
        impl<L: Numbers> $operation for Pair<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}
both!(Add add, Sub sub, Mul mul, Div div);

impl<L: Numbers> Neg for Pair<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

/// The truth values of a pair, and the width of the first.
#[derive(Clone, Copy)]
pub(super) struct PairMask<M>(M, M, usize);

impl<M: Mask> Mask for PairMask<M> {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0.and(other.0), self.1.and(other.1), self.2)
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0.or(other.0), self.1.or(other.1), self.2)
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        // the bits of the second half follow those of the first
        self.0.bits() | self.1.bits() << self.2
    }
}

impl<L: Numbers> Numbers for Pair<L> {
    type Mask = PairMask<L::Mask>;
    const WIDTH: usize = 2 * L::WIDTH;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(L::splat(x), L::splat(x))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        // the width goes with the mask, because masks of two types can have the same bits
        PairMask(self.0.less(other.0), self.1.less(other.1), L::WIDTH)
    }
    #[inline(always)]
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(L::choose(mask.0, yes.0, no.0), L::choose(mask.1, yes.1, no.1))
    }
}

impl<L: Half> Lane for Pair<L> {
    type Rough = L::Double;

    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        sin_cos_lanes(self)
    }

    #[inline(always)]
    fn widened(from: L::Double) -> Self {
        let (first, second) = L::both_widened(from);
        Self(first, second)
    }
    #[inline(always)]
    fn rounded(self) -> L::Double {
        self.0.both_rounded(self.1)
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self(L::load(from), L::load(&from[L::WIDTH..]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        self.0.store(to);
        self.1.store(&mut to[L::WIDTH..]);
    }
    #[inline(always)]
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N] {
        let (first, second) = (L::rows(table, at), L::rows(table, &at[L::WIDTH..]));
        let mut columns = [Self::splat(0.0); N];
        let mut k = 0;
        // a loop, because a closure is not always compiled for the processor's instructions
        while k < N {
            columns[k] = Self(first[k], second[k]);
            k += 1;
        }
        columns
    }
    #[inline(always)]
    fn store_rows(c: [Self; 8], rows: &mut [[f64; 8]]) {
        // the two halves write disjoint rows
        let (first, second) = rows.split_at_mut(L::WIDTH);
        L::store_rows([c[0].0, c[1].0, c[2].0, c[3].0, c[4].0, c[5].0, c[6].0, c[7].0], first);
        L::store_rows([c[0].1, c[1].1, c[2].1, c[3].1, c[4].1, c[5].1, c[6].1, c[7].1], second);
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor(), self.1.floor())
    }
    #[inline(always)]
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        let (first, second) = (L::turned(quarters.0, sin.0, cos.0), L::turned(quarters.1, sin.1, cos.1));
        (Self(first.0, second.0), Self(first.1, second.1))
    }
}

impl<N: Single> Single for Pair<N> {
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        Self(N::load(from), N::load(&from[N::WIDTH..]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store(to);
        self.1.store(&mut to[N::WIDTH..]);
    }
    #[inline(always)]
    fn store_some(self, bits: u32, to: &mut [f32]) {
        let first = bits & ((1 << N::WIDTH) - 1);
        // only chosen numbers are stored: the second half goes on where the first one stopped
        self.0.store_some(first, to);
        self.1.store_some(bits >> N::WIDTH, &mut to[first.count_ones() as usize..]);
    }
}

impl<H: Half> Half for Pair<H> {
    type Double = Pair<H::Double>;
    #[inline(always)]
    fn both_widened(from: Self::Double) -> (Self, Self) {
        let (a, b) = H::both_widened(from.0);
        let (c, d) = H::both_widened(from.1);
        (Self(a, b), Self(c, d))
    }
    #[inline(always)]
    fn both_rounded(self, second: Self) -> Self::Double {
        // four quarters in their order: the first pair is the first half of the result
        Pair(self.0.both_rounded(self.1), second.0.both_rounded(second.1))
    }
}
