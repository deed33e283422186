//! The metadata of an array, the content of its `zarr.json`, as version 3 of Zarr defines them.
//!
//! Every codec is an object with a name, because some readers support no other form.

use crate::chunk::Chunked;
use crate::codec::{Holds, LEVEL};
use serde_json::{Map, Value, json};
use vibroimpact_study::NumberType;

/// Maximum number of values of a chunk of an array that is known by its metadata only, which may be damaged.
const MOST_VALUES: usize = 1 << 27;

/// The parts of the metadata that state how chunks are named and encoded. The level of compression is not among them.
const ENCODING: [&str; 8] = [
    "/zarr_format",
    "/node_type",
    "/chunk_grid",
    "/chunk_key_encoding",
    "/codecs/0",
    "/codecs/1/name",
    "/codecs/2",
    "/codecs/3",
];

/// The types of values and their names in Zarr.
const TYPES: [(Holds, &str); 4] = [
    (Holds::Numbers(NumberType::I8), "int8"),
    (Holds::Numbers(NumberType::I32), "int32"),
    (Holds::Numbers(NumberType::F64), "float64"),
    (Holds::Text, "string"),
];

impl Chunked {
    /// Its metadata, the content of its `zarr.json`.
    pub(crate) fn description(&self) -> Value {
        let fill = match self.kind {
            Holds::Numbers(NumberType::I8) => i8::try_from(self.fill).unwrap_or(i8::MIN).into(),
            Holds::Numbers(NumberType::I32) => self.fill.into(),
            Holds::Numbers(NumberType::F64) => "NaN".into(),
            Holds::Text => Value::from(""),
        };
        let dimensions = || self.dimensions.iter();
        let chunk: Value = dimensions().map(|(_, _, chunk)| *chunk).collect();
        let (file, codecs) = match &self.shard {
            None => (chunk, codecs(self.kind)),
            Some(shard) => (json!(shard), json!([sharding(&chunk, &codecs(self.kind))])),
        };
        json!({
            "zarr_format": 3,
            "node_type": "array",
            "shape": dimensions().map(|(_, count, _)| *count).collect::<Value>(),
            "data_type": TYPES.iter().find(|(kind, _)| *kind == self.kind).map(|(_, name)| name),
            "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": file } },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
            "fill_value": fill,
            "codecs": codecs,
            "attributes": self.attributes,
            "dimension_names": dimensions().map(|(name, _, _)| name.as_str()).collect::<Value>(),
        })
    }

    /// What of an array is needed to read its chunks, from its metadata; `None` if they are damaged, or if they state
    /// another encoding than that of this version.
    pub(crate) fn from_description(name: &str, description: &Value) -> Option<Self> {
        let data = description["data_type"].as_str()?;
        let (kind, _) = *TYPES.iter().find(|(_, name)| *name == data)?;
        let lengths = |list: &Value| -> Option<Vec<usize>> {
            list.as_array()?.iter().map(|n| n.as_u64().and_then(|n| usize::try_from(n).ok())).collect()
        };
        let counts = lengths(&description["shape"])?;
        let chunk = lengths(description.pointer("/chunk_grid/configuration/chunk_shape")?)?;
        let values = chunk.iter().try_fold(1_usize, |product, n| product.checked_mul(*n))?;
        if counts.len() != chunk.len() || values > MOST_VALUES {
            return None;
        }
        let dimensions = counts.into_iter().zip(chunk).map(|(count, chunk)| (String::new(), count, chunk)).collect();
        let (name, attributes) = (name.to_owned(), Map::new());
        let array = Self { name, kind, fill: 0, dimensions, shard: None, attributes };
        let same = array.description();
        ENCODING.iter().all(|part| same.pointer(part) == description.pointer(part)).then_some(array)
    }
}

/// The codecs of a chunk. See [`codec`](crate::codec).
fn codecs(kind: Holds) -> Value {
    let values = match kind {
        Holds::Numbers(_) => little_endian(),
        Holds::Text => json!({ "name": "vlen-utf8" }),
    };
    let zstd = json!({ "name": "zstd", "configuration": { "level": LEVEL, "checksum": false } });
    json!([values, zstd, { "name": "crc32c" }])
}

fn little_endian() -> Value {
    json!({ "name": "bytes", "configuration": { "endian": "little" } })
}

/// The codec of a shard, whose chunks have the lengths `chunk` and the given codecs. See [`shards`](crate::shards).
fn sharding(chunk: &Value, codecs: &Value) -> Value {
    json!({
        "name": "sharding_indexed",
        "configuration": {
            "chunk_shape": chunk,
            "codecs": codecs,
            "index_codecs": [little_endian(), { "name": "crc32c" }],
            "index_location": "end",
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(kind: Holds, shard: Option<Vec<usize>>) -> Chunked {
        let dimensions = vec![("gap".to_owned(), 50, 10), ("x".to_owned(), 70, 10)];
        let mut attributes = Map::new();
        attributes.insert("units".into(), "F/k".into());
        Chunked { name: "label".into(), kind, fill: -9, dimensions, shard, attributes }
    }

    /// Readers depend on it, and stores of all versions have the same bytes.
    #[test]
    fn the_text_of_metadata() {
        let text = |array: &Chunked| serde_json::to_string(&array.description()).unwrap();
        let (start, end) = (
            r#"{"zarr_format":3,"node_type":"array","shape":[50,70],"data_type":"#,
            r#","attributes":{"units":"F/k"},"dimension_names":["gap","x"]}"#,
        );
        let grid = |lengths: &str| {
            format!(
                r#""chunk_grid":{{"name":"regular","configuration":{{"chunk_shape":{lengths}}}}},"chunk_key_encoding":{{"name":"default","configuration":{{"separator":"/"}}}},"fill_value":"#
            )
        };
        let little = r#"{"name":"bytes","configuration":{"endian":"little"}}"#;
        let rest = r#"{"name":"zstd","configuration":{"level":3,"checksum":false}},{"name":"crc32c"}"#;
        let single = grid("[10,10]");
        for (kind, data, fill, first) in [
            (Holds::Numbers(NumberType::I8), "int8", "-9", little),
            (Holds::Numbers(NumberType::I32), "int32", "-9", little),
            (Holds::Numbers(NumberType::F64), "float64", r#""NaN""#, little),
            (Holds::Text, "string", r#""""#, r#"{"name":"vlen-utf8"}"#),
        ] {
            let wanted = format!(r#"{start}"{data}",{single}{fill},"codecs":[{first},{rest}]{end}"#);
            assert_eq!(text(&array(kind, None)), wanted);
        }
        let sharded = array(Holds::Numbers(NumberType::I32), Some(vec![30, 40]));
        let codec = format!(
            r#"{{"name":"sharding_indexed","configuration":{{"chunk_shape":[10,10],"codecs":[{little},{rest}],"index_codecs":[{little},{{"name":"crc32c"}}],"index_location":"end"}}}}"#
        );
        let grid = grid("[30,40]");
        assert_eq!(text(&sharded), format!(r#"{start}"int32",{grid}-9,"codecs":[{codec}]{end}"#));
    }

    #[test]
    fn an_array_is_known_by_its_metadata() {
        for (kind, _) in TYPES {
            let description = array(kind, None).description();
            let same = Chunked::from_description("label", &description).unwrap();
            assert_eq!((same.kind, same.first_key().as_str()), (kind, "label/c/0/0"));
            for (part, value) in [
                ("/data_type", json!("int16")),
                ("/shape", json!([50])),
                ("/chunk_grid/name", json!("rectangular")),
                ("/chunk_grid/configuration/chunk_shape", json!([10, -1])),
                ("/chunk_grid/configuration/chunk_shape", json!([1_u64 << 40, 1_u64 << 40])),
                ("/chunk_key_encoding/configuration/separator", json!(".")),
                ("/codecs/0/name", json!("transpose")),
                ("/codecs/1/name", json!("gzip")),
                ("/codecs", json!([])),
            ] {
                let mut changed = description.clone();
                *changed.pointer_mut(part).unwrap() = value;
                assert!(Chunked::from_description("label", &changed).is_none(), "{kind:?} {part}");
            }
            let mut level = description.clone();
            level["codecs"][1]["configuration"]["level"] = 5.into();
            assert!(Chunked::from_description("label", &level).is_some());
            let sharded = array(kind, Some(vec![20, 20])).description();
            assert!(Chunked::from_description("label", &sharded).is_none());
        }
        assert!(Chunked::from_description("label", &json!({})).is_none());
    }
}
