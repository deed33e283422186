//! The arrays of a study in a store: one for each field, its coordinates, and the status of its tiles.

use crate::chunk::Chunked;
use crate::codec::Holds;
use crate::recent::Recent;
use crate::shards::Shards;
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use vibroimpact_study::Grid;
use vibroimpact_study::study::{Cells, Study, StudyTable};
use vibroimpact_study::{Column, Field, NumberType, Unit};

/// The field that is written last. A tile is complete if its chunk of this field exists.
pub(crate) const STATUS: &str = "status";
/// The status of a complete tile.
pub(crate) const DONE: i8 = 1;

/// The arrays of a study.
pub(crate) struct Layout {
    pub(crate) grid: Grid,
    /// The shards, if the chunks of tiles are in shards.
    pub(crate) shards: Option<Shards>,
    pub(crate) fields: Vec<Field>,
    /// The arrays of the fields, in their order.
    pub(crate) arrays: Vec<Chunked>,
    /// The last chunks of each.
    pub(crate) recent: Vec<Recent>,
    pub(crate) status: Chunked,
    pub(crate) coordinates: Vec<(Chunked, Cells)>,
}

fn text(value: &str) -> Value {
    Value::String(value.to_owned())
}

/// The attributes of a variable according to the CF conventions: long name, units, flags; and the scale of nondimensional
/// numbers.
fn attributes(long_name: &str, unit: Unit, comment: &str, flags: &[(i32, String)]) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("long_name".into(), text(long_name));
    if !unit.name.is_empty() {
        map.insert("units".into(), text(unit.name));
    }
    if !unit.scale.is_empty() {
        map.insert("scale".into(), text(unit.scale));
    }
    if !comment.is_empty() {
        map.insert("comment".into(), text(comment));
    }
    if !flags.is_empty() {
        let meanings: Vec<&str> = flags.iter().map(|(_, meaning)| meaning.as_str()).collect();
        map.insert("flag_values".into(), json!(flags.iter().map(|(value, _)| value).collect::<Vec<_>>()));
        map.insert("flag_meanings".into(), text(&meanings.join(" ")));
    }
    map
}

/// The array of a field; `more` are additional flags.
pub(crate) fn array_of(field: &Field, (grid, shards): (&Grid, Option<&Shards>), more: &[(i32, String)]) -> Chunked {
    let mut dimensions: Vec<_> = grid.dimensions.iter().map(|d| (d.name.clone(), d.count, d.tile)).collect();
    dimensions.extend(field.extra.iter().map(|extra| (extra.name.to_owned(), extra.count, extra.count)));
    let shard = shards.map(|shards| {
        let sides = shards.side.iter().zip(&grid.dimensions).map(|(side, d)| side * d.tile);
        sides.chain(field.extra.iter().map(|extra| extra.count)).collect()
    });
    let own = field.flags.iter().map(|(value, meaning)| (*value, (*meaning).to_owned()));
    let flags: Vec<(i32, String)> = own.chain(more.iter().cloned()).collect();
    Chunked {
        name: field.name.to_string(),
        kind: Holds::Numbers(field.kind),
        fill: field.fill,
        dimensions,
        shard,
        attributes: attributes(&field.long_name, field.unit, field.comment, &flags),
    }
}

/// The array of a table.
pub(crate) fn array_of_table(table: &StudyTable) -> Chunked {
    Chunked {
        name: table.name.to_owned(),
        kind: Holds::of(&table.values),
        fill: i32::MIN,
        dimensions: table.dimensions.iter().map(|(name, count)| ((*name).to_owned(), *count, *count)).collect(),
        shard: None,
        attributes: attributes(table.long_name, table.unit, "", &[]),
    }
}

impl Layout {
    pub(crate) fn new(study: &Study, shards: Option<Shards>) -> Self {
        let (grid, fields) = (study.grid().clone(), study.fields());
        let array = |field| array_of(field, (&grid, shards.as_ref()), &[]);
        let arrays = fields.iter().map(array).collect();
        let recent = fields.iter().map(|_| Recent::default()).collect();
        // the status of all tiles of a shard is one chunk
        let side = shards.as_ref().map_or_else(|| vec![1; grid.dimensions.len()], |shards| shards.side.clone());
        let tiles = grid.dimensions.iter().zip(grid.tiles_along());
        let flags = [(0, "not_computed".to_owned()), (i32::from(DONE), "done".to_owned())];
        let status = Chunked {
            name: STATUS.to_owned(),
            kind: Holds::Numbers(NumberType::I8),
            fill: 0,
            dimensions: tiles.zip(side).map(|((d, count), side)| (format!("tile_{}", d.name), count, side)).collect(),
            shard: None,
            attributes: attributes("whether the tile is computed", Unit::NUMBER, "", &flags),
        };
        let coordinate = |along: vibroimpact_study::study::Along| {
            let count = along.values.len();
            let array = Chunked {
                name: along.name,
                kind: Holds::Numbers(NumberType::F64),
                fill: 0,
                dimensions: vec![(along.dimension, count, count)],
                shard: None,
                attributes: attributes(&along.long_name, along.unit, "", &[]),
            };
            (array, Cells::Numbers(Column::F64(along.values)))
        };
        let coordinates = study.coordinates().into_iter().map(coordinate).collect();
        Self { grid, shards, fields, arrays, recent, status, coordinates }
    }

    /// The indices of a tile, or of its shard, in all arrays without further dimensions.
    fn place(&self, tile: u64) -> Vec<usize> {
        match &self.shards {
            None => self.grid.place(tile),
            Some(shards) => shards.place(shards.of_tile(tile)),
        }
    }

    /// The key of the status of a tile, or of its shard.
    pub(crate) fn status_key(&self, tile: u64) -> String {
        self.status.key(&self.place(tile))
    }

    /// The key of the file that holds the chunk of a tile in the array of a field: its own, or that of its shard.
    pub(crate) fn key(&self, tile: u64, field: usize) -> String {
        let extra = self.fields[field].extra.iter().map(|_| 0);
        self.arrays[field].key(&self.place(tile).into_iter().chain(extra).collect::<Vec<_>>())
    }

    /// The status in the chunk of a tile: that all tiles there are complete.
    pub(crate) fn all_done(&self, tile: u64) -> Cells {
        let status = match &self.shards {
            None => vec![DONE],
            Some(shards) => {
                let of = |tile: Option<u64>| if tile.is_some() { DONE } else { 0 };
                shards.tiles(shards.of_tile(tile)).into_iter().map(of).collect()
            }
        };
        Cells::Numbers(Column::I8(status))
    }

    /// The chunk of a tile: its column, padded to the size of a chunk.
    pub(crate) fn padded<'a>(&self, tile: u64, field: usize, column: &'a Column) -> Cow<'a, Column> {
        let (full, field) = (self.grid.full_tile(tile), &self.fields[field]);
        if self.grid.tile(tile) == full {
            return Cow::Borrowed(column);
        }
        let mut chunk = field.empty(full.points());
        self.grid.tile(tile).rows(&full, field.width(), |at, from, len| chunk.copy(at, column, from, len));
        Cow::Owned(chunk)
    }

    /// The column of a tile: its chunk without the padding.
    pub(crate) fn unpadded(&self, tile: u64, field: usize, chunk: &Column) -> Column {
        let (full, field, block) = (self.grid.full_tile(tile), &self.fields[field], self.grid.tile(tile));
        let mut column = field.empty(block.points());
        block.rows(&full, field.width(), |at, from, len| column.copy(from, chunk, at, len));
        column
    }
}
