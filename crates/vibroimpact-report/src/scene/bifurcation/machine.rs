//! The branches of a machine along a line.

use super::{BifurcationDiagram, FOLLOW, LOOKS, MOST_LABELS, POINTS, SAMPLES, SEED, STARTS, along, most_first};
use crate::{AnswerError, ReportError, Units};
use vibroimpact::Label;
use vibroimpact::continuation::{Direction, machine::SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{find_machine_while, machine::Cycle};
use vibroimpact::verdict::{
    Census, CountedMotion, SettleOptions, Verdict, scattered_machine_starts, settle_machine_while,
};
use vibroimpact_study::diagram::Shown as _;
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{
    BranchPlace, Control, Cut, DiagramPlan, OrbitLine, Plan, PlanResults, Results, RunError, System, Task,
    machine_label, run,
};

/// Starts from which orbits of a given label are searched at each value.
const ORBIT_STARTS: u64 = 16;
/// A cycle lies on a branch if its speed and its period are between those of the points before and after it, up to this part
/// of their size.
const CLOSE: f64 = 1e-3;

/// The branches of some labels over the orbit diagram of a plan, between the ends of its values. The plan also determines
/// whether the speeds of closings or a quantity are shown. Without labels they are those of the motions on the line with most
/// starts. Each cycle found at a grid of values is followed in both directions to the ends of the range, through its events. Of
/// the branches that begin at flips and branch points, those that reach one of the labels are there too.
///
/// Orbits to which neither a value of the grid nor such an event leads are missed.
///
/// # Errors
/// [`AnswerError`] for an invalid plan or label, for a coordinate at phase 0, which branches do not have, or when stopped.
pub fn machine_bifurcation(
    name: &str,
    plan: &Plan,
    named: Option<&[String]>,
    control: &Control<'_>,
) -> Result<BifurcationDiagram<MachineSource>, AnswerError> {
    plan.check()?;
    let (System::Machine(source), Task::Diagram(diagram)) = (&plan.system, &plan.task) else {
        // the command asks for no other task
        return Err(ReportError::NoLabels.into());
    };
    let diagram: DiagramPlan<String, String> = diagram.typed()?;
    let (machine, _) = source.described()?;
    if diagram.show.is_states() || (diagram.show.is_closings() && machine.stops().is_empty()) {
        let coordinate = machine.parts().coordinates.first().cloned().unwrap_or_default();
        return Err(ReportError::NoBranchValue { show: diagram.show.clone(), coordinate }.into());
    }
    let parsed = |labels: &[String]| labels.iter().map(|text| machine_label(&machine, text)).collect();
    let given: Option<Vec<Label>> = named.map(parsed).transpose()?;
    let cut = diagram.cut();
    let mut seeds = match &given {
        Some(labels) => orbits(source, &cut, labels, control)?,
        None => motions(source, &cut, &diagram, control)?,
    };
    let labels: Vec<String> = match named {
        Some(labels) => labels.to_vec(),
        None => common(&seeds),
    };
    let known = |label: Label| labels.contains(&label.to_string());
    seeds.iter_mut().for_each(|(_, cycles)| cycles.retain(|(cycle, _)| known(cycle.label)));
    let PlanResults::Machine(Results::Diagram(behind)) = run(plan, control)? else {
        // the task of this plan has no other result
        return Err(ReportError::NoLabels.into());
    };
    let line = OrbitLine::new(source, &cut, POINTS);
    let mut branches: Vec<Vec<SolutionPoint>> = Vec::new();
    let mut seen: Vec<BranchPlace> = Vec::new();
    for (value, cycle) in seeds.iter().flat_map(|(value, cycles)| cycles.iter().map(move |(cycle, _)| (*value, cycle)))
    {
        if branches.iter().any(|branch| passes(branch, cycle, value)) {
            continue;
        }
        for direction in [Direction::Up, Direction::Down] {
            let points = match line.trace((value, cycle), direction, control) {
                Ok(points) => points,
                Err(RunError::Stopped(stopped)) => return Err(stopped.into()),
                // at the end of the range, or where the cycle ceases to exist, there is no branch in this direction
                Err(RunError::Plan(_)) => continue,
            };
            let (further, _) = line.beginning_on(&points, FOLLOW as usize, &mut seen, control)?;
            branches.push(points);
            branches.extend(further.into_iter().map(|followed| followed.points));
        }
    }
    branches.retain(|points| points.iter().any(|point| known(point.cycle.label)));
    let (name, written, units) = (name.to_owned(), (**source).clone(), Units::default());
    Ok(BifurcationDiagram { behind, branches, name, written, system: machine, units })
}

/// Cycles at a value of the number, and for how many starts each stands.
type Seeds = Vec<(f64, Vec<(Cycle, u64)>)>;

/// Cycles at `count` values along a line. A value at which there is no machine has none.
fn cycles(
    source: &MachineSource,
    (cut, count): (&Cut<String>, u32),
    control: &Control<'_>,
    find: impl Fn(&Machine) -> Vec<(Cycle, u64)> + Sync,
) -> Result<Seeds, AnswerError> {
    along(cut.ends, count, control, |value| {
        let machine = cut.source(source, value).and_then(|source| Ok(source.machine()?));
        machine.map_or_else(|_| Vec::new(), |machine| find(&machine))
    })
}

/// The orbits with these labels along a line.
fn orbits(
    source: &MachineSource,
    cut: &Cut<String>,
    labels: &[Label],
    control: &Control<'_>,
) -> Result<Seeds, AnswerError> {
    cycles(source, (cut, LOOKS), control, |machine| {
        let starts = || (0..ORBIT_STARTS).map(|k| scattered_machine_starts(machine, SEED, k));
        let of = |label: &Label| find_machine_while(machine, *label, starts(), &|| !control.stopping());
        labels.iter().flat_map(|label| of(label).unwrap_or_default()).map(|cycle| (cycle, 1)).collect()
    })
}

/// The cycles into which a few starts settle along a line. Those without closings have no speeds to be shown.
fn motions(
    source: &MachineSource,
    cut: &Cut<String>,
    diagram: &DiagramPlan<String, String>,
    control: &Control<'_>,
) -> Result<Seeds, AnswerError> {
    let options = SettleOptions::default();
    cycles(source, (cut, SAMPLES), control, |machine| {
        let mut census = Census::default();
        for k in 0..STARTS {
            let start = scattered_machine_starts(machine, SEED, k);
            let settled = settle_machine_while(machine, &start, &options, &|| !control.stopping());
            if let Some(settled) = settled.ok().flatten() {
                census.add(&settled.verdict);
            }
        }
        let cycle = |motion: &CountedMotion<Machine>| match &motion.verdict {
            Verdict::Periodic(cycle) => Some((cycle.clone(), motion.count)),
            _ => None,
        };
        let shown = |(cycle, _): &(Cycle, u64)| !diagram.show.is_closings() || cycle.fastest() > 0.0;
        census.motions().iter().filter_map(cycle).filter(shown).collect()
    })
}

/// The labels of the cycles of most starts.
fn common(seeds: &Seeds) -> Vec<String> {
    let cycles = seeds.iter().flat_map(|(_, cycles)| cycles);
    let mut labels = most_first(cycles.map(|(cycle, count)| (cycle.label.to_string(), *count)));
    labels.truncate(MOST_LABELS);
    labels
}

/// Whether a branch passes through a cycle at a value of the number.
fn passes(branch: &[SolutionPoint], cycle: &Cycle, value: f64) -> bool {
    let between = |a: f64, b: f64, x: f64| {
        let room = (a - b).abs() + CLOSE * x.abs();
        x >= a.min(b) - room && x <= a.max(b) + room
    };
    branch.windows(2).any(|pair| {
        let (a, b) = (&pair[0], &pair[1]);
        a.cycle.label == cycle.label
            && b.cycle.label == cycle.label
            && a.value.min(b.value) <= value
            && value <= a.value.max(b.value)
            && between(a.cycle.fastest(), b.cycle.fastest(), cycle.fastest())
            && between(a.cycle.period, b.cycle.period, cycle.period)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::json::branch::PointObject;
    use vibroimpact_study::diagram::DiagramPoint;

    fn plan(name: &str, task: &str) -> Plan {
        let machine = MachineSource::open(name).unwrap().into();
        Plan {
            task: Task::from_json(task, &machine).unwrap(),
            ..Plan::new(machine, Task::Orbit { label: "1/1".into() })
        }
    }

    /// The values of events of a kind and a label.
    fn events(found: &BifurcationDiagram<MachineSource>, kind: &str, label: &str) -> Vec<f64> {
        let all = found.events();
        all.iter().filter(|event| event.kind == kind && event.label == label).map(|event| event.value).collect()
    }

    #[test]
    fn the_branches_of_the_motions_on_a_line() {
        let control = Control::default();
        let over = r#"{"diagram":{"vary":"frequency","over":"0.95:1.2:26"}}"#;
        let found = machine_bifurcation("hammer", &plan("two-mass-hammer", over), None, &control).unwrap();
        // docs/machines.md: 1/1 ends at a grazing, and comes back from a fold as 2/1
        for (kind, label, value) in [("fold", "2/1", 1.070_61), ("grazing", "2/1", 1.055)] {
            let at = events(&found, kind, label);
            assert!(at.len() == 1 && (at[0] - value).abs() < 1e-3, "{kind} {at:?}");
        }
        assert!(found.events().is_sorted_by(|a, b| a.value <= b.value));
        let svg = found.figure().unwrap().to_svg();
        for word in [">1/1<", ">2/1<", ">stable<", ">unstable<", ">fold<", ">grazing<", ">simulation<"] {
            assert!(svg.contains(word), "{word}");
        }
        let mut table = Vec::new();
        found.table().unwrap().write(&mut table).unwrap();
        let table = String::from_utf8(table).unwrap();
        assert!(table.starts_with("frequency,sweep,kind,stop,phase,speed,label,event\n"), "{}", &table[..80]);
        let fold = table.lines().find(|row| row.ends_with(",2/1,fold")).unwrap();
        let value: f64 = fold.split(',').next().unwrap().parse().unwrap();
        assert!((value - events(&found, "fold", "2/1")[0]).abs() < 1e-12);
        let widths: Vec<usize> = table.lines().map(|row| row.split(',').count()).collect();
        assert!(widths.iter().all(|width| *width == 8), "{widths:?}");
        // from 1/1 alone the branch is followed through the grazing as well
        let named = |label: &str| {
            machine_bifurcation("hammer", &plan("two-mass-hammer", over), Some(&[label.to_owned()]), &control)
        };
        let one = named("1/1").unwrap();
        assert_eq!((events(&one, "grazing", "1/1").len(), events(&one, "fold", "2/1").len()), (1, 1));
        assert!(named("7/1").unwrap().branches.is_empty());
        let bad = named("1/0");
        assert!(matches!(bad, Err(AnswerError::Plan(_))), "{bad:?}");
    }

    /// A quantity stands for each cycle, also without stops: where the mass ceases to be held its branch has an event.
    #[test]
    fn the_branches_of_a_quantity() {
        let control = Control::default();
        let task = r#"{"diagram":{"vary":"frequency","over":"0.45:0.6:16","show":"q.mass.displacement_max"}}"#;
        let found = machine_bifurcation("den-hartog", &plan("den-hartog", task), None, &control).unwrap();
        assert!(!events(&found, "holding ends", "0").is_empty(), "{:?}", found.events());
        // the drawn values are those of simulation
        let branches = found.objects();
        let mut compared = 0;
        for (step, value) in found.behind.steps.iter().filter_map(|step| match step.points.first()? {
            DiagramPoint::Value(value) => Some((step, *value)),
            _ => None,
        }) {
            let at = found.behind.plan.over.at(step.index as usize);
            let around = |pair: &&[PointObject<'_>]| {
                let (a, b) = (pair[0].parameter, pair[1].parameter);
                a.min(b) <= at && at <= a.max(b)
            };
            let Some(pair) = branches.iter().flat_map(|branch| branch.points.windows(2)).find(around) else { continue };
            let (a, b) = (pair[0].quantity(), pair[1].quantity());
            assert!(value >= a.min(b) - 1e-3 && value <= a.max(b) + 1e-3, "{at}: {value} {a} {b}");
            compared += 1;
        }
        assert!(compared > 20, "{compared}");
        for show in ["speed", "q.mass"] {
            let task = task.replace("q.mass.displacement_max", show);
            let refused = machine_bifurcation("den-hartog", &plan("den-hartog", &task), None, &control);
            let said = refused.unwrap_err().to_string();
            assert!(said.contains(&format!("not `{show}`")) && said.contains("q.mass.displacement_max"), "{said}");
        }
    }
}
