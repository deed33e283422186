//! Lane types of one register: their arithmetic, by intrinsics that act on each number separately.

/// Defines a lane type of `$count` numbers in a register. `max` and `min` must return the second operand unless the first is
/// greater (less), and `less` must be false where one is NaN, as the trait requires; `choose` takes `yes` where the mask is set.
///
/// # Safety
/// The intrinsics need a processor that has them: a value of the type exists only below an entry of [`super::width`] that has
/// asked it.
macro_rules! in_register {
    (
        $(#[$about:meta])* $name:ident($register:ty), $count:literal of $number:ty, mask $mask:ty,
        $($operation:ident $method:ident $intrinsic:ident),*;
        set1 $set1:ident, xor $xor:ident, andnot $andnot:ident, max $max:ident, min $min:ident, sqrt $sqrt:ident,
        less |$a:ident, $b:ident| $less:expr, choose |$set:ident, $yes:ident, $no:ident| $choose:expr
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy)]
        pub(super) struct $name(pub(super) $register);

        $(
            impl core::ops::$operation for $name {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(unsafe { $intrinsic(self.0, other.0) })
                }
            }
        )*

        impl core::ops::Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // flips the sign bit, of zeros and NaN too, as one number does
                Self(unsafe { $xor(self.0, $set1(-0.0)) })
            }
        }

        impl crate::math::Numbers for $name {
            type Mask = $mask;
            const WIDTH: usize = $count;
            #[inline(always)]
            fn splat(x: f64) -> Self {
                Self(unsafe { $set1(<$number as crate::math::Numbers>::splat(x)) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(unsafe { $andnot($set1(-0.0), self.0) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn less(self, other: Self) -> $mask {
                let ($a, $b) = (self.0, other.0);
                unsafe { $less }
            }
            #[inline(always)]
            fn choose(mask: $mask, yes: Self, no: Self) -> Self {
                let ($set, $yes, $no) = (mask.0, yes.0, no.0);
                Self(unsafe { $choose })
            }
        }
    };
}

/// Defines truth values in a register; all bits of an element are set, or none.
macro_rules! mask_in_register {
    ($name:ident($register:ty), and $and:ident, or $or:ident, bits $bits:ident) => {
        /// Truth values in a register.
        #[derive(Clone, Copy)]
        pub(super) struct $name($register);

        impl crate::math::Mask for $name {
            #[inline(always)]
            fn and(self, other: Self) -> Self {
                Self(unsafe { $and(self.0, other.0) })
            }
            #[inline(always)]
            fn or(self, other: Self) -> Self {
                Self(unsafe { $or(self.0, other.0) })
            }
            #[inline(always)]
            fn bits(self) -> u32 {
                unsafe { $bits(self.0) }.cast_unsigned()
            }
        }
    };
}

pub(super) use {in_register, mask_in_register};
