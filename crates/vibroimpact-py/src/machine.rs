//! Machines: a machine as it is written, the events of its motion, and its waveform.

use crate::columns::{column, grid};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::events::{EventFields, Events, code};
use crate::plan::parsed;
use crate::section::{Section, States, columns, whole_periods};
use crate::simulate::{checked_step, simulate_plan};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use vibroimpact::events::{self, Event, Sample, Samples};
use vibroimpact::machine::Machine;
use vibroimpact::regime::ContactState;
use vibroimpact_report::json::event::of_machine;
use vibroimpact_study::machine::{CATALOGUE, MachineFileError, MachineProblem, MachineSource, StartText};
use vibroimpact_study::{
    Control, Plan, PlanError, PlanResults, Results, Simulated, System, Task, events_with_states, motion_limits, run,
    tiles,
};

/// A machine file that describes a machine.
#[pyclass(frozen, module = "vibroimpact._core")]
#[derive(Debug)]
pub(crate) struct MachineFile(pub(crate) MachineSource);

/// Coordinates, velocities and phase.
pub(crate) type Start = (Vec<f64>, Vec<f64>, f64);

fn checked(source: MachineSource) -> Result<MachineFile, Trouble> {
    source.machine()?;
    Ok(MachineFile(source))
}

impl From<MachineFileError> for Trouble {
    fn from(error: MachineFileError) -> Self {
        Self::question(error.to_string())
    }
}

#[pymethods]
impl MachineFile {
    /// Reads TOML or JSON. `files` returns the text of a file that it names.
    #[new]
    fn new(text: &str, files: &Bound<'_, PyAny>) -> Result<Self, Trouble> {
        let read = |name: &str| {
            let text = files.call1((name,)).and_then(|text| text.extract::<String>());
            text.map_err(|error| format!("cannot be read: {}", error.value(files.py())))
        };
        let source = MachineSource::from_text(text, read).map_err(|error| match error.problem {
            // JSON is written by this package, so a position in it does not help the user
            MachineProblem::Read(error) if text.starts_with('{') => {
                Trouble::question(error.without_place().to_string())
            }
            _ => error.into(),
        })?;
        checked(source)
    }

    /// The machine of this name in the catalogue.
    #[staticmethod]
    fn named(name: &str) -> Result<Self, Trouble> {
        let entry = CATALOGUE.iter().find(|entry| entry.name == name).ok_or_else(|| {
            let names: Vec<&str> = CATALOGUE.iter().map(|entry| entry.name).collect();
            Trouble::question(format!("`{name}` is no machine of the catalogue\nhint: {}", names.join(", ")))
        })?;
        checked(entry.source()?)
    }

    /// The same with other numbers, in this order.
    fn with_numbers(&self, changes: Vec<(String, f64)>) -> Result<Self, Trouble> {
        let mut source = self.0.clone();
        for (path, value) in &changes {
            source = source.with(path, *value)?;
        }
        checked(source)
    }

    /// The same with the start of a state, which is JSON.
    fn starting(&self, state: &str) -> Result<Self, Trouble> {
        checked(MachineSource { start: Some(parsed::<StartText>(state)?), ..self.0.clone() })
    }

    fn number(&self, path: &str) -> Result<f64, Trouble> {
        Ok(self.0.number(path)?)
    }

    fn paths(&self) -> Result<Vec<String>, Trouble> {
        Ok(self.0.paths()?)
    }

    /// As it is written, or the matrices and directions to which it expands.
    fn toml(&self, expanded: bool) -> Result<String, Trouble> {
        Ok(if expanded { self.0.expansion()?.to_toml() } else { self.0.to_toml() })
    }

    /// The names of the coordinates, stops and joints.
    fn names(&self) -> Result<[Vec<String>; 3], Trouble> {
        let parts = self.0.parts()?;
        Ok([
            parts.coordinates,
            parts.stops.into_iter().map(|stop| stop.name).collect(),
            parts.joints.into_iter().map(|joint| joint.name).collect(),
        ])
    }

    /// Title, source and summary.
    fn texts(&self) -> [Option<&str>; 3] {
        [&self.0.title, &self.0.source, &self.0.summary].map(Option::as_deref)
    }

    /// The period of the forcing.
    fn period(&self) -> Result<Option<f64>, Trouble> {
        Ok(self.0.machine()?.period())
    }

    /// The start, with what is given instead of what is written.
    fn start(&self, q: Option<Vec<f64>>, qdot: Option<Vec<f64>>, phase: Option<f64>) -> Result<Start, Trouble> {
        let start = self.0.start()?;
        Ok((q.unwrap_or(start.q), qdot.unwrap_or(start.qdot), phase.unwrap_or(start.phase)))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

/// The start with these coordinates, velocities and phase. That of the file has its contacts too.
pub(crate) fn start(file: &MachineFile, (q, qdot, phase): Start) -> Result<events::Start, Trouble> {
    let own = file.0.start()?;
    let same = (&own.q, &own.qdot) == (&q, &qdot) && own.phase.to_bits() == phase.to_bits();
    Ok(if same { own } else { events::Start { q, qdot, phase, ..events::Start::default() } })
}

/// The state, as JSON, from which a motion goes on after event number `event` of the simulation of a plan, which is JSON.
#[pyfunction]
pub(crate) fn machine_state(py: Python<'_>, plan: &str, event: usize) -> Result<String, Trouble> {
    let plan = crate::plan::read(plan)?;
    let (System::Machine(machine), Task::Simulate(simulation)) = (plan.system, plan.task) else {
        return Err(Trouble::question("this is no plan that simulates a machine".to_owned()));
    };
    let (machine, start) = machine.problem()?;
    door::run(py, Watch::alone("following a machine"), move |control| {
        let mut events = events_with_states(&machine, &start, simulation.until(machine.period()))?
            .take_while(|_| !control.stopping());
        let state = events.nth(event).and_then(|event| event.state);
        let text = state.map(|state| StartText::of(&state, machine.parts()));
        // finite numbers and texts can always be written as JSON
        Ok(text.and_then(|text| serde_json::to_string(&text).ok()).unwrap_or_default())
    })
}

/// The events of motions of machines: a row of `width` events for each motion.
#[derive(IntoPyObject)]
pub(crate) struct ManyEventFields<'py> {
    width: usize,
    events: EventFields<'py>,
    count: Bound<'py, PyArray1<i32>>,
    /// The names of reasons for which lists end, and the code of each list.
    ends: Vec<String>,
    end: Bound<'py, PyArray1<i32>>,
    end_time: Bound<'py, PyArray1<f64>>,
}

impl<'py> ManyEventFields<'py> {
    fn new(py: Python<'py>, found: &[Simulated<Event>], machine: &Machine) -> Self {
        let width = found.iter().map(|one| one.events.len()).max().unwrap_or(0);
        let places = machine.stops().len() + machine.joints().len();
        let mut events = Events::new(machine.n(), (0..places).map(|place| machine.name_of(place).to_owned()).collect());
        for (row, one) in found.iter().enumerate() {
            one.events.iter().for_each(|event| events.push(&of_machine(machine, event)));
            events.fill((row + 1) * width);
        }
        let mut ends = Vec::new();
        Self {
            width,
            events: events.fields(py),
            count: column(py, found.iter().map(|one| i32::try_from(one.events.len()).unwrap_or(i32::MAX))),
            end: column(py, found.iter().map(|one| code(&mut ends, one.reason))),
            end_time: column(py, found.iter().map(|one| one.time)),
            ends,
        }
    }
}

/// The results of `work` for machines with one start each. `numbers` are columns of numbers that vary, by their paths.
fn each<T: Send + 'static>(
    py: Python<'_>,
    file: &MachineFile,
    (numbers, starts): (Numbers, Vec<Start>),
    (threads, progress): (usize, Option<Py<PyAny>>),
    work: impl Fn(MachineSource, &events::Start, &Control<'_>) -> Result<T, Trouble> + Send + Sync + 'static,
) -> Result<Vec<T>, Trouble> {
    let (source, total) = (file.0.clone(), starts.len() as u64);
    let watch = Watch { what: "following machines", total, progress, threads };
    door::run(py, watch, move |control| {
        let one = |k: usize| {
            let there = numbers.iter().try_fold(source.clone(), |there, (path, values)| there.with(path, values[k]))?;
            let (q, qdot, phase) = starts[k].clone();
            // the progress is that of whole motions
            let alone = Control { stop: control.stop, threads: 1, ..Control::default() };
            work(there, &events::Start { q, qdot, phase, ..events::Start::default() }, &alone)
        };
        let parts = tiles(total, 1, control, |range, tick| {
            let found = one(usize::try_from(range.start).unwrap_or(usize::MAX));
            tick();
            found
        })?;
        parts.into_iter().collect()
    })
}

/// Numbers that vary, as columns by path.
type Numbers = Vec<(String, Vec<f64>)>;

/// Time and phase, coordinates, and velocities.
type State = (f64, f64, Vec<f64>, Vec<f64>);

/// The states of a machine in a section. A start beyond a stop is an error.
fn section(machine: &Machine, start: &events::Start, of: &Section) -> Result<Vec<State>, Trouble> {
    let period = || machine.period().ok_or(PlanError::Unforced);
    let wrong = |error: vibroimpact::machine::MachineError| PlanError::Machine(error.into());
    let states = |times: &[f64]| -> Result<Vec<State>, Trouble> {
        let nothing = || (f64::NAN, f64::NAN, vec![f64::NAN; machine.n()], vec![f64::NAN; machine.n()]);
        let of = |state: Option<Sample>| {
            state.map_or_else(nothing, |Sample { time, phase, q, qdot, .. }| (time, phase, q, qdot))
        };
        Ok(events::states_at(machine, start, times).map_err(wrong)?.into_iter().map(of).collect())
    };
    match of {
        Section::At(times) => states(times),
        Section::Phase(phase, periods) => {
            let period = period()?;
            let first = vibroimpact::system::phase::wrap(phase - start.phase) / core::f64::consts::TAU;
            let times: Vec<f64> = whole_periods(*periods).map(|k| (first + f64::from(k)) * period).collect();
            let phase = vibroimpact::system::phase::wrap(*phase);
            Ok(states(&times)?.into_iter().map(|(time, _, q, qdot)| (time, phase, q, qdot)).collect())
        }
        Section::Position(name, position, periods) => {
            let until = periods * period()?;
            let names = &machine.parts().coordinates;
            let place = names
                .iter()
                .position(|one| one == name)
                .ok_or_else(|| Trouble::question(format!("`{name}` is no coordinate\nhint: {}", names.join(", "))))?;
            let found = events::crossings(machine, start, (place, *position), until).map_err(wrong)?;
            Ok(found.into_iter().map(|Sample { time, phase, q, qdot, .. }| (time, phase, q, qdot)).collect())
        }
    }
}

/// The states of machines in a section: a row of `width` states for each, filled up with not-a-number. Times and phases, and one column
/// for each coordinate and each velocity.
#[pyfunction]
pub(crate) fn states_of_machines<'py>(
    py: Python<'py>,
    file: &MachineFile,
    numbers: Numbers,
    starts: Vec<Start>,
    of: Section,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<States<'py>, Trouble> {
    of.check()?;
    let n = file.0.machine()?.n();
    let found = each(py, file, (numbers, starts), (threads, progress), move |there, start, _| {
        let (machine, start) = there.starting(start).problem()?;
        section(&machine, &start, &of)
    })?;
    let value = |(time, phase, q, qdot): &State, k: usize| match k {
        0 => *time,
        1 => *phase,
        k if k < 2 + n => q[k - 2],
        k => qdot[k - 2 - n],
    };
    Ok(columns(py, &found, 2 + 2 * n, value))
}

/// Follows machines event by event, from one start each. `numbers` are columns of numbers that vary, by their paths.
#[pyfunction]
pub(crate) fn simulate_machines<'py>(
    py: Python<'py>,
    file: &MachineFile,
    numbers: Numbers,
    starts: Vec<Start>,
    plan: &str,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<ManyEventFields<'py>, Trouble> {
    let (machine, plan) = (file.0.machine()?, simulate_plan(plan)?);
    let found = each(py, file, (numbers, starts), (threads, progress), move |there, start, control| {
        match run(&Plan::new(there.starting(start), plan), control)? {
            PlanResults::Machine(Results::Simulate(found)) => Ok(found),
            _ => Err(Trouble::Defect("following machines")),
        }
    })?;
    Ok(ManyEventFields::new(py, &found, &machine))
}

/// The fields of `MachineWaveform`.
#[derive(IntoPyObject)]
pub(crate) struct WaveformFields<'py> {
    time: Bound<'py, PyArray1<f64>>,
    phase: Bound<'py, PyArray1<f64>>,
    q: Bound<'py, PyArray2<f64>>,
    qdot: Bound<'py, PyArray2<f64>>,
    gap: Bound<'py, PyArray2<f64>>,
    force: Bound<'py, PyArray2<f64>>,
    contact: Bound<'py, PyArray2<bool>>,
}

/// The waveform of a machine up to a time, at equal steps, and on both sides of each event if asked.
#[pyfunction]
pub(crate) fn machine_waveform<'py>(
    py: Python<'py>,
    file: &MachineFile,
    from: Start,
    until: f64,
    step: f64,
    events: bool,
) -> Result<WaveformFields<'py>, Trouble> {
    let step = checked_step(step, until)?;
    let machine = file.0.machine()?;
    let (n, stops, joints) = (machine.n(), machine.stops().len(), machine.joints().len());
    let start = start(file, from)?;
    let wave: Vec<Sample> = door::run(py, Watch::alone("drawing a waveform"), move |control| {
        let samples = Samples::new(&machine, &start, motion_limits(&machine, until), (until, step));
        let samples = samples.map_err(|error| PlanError::Machine(error.into()))?;
        Ok(samples.filter(|sample| events || sample.even).take_while(|_| !control.stopping()).collect())
    })?;
    let contact = |sample: &Sample| {
        let closed = |state: &ContactState| matches!(state, ContactState::Closed | ContactState::Resting);
        sample.states[..stops].iter().map(closed).collect()
    };
    Ok(WaveformFields {
        time: column(py, wave.iter().map(|sample| sample.time)),
        phase: column(py, wave.iter().map(|sample| sample.phase)),
        q: grid(py, wave.iter().map(|sample| sample.q.clone()), n)?,
        qdot: grid(py, wave.iter().map(|sample| sample.qdot.clone()), n)?,
        gap: grid(py, wave.iter().map(|sample| sample.gaps.clone()), stops)?,
        force: grid(py, wave.iter().map(|sample| sample.forces.clone()), stops + joints)?,
        contact: grid(py, wave.iter().map(contact), stops)?,
    })
}

/// The names of the machines of the catalogue.
#[pyfunction]
pub(crate) fn machine_names() -> Vec<&'static str> {
    CATALOGUE.iter().map(|entry| entry.name).collect()
}
