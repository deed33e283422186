//! Events of motions of any system as columns.

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use vibroimpact_report::json::event::EventObject;

/// Events of motions: rows of equal length, filled up with -1 and not-a-number.
pub(crate) struct Events {
    kinds: Vec<String>,
    stops: Vec<String>,
    kind: Vec<i8>,
    stop: Vec<i32>,
    /// Times, phases, speeds, coordinates and velocities.
    real: Vec<Vec<f64>>,
}

/// The events as arrays.
#[derive(IntoPyObject)]
pub(crate) struct EventFields<'py> {
    /// The names of kinds of events, and of stops and joints, by their codes.
    kinds: Vec<String>,
    stops: Vec<String>,
    kind: Bound<'py, PyArray1<i8>>,
    stop: Bound<'py, PyArray1<i32>>,
    /// Times, phases, speeds (of a slip the direction), and one column for each coordinate and each velocity.
    real: Vec<Bound<'py, PyArray1<f64>>>,
}

/// The code of a name in a list, to which it is added when it is new.
pub(crate) fn code(names: &mut Vec<String>, name: &str) -> i32 {
    let place = names.iter().position(|known| known == name).unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    });
    i32::try_from(place).unwrap_or(i32::MAX)
}

impl Events {
    /// None yet, of motions in `n` coordinates; `stops` are the names of stops and joints with the first codes.
    pub(crate) fn new(n: usize, stops: Vec<String>) -> Self {
        Self { kinds: Vec::new(), stops, kind: Vec::new(), stop: Vec::new(), real: vec![Vec::new(); 3 + 2 * n] }
    }

    pub(crate) fn push(&mut self, event: &EventObject<'_>) {
        self.kind.push(i8::try_from(code(&mut self.kinds, event.kind)).unwrap_or(i8::MAX));
        self.stop.push(code(&mut self.stops, event.stop));
        let first = [event.time, event.phase.unwrap_or(0.0), event.direction.unwrap_or(event.speed)];
        let values = first.iter().chain(event.q.iter()).chain(event.qdot.iter());
        self.real.iter_mut().zip(values).for_each(|(column, value)| column.push(*value));
    }

    /// Fills up so that there are `count` events.
    pub(crate) fn fill(&mut self, count: usize) {
        self.kind.resize(count, -1);
        self.stop.resize(count, -1);
        self.real.iter_mut().for_each(|column| column.resize(count, f64::NAN));
    }

    pub(crate) fn fields(self, py: Python<'_>) -> EventFields<'_> {
        EventFields {
            kinds: self.kinds,
            stops: self.stops,
            kind: self.kind.into_pyarray(py),
            stop: self.stop.into_pyarray(py),
            real: self.real.into_iter().map(|column| column.into_pyarray(py)).collect(),
        }
    }
}
