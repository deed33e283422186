//! The cases in the files of `vectors/`.

use serde_json::Value;
use std::path::Path;
use vibroimpact::events::{Event, Start};
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::math::Matrix;

pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) machine: Machine,
    pub(crate) start: Start,
    pub(crate) events: Vec<Wanted>,
    pub(crate) states: Vec<State>,
    pub(crate) robust: usize,
    pub(crate) after_chatter: Option<After>,
}

#[derive(Debug)]
pub(crate) struct Wanted {
    pub(crate) kind: String,
    pub(crate) stop: String,
    pub(crate) time: f64,
    pub(crate) speed: f64,
    pub(crate) condition: f64,
}

pub(crate) struct State {
    pub(crate) event: usize,
    q: Vec<f64>,
    qdot: Vec<f64>,
    condition: [f64; 2],
}

pub(crate) struct After {
    pub(crate) events: Vec<Wanted>,
    pub(crate) robust: usize,
}

impl State {
    pub(crate) fn differs(&self, event: &Event, roundings: f64) -> Option<String> {
        for (name, got, want, condition) in
            [("q", &event.q, &self.q, self.condition[0]), ("qdot", &event.qdot, &self.qdot, self.condition[1])]
        {
            let size = want.iter().fold(condition.max(0.1), |most, value| most.max(value.abs()));
            let error = got.iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if error > roundings * f64::EPSILON * size || error.is_nan() {
                return Some(format!("{name} {got:?}, {want:?} wanted: {:e} roundings", error / (f64::EPSILON * size)));
            }
        }
        None
    }
}

pub(crate) fn cases() -> Vec<(String, Vec<Case>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/machines/vectors");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
        .into_iter()
        .map(|file| {
            let text = std::fs::read_to_string(&file).unwrap();
            let cases = text.lines().map(|line| case(&serde_json::from_str(line).unwrap())).collect();
            (file.file_stem().unwrap().to_string_lossy().into_owned(), cases)
        })
        .collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().map(|all| all.iter().map(|x| x.as_f64().unwrap()).collect()).unwrap_or_default()
}

fn number(value: &Value, otherwise: f64) -> f64 {
    value.as_f64().unwrap_or(otherwise)
}

fn matrix(value: &Value, n: usize) -> Matrix {
    match value.as_array() {
        None => Matrix::zeros(n, n),
        Some(rows) if rows.first().is_some_and(Value::is_array) => {
            Matrix::from_rows(&rows.iter().map(numbers).collect::<Vec<_>>()).unwrap()
        }
        Some(_) => Matrix::diagonal(&numbers(value)),
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> String {
    value.as_str().unwrap().to_owned()
}

fn events(value: &Value) -> Vec<Wanted> {
    list(value)
        .iter()
        .map(|row| Wanted {
            kind: text(&row[0]),
            stop: text(&row[1]),
            time: row[2].as_f64().unwrap(),
            speed: row[3].as_f64().unwrap(),
            condition: row[4].as_f64().unwrap(),
        })
        .collect()
}

fn case(value: &Value) -> Case {
    let described = &value["machine"];
    let names: Vec<String> = list(&described["coordinates"]).iter().map(text).collect();
    let n = names.len();
    let mut parts = MachineParts::new(names);
    parts.mass = matrix(&described["mass"], n);
    parts.stiffness = matrix(&described["stiffness"], n);
    parts.damping = matrix(&described["damping"], n);
    if described["constant"].is_array() {
        parts.constant = numbers(&described["constant"]);
    }
    parts.frequency = described["frequency"].as_f64();
    let order = |value: &Value| u32::try_from(value["order"].as_u64().unwrap()).unwrap();
    for force in list(&described["force"]) {
        let (cos, sin) = (numbers(&force["cos"]), numbers(&force["sin"]));
        for i in 0..n {
            parts = parts.with_force(
                i,
                order(force),
                cos.get(i).copied().unwrap_or(0.0),
                sin.get(i).copied().unwrap_or(0.0),
            );
        }
    }
    for stop in list(&described["stop"]) {
        let law = match stop["restitution"].as_f64() {
            Some(restitution) => StopLaw::Rigid { restitution },
            None => StopLaw::Compliant {
                stiffness: stop["stiffness"].as_f64().unwrap(),
                damping: number(&stop["damping"], 0.0),
                preload: number(&stop["preload"], 0.0),
                opening: if stop["opening"] == "position" { Opening::Position } else { Opening::Force },
            },
        };
        parts = parts.with_stop(
            stop["name"].as_str().unwrap(),
            &numbers(&stop["direction"]),
            stop["gap"].as_f64().unwrap(),
            law,
        );
        let motion = list(&stop["motion"]).iter().map(|of| HarmonicMotion {
            order: order(of),
            cos: number(&of["cos"], 0.0),
            sin: number(&of["sin"], 0.0),
        });
        parts.stops.last_mut().unwrap().motion = motion.collect();
    }
    for joint in list(&described["friction"]) {
        let sliding = joint["sliding"].as_f64().unwrap();
        let (limit, belt) = (number(&joint["static"], sliding), number(&joint["belt"], 0.0));
        parts = parts.with_joint(joint["name"].as_str().unwrap(), &numbers(&joint["direction"]), sliding, limit, belt);
    }
    let name = text(&value["name"]);
    let machine = Machine::new(parts).unwrap_or_else(|error| panic!("{name}: {error}"));
    let start = &value["start"];
    let start = Start {
        q: numbers(&start["q"]),
        qdot: numbers(&start["qdot"]),
        phase: number(&start["phase"], 0.0),
        ..Start::default()
    };
    let states = list(&value["states"]).iter().map(|row| State {
        event: usize::try_from(row[0].as_u64().unwrap()).unwrap(),
        q: numbers(&row[1]),
        qdot: numbers(&row[2]),
        condition: [row[3].as_f64().unwrap(), row[4].as_f64().unwrap()],
    });
    let robust = |of: &Value| usize::try_from(of["robust"].as_u64().unwrap()).unwrap();
    let after = &value["after_chatter"];
    Case {
        name,
        machine,
        start,
        events: events(&value["events"]),
        states: states.collect(),
        robust: robust(value),
        after_chatter: after.is_object().then(|| After { events: events(&after["events"]), robust: robust(after) }),
    }
}
