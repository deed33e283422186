//! The orbits with a label: admissible ones and inadmissible solutions of the equations.

use crate::Table;
use crate::figure::{label, series};
use crate::json::event::{closings, fastest, side};
use crate::json::motion::MotionObject;
use crate::number::Number;
use crate::number::short;
use crate::table::cycles::Columns;
use crate::text::Teller;
use crate::text::oscillator::impacts;
use crate::text::words::{multipliers, stop_name};
use crate::{AnswerOf, Units};
use core::f64::consts::TAU;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::EarlierContact;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::Verdict;
use vibroimpact::{Label, Oscillator};
use vibroimpact_plot::{Figure, FigureAxis, Legend, Panel, Points};
use vibroimpact_study::{CycleOf, Orbit, SystemPlan, Task};

/// The answer to `vibro orbit`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct OrbitAnswer<'a> {
    /// The orbits.
    pub(crate) orbits: Vec<OrbitObject<'a>>,
}

/// One orbit.
#[derive(JsonSchema, Serialize)]
pub struct OrbitObject<'a> {
    #[serde(flatten)]
    pub(crate) motion: MotionObject<'a>,
    /// False for a solution of the equations of an oscillator that passes through a stop.
    pub(crate) admissible: bool,
    /// The first contact of such a solution with a stop before its next impact.
    earlier_contact: Option<ContactObject>,
}

#[derive(JsonSchema, Serialize)]
struct ContactObject {
    /// Number of the impact before the contact, counted from 1; none if the motion has no impacts.
    after_impact: Option<usize>,
    /// `upper` or `lower`.
    stop: &'static str,
    /// Time from that impact, or from phase 0, to the contact.
    time: f64,
}

impl<'a> OrbitObject<'a> {
    pub(crate) fn of_oscillator(orbit: &Orbit, osc: &Oscillator, units: &Units) -> Self {
        let earlier = |contact: EarlierContact| ContactObject {
            after_impact: (!orbit.cycle.points.is_empty()).then_some(contact.flight + 1),
            stop: side(contact.side),
            time: contact.time * units.time(),
        };
        Self {
            admissible: orbit.admissible,
            earlier_contact: orbit.earlier.map(earlier),
            motion: MotionObject::of_oscillator(&Verdict::Periodic(orbit.cycle.clone()), osc, units),
        }
    }

    /// An orbit of a machine, of which only admissible ones are found.
    pub(crate) fn of_machine(machine: &'a Machine, cycle: &'a Cycle) -> Self {
        Self { motion: MotionObject::of_cycle(machine, cycle), admissible: true, earlier_contact: None }
    }
}

/// The table of `vibro orbit`: number, label, whether it is admissible and stable, its stability, fastest closing, multipliers, and
/// of each closing the phase, speed and stop; of a machine without forcing the period.
pub(crate) fn table<'a>(answer: OrbitAnswer<'a>, machine: Option<&Machine>, units: &Units) -> Table<'a> {
    let columns = Columns::new(machine, units, false);
    let speed = units.column("fastest", QuantityKind::Velocity);
    let header = format!("orbit,label,admissible,stable,stability,{speed},{}", columns.names());
    let rows = answer.orbits.into_iter().enumerate().map(move |(k, OrbitObject { motion, admissible, .. })| {
        let cycle = (motion.cycle.as_slice(), motion.period.unwrap_or(f64::NAN));
        let cells = columns.cells(cycle, motion.multipliers.as_deref().unwrap_or_default(), None);
        let (stable, stability) = (admissible && motion.stable == Some(true), motion.stability.unwrap_or_default());
        let (label, fastest) = (motion.label, Number(fastest(&motion.cycle)));
        format!("{},{label},{admissible},{stable},{stability},{fastest}{cells}", k + 1)
    });
    Table::new(header, rows)
}

/// The size of a dot, and how much larger each orbit's are than those of the one after it: orbits may share closings.
const SIZE: f64 = 6.0;
const LARGER: f64 = 2.5;
/// The phases and speeds of the closings of orbits; `ordinate` is the name of the speeds. Inadmissible solutions are left out.
pub(crate) fn figure(answer: &OrbitAnswer<'_>, ordinate: String, title: String) -> Figure {
    let shown: Vec<_> = answer.orbits.iter().enumerate().filter(|(_, orbit)| orbit.admissible).collect();
    let most = shown.iter().map(|(_, orbit)| fastest(&orbit.motion.cycle)).fold(0.0, f64::max);
    let top = if most > 0.0 { 1.05 * most } else { 1.0 };
    let mut panel =
        Panel::new(FigureAxis::new("phase (rad)").range(0.0, TAU), FigureAxis::new(ordinate).range(0.0, top));
    let mut legend = Legend::below();
    for (k, (number, orbit)) in shown.iter().enumerate() {
        #[allow(clippy::cast_precision_loss)] // a few orbits
        let size = SIZE + LARGER * (shown.len() - 1 - k).min(6) as f64;
        let motion = &orbit.motion;
        let name = format!("orbit {}: {}, {}", number + 1, label(&motion.label), motion.stability.unwrap_or_default());
        legend = legend.points(&Points::new([], [], series(k)).size(SIZE), name);
        let closings = closings(&motion.cycle).map(|at| (at.phase.unwrap_or(0.0), at.speed));
        let (phases, speeds): (Vec<f64>, Vec<f64>) = closings.unzip();
        panel.add(Points::new(phases, speeds, series(k)).size(size));
    }
    Figure::new(panel).title(title).legend(legend)
}

/// The text of all orbits of a label, with their numbers if there are several.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, orbits: &[Orbit<CycleOf<D>>]) -> String {
    let count = orbits.len();
    if count == 0 {
        let label = if let Task::Orbit { label } = &of.plan.task { label.trim() } else { "" };
        let label = label.parse().map_or_else(|_| label.to_owned(), |label: Label| label.to_string());
        return format!("no orbit {label} was found\n{}", D::orbit_text(of, None));
    }
    let one = |(k, orbit): (usize, &Orbit<CycleOf<D>>)| {
        let text = D::orbit_text(of, Some(orbit));
        if count > 1 { format!("orbit {} of {count}\n{text}", k + 1) } else { text }
    };
    orbits.iter().enumerate().map(one).collect::<Vec<_>>().join("\n")
}

/// The text of an orbit of an oscillator; without one why there may be none.
pub(crate) fn of_oscillator(of: &AnswerOf<SystemPlan>, orbit: Option<&Orbit>) -> String {
    let units = &of.units;
    let Some(orbit) = orbit else {
        let free = matches!(&of.plan.task, Task::Orbit { label } if label.parse() == Ok(Label::new(0, 1)));
        let why = "without damping, motions without impacts are no single cycle: `vibro settle` finds them\n";
        return if free { why } else { "" }.to_owned();
    };
    if orbit.admissible {
        return SystemPlan::told(of, &Verdict::Periodic(orbit.cycle.clone()));
    }
    let cycle = &orbit.cycle;
    let by_stop = SystemPlan::by_stop(of, &Verdict::Periodic(cycle.clone()));
    let mut text = format!("{}{by_stop}: inadmissible, it passes through a stop on its way\n", cycle.label);
    text.push_str(&impacts(of, cycle));
    text.push_str(&format!("  multipliers {}\n", multipliers(&cycle.multipliers)));
    if let Some(contact) = &orbit.earlier {
        let unit = if units.si { " s" } else { "" };
        let (stop, time) = (stop_name(contact.side), short(contact.time * units.time()));
        let impact = contact.flight + 1;
        text.push_str(&match cycle.points.get(contact.flight) {
            None => format!("  it would swing through the {stop}, which it meets {time}{unit} after phase 0\n"),
            Some(point) if contact.time > 0.0 => format!(
                "  earlier contact: after impact {impact} it meets the {stop} at a time of {time}{unit}, not {}{unit}\n",
                short(point.interval * units.time())
            ),
            Some(_) => format!("  earlier contact: it does not leave the {stop} after impact {impact}\n"),
        });
    }
    text
}
