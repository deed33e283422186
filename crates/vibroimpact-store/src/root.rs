//! The metadata of a store: those of the initial arrays, and the root, which is written after them.

use crate::chunk::Chunked;
use crate::codec::Defect;
use crate::layout::Layout;
use crate::shelf::Shelf;
use crate::{FORMAT, Store, StoreError};
use serde_json::{Map, Value, json};
use std::io;
use vibroimpact_study::study::Cells;
use vibroimpact_study::{Plan, System};

/// The key of the root, which describes the whole store. It is the last of the initial objects to be written.
pub(crate) const ROOT: &str = "zarr.json";

impl Store {
    pub(crate) fn root(&self) -> Result<Value, StoreError> {
        read_root(self.shelf.as_ref())
    }

    /// The arrays that a store has from the beginning.
    pub(crate) fn described(&self) -> impl Iterator<Item = &Chunked> {
        let Layout { arrays, status, coordinates, .. } = &self.layout;
        arrays.iter().chain([status]).chain(coordinates.iter().map(|(array, _)| array))
    }

    /// Writes the initial objects.
    pub(crate) fn describe(&self) -> Result<(), StoreError> {
        self.settle_all(&self.descriptions(None)?)
    }

    /// Writes the given objects, in order, except those that already have the right bytes.
    pub(crate) fn settle_all(&self, objects: &[Object]) -> Result<(), StoreError> {
        objects.iter().try_for_each(|object| self.settle(&object.key, &object.bytes))
    }

    /// All objects except the chunks of fields and status, with the root last. Without a conclusion they have their
    /// initial form, with a conclusion their final form.
    pub(crate) fn descriptions(&self, conclusion: Option<&Conclusion>) -> Result<Vec<Object>, StoreError> {
        let mut written = Described::default();
        let Layout { arrays, status, coordinates, .. } = &self.layout;
        let (labelled, tables) =
            conclusion.map_or((&[][..], &[][..]), |found| (found.labelled.as_slice(), found.tables.as_slice()));
        let with_labels =
            |(number, array)| labelled.iter().find(|(of, _)| *of == number).map_or(array, |(_, with)| with);
        let fields = arrays.iter().enumerate().map(with_labels).chain([status]).map(|array| (array, None));
        let with_values = coordinates.iter().chain(tables).map(|(array, values)| (array, Some(values)));
        for (array, values) in fields.chain(with_values) {
            written.add(array, values).map_err(|why| self.defect(&array.name, why))?;
        }
        let bytes = self.root_bytes(&written.consolidated, conclusion.is_some())?;
        written.objects.push(Object { key: ROOT.into(), bytes });
        Ok(written.objects)
    }

    fn root_bytes(&self, descriptions: &Map<String, Value>, complete: bool) -> Result<Vec<u8>, StoreError> {
        let plan = serde_json::to_string(&self.plan).map_err(|error| self.defect(ROOT, error.to_string()))?;
        let mut root = json!({
            "zarr_format": 3,
            "node_type": "group",
            "attributes": {
                "Conventions": "CF-1.11",
                "title": self.plan.title(),
                "source": format!("vibroimpact {}", self.begun_by),
                // the conventions want one; nothing in a store depends on the time
                "history": format!("computed by vibroimpact {} from the attribute plan", self.begun_by),
                "references": references(&self.plan),
                "vibroimpact_format": self.format(),
                "vibroimpact_version": self.begun_by,
                "plan": plan,
                "plan_hash": self.plan.hash(),
                "complete": i32::from(complete),
            },
            "consolidated_metadata": { "kind": "inline", "must_understand": false, "metadata": descriptions },
        });
        // coordinates that are not dimensions must be named in an attribute (CF 5)
        let beside: Vec<String> = self
            .study
            .coordinates()
            .into_iter()
            .filter(|along| along.name != along.dimension)
            .map(|along| along.name)
            .collect();
        if !beside.is_empty() {
            root["attributes"]["coordinates"] = beside.join(" ").into();
        }
        Ok(pretty(&root))
    }
}

/// The sources of what a study is about.
fn references(plan: &Plan) -> &str {
    match &plan.system {
        System::Oscillator(_) => "Fukaya and Irie (1971); every motion is settled to a proved verdict",
        System::Machine(machine) => machine.source.as_deref().unwrap_or_default(),
    }
}

/// An object of a store: its key and its bytes.
pub(crate) struct Object {
    pub(crate) key: String,
    pub(crate) bytes: Vec<u8>,
}

/// The results that need all tiles.
pub(crate) struct Conclusion {
    /// The arrays of labels, with the texts of all labels that occur, by the numbers of their fields.
    pub(crate) labelled: Vec<(usize, Chunked)>,
    /// The tables and their values.
    pub(crate) tables: Vec<(Chunked, Cells)>,
}

/// Metadata of arrays, collected for the root.
#[derive(Default)]
struct Described {
    objects: Vec<Object>,
    consolidated: Map<String, Value>,
}

impl Described {
    /// Adds an array; its values too, if they are one chunk.
    fn add(&mut self, array: &Chunked, values: Option<&Cells>) -> Result<(), Defect> {
        let description = array.description();
        self.objects.push(Object { key: array.description_key(), bytes: pretty(&description) });
        self.consolidated.insert(array.name.clone(), description);
        if let Some(values) = values {
            self.objects.push(Object { key: array.first_key(), bytes: array.encode(values)? });
        }
        Ok(())
    }
}

/// JSON in an indented, human-readable form.
fn pretty(value: &Value) -> Vec<u8> {
    let mut bytes = serde_json::to_vec_pretty(value).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

pub(crate) fn read_root(shelf: &dyn Shelf) -> Result<Value, StoreError> {
    let place = shelf.name();
    let damaged = |why: String| StoreError::Damaged { place: place.clone(), key: ROOT.into(), why };
    match shelf.get(ROOT) {
        Ok(Some(bytes)) => serde_json::from_slice(&bytes).map_err(|error| damaged(error.to_string())),
        Ok(None) => Err(StoreError::Absent(place)),
        // the path of the folder is that of a file
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Err(StoreError::Foreign(place)),
        Err(error) => Err(StoreError::Read { place, key: ROOT.into(), error }),
    }
}

/// The contents of the root of a store.
pub(crate) struct Found {
    pub(crate) plan: String,
    pub(crate) hash: String,
    pub(crate) version: String,
    pub(crate) format: u64,
}

impl Found {
    pub(crate) fn of(root: &Value, place: &str) -> Result<Self, StoreError> {
        let attribute = |name: &str| root.get("attributes").and_then(|all| all.get(name));
        let word = |name: &str| attribute(name).and_then(Value::as_str).map(str::to_owned);
        let Some(format) = attribute("vibroimpact_format").and_then(Value::as_u64) else {
            return Err(StoreError::Foreign(place.to_owned()));
        };
        if format > FORMAT {
            let program = word("vibroimpact_version").unwrap_or_else(|| "unknown".into());
            return Err(StoreError::Newer { place: place.to_owned(), found: format, known: FORMAT, program });
        }
        match (word("plan"), word("plan_hash"), word("vibroimpact_version")) {
            (Some(plan), Some(hash), Some(version)) => Ok(Self { plan, hash, version, format }),
            _ => Err(StoreError::Damaged {
                place: place.to_owned(),
                key: ROOT.into(),
                why: "the plan is missing".into(),
            }),
        }
    }
}
