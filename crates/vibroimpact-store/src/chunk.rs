//! One array of a store: its metadata, and the conversion of its chunks between numbers and bytes.
//!
//! A chunk contains little-endian numbers compressed by Zstandard and ends with a CRC-32C, so that a truncated chunk or
//! a flipped bit is detected. Not-a-number always has the same bit pattern.

use serde_json::{Map, Value, json};
use std::sync::Arc;
use vibroimpact_study::study::Cells;
use vibroimpact_study::{Column, NumberType};
use zarrs::array::codec::{Crc32cCodec, ZstdCodec};
use zarrs::array::{
    Array, ArrayBuilder, ArrayBytes, ArrayToBytesCodecTraits, CodecOptions, FillValue, FromArrayBytes, IntoArrayBytes,
    data_type,
};
use zarrs::storage::store::MemoryStore;

/// Compression level; higher levels take more time and save little on these data.
const LEVEL: i32 = 3;

/// The type of the values of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Numbers.
    Numbers(NumberType),
    /// Texts.
    Text,
}

/// An array: its name, shape, chunks and encoding.
pub(crate) struct Chunked {
    pub(crate) name: String,
    array: Array<MemoryStore>,
    kind: Holds,
    /// The lengths of a shard along each dimension, if chunks are in shards.
    shard: Option<Vec<usize>>,
}

/// The description of an internal error that should not occur.
pub(crate) type Defect = String;

/// The metadata of an array.
pub(crate) struct Description<'a> {
    pub(crate) name: &'a str,
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
    pub(crate) fn new(description: Description<'_>) -> Result<Self, Defect> {
        let Description { name, kind, fill, dimensions, shard, attributes } = description;
        let (data, fill) = match kind {
            Holds::Numbers(NumberType::I8) => {
                (data_type::int8(), FillValue::from(i8::try_from(fill).unwrap_or(i8::MIN)))
            }
            Holds::Numbers(NumberType::I32) => (data_type::int32(), FillValue::from(fill)),
            Holds::Numbers(NumberType::F64) => (data_type::float64(), FillValue::from(f64::NAN)),
            Holds::Text => (data_type::string(), FillValue::from("")),
        };
        let shape: Vec<u64> = dimensions.iter().map(|(_, count, _)| *count as u64).collect();
        let chunks: Vec<u64> = dimensions.iter().map(|(_, _, chunk)| *chunk as u64).collect();
        let mut builder = ArrayBuilder::new(shape, chunks, data, fill);
        builder
            .dimension_names(Some(dimensions.iter().map(|(name, _, _)| name.as_str())))
            .attributes(attributes)
            .bytes_to_bytes_codecs(vec![Arc::new(ZstdCodec::new(LEVEL, false)), Arc::new(Crc32cCodec::new())]);
        let array = builder
            .build(Arc::new(MemoryStore::new()), &format!("/{name}"))
            .map_err(|error| format!("array {name}: {error}"))?;
        Ok(Self { name: name.to_owned(), array, kind, shard })
    }

    /// The key of its metadata.
    pub(crate) fn description_key(&self) -> String {
        format!("{}/zarr.json", self.name)
    }

    /// Its metadata, the content of its `zarr.json`.
    pub(crate) fn description(&self) -> Result<Value, Defect> {
        let text = serde_json::to_value(self.array.metadata()).map_err(|error| error.to_string())?;
        let mut description = plain(text);
        if let Some(shard) = &self.shard {
            sharded(&mut description, shard);
        }
        Ok(description)
    }

    /// The key of a chunk.
    pub(crate) fn key(&self, place: &[u64]) -> String {
        self.array.chunk_key(place).as_str().to_owned()
    }

    /// The indices of the first chunk.
    pub(crate) fn first(&self) -> Vec<u64> {
        vec![0; self.array.dimensionality()]
    }

    /// The prefix of the keys of its chunks.
    pub(crate) fn chunk_prefix(&self) -> String {
        format!("{}/c/", self.name)
    }

    fn options() -> CodecOptions {
        CodecOptions::default().with_concurrent_target(1)
    }

    /// The bytes of a chunk from its values.
    pub(crate) fn encode(&self, place: &[u64], values: Cells) -> Result<Vec<u8>, Defect> {
        let data = self.array.data_type();
        let bytes = match values {
            Cells::Numbers(Column::I8(v)) => v.into_array_bytes(data),
            Cells::Numbers(Column::I32(v)) => v.into_array_bytes(data),
            Cells::Numbers(Column::F64(v)) => {
                let one_nan = |x: f64| if x.is_nan() { f64::NAN } else { x };
                v.into_iter().map(one_nan).collect::<Vec<f64>>().into_array_bytes(data)
            }
            Cells::Text(words) => words.into_array_bytes(data),
        };
        let bytes = bytes.map_err(|error| error.to_string())?.into_owned();
        let shape = self.array.chunk_shape(place).map_err(|error| error.to_string())?;
        let codecs = self.array.codecs();
        let encoded = codecs.encode(bytes, &shape, data, self.array.fill_value(), &Self::options());
        encoded.map(std::borrow::Cow::into_owned).map_err(|error| error.to_string())
    }

    /// The values of a chunk from its bytes, or a description of the damage.
    pub(crate) fn decode(&self, place: &[u64], bytes: Vec<u8>) -> Result<Cells, Defect> {
        let shape = self.array.chunk_shape(place).map_err(|error| error.to_string())?;
        let data = self.array.data_type();
        let codecs = self.array.codecs();
        let decoded: ArrayBytes<'_> = codecs
            .decode(bytes.into(), &shape, data, self.array.fill_value(), &Self::options())
            .map_err(|error| error.to_string())?;
        let decoded = decoded.into_owned();
        let lengths: Vec<u64> = shape.iter().map(|n| n.get()).collect();
        let cells = match self.kind {
            Holds::Numbers(NumberType::I8) => {
                Vec::from_array_bytes(decoded, &lengths, data).map(|v| Cells::Numbers(Column::I8(v)))
            }
            Holds::Numbers(NumberType::I32) => {
                Vec::from_array_bytes(decoded, &lengths, data).map(|v| Cells::Numbers(Column::I32(v)))
            }
            Holds::Numbers(NumberType::F64) => {
                Vec::from_array_bytes(decoded, &lengths, data).map(|v| Cells::Numbers(Column::F64(v)))
            }
            Holds::Text => Vec::from_array_bytes(decoded, &lengths, data).map(Cells::Text),
        };
        cells.map_err(|error| error.to_string())
    }
}

/// An array made from its metadata.
fn described(name: &str, description: &Value) -> Result<Array<MemoryStore>, Defect> {
    let metadata = serde_json::from_value(description.clone()).map_err(|error| error.to_string())?;
    let array = Array::new_with_metadata(Arc::new(MemoryStore::new()), &format!("/{name}"), metadata);
    array.map_err(|error| error.to_string())
}

/// The key of the first chunk of an array, made from its metadata.
pub(crate) fn first_key(name: &str, description: &Value) -> Result<String, Defect> {
    let array = described(name, description)?;
    Ok(array.chunk_key(&vec![0; array.dimensionality()]).as_str().to_owned())
}

/// Whether some bytes are an undamaged first chunk of an array, which is known by its metadata.
pub(crate) fn reads(name: &str, description: &Value, bytes: Vec<u8>) -> bool {
    let Ok(array) = described(name, description) else { return false };
    let Ok(shape) = array.chunk_shape(&vec![0; array.dimensionality()]) else { return false };
    let options = Chunked::options();
    array.codecs().decode(bytes.into(), &shape, array.data_type(), array.fill_value(), &options).is_ok()
}

/// Changes the metadata of an array of chunks to those of the same chunks in shards.
fn sharded(description: &mut Value, shard: &[usize]) {
    let side = core::mem::replace(&mut description["chunk_grid"]["configuration"]["chunk_shape"], json!(shard));
    let codecs = description["codecs"].take();
    let little = json!({ "name": "bytes", "configuration": { "endian": "little" } });
    description["codecs"] = json!([{
        "name": "sharding_indexed",
        "configuration": {
            "chunk_shape": side,
            "codecs": codecs,
            "index_codecs": [little, { "name": "crc32c" }],
            "index_location": "end",
        },
    }]);
}

/// Removes the name of the library that wrote the metadata, and writes every codec as an object, because some readers
/// support no other form.
fn plain(mut description: Value) -> Value {
    if let Some(attributes) = description.get_mut("attributes").and_then(Value::as_object_mut) {
        attributes.remove("_zarrs");
    }
    for key in ["codecs", "storage_transformers"] {
        for codec in description.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten() {
            if let Value::String(name) = codec {
                *codec = serde_json::json!({ "name": name });
            }
        }
    }
    for key in ["chunk_grid", "chunk_key_encoding"] {
        if let Some(Value::String(name)) = description.get(key) {
            description[key] = serde_json::json!({ "name": name });
        }
    }
    description
}
