//! The events of many motions as columns of numbers.

use vibroimpact::Side;
use vibroimpact::motion::{Event, EventKind};

/// The reasons for which lists of events end, in the order of their codes.
pub const END_REASONS: [&str; 5] = ["impact_limit", "time_limit", "no_more_impacts", "stuck", "search_limit"];

/// The events of many motions: a row for each motion, with room for `room` events. Their real numbers are in memory of the
/// caller, because that of numpy comes in large pages: the first access to each small one takes a third of the time of the
/// events on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventColumns {
    /// The number of cells of each row.
    pub room: usize,
    /// The largest number of events of a motion, at most `room`. The further cells of all rows hold no events.
    pub width: usize,
    /// 0 impact, 1 graze, 2 stick, 3 release; -1 after the last event.
    pub kind: Vec<i8>,
    /// 1 for the first stop, -1 for the second; 0 after the last event.
    pub side: Vec<i8>,
    /// The [real numbers](REAL_COLUMNS) instead of those of the caller, if the rows had too little room or far too much.
    pub refitted: Option<Vec<f64>>,
    /// The number of events of each motion.
    pub count: Vec<i32>,
    /// Why the list of each motion ends: a place in [`END_REASONS`].
    pub end: Vec<i8>,
    /// The time at which the list of each motion ends.
    pub end_time: Vec<f64>,
}

/// The number of real columns, one after another: time since the start, phase of the force, and the velocity towards the stop
/// before and after an impact, which are nan for other events. All are nan after the last event.
pub const REAL_COLUMNS: usize = 4;

/// Some rows, which one thread fills. Events for which the rows have no room are kept aside, each with its row.
pub(crate) struct Rows<'a> {
    room: usize,
    small: [&'a mut [i8]; 2],
    real: [&'a mut [f64]; REAL_COLUMNS],
    count: &'a mut [i32],
    end: &'a mut [i8],
    end_time: &'a mut [f64],
    /// Events that are not yet written, together, because those of motions side by side come in any order, and each would
    /// touch a line of the cache in every column.
    last: Vec<Last>,
    kept: Vec<Kept>,
    aside: Vec<(usize, Numbers)>,
}

/// An event as it is written: kind and stop; time, phase and velocities.
pub(crate) type Numbers = ([i8; 2], [f64; REAL_COLUMNS]);

/// The number of events that are written at once: as many numbers as a line of the cache has.
const AT_ONCE: usize = 8;

/// The number of events of a motion that are written, and kinds and stops of those that are not.
#[derive(Clone, Copy, Default)]
struct Last {
    written: u32,
    count: u32,
    small: [[i8; 2]; AT_ONCE],
}

/// The numbers of the last events of a motion, which are not yet written.
#[derive(Clone, Copy, Default)]
#[repr(align(64))]
struct Kept([[f64; REAL_COLUMNS]; AT_ONCE]);

/// The numbers of an event.
#[inline]
fn numbers(event: &Event) -> Numbers {
    let (kind, before, after) = match event.kind {
        EventKind::Impact { velocity_before, velocity_after } => (0, velocity_before, velocity_after),
        EventKind::Graze { .. } => (1, f64::NAN, f64::NAN),
        EventKind::Stick { .. } => (2, f64::NAN, f64::NAN),
        EventKind::Release => (3, f64::NAN, f64::NAN),
    };
    let side = match event.side {
        Side::Upper => 1,
        Side::Lower => -1,
    };
    ([kind, side], [event.time, event.phase, before, after])
}

/// What is written after the last event of a motion.
const NOTHING: Numbers = ([-1, 0], [f64::NAN; REAL_COLUMNS]);

impl Rows<'_> {
    /// Makes the rows ready for events.
    pub(crate) fn begun(mut self) -> Self {
        self.last = vec![Last::default(); self.count.len()];
        self.kept = vec![Kept::default(); self.count.len()];
        self
    }

    /// Takes the next event of a motion for its row.
    #[inline]
    pub(crate) fn push(&mut self, row: usize, event: &Event) {
        let (last, (small, real)) = (&mut self.last[row], numbers(event));
        let at = last.count as usize % AT_ONCE;
        (last.small[at], self.kept[row].0[at]) = (small, real);
        last.count += 1;
        if last.count as usize == AT_ONCE {
            self.write(row);
        }
    }

    /// Writes the last events of a motion into its row.
    fn write(&mut self, row: usize) {
        let (last, kept) = (&mut self.last[row], &self.kept[row].0);
        let (written, count) = (last.written as usize, last.count as usize);
        (last.written, last.count) = (last.written + last.count, 0);
        let here = count.min(self.room.saturating_sub(written));
        self.aside.extend((here..count).map(|k| (row, (last.small[k], kept[k]))));
        let at = row * self.room + written.min(self.room);
        for (k, column) in self.small.iter_mut().enumerate() {
            column[at..at + here].iter_mut().zip(&last.small).for_each(|(cell, small)| *cell = small[k]);
        }
        for (k, column) in self.real.iter_mut().enumerate() {
            column[at..at + here].iter_mut().zip(kept).for_each(|(cell, real)| *cell = real[k]);
        }
    }

    /// Writes why and when the list of a motion ends.
    pub(crate) fn end(&mut self, row: usize, reason: &str, time: f64) {
        let code = END_REASONS.iter().position(|known| *known == reason);
        self.end[row] = code.and_then(|code| i8::try_from(code).ok()).unwrap_or(-1);
        self.end_time[row] = time;
    }

    /// Fills up all rows. Returns the events for which they had no room.
    pub(crate) fn filled(mut self) -> Vec<(usize, Numbers)> {
        for row in 0..self.last.len() {
            self.write(row);
            let written = self.last[row].written;
            self.count[row] = i32::try_from(written).unwrap_or(i32::MAX);
            let rest = row * self.room + (written as usize).min(self.room)..(row + 1) * self.room;
            self.small.iter_mut().zip(NOTHING.0).for_each(|(column, value)| column[rest.clone()].fill(value));
            self.real.iter_mut().zip(NOTHING.1).for_each(|(column, value)| column[rest.clone()].fill(value));
        }
        self.aside
    }
}

impl EventColumns {
    /// Columns with this number of rows, with room for `room` events each, which is at least 1. They must be
    /// [filled](Rows::filled).
    pub(crate) fn open(rows: usize, room: usize) -> Self {
        Self {
            room,
            width: 0,
            kind: vec![0; rows * room],
            side: vec![0; rows * room],
            refitted: None,
            count: vec![0; rows],
            end: vec![0; rows],
            end_time: vec![0.0; rows],
        }
    }

    /// The rows in parts of `part` rows each, with the real columns, which are all of the same length.
    pub(crate) fn parts<'a>(&'a mut self, real: &'a mut [f64], part: usize) -> Vec<Rows<'a>> {
        let (room, cells) = (self.room, part * self.room);
        let (times, velocities) = real.split_at_mut(2 * self.kind.len());
        let pairs = |of: &'a mut [f64]| {
            let (one, other) = of.split_at_mut(of.len() / 2);
            one.chunks_mut(cells).zip(other.chunks_mut(cells))
        };
        let small = self.kind.chunks_mut(cells).zip(self.side.chunks_mut(cells));
        let (times, velocities) = (pairs(times), pairs(velocities));
        let ends = self.count.chunks_mut(part).zip(self.end.chunks_mut(part)).zip(self.end_time.chunks_mut(part));
        let all = small.zip(times.zip(velocities)).zip(ends);
        all.map(|(((kind, side), ((time, phase), (before, after))), ((count, end), end_time))| Rows {
            room,
            small: [kind, side],
            real: [time, phase, before, after],
            last: Vec::new(),
            kept: Vec::new(),
            count,
            end,
            end_time,
            aside: Vec::new(),
        })
        .collect()
    }

    /// The columns with room for the events of the longest row. `aside` are the events that the rows had no room for, in
    /// their order.
    pub(crate) fn fitted(mut self, real: &[f64], aside: impl Iterator<Item = (usize, Numbers)>) -> Self {
        self.width = self.count.iter().max().map_or(0, |count| usize::try_from(*count).unwrap_or(0));
        let (old, new, rows) = (self.room, self.width, self.count.len());
        // a copy of all events takes longer than a few empty cells are worth
        if (old - old / 4..=old).contains(&new) {
            return self;
        }
        let small = [&mut self.kind, &mut self.side];
        small.into_iter().zip(NOTHING.0).for_each(|(column, nothing)| *column = refit(column, (old, new), nothing));
        let mut refitted: Vec<f64> = Vec::with_capacity(REAL_COLUMNS * rows * new);
        let columns = real.chunks((rows * old).max(1)).zip(NOTHING.1);
        columns.for_each(|(column, nothing)| refitted.extend(refit(column, (old, new), nothing)));
        self.room = new;
        let mut next = vec![old; rows];
        for (row, ([kind, side], numbers)) in aside {
            let at = row * new + next[row];
            next[row] += 1;
            (self.kind[at], self.side[at]) = (kind, side);
            numbers.into_iter().enumerate().for_each(|(k, number)| refitted[k * rows * new + at] = number);
        }
        self.refitted = Some(refitted);
        self
    }
}

/// Rows with room for so many cells as rows with other room.
fn refit<T: Copy>(column: &[T], (old, new): (usize, usize), nothing: T) -> Vec<T> {
    let mut fitted = Vec::with_capacity(column.len() / old * new);
    for (row, values) in column.chunks(old).enumerate() {
        fitted.extend_from_slice(&values[..old.min(new)]);
        fitted.resize((row + 1) * new, nothing);
    }
    fitted
}
