//! A tile of a map in which every point is computed itself, a part at a time.
//!
//! The page has the tile already, with points that have the motions of their neighbours, and with smaller budgets. What
//! was computed then is not computed again if the cache still has it. Each request goes on where the one before ended,
//! also if that was cancelled. The answer has the field `computed` as long as there are points that are not computed.

use super::asked::{PlanRequest, Query, bytes};
use super::tile::{KIND, named};
use crate::refusal::Refusal;
use crate::workshop::Bench;
use crate::{Explorer, packed};
use axum::body::Bytes;
use axum::extract::State;
use axum::response::Response;
use core::time::Duration;
use serde::Deserialize;
use std::time::Instant;
use vibroimpact_study::study::{UNDECIDED, points_until};
use vibroimpact_study::{Column, Control, Field, MapPlan, Plan, Study, Task, Variable};

/// Number of starts that one thread settles together. Chaotic ones take 4 s. With 256 of them the time is a fifth longer,
/// because more lanes are empty at the end of each group; with more, a request that is cancelled loses more.
const TOGETHER: u64 = 4096;
/// Flags of the field `computed`: the point was computed itself, or has the motions of its neighbours.
const COMPUTED: i8 = 1;
const FILLED: i8 = 2;

#[derive(Deserialize)]
pub(super) struct Wanted {
    /// Milliseconds after which no further points begin.
    within: u32,
    /// How the tile was computed before, the best first: `BUDGET:DISTANCE` or `BUDGET`, separated by commas, where the
    /// distance is that of the points that refinement computes first.
    after: Option<String>,
}

pub(super) async fn whole(
    State(explorer): State<Explorer>,
    Query(wanted): Query<Wanted>,
    asked: PlanRequest,
) -> Result<Response, Refusal> {
    let plan = asked.plan;
    let Task::Map(map) = &plan.task else { return Err(Refusal::bad("a whole tile is a piece of a map")) };
    if map.refine.is_some() {
        return Err(Refusal::bad("a whole tile has no refine\nhint: /api/tile computes refined tiles"));
    }
    let (name, begun) = (named(&plan), format!("begun {}", plan.hash()));
    if let Some(finished) = explorer.known(&name) {
        return Ok(bytes(KIND, finished));
    }
    let before = earlier(&plan, map, wanted.after.as_deref().unwrap_or_default())?;
    let (cache, within) = (explorer.clone(), Duration::from_millis(wanted.within.into()));
    let work = move |control: &Control<'_>| {
        let end = Instant::now() + within;
        let mut tile = Tile::new(&plan)?;
        for (name, same) in [(begun.clone(), true)].into_iter().chain(before) {
            if let Some(known) = cache.known(&name) {
                tile.take(&known, same);
            }
        }
        tile.compute(control, || Instant::now() > end);
        let body = Bytes::from(tile.pack());
        if tile.missing().is_empty() {
            cache.keep(name, &body);
            cache.forget(&begun);
        } else {
            cache.keep(begun, &body);
        }
        Ok(body)
    };
    Ok(bytes(KIND, explorer.workshop.run(Bench::Tiles, 0, |_| {}, work).await?))
}

/// The keys of the tiles that were computed before, and whether their budget is that of the plan. Larger budgets are left out.
fn earlier(plan: &Plan, map: &MapPlan<Variable, String>, after: &str) -> Result<Vec<(String, bool)>, Refusal> {
    let one = |text: &str| {
        let (impacts, refine) = text.split_once(':').map_or((text, None), |(impacts, refine)| (impacts, Some(refine)));
        let number = |text: &str| text.trim().parse::<u32>();
        let read = number(impacts).and_then(|impacts| Ok((impacts, refine.map(number).transpose()?)));
        read.map_err(|_| Refusal::bad(format!("after = {text} is no BUDGET:DISTANCE or BUDGET")))
    };
    let texts = after.split(',').filter(|text| !text.is_empty());
    let steps: Vec<(u32, Option<u32>)> = texts.map(one).collect::<Result<_, _>>()?;
    let budget = map.impacts.unwrap_or(u32::MAX);
    let smaller = steps.into_iter().filter(|(impacts, _)| *impacts <= budget);
    Ok(smaller
        .map(|(impacts, refine)| {
            let task = Task::Map(MapPlan { impacts: Some(impacts), refine, ..map.clone() });
            (named(&Plan { task, ..plan.clone() }), Some(impacts) == map.impacts)
        })
        .collect())
}

/// A tile whose points are computed in any order.
struct Tile {
    /// The study with refinement, which has a field that says which points are computed.
    study: Study,
    starts: u64,
    /// The fields that are drawn and their columns; the last one says which points are computed.
    fields: Vec<Field>,
    columns: Vec<Column>,
    /// Which fields of the study these are.
    places: Vec<usize>,
}

impl Tile {
    fn new(plan: &Plan) -> Result<Self, Refusal> {
        let Task::Map(map) = &plan.task else { return Err(Refusal::fault("no map")) };
        let task = Task::Map(MapPlan { refine: Some(2), ..map.clone() });
        let study = Study::new(&Plan { task, ..plan.clone() })?;
        let points = usize::try_from(study.grid().points()).unwrap_or(usize::MAX);
        let drawn = study.fields().into_iter().enumerate().filter(|(_, field)| packed::is_drawn(field));
        let (places, fields): (Vec<_>, Vec<_>) = drawn.unzip();
        let columns = fields.iter().map(|field| field.empty(points)).collect();
        Ok(Self { study, starts: map.starts, fields, columns, places })
    }

    /// The flag of each point.
    fn flags(&self) -> &[i8] {
        self.columns.last().map_or(&[], Column::flags)
    }

    fn missing(&self) -> Vec<usize> {
        self.flags().iter().enumerate().filter(|(_, flag)| **flag != COMPUTED).map(|(k, _)| k).collect()
    }

    fn mark(&mut self, point: usize, flag: i8) {
        if let Some(Column::I8(flags)) = self.columns.last_mut() {
            flags[point] = flag;
        }
    }

    /// Takes points from the bytes of a tile: those that are computed, with a smaller budget if they are decided; and for
    /// points that have no motions yet those of their neighbours.
    fn take(&mut self, bytes: &[u8], same: bool) {
        let points = self.flags().len();
        let Some(mut known) = packed::unpack(bytes, &self.fields, points) else { return };
        let flags = known.pop().flatten();
        let Some(known) = known.into_iter().collect::<Option<Vec<Column>>>() else { return };
        for point in self.missing() {
            let own = flags.as_ref().is_none_or(|flags| flags.flags()[point] == COMPUTED);
            let taken = own && (same || self.decided(&known, point));
            let filled = flags.as_ref().is_none_or(|flags| flags.flags()[point] > 0);
            if taken || filled && self.flags()[point] == 0 {
                self.put(point, &known, point);
                self.mark(point, if taken { COMPUTED } else { FILLED });
            }
        }
    }

    /// Whether all starts of a point are decided.
    fn decided(&self, known: &[Column], point: usize) -> bool {
        let part = |name: &str| {
            let at = self.fields.iter().position(|field| field.name == name)?;
            let width = self.fields[at].width();
            Some((&known[at], point * width..(point + 1) * width))
        };
        let (Some((labels, one)), Some((shares, other))) = (part("label"), part("share")) else { return false };
        let shares: f64 = shares.real()[other].iter().filter(|share| !share.is_nan()).sum();
        // more motions than are kept may be undecided
        shares > 1.0 - 1e-9 && !labels.whole()[one].contains(&UNDECIDED)
    }

    /// Copies the values of a point of other columns, without its flag.
    fn put(&mut self, point: usize, from: &[Column], at: usize) {
        for ((field, column), from) in self.fields.iter().zip(&mut self.columns).zip(from) {
            let width = field.width();
            column.copy(point * width, from, at * width, width);
        }
    }

    /// Computes points that are not computed yet.
    fn compute(&mut self, control: &Control<'_>, enough: impl Fn() -> bool + Sync) {
        let missing = self.missing();
        let together = usize::try_from(TOGETHER / self.starts.max(1)).unwrap_or(1).max(16);
        let found = points_until(&self.study, &missing, together, control, enough);
        for (group, columns) in found {
            let columns: Vec<Column> = self.places.iter().map(|place| columns[*place].clone()).collect();
            for (k, point) in group.iter().enumerate() {
                self.put(*point, &columns, k);
            }
        }
    }

    /// The bytes of the tile; without the flags if every point is computed, as a tile without refinement.
    fn pack(&self) -> Vec<u8> {
        let all = self.missing().is_empty();
        let fields = self.fields.iter().zip(&self.columns).take(self.fields.len() - usize::from(all));
        packed::pack_fields(self.study.grid(), fields, &[])
    }
}
