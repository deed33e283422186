//! One array of a store: the keys of its metadata and of its chunks, and the size and type of its chunks.

use crate::codec::{self, Defect, Holds};
use serde_json::{Map, Value};
use std::fmt::Write;
use vibroimpact_study::study::Cells;

/// An array: its name, shape, chunks and attributes.
pub(crate) struct Chunked {
    pub(crate) name: String,
    pub(crate) kind: Holds,
    /// The value of points that have not been computed; not-a-number for real numbers.
    pub(crate) fill: i32,
    /// Name, length and chunk length of each dimension.
    pub(crate) dimensions: Vec<(String, usize, usize)>,
    /// The lengths of a shard along each dimension, if chunks are in shards.
    pub(crate) shard: Option<Vec<usize>>,
    pub(crate) attributes: Map<String, Value>,
}

impl Chunked {
    /// The key of its metadata.
    pub(crate) fn description_key(&self) -> String {
        format!("{}/zarr.json", self.name)
    }

    /// The key of a chunk.
    pub(crate) fn key(&self, place: &[usize]) -> String {
        let mut key = format!("{}/c", self.name);
        for index in place {
            // a text can always be written to
            let _ = write!(key, "/{index}");
        }
        key
    }

    /// The key of the first chunk.
    pub(crate) fn first_key(&self) -> String {
        self.key(&vec![0; self.dimensions.len()])
    }

    /// The prefix of the keys of its chunks.
    pub(crate) fn chunk_prefix(&self) -> String {
        format!("{}/c/", self.name)
    }

    /// The number of values of a chunk.
    fn values(&self) -> usize {
        self.dimensions.iter().map(|(_, _, chunk)| chunk).product()
    }

    /// The bytes of a chunk from its values.
    pub(crate) fn encode(&self, values: &Cells) -> Result<Vec<u8>, Defect> {
        let count = match values {
            Cells::Numbers(column) => column.len(),
            Cells::Text(words) => words.len(),
        };
        if Holds::of(values) != self.kind || count != self.values() {
            return Err(format!("{count} values do not fill a chunk of {}", self.values()));
        }
        codec::encode(values)
    }

    /// The values of a chunk from its bytes, or a description of the damage.
    pub(crate) fn decode(&self, bytes: &[u8]) -> Result<Cells, Defect> {
        codec::decode(self.kind, self.values(), bytes)
    }
}
