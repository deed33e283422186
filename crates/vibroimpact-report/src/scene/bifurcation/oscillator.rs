//! The branches of an oscillator along a line.

use super::{BifurcationDiagram, FOLLOW, LOOKS, MOST_LABELS, NEAR, POINTS, SAMPLES, SEED, STARTS, along, most_first};
use crate::{AnswerError, Asked, ReportError};
use vibroimpact::Label;
use vibroimpact::continuation::SolutionPoint;
use vibroimpact::motion::Strobes;
use vibroimpact::verdict::{Count, CountedMotion, SettleOptions, Verdict, attractors};
use vibroimpact_study::{
    BranchPlan, Control, Cut, DiagramPlan, Plan, PlanError, PlanResults, Results, RunError, Span, Stopped, SystemPlan,
    Target, run,
};

/// Velocity and position at phase 0 of the force in each of its periods. A solution that is not admissible has none.
pub(crate) fn strobes(point: &SolutionPoint, cut: &Cut, Asked { system, units }: &Asked) -> Vec<(f64, f64)> {
    let osc = cut.oscillator(system, point.value).ok().filter(|_| point.physical);
    let (Some(osc), Some(first)) = (osc, point.cycle.points.first()) else { return Vec::new() };
    let there = units.at(cut.vary, point.value);
    let states = Strobes::new(&osc, first.state.rebound(&osc), 0.0).take(point.cycle.label.periods as usize);
    states.map(|state| (state.v * there.velocity(), state.x * there.length())).collect()
}

/// The branches of some labels over the orbit diagram of a plan, between the ends of its values. The plan also determines whether impact velocities or
/// positions at phase 0 are shown. Without labels they are those of the motions on the line with most starts. Each orbit found on a grid of
/// values is followed in both directions to the ends of the range, through its events. Of the branches that begin at
/// flips and branch points, those that reach one of the labels are drawn too.
///
/// Orbits to which neither a value of the grid nor such an event leads are missed.
///
/// # Errors
/// [`AnswerError`] for an invalid plan or label, or when stopped.
pub fn bifurcation(
    asked: &Asked,
    plan: &DiagramPlan,
    named: Option<&[String]>,
    control: &Control<'_>,
) -> Result<BifurcationDiagram<SystemPlan>, AnswerError> {
    let found;
    let labels = match named {
        Some(labels) => labels,
        None => {
            found = labels(asked, plan, SAMPLES, control)?;
            &found[..found.len().min(MOST_LABELS)]
        }
    };
    let PlanResults::Oscillator(Results::Diagram(behind)) = run(&Plan::new(asked.system, plan.clone()), control)?
    else {
        // the task of this plan has no other result
        return Err(ReportError::NoLabels.into());
    };
    let mut branches = Vec::new();
    for label in labels {
        follow(asked, plan, label, &mut branches, control)?;
    }
    branches.retain(|points| points.iter().any(|point| labels.contains(&point.cycle.label.to_string())));
    let (name, system) = ("oscillator".to_owned(), asked.system.oscillator()?);
    Ok(BifurcationDiagram { behind, branches, name, written: asked.system, system, units: asked.units })
}

/// Adds the branches of a label, unless an existing branch passes through its orbit.
fn follow(
    asked: &Asked,
    plan: &DiagramPlan,
    label: &str,
    branches: &mut Vec<Vec<SolutionPoint>>,
    control: &Control<'_>,
) -> Result<(), AnswerError> {
    let name: Label = label.parse().map_err(PlanError::from)?;
    let (from, to) = plan.over.ends();
    let looks = if from == to { return Ok(()) } else { Span::new(from, to, LOOKS)? };
    for (k, value) in (0_u64..).zip(looks.values()) {
        if control.stopping() {
            return Err(Stopped { done: k, total: u64::from(LOOKS) }.into());
        }
        if branches.iter().any(|points| passes(points, name, value, NEAR * (to - from).abs())) {
            continue;
        }
        let cut = plan.cut();
        let system = cut.system(&asked.system, value)?;
        for end in [from, to].into_iter().filter(|end| *end != value) {
            let also = cut.also.zip(cut.values(end).nth(1)).map(|(also, to)| Target { parameter: also.parameter, to });
            let label = Some(label.to_owned());
            let (vary, to, follow, points) = (cut.vary, end, FOLLOW, POINTS);
            let task = BranchPlan { label, vary, to, back: None, also, orbit: None, follow, points };
            match run(&Plan::new(system, task), control) {
                Ok(PlanResults::Oscillator(Results::Branch(found))) => {
                    branches.extend(found.followed.into_iter().map(|branch| branch.points));
                }
                Ok(_) => {}
                Err(RunError::Stopped(stopped)) => return Err(stopped.into()),
                // an absent orbit is no error: the label exists only on a part of the line
                Err(RunError::Plan(_)) => {}
            }
        }
    }
    Ok(())
}

/// Whether a branch has a cycle with this label at a value.
fn passes(points: &[SolutionPoint], label: Label, value: f64, near: f64) -> bool {
    let points = points.windows(2);
    points.filter(|pair| pair[0].cycle.label == label && pair[1].cycle.label == label).any(|pair| {
        let (a, b) = (pair[0].value, pair[1].value);
        a.min(b) - near <= value && value <= a.max(b) + near
    })
}

/// The labels of the cycles along the line of a diagram, those of most starts first. At `count` values a few starts are
/// settled.
///
/// # Errors
/// [`AnswerError`] for an invalid plan, or when stopped.
pub fn labels(
    asked: &Asked,
    plan: &DiagramPlan,
    count: u32,
    control: &Control<'_>,
) -> Result<Vec<String>, AnswerError> {
    plan.check(&asked.system)?;
    let options = SettleOptions::default();
    let found = along(plan.over.ends(), count, control, |value| {
        let osc = plan.cut().oscillator(&asked.system, value)?;
        Ok(attractors(&osc, STARTS, SEED, &options))
    })?;
    let found: Result<Vec<_>, PlanError> = found.into_iter().map(|(_, census)| census).collect();
    let motions = found?.into_iter().flat_map(|census| census.motions().to_vec());
    // motions without impacts, or with infinitely many, have no branch of impacts
    let label = |motion: CountedMotion| match &motion.verdict {
        Verdict::Periodic(cycle) if matches!(cycle.label.impacts, Count::Finite(1..)) => {
            Some((cycle.label.to_string(), motion.count))
        }
        _ => None,
    };
    Ok(most_first(motions.filter_map(label)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact_plot::{Dash, Figure, Mark};
    use vibroimpact_study::diagram::{DiagramPoint, Show};
    use vibroimpact_study::{Parameter, Span, Stretch};

    #[test]
    fn f10b_the_branches_of_the_labels_on_a_line() {
        let system = SystemPlan::from_inverse_beta(1.11, 1.5, 0.5);
        let (asked, control) = (Asked { system, units: Units::default() }, Control::default());
        let over = "1.5:2.2:15".parse::<Span>().unwrap();
        let plan = DiagramPlan { transient: 100, keep: 8, ..DiagramPlan::new(Parameter::Gap, over) };
        let found = labels(&asked, &plan, 8, &control).unwrap();
        assert!(found.iter().any(|label| label == "1/1"), "{found:?}");
        let diagram = bifurcation(&asked, &plan, Some(&["1/1".into(), "2/2".into()]), &control).unwrap();
        let svg = diagram.figure().unwrap().to_svg();
        // the closed form of the flip: docs/orbits.md
        let flips: Vec<f64> = (diagram.events().iter().filter(|event| event.kind == "flip" && event.label == "1/1"))
            .map(|event| event.value)
            .collect();
        assert!(flips.len() == 1 && (flips[0] - 1.829).abs() < 1e-3, "{flips:?}");
        assert!(diagram.events().is_sorted_by(|a, b| a.value <= b.value));
        // the table has the simulated points and the branches, with the flip in a row of its own
        let mut table = Vec::new();
        diagram.table().unwrap().write(&mut table).unwrap();
        let table = String::from_utf8(table).unwrap();
        assert!(table.starts_with("gap,sweep,kind,stop,phase,speed,label,event\n"), "{}", &table[..80]);
        let simulated = table.lines().filter(|row| row.ends_with(",,")).count();
        let stable = table.lines().filter(|row| row.contains(",stable,upper,") && row.ends_with(",1/1,")).count();
        let flip = table.lines().find(|row| row.ends_with(",1/1,flip")).unwrap();
        assert!(simulated >= 15 && stable > 3, "{simulated} {stable}");
        assert!((flip.split(',').next().unwrap().parse::<f64>().unwrap() - flips[0]).abs() < 1e-12, "{flip}");
        // 1/1 is stable up to its flip at 1.829, where 2/2 begins, which ends as 1/2
        for word in ["1/1", "2/2", "1/2", ">stable<", ">unstable<", ">flip<", ">simulation<"] {
            assert!(svg.contains(word), "{word}");
        }
        // along a line through two parameters, 1/1 flips where the line crosses its curve of flips
        let also = Stretch { parameter: Parameter::InverseBeta, from: 1.05, to: 1.12 };
        let line = DiagramPlan { also: Some(also), ..plan.clone() };
        let found = labels(&asked, &line, 8, &control).unwrap();
        assert!(found.iter().any(|label| label == "1/1"), "{found:?}");
        let svg = bifurcation(&asked, &line, Some(&found), &control).unwrap().figure().unwrap().to_svg();
        for word in [">flip<", "with", "1.05 to 1.12"] {
            assert!(svg.contains(word), "{word}");
        }
        // positions once in a period, if requested: 1/1 has one, which lies between the stop and the lowest position
        let strobes = DiagramPlan { show: Show::Strobe, ..plan.clone() };
        let figure = bifurcation(&asked, &strobes, Some(&["1/1".into()]), &control).unwrap().figure().unwrap();
        let svg = figure.to_svg();
        assert!(svg.contains("at phase 0") && !svg.contains("arrival velocity"), "{svg}");
        // the ordinates of the stable part, which simulation finds too
        let ordinates = |figure: &Figure| -> Vec<f64> {
            let lines = figure.panels[0].marks.iter().filter_map(|mark| match mark {
                Mark::Line(line) if line.stroke.dash == Dash::Solid => Some(line),
                _ => None,
            });
            lines.flat_map(|line| line.ys.clone()).filter(|y| !y.is_nan()).collect()
        };
        let behind = Plan::new(asked.system, strobes.clone());
        let PlanResults::Oscillator(Results::Diagram(behind)) = run(&behind, &control).unwrap() else {
            panic!("another result")
        };
        let positions: Vec<f64> = behind
            .steps
            .iter()
            .flat_map(|step| &step.points)
            .filter_map(|point| match point {
                DiagramPoint::State { x, .. } => Some(*x),
                _ => None,
            })
            .collect();
        let drawn = ordinates(&figure);
        let near = |x: &f64| positions.iter().any(|y| (x - y).abs() < 0.2);
        assert!(drawn.len() > 3 && drawn.iter().all(near), "{drawn:?}");
        let bad = bifurcation(&asked, &plan, Some(&["1/0".into()]), &control);
        assert!(matches!(bad, Err(AnswerError::Plan(_))), "{bad:?}");
    }
}
