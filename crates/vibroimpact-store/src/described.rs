//! Verification of the metadata of a store against its plan: the metadata of every array, the root (which repeats
//! them), and the values of coordinates and tables.

use crate::check::Damage;
use crate::chunk::Chunked;
use crate::root::{Object, ROOT};
use crate::{Store, StoreError};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The end of the keys of metadata.
const DESCRIPTION: &str = "/zarr.json";

impl Store {
    /// The faults of the metadata. `whole` states whether all tiles are complete and undamaged.
    ///
    /// The objects are compared byte by byte. There are two exceptions: another version may use other texts, and the
    /// final tables need all tiles. In these cases the objects are compared with each other, and with the plan in
    /// everything that readers need to find the numbers.
    pub(crate) fn description_damage(&self, whole: bool) -> Result<Vec<Damage>, StoreError> {
        let concluded = self.concluded()?;
        if !self.is_ours() || (concluded && !whole) {
            return self.structural_damage();
        }
        let begun = self.descriptions(None)?;
        if !whole {
            return self.differing(&begun, &BTreeMap::new());
        }
        let conclusion = self.conclusion(&mut |_, _, _| Ok(()))?;
        let concluding = self.descriptions(Some(&conclusion))?;
        if concluded {
            return self.differing(&concluding, &BTreeMap::new());
        }
        // a run that was killed while it concluded the store leaves some objects in their initial form
        let before = begun.into_iter().map(|object| (object.key, object.bytes)).collect();
        let mut damage = self.differing(&concluding, &before)?;
        damage.push(of_store(format!("`{ROOT}` does not say that the store is complete, though all tiles are there")));
        Ok(damage)
    }

    /// The objects that differ from `wanted`. If `before` is given, the initial form is allowed too.
    fn differing(&self, wanted: &[Object], before: &BTreeMap<String, Vec<u8>>) -> Result<Vec<Damage>, StoreError> {
        let mut damage = Vec::new();
        for Object { key, bytes } in wanted {
            let there = self.get(key)?;
            let as_before = !before.is_empty() && there.as_ref() == before.get(key);
            if there.as_ref() != Some(bytes) && !as_before {
                damage.push(of_store(wrong(key, there.as_deref())));
            }
        }
        Ok(damage)
    }

    /// Faults that prevent readers from finding the numbers: metadata that are missing, cannot be parsed, or contradict
    /// the plan or each other; and damaged coordinates or tables.
    pub(crate) fn structural_damage(&self) -> Result<Vec<Damage>, StoreError> {
        let root = self.root()?;
        let mut damage = Vec::new();
        let none = Map::new();
        let consolidated = root.pointer("/consolidated_metadata/metadata").and_then(Value::as_object).unwrap_or(&none);
        for array in self.described() {
            let key = array.description_key();
            let bytes = self.get(&key)?;
            let found = bytes.as_deref().and_then(|bytes| serde_json::from_slice::<Value>(bytes).ok());
            let wanted = array.description();
            if found.as_ref().map(structure) != Some(structure(&wanted)) {
                damage.push(of_store(wrong(&key, bytes.as_deref())));
            }
            if consolidated.get(&array.name).map(structure) != Some(structure(&wanted)) {
                damage.push(of_store(format!(
                    "the description of `{}` in `{ROOT}` is not what the plan gives",
                    array.name
                )));
            }
        }
        for (array, values) in &self.layout.coordinates {
            let whole = self.get(&array.key(&[0]))?.and_then(|bytes| array.decode(&bytes).ok());
            if whole.as_ref() != Some(values) {
                damage.push(of_store(format!("the values of `{}` are damaged", array.name)));
            }
        }
        if self.concluded()? {
            damage.extend(self.concluded_damage(consolidated)?);
        }
        Ok(damage)
    }

    /// Faults of a concluded store: metadata that differ between the root and the array itself, and tables that cannot
    /// be read.
    fn concluded_damage(&self, consolidated: &Map<String, Value>) -> Result<Vec<Damage>, StoreError> {
        let mut damage = Vec::new();
        for (name, description) in consolidated {
            let key = format!("{name}{DESCRIPTION}");
            let bytes = self.get(&key)?;
            let found = bytes.as_deref().and_then(|bytes| serde_json::from_slice::<Value>(bytes).ok());
            if found.as_ref() != Some(description) {
                damage.push(of_store(format!(
                    "`{key}` and `{ROOT}` describe it in different words, or one of them is damaged"
                )));
            }
            if self.described().any(|array| array.name == *name) {
                continue;
            }
            let undamaged = match Chunked::from_description(name, description) {
                Some(array) => self.get(&array.first_key())?.is_some_and(|bytes| array.decode(&bytes).is_ok()),
                None => false,
            };
            if !undamaged {
                damage.push(of_store(format!("the values of `{name}` are damaged")));
            }
        }
        Ok(damage)
    }

    /// The lengths of the tiles of a store whose root states others than its plan gives by default now. The metadata of the array
    /// itself must agree; otherwise one of the two is damaged.
    pub(crate) fn begun_tiles(&self, root: &Value) -> Result<Option<Vec<usize>>, StoreError> {
        let Some(array) = self.layout.arrays.first() else { return Ok(None) };
        let Some(stated) = described(root, &array.name) else { return Ok(None) };
        let along = self.layout.grid.dimensions.len();
        let lengths = |description: &Value| Some(chunk_of(description)?.get(..along)?.to_vec());
        let tiles = lengths(stated).filter(|tiles| Some(tiles) != lengths(&array.description()).as_ref());
        let Some(tiles) = tiles else { return Ok(None) };
        let own = self.get(&array.description_key())?.and_then(|bytes| serde_json::from_slice::<Value>(&bytes).ok());
        Ok(Some(tiles).filter(|tiles| own.as_ref().and_then(lengths).as_ref() == Some(tiles)))
    }

    /// The fields of the plan that a store was begun without, by a version that did not know them: neither its root nor an array
    /// describes them.
    pub(crate) fn absent_fields(&self, root: &Value) -> Result<Vec<String>, StoreError> {
        let mut absent = Vec::new();
        for array in self.layout.arrays.iter().filter(|array| described(root, &array.name).is_none()) {
            if self.get(&array.description_key())?.is_none() {
                absent.push(array.name.clone());
            }
        }
        // a root that describes nothing is damaged
        Ok(if absent.len() < self.layout.arrays.len() { absent } else { Vec::new() })
    }

    /// Writes damaged metadata and coordinates again.
    pub(crate) fn mend_descriptions(&self) -> Result<(), StoreError> {
        if self.structural_damage()?.is_empty() { Ok(()) } else { self.describe() }
    }
}

/// The description of an array in the root.
fn described<'a>(root: &'a Value, name: &str) -> Option<&'a Value> {
    root.pointer("/consolidated_metadata/metadata")?.get(name)
}

/// The lengths of a chunk in a description: in a shard, those of the chunks within.
fn chunk_of(description: &Value) -> Option<Vec<usize>> {
    let inner = description.pointer("/codecs/0/configuration/chunk_shape");
    let lengths = inner.or_else(|| description.pointer("/chunk_grid/configuration/chunk_shape"))?.as_array()?;
    lengths.iter().map(|n| n.as_u64().and_then(|n| usize::try_from(n).ok())).collect()
}

/// A fault of the whole store.
pub(crate) fn of_store(what: String) -> Damage {
    Damage { tile: None, what }
}

/// A description of the fault of an object.
fn wrong(key: &str, there: Option<&[u8]>) -> String {
    let json = key == ROOT || key.ends_with(DESCRIPTION);
    match there {
        None => format!("`{key}` is missing"),
        Some(bytes) if json && serde_json::from_slice::<Value>(bytes).is_err() => format!("`{key}` does not read"),
        Some(_) => format!("`{key}` is not what the plan gives"),
    }
}

/// Metadata without descriptive texts.
fn structure(description: &Value) -> Value {
    let mut rest = description.clone();
    if let Some(rest) = rest.as_object_mut() {
        rest.remove("attributes");
    }
    rest
}
