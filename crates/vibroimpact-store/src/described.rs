//! Whether what describes a store is what its plan gives: the description of every array, the root with all of them again, the values
//! of coordinates and of tables.

use crate::check::Damage;
use crate::root::{Object, ROOT};
use crate::{Store, StoreError, chunk};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use vibroimpact_study::Column;
use vibroimpact_study::study::Tiles;

/// The end of the key of a description.
const DESCRIPTION: &str = "/zarr.json";

impl Store {
    /// What is wrong with the objects that describe the store, where `whole` says that all tiles are there and whole.
    ///
    /// They are compared byte by byte. Another version may have said the same in other words, and what only the whole can say needs all
    /// tiles: there they are compared with each other, and with the plan in all that readers need to find the numbers.
    pub(crate) fn description_damage(&self, whole: bool) -> Result<Vec<Damage>, StoreError> {
        let concluded = self.concluded()?;
        if !self.is_ours() || (concluded && !whole) {
            return self.structural_damage();
        }
        let begun = self.descriptions(None)?;
        if !whole {
            return self.differing(&begun, &BTreeMap::new());
        }
        let conclusion = self.conclusion(&mut Untouched(self))?;
        let concluding = self.descriptions(Some(&conclusion))?;
        if concluded {
            return self.differing(&concluding, &BTreeMap::new());
        }
        // a run that was killed while it concluded leaves some as they were from the beginning
        let before = begun.into_iter().map(|object| (object.key, object.bytes)).collect();
        let mut damage = self.differing(&concluding, &before)?;
        damage.push(of_store(format!("`{ROOT}` does not say that the store is complete, though all tiles are there")));
        Ok(damage)
    }

    /// Objects that are not as they are to be; where `before` is given, as they were from the beginning is right too.
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

    /// What keeps readers from the numbers: descriptions that are missing, do not read, or do not fit the plan or each other, and
    /// coordinates and tables that are damaged.
    pub(crate) fn structural_damage(&self) -> Result<Vec<Damage>, StoreError> {
        let root = self.root()?;
        let mut damage = Vec::new();
        let none = Map::new();
        let consolidated = root.pointer("/consolidated_metadata/metadata").and_then(Value::as_object).unwrap_or(&none);
        for array in self.described() {
            let key = array.description_key();
            let bytes = self.get(&key)?;
            let found = bytes.as_deref().and_then(|bytes| serde_json::from_slice::<Value>(bytes).ok());
            let wanted = array.description().map_err(|why| self.defect(&array.name, why))?;
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
            let whole = self.get(&array.key(&[0]))?.and_then(|bytes| array.decode(&[0], bytes).ok());
            if whole.as_ref() != Some(values) {
                damage.push(of_store(format!("the values of `{}` are damaged", array.name)));
            }
        }
        if self.concluded()? {
            damage.extend(self.concluded_damage(consolidated)?);
        }
        Ok(damage)
    }

    /// Of a store that was concluded: descriptions that the root has in other words than they have themselves, tables that do not read.
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
            let reads = match chunk::first_key(name, description) {
                Ok(key) => self.get(&key)?.is_some_and(|bytes| chunk::reads(name, description, bytes)),
                Err(_) => false,
            };
            if !reads {
                damage.push(of_store(format!("the values of `{name}` are damaged")));
            }
        }
        Ok(damage)
    }

    /// Writes descriptions and coordinates anew where they are damaged.
    pub(crate) fn mend_descriptions(&self) -> Result<(), StoreError> {
        if self.structural_damage()?.is_empty() { Ok(()) } else { self.describe() }
    }
}

fn of_store(what: String) -> Damage {
    Damage { tile: None, what }
}

/// What is wrong with an object that is not as it is to be.
fn wrong(key: &str, there: Option<&[u8]>) -> String {
    let json = key == ROOT || key.ends_with(DESCRIPTION);
    match there {
        None => format!("`{key}` is missing"),
        Some(bytes) if json && serde_json::from_slice::<Value>(bytes).is_err() => format!("`{key}` does not read"),
        Some(_) => format!("`{key}` is not what the plan gives"),
    }
}

/// A description without the words for people.
fn structure(description: &Value) -> Value {
    let mut rest = description.clone();
    if let Some(rest) = rest.as_object_mut() {
        rest.remove("attributes");
    }
    rest
}

/// The tiles of a store, read only.
struct Untouched<'a>(&'a Store);

impl Tiles for Untouched<'_> {
    type Error = StoreError;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, StoreError> {
        let mut store = self.0;
        Tiles::read(&mut store, tile, field)
    }

    /// What would be written is not needed: each tile is read once.
    fn write(&mut self, _: u64, _: usize, _: &Column) -> Result<(), StoreError> {
        Ok(())
    }
}
