//! Plans in TOML and JSON, valid and mutated: read, checked and answered in memory.

mod draw;
mod mutate;

pub use draw::{of as system, plan as drawn};

use crate::case::Property;
use crate::command::same;
use crate::limits::processor_time;
use crate::rules;
use core::sync::atomic::{AtomicBool, Ordering};
use mutate::{Change, Edit};
use proptest::prelude::*;
use serde_json::Value;
use std::sync::mpsc;
use std::time::{Duration, Instant};
use vibroimpact_report::{AnswerError, Shown, Units, answer};
use vibroimpact_study::{Control, Plan, SimulatePlan, Task};

/// A plan, its mutations, and its format.
#[derive(Clone, Debug)]
pub struct Written {
    plan: Value,
    changes: Vec<Change>,
    edits: Vec<Edit>,
    toml: bool,
}

impl Written {
    /// The strategy by which plans are drawn.
    pub(crate) fn strategy() -> BoxedStrategy<Self> {
        Self::of(draw::plan())
    }

    /// The strategy by which these trees of values are written and mutated.
    pub(crate) fn of(trees: BoxedStrategy<Value>) -> BoxedStrategy<Self> {
        (trees, mutate::changes(), mutate::edits(), any::<bool>())
            .prop_map(|(plan, changes, edits, toml)| Self { plan, changes, edits, toml })
            .boxed()
    }

    /// Its text.
    pub(crate) fn text(&self) -> String {
        let tree = mutate::changed(self.plan.clone(), &self.changes);
        let toml = if self.toml { toml::to_string(&tree).ok() } else { None };
        // values that TOML cannot express are written as JSON
        mutate::edited(&toml.unwrap_or_else(|| tree.to_string()), &self.edits)
    }

    /// The same as TOML, without deep nests, if it can be written as such.
    pub(crate) fn toml(mut self) -> String {
        self.changes.retain(|change| !matches!(change, Change::Nest(..)));
        Self { toml: true, ..self }.text()
    }

    /// The same plan as JSON.
    pub(crate) fn json(&self) -> String {
        Self { toml: false, ..self.clone() }.text()
    }
}

/// The family of plans.
#[derive(Clone, Copy, Debug)]
pub struct Plans;

/// Limit of processor time for a plan with a small budget.
const SMALL: Duration = Duration::from_secs(30);
/// Processor time after which a plan with a large budget is stopped.
const LARGE: Duration = Duration::from_secs(2);
/// Maximum number of impacts of a small budget.
const FEW: u64 = 200_000;
/// Maximum number of points of a small budget.
const POINTS: u64 = 100_000;

impl Property for Plans {
    type Case = Written;

    fn strategy(&self) -> BoxedStrategy<Written> {
        Written::strategy()
    }

    fn describe(&self, case: &Written) -> String {
        format!("the plan\n{}", case.text().chars().take(4000).collect::<String>())
    }

    fn check(&mut self, case: &Written) -> Result<(), String> {
        let plan = match Plan::from_text(&case.text()) {
            Ok(plan) => plan,
            Err(why) => return rules::sentence(&why.to_string()),
        };
        if let Err(why) = plan.check() {
            return rules::sentence(&why.to_string());
        }
        as_written(&plan)?;
        if plan.work().is_some_and(|(points, _)| points > POINTS) {
            return Ok(());
        }
        let limit = if small(&plan) { SMALL } else { LARGE };
        match stopped_after(limit, |stop| asked(&plan, 1, stop)) {
            Ok(first) => answered(&plan, &first),
            Err(Refused::Sentence(why)) => rules::sentence(&why),
            Err(Refused::Stopped) if limit == LARGE => Ok(()),
            Err(Refused::Stopped) => {
                Err(format!("a plan of a small budget is not answered within {} s", SMALL.as_secs()))
            }
        }
    }
}

/// Checks that the plan is the same when it is written and read again.
fn as_written(plan: &Plan) -> Result<(), String> {
    let json = serde_json::to_string(plan).map_err(|why| format!("it cannot be written: {why}"))?;
    for (kind, text) in [("JSON", json), ("TOML", plan.to_toml())] {
        let again = Plan::from_text(&text).map_err(|why| format!("its own {kind} does not read: {why}: {text}"))?;
        let canonical = plan.canonical().map_err(|why| why.to_string())?;
        if again.canonical().map_err(|why| why.to_string())? != canonical || again.hash() != canonical.hash() {
            return Err(format!("its own {kind} is another plan: {text}"));
        }
    }
    Ok(())
}

/// Whether its budget is so small that its answer is waited for.
pub(crate) fn small(plan: &Plan) -> bool {
    budget(plan) <= FEW
}

/// Approximate number of impacts of its budget.
fn budget(plan: &Plan) -> u64 {
    match &plan.task {
        Task::Simulate(SimulatePlan { impacts, periods, time, .. }) => {
            // a time has more periods than this at high frequencies only, where a period has few impacts
            let periods = periods.or(*time).map_or(0.0, |length| length.min(1e9));
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // saturating
            let more = (100.0 * periods).max(0.0).round() as u64;
            impacts.unwrap_or(100).saturating_add(more)
        }
        Task::Settle { .. } | Task::Region(_) | Task::Curve(_) => 1,
        Task::Orbit { label } => {
            if label.len() > 3 {
                u64::MAX
            } else {
                1
            }
        }
        Task::Attractors { starts, impacts, .. } => starts.saturating_mul(impacts.map_or(5000, u64::from)),
        Task::Basin(basin) => basin.starts().saturating_mul(basin.impacts.map_or(5000, u64::from)),
        Task::Map(map) => map.points().saturating_mul(map.starts).saturating_mul(map.impacts.map_or(5000, u64::from)),
        Task::Diagram(diagram) => {
            let each = diagram.transient.saturating_add(diagram.keep);
            (diagram.over.count() as u64).saturating_mul(diagram.runs()).saturating_mul(each)
        }
        Task::Lyapunov(lyapunov) => {
            let (impacts, transient) = lyapunov.lengths();
            impacts.saturating_add(transient).saturating_add(lyapunov.points.unwrap_or(0))
        }
        // its branches have up to 40 times 6000 points
        Task::Response(response) => response.motions().saturating_mul(5000).saturating_add(100 * 240_000),
        Task::Branch(branch) => {
            u64::from(branch.points).saturating_mul(u64::from(branch.follow) + 1).saturating_mul(100)
        }
        // each of its bisections settles some thirty starts
        Task::Edge(edge) => u64::from(edge.laps()).saturating_mul(30 * 1_000),
        // two branches for each parameter, and steps along each line
        Task::Margins(margins) => 12 * 20_000 + u64::from(margins.lines()).saturating_mul(1_000),
        // the plans that are drawn are of oscillators
        Task::SettleMany(_) => u64::MAX,
    }
}

enum Refused {
    Sentence(String),
    Stopped,
}

/// Everything that is reported of a plan: JSON, table, figure.
struct EventRecord {
    json: String,
    table: Vec<u8>,
    figure: Result<String, String>,
}

fn asked(plan: &Plan, threads: usize, stop: &AtomicBool) -> Result<EventRecord, Refused> {
    let control = Control { stop, threads, ..Control::default() };
    let refused = |why: AnswerError| match why {
        AnswerError::Stopped(_) => Refused::Stopped,
        other => Refused::Sentence(other.to_string()),
    };
    let answer = answer(plan, Units::default(), &control).map_err(refused)?;
    let mut table = Vec::new();
    match answer.table(&Shown::default()) {
        Ok(Some(found)) => found.write(&mut table).map_err(|why| Refused::Sentence(why.to_string()))?,
        Ok(None) => {}
        // a refused table, for example one with too many points, is only an error of the table
        Err(why) => rules::sentence(&why.to_string()).map_err(Refused::Sentence)?,
    }
    let figure = match answer.figure(&Shown::default(), &control) {
        Ok(figure) => Ok(figure.map(|figure| figure.to_svg()).unwrap_or_default()),
        Err(AnswerError::Stopped(_)) => return Err(Refused::Stopped),
        Err(why) => Err(why.to_string()),
    };
    Ok(EventRecord { json: answer.json(), table, figure })
}

/// Checks that the answer contains what programs need, and is the same with other numbers of threads and from the plan
/// that it prints.
fn answered(plan: &Plan, first: &EventRecord) -> Result<(), String> {
    let object = rules::object(first.json.as_bytes())?;
    let task = serde_json::to_value(&plan.task).unwrap_or_default();
    let name = task.as_object().and_then(|task| task.keys().next().cloned()).unwrap_or_default();
    rules::answer(&name, &object)?;
    rules::table(&first.table)?;
    match &first.figure {
        Ok(svg) => rules::figure(svg)?,
        Err(why) => rules::sentence(why)?,
    }
    let printed = Plan::from_text(&object["plan"].to_string())
        .map_err(|why| format!("the plan it prints does not read: {why}"))?;
    match stopped_after(SMALL * 2, |stop| asked(&printed, 3, stop)) {
        Ok(second) => {
            same(first.json.as_bytes(), second.json.as_bytes())
                .map_err(|why| format!("its plan gives another answer: {why}"))?;
            same(&first.table, &second.table).map_err(|why| format!("its plan gives another table: {why}"))?;
            let (a, b) = (first.figure.clone().unwrap_or_else(|why| why), second.figure.unwrap_or_else(|why| why));
            same(a.as_bytes(), b.as_bytes()).map_err(|why| format!("its plan gives another figure: {why}"))
        }
        Err(Refused::Stopped) => Ok(()),
        Err(Refused::Sentence(why)) => Err(format!("the plan it prints is refused: {why}")),
    }
}

/// Runs work with a stop flag that is set after this time, measured as processor time if the system provides it.
fn stopped_after<T>(limit: Duration, work: impl FnOnce(&AtomicBool) -> T) -> T {
    const LOOK: Duration = Duration::from_millis(100);
    let stop = AtomicBool::new(false);
    let (done, over) = mpsc::channel::<()>();
    std::thread::scope(|scope| {
        let stop = &stop;
        scope.spawn(move || {
            let id = std::process::id();
            let (begun, before) = (Instant::now(), processor_time(id));
            // the work is over when its end of the channel is dropped, also by a panic
            while over.recv_timeout(LOOK) == Err(mpsc::RecvTimeoutError::Timeout) {
                let taken = processor_time(id).zip(before).map(|(now, before)| now - before);
                let taken = taken.unwrap_or_else(|| begun.elapsed().as_secs_f64());
                if taken > limit.as_secs_f64() || begun.elapsed() > 10 * limit {
                    stop.store(true, Ordering::Relaxed);
                }
            }
        });
        let _done = done;
        work(stop)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::runner;
    use proptest::strategy::ValueTree;

    /// Many plans are valid, so that results are computed, and many are not, so that errors are. The share is about 30 %, with
    /// a standard error of 2.3 %.
    #[test]
    fn many_plans_are_sound() {
        let count = || {
            let texts = (0..400).map(|k| Plans.strategy().new_tree(&mut runner(1, "plans", k)).unwrap().current());
            texts.filter(|case| Plan::from_text(&case.text()).is_ok_and(|plan| plan.check().is_ok())).count()
        };
        // some plans are nested 5000 levels deep; a worker has the stack of a main thread
        let roomy = std::thread::Builder::new().stack_size(8 << 20);
        let sound = roomy.spawn(count).unwrap().join().unwrap();
        assert!((90..330).contains(&sound), "{sound} of 400");
    }
}
