//! The arrays of a study over its grid, with their types, descriptions and units.

use crate::unit::Unit;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The type of the numbers of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// Integers of 8 bits.
    I8,
    /// Integers of 32 bits.
    I32,
    /// Floating-point numbers of 64 bits.
    F64,
}

impl NumberType {
    /// Number of bytes of a number.
    #[must_use]
    pub const fn size(self) -> usize {
        match self {
            Self::I8 => 1,
            Self::I32 => 4,
            Self::F64 => 8,
        }
    }
}

/// A dimension of a field in addition to those of the grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Extra {
    /// Its name.
    pub name: &'static str,
    /// Its length.
    pub count: usize,
}

/// One array of a study. Its dimensions are those of the grid, followed by extra dimensions, which vary fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: Cow<'static, str>,
    /// One line of text that describes it.
    pub long_name: Cow<'static, str>,
    /// Its unit.
    pub unit: Unit,
    /// The type of its numbers.
    pub kind: NumberType,
    /// The value at points where nothing was computed; real numbers always use not-a-number. No result equals this
    /// value.
    pub fill: i32,
    /// Dimensions in addition to those of the grid.
    pub extra: Vec<Extra>,
    /// Values with a special meaning, and the meaning of each.
    pub flags: Vec<(i32, &'static str)>,
    /// Further remarks.
    pub comment: &'static str,
}

impl Field {
    /// A field of real numbers.
    pub(crate) fn real(
        name: impl Into<Cow<'static, str>>,
        long_name: impl Into<Cow<'static, str>>,
        unit: Unit,
        extra: &[Extra],
    ) -> Self {
        let (name, long_name, extra) = (name.into(), long_name.into(), extra.to_vec());
        Self { name, long_name, unit, kind: NumberType::F64, fill: 0, extra, flags: Vec::new(), comment: "" }
    }

    /// A field of integers. The first of the special values stands for points where nothing was computed.
    pub(crate) fn integers(
        name: &'static str,
        long_name: &'static str,
        kind: NumberType,
        extra: &[Extra],
        flags: &[(i32, &'static str)],
    ) -> Self {
        let fill = flags.first().map_or(0, |(value, _)| *value);
        Self { kind, fill, flags: flags.to_vec(), ..Self::real(name, long_name, Unit::NUMBER, extra) }
    }

    /// Number of values for each point of the grid.
    #[must_use]
    pub fn width(&self) -> usize {
        self.extra.iter().map(|extra| extra.count).product()
    }

    /// A column of `points` points in which nothing was computed.
    #[must_use]
    pub fn empty(&self, points: usize) -> Column {
        let len = points * self.width();
        match self.kind {
            NumberType::I8 => Column::I8(vec![i8::try_from(self.fill).unwrap_or(i8::MIN); len]),
            NumberType::I32 => Column::I32(vec![self.fill; len]),
            NumberType::F64 => Column::F64(vec![f64::NAN; len]),
        }
    }
}

/// The numbers of a field over some points, in row-major order.
#[derive(Clone, Debug)]
pub enum Column {
    /// Integers of 8 bits.
    I8(Vec<i8>),
    /// Integers of 32 bits.
    I32(Vec<i32>),
    /// Floating-point numbers of 64 bits.
    F64(Vec<f64>),
}

/// Compares bits: not-a-number equals itself.
impl PartialEq for Column {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::I8(a), Self::I8(b)) => a == b,
            (Self::I32(a), Self::I32(b)) => a == b,
            (Self::F64(a), Self::F64(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
            }
            _ => false,
        }
    }
}

impl Column {
    /// The number of values.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::I8(v) => v.len(),
            Self::I32(v) => v.len(),
            Self::F64(v) => v.len(),
        }
    }

    /// Whether it has no values.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The type of its numbers.
    #[must_use]
    pub const fn kind(&self) -> NumberType {
        match self {
            Self::I8(_) => NumberType::I8,
            Self::I32(_) => NumberType::I32,
            Self::F64(_) => NumberType::F64,
        }
    }

    /// The numbers as bytes, the least significant first. Not-a-number always has the same bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let one_nan = |x: &f64| if x.is_nan() { f64::NAN } else { *x };
        match self {
            Self::I8(v) => v.iter().map(|x| x.cast_unsigned()).collect(),
            Self::I32(v) => v.iter().map(|x| x.to_le_bytes()).collect::<Vec<_>>().into_flattened(),
            Self::F64(v) => v.iter().map(|x| one_nan(x).to_le_bytes()).collect::<Vec<_>>().into_flattened(),
        }
    }

    /// The numbers from their bytes; bytes after the last whole number are left out.
    #[must_use]
    pub fn from_bytes(kind: NumberType, bytes: &[u8]) -> Self {
        let (of_four, of_eight) = (bytes.as_chunks().0, bytes.as_chunks().0);
        match kind {
            NumberType::I8 => Self::I8(bytes.iter().map(|x| x.cast_signed()).collect()),
            NumberType::I32 => Self::I32(of_four.iter().map(|x| i32::from_le_bytes(*x)).collect()),
            NumberType::F64 => Self::F64(of_eight.iter().map(|x| f64::from_le_bytes(*x)).collect()),
        }
    }

    /// Copies `len` values of `from`, beginning at index `at`, to index `to` of this column. Does nothing if the
    /// columns have different types (which does not occur).
    pub fn copy(&mut self, to: usize, from: &Self, at: usize, len: usize) {
        match (self, from) {
            (Self::I8(a), Self::I8(b)) => a[to..to + len].copy_from_slice(&b[at..at + len]),
            (Self::I32(a), Self::I32(b)) => a[to..to + len].copy_from_slice(&b[at..at + len]),
            (Self::F64(a), Self::F64(b)) => a[to..to + len].copy_from_slice(&b[at..at + len]),
            _ => {}
        }
    }

    /// Value number `k`; `None` if there is none.
    pub(crate) fn get(&self, k: usize) -> Option<f64> {
        match self {
            Self::I8(values) => values.get(k).copied().map(f64::from),
            Self::I32(values) => values.get(k).copied().map(f64::from),
            Self::F64(values) => values.get(k).copied(),
        }
    }

    /// Writes value number `k`, of a column of integers one of its integers.
    #[allow(clippy::cast_possible_truncation)] // a value of the column
    pub(crate) fn set(&mut self, k: usize, value: f64) {
        match self {
            Self::I8(values) => values[k] = value as i8,
            Self::I32(values) => values[k] = value as i32,
            Self::F64(values) => values[k] = value,
        }
    }

    /// How often each number occurs in a column of integers, the smallest number first; empty for real numbers.
    #[must_use]
    pub fn counts(&self) -> Vec<(i32, u64)> {
        /// Neighbours mostly have the same number.
        fn of<T: Copy + PartialEq + Into<i32>>(values: &[T]) -> BTreeMap<i32, u64> {
            let mut counts = BTreeMap::new();
            for run in values.chunk_by(|a, b| a == b) {
                *counts.entry(run[0].into()).or_default() += run.len() as u64;
            }
            counts
        }
        let counts = match self {
            Self::I8(values) => of(values),
            Self::I32(values) => of(values),
            Self::F64(_) => BTreeMap::new(),
        };
        counts.into_iter().collect()
    }

    /// The values of a column of 32-bit integers; empty for other types.
    #[must_use]
    pub fn whole(&self) -> &[i32] {
        if let Self::I32(values) = self { values } else { &[] }
    }

    /// The values of a column of 8-bit integers; empty for other types.
    #[must_use]
    pub fn flags(&self) -> &[i8] {
        if let Self::I8(values) = self { values } else { &[] }
    }

    /// The values of a column of floating-point numbers; empty for other types.
    #[must_use]
    pub fn real(&self) -> &[f64] {
        if let Self::F64(values) = self { values } else { &[] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_columns_hold_the_fill() {
        let extra = [Extra { name: "motion", count: 3 }];
        let field = Field::integers("label", "", NumberType::I32, &extra, &[(-9, "not_computed")]);
        assert_eq!(field.empty(2).whole(), [-9; 6]);
        let real = Field { kind: NumberType::F64, ..field };
        assert_eq!(real.empty(2), real.empty(2));
        let mut some = real.empty(1);
        some.copy(1, &Column::F64(vec![1.0, 2.0]), 1, 1);
        assert_eq!(some.real()[1], 2.0);
        assert_ne!(some, real.empty(1));
    }

    #[test]
    fn numbers_are_counted() {
        assert_eq!(Column::I32(vec![4, 4, -1, 4, -1]).counts(), [(-1, 2), (4, 3)]);
        assert_eq!(Column::I8(vec![2, 1, 2, 2]).counts(), [(1, 1), (2, 3)]);
        assert!(Column::I32(Vec::new()).counts().is_empty() && Column::F64(vec![1.0]).counts().is_empty());
    }
}
