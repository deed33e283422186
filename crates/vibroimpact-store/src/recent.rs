//! The last chunks of a field of integers with their bytes. In a refined study most tiles have the same chunks as one of the
//! tiles before, which are not compressed again.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use vibroimpact_study::Column;

/// Number of chunks that are kept, and the most values of one, so that they need little memory.
const KEPT: usize = 4;
const LARGEST: usize = 1 << 18;

/// A chunk and its bytes.
type Known = Arc<(Column, Vec<u8>)>;

/// The last different chunks.
#[derive(Default)]
pub(crate) struct Recent(Mutex<VecDeque<Known>>);

impl Recent {
    /// The bytes of a chunk, from `encode` unless they are known.
    pub(crate) fn bytes<E>(
        &self,
        chunk: &Column,
        encode: impl FnOnce(Column) -> Result<Vec<u8>, E>,
    ) -> Result<Vec<u8>, E> {
        // real numbers are hardly ever the same
        if matches!(chunk, Column::F64(_)) || chunk.len() > LARGEST {
            return encode(chunk.clone());
        }
        // compared without the lock, for the other threads
        let known: Vec<Known> = self.0.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect();
        if let Some(same) = known.iter().find(|known| known.0 == *chunk) {
            return Ok(same.1.clone());
        }
        let bytes = encode(chunk.clone())?;
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.truncate(KEPT - 1);
        known.push_front(Arc::new((chunk.clone(), bytes.clone())));
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chunk_is_encoded_again_only_after_others() {
        let (recent, mut encoded) = (Recent::default(), Vec::new());
        for number in [1, 1, 2, 3, 1, 2, 4, 5, 1, 1] {
            let chunk = Column::I8(vec![number; 3]);
            let bytes = recent.bytes(&chunk, |chunk| {
                encoded.push(chunk.flags()[0]);
                Ok::<_, ()>(vec![chunk.flags()[0].cast_unsigned()])
            });
            assert_eq!(bytes, Ok(vec![number.cast_unsigned()]));
        }
        assert_eq!(encoded, [1, 2, 3, 4, 5, 1]);
    }
}
