//! The arrays of a plane as bytes: a JSON header, then the numbers in little-endian order.
//!
//! The first four bytes are the length of the header, which is padded so that the numbers begin at a multiple of eight
//! bytes. The header contains the fields with their types and positions, every label that occurs with its colour, and
//! for a basin its cycles.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use vibroimpact_plot::class_style;
use vibroimpact_study::study::{Cells, NOT_COMPUTED, Sheet, StudyTable, label_of};
use vibroimpact_study::{Column, Field, Grid, NumberType, Quantity};

/// The fields that the page draws, besides the quantities that the plan asks for. Other fields of a study are only for tables.
const DRAWN: [&str; 4] = ["label", "share", "cycle", "computed"];

#[derive(Serialize)]
struct Header<'a> {
    /// Numbers of rows and columns; the first row has the lowest value.
    shape: Vec<usize>,
    fields: Vec<Place<'a>>,
    labels: BTreeMap<i32, Named>,
    cycles: Vec<Cycle>,
    /// The share of the points that were computed (as opposed to filled by refinement).
    computed: f64,
}

#[derive(Serialize, Deserialize)]
struct Place<'a> {
    name: Cow<'a, str>,
    #[serde(rename = "type")]
    kind: Cow<'a, str>,
    per_point: usize,
    offset: usize,
    length: usize,
}

/// A label and its colour, which is the same in every figure.
#[derive(Clone, Serialize)]
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) colour: String,
}

impl Named {
    pub(crate) fn new(label: &str) -> Self {
        Self { name: label.to_owned(), colour: class_style(label).colour.to_hex() }
    }
}

/// The fastest impact of a cycle, which distinguishes cycles with the same label.
#[derive(Serialize)]
struct Cycle {
    label: String,
    phase: Option<f64>,
    velocity: Option<f64>,
    share: f64,
    colour: String,
}

/// Whether the page draws a field.
pub(crate) fn is_drawn(field: &Field) -> bool {
    DRAWN.contains(&field.name.as_ref()) || Quantity::from_name(&field.name).is_some()
}

/// The bytes of a sheet.
pub(crate) fn pack(sheet: &Sheet) -> Vec<u8> {
    pack_fields(sheet.study.grid(), sheet.fields.iter().zip(&sheet.columns), &sheet.tables)
}

/// The bytes of the fields of a grid.
pub(crate) fn pack_fields<'a>(
    grid: &Grid,
    fields: impl Iterator<Item = (&'a Field, &'a Column)>,
    tables: &[StudyTable],
) -> Vec<u8> {
    let mut body = Vec::new();
    let mut header = Header {
        shape: grid.dimensions.iter().map(|dimension| dimension.count).collect(),
        fields: Vec::new(),
        labels: BTreeMap::new(),
        cycles: cycles(tables),
        computed: 1.0,
    };
    for (field, column) in fields.filter(|(field, _)| is_drawn(field)) {
        header.fields.push(place(field, column, &mut body));
        match (field.name.as_ref(), column) {
            ("label", Column::I32(codes)) => header.labels = labels(codes),
            ("computed", Column::I8(how)) => {
                #[allow(clippy::cast_precision_loss)] // a screen full
                let part = how.iter().filter(|how| **how == 1).count() as f64 / how.len().max(1) as f64;
                header.computed = part;
            }
            _ => {}
        }
    }
    // numbers, texts and lists of them can always be written as JSON
    let mut text = serde_json::to_vec(&header).unwrap_or_default();
    text.resize((4 + text.len()).next_multiple_of(8) - 4, b' ');
    let length = u32::try_from(text.len()).unwrap_or(u32::MAX);
    [&length.to_le_bytes(), text.as_slice(), body.as_slice()].concat()
}

/// Writes a column, beginning at a multiple of eight bytes.
fn place<'a>(field: &'a Field, column: &Column, body: &mut Vec<u8>) -> Place<'a> {
    body.resize(body.len().next_multiple_of(8), 0);
    let offset = body.len();
    body.extend(column.to_bytes());
    let kind = match field.kind {
        NumberType::I8 => "i8",
        NumberType::I32 => "i32",
        NumberType::F64 => "f64",
    };
    Place {
        name: field.name.as_ref().into(),
        kind: kind.into(),
        per_point: field.width(),
        offset,
        length: column.len(),
    }
}

/// The columns of these fields in packed bytes, for a grid of `points` points; `None` for a field that they do not have.
pub(crate) fn unpack(bytes: &[u8], fields: &[Field], points: usize) -> Option<Vec<Option<Column>>> {
    #[derive(Deserialize)]
    struct Places<'a> {
        #[serde(borrow)]
        fields: Vec<Place<'a>>,
    }
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    let (header, body) = rest.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)?;
    let Places { fields: places } = serde_json::from_slice(header).ok()?;
    let column = |field: &Field| {
        let place = places.iter().find(|place| place.name == field.name)?;
        let size = points * field.width() * field.kind.size();
        Some(Column::from_bytes(field.kind, body.get(place.offset..)?.get(..size)?))
    };
    Some(fields.iter().map(column).collect())
}

fn labels(codes: &[i32]) -> BTreeMap<i32, Named> {
    let mut seen: Vec<i32> = codes.to_vec();
    seen.sort_unstable();
    seen.dedup();
    let named = |code: i32| match code {
        NOT_COMPUTED => None,
        code => label_of(code).map(|label| (code, Named::new(&label))),
    };
    seen.into_iter().filter_map(named).collect()
}

fn cycles(tables: &[StudyTable]) -> Vec<Cycle> {
    let table = |name: &str| tables.iter().find(|table| table.name == name);
    let Some(Cells::Text(labels)) = table("cycle_label").map(|table| &table.values) else { return Vec::new() };
    let numbers = |name: &str| match table(name).map(|table| &table.values) {
        Some(Cells::Numbers(Column::F64(numbers))) => numbers.as_slice(),
        _ => &[],
    };
    let [phases, velocities, shares] = ["cycle_phase", "cycle_velocity", "cycle_share"].map(numbers);
    let each = phases.len() / labels.len().max(1);
    let first = |of: &[f64], k: usize| of.get(k * each).copied().filter(|value| value.is_finite());
    let cycle = |(k, label): (usize, &String)| Cycle {
        label: label.clone(),
        phase: first(phases, k),
        velocity: first(velocities, k),
        share: shares.get(k).copied().unwrap_or(f64::NAN),
        colour: class_style(label).colour.to_hex(),
    };
    labels.iter().enumerate().map(cycle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::study::in_memory;
    use vibroimpact_study::{Control, Plan, Study};

    const MAP: &str = r#""map":{"axes":[{"vary":"inverse_beta","over":"0.5:2:7"},{"vary":"gap","over":"0:2:5"}],"starts":2,"impacts":200"#;

    fn sheet(task: &str) -> Sheet {
        let plan = Plan::from_text(&format!(
            r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{{task}}}}}"#
        ));
        in_memory(Study::new(&plan.unwrap()).unwrap(), &Control::default()).unwrap()
    }

    fn packed(task: &str) -> (serde_json::Value, Vec<u8>) {
        let bytes = pack(&sheet(task));
        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        assert_eq!((4 + length) % 8, 0);
        (serde_json::from_slice(&bytes[4..4 + length]).unwrap(), bytes[4 + length..].to_vec())
    }

    fn whole(body: &[u8], field: &serde_json::Value) -> Vec<i32> {
        let at = usize::try_from(field["offset"].as_u64().unwrap()).unwrap();
        let count = usize::try_from(field["length"].as_u64().unwrap()).unwrap();
        body[at..at + 4 * count].chunks(4).map(|four| i32::from_le_bytes(four.try_into().unwrap())).collect()
    }

    /// S of the 1971 paper has two motions, and every start leads to one of them.
    #[test]
    fn a_basin() {
        let axes = r#"[{"vary":"x","over":"-2:0.75:13"},{"vary":"v","over":"-2:2:9"}]"#;
        let (header, body) = packed(&format!(r#""basin":{{"axes":{axes},"refine":4}}"#));
        assert_eq!(header["shape"], serde_json::json!([9, 13]));
        let names: Vec<_> = header["fields"].as_array().unwrap().iter().map(|f| f["name"].clone()).collect();
        assert_eq!(names, ["label", "cycle", "computed"]);
        let labels = whole(&body, &header["fields"][0]);
        assert_eq!(labels.len(), 117);
        assert!(labels.iter().all(|code| header["labels"][code.to_string()]["name"].is_string()));
        let cycles = header["cycles"].as_array().unwrap();
        assert_eq!(cycles.len(), 2);
        let label = |k: usize| cycles[k]["label"].as_str().unwrap();
        let numbers = whole(&body, &header["fields"][1]);
        assert!(
            labels
                .iter()
                .zip(&numbers)
                .all(|(code, k)| { header["labels"][code.to_string()]["name"] == label(usize::try_from(*k).unwrap()) })
        );
        assert!(header["computed"].as_f64().unwrap() <= 1.0);
    }

    /// The values of a quantity are those of the motions; chaotic and undecided motions have none.
    #[test]
    fn a_quantity() {
        let (header, body) = packed(&format!(r#"{MAP},"fields":["impact_speed_max"]}}"#));
        assert_eq!(header["shape"], serde_json::json!([5, 7]));
        assert!(header["labels"]["10001"]["colour"].as_str().unwrap().starts_with('#'));
        let fields = header["fields"].as_array().unwrap();
        let names: Vec<_> = fields.iter().map(|field| field["name"].clone()).collect();
        assert_eq!(names, ["label", "share", "impact_speed_max"]);
        assert_eq!((&fields[0]["per_point"], &fields[1]["type"]), (&2.into(), &"f64".into()));
        let labels = whole(&body, &fields[0]);
        assert_eq!(labels.len(), 70);
        let begin = usize::try_from(fields[2]["offset"].as_u64().unwrap()).unwrap();
        let value = |k: usize| f64::from_le_bytes(body[begin + 8 * k..begin + 8 * k + 8].try_into().unwrap());
        let one = labels.iter().position(|code| *code == 10_001).unwrap();
        assert!(value(one) > 0.0, "{}", value(one));
        let none = labels.iter().position(|code| *code == vibroimpact_study::study::NO_MOTION).unwrap();
        assert!(value(none).is_nan());
    }

    #[test]
    fn what_is_packed_is_unpacked() {
        let sheet = sheet(&format!(r#"{MAP},"refine":4,"fields":["power"]}}"#));
        let bytes = pack(&sheet);
        let columns = unpack(&bytes, &sheet.fields, 35).unwrap();
        for ((field, packed), unpacked) in sheet.fields.iter().zip(&sheet.columns).zip(columns) {
            assert_eq!(unpacked.as_ref(), is_drawn(field).then_some(packed), "{}", field.name);
        }
        assert!(unpack(&bytes[..100], &sheet.fields, 35).is_none_or(|all| all.iter().all(Option::is_none)));
        assert!(unpack(&bytes, &sheet.fields, 36).unwrap().iter().any(Option::is_none));
    }
}
