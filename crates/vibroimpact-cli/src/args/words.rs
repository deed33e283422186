//! WORDS: an argument that is one of several names.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Names with what they stand for, and what help says of it.
pub(crate) type Words<T, const N: usize> = [(&'static str, T, &'static str); N];

/// Parses one of these names.
pub(crate) fn word<T, const N: usize>(words: &'static Words<T, N>) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let names = words.iter().map(|(name, _, help)| PossibleValue::new(*name).help(*help));
    PossibleValuesParser::new(names).try_map(|given| {
        let known = words.iter().find(|(name, ..)| *name == given);
        known.map(|(_, meaning, _)| *meaning).ok_or_else(|| format!("`{given}` is no name"))
    })
}
