//! An orbit diagram in memory: its tiles are joined.

use crate::diagram::{Diagram, SweepDirection};
use crate::study::{Fill, SweepFill, Swept, tiles_of};
use crate::{Control, RunError};
use vibroimpact::math::sort_by_key;

/// Number of scattered starts, and of values, in a tile.
pub(crate) const DIAGRAM_TILE: u32 = 4;

/// Follows the motions at all values: sweeps one after another, scattered starts value by value.
pub(crate) fn diagram<D: Swept>(
    task: &SweepFill<D>,
    control: &Control<'_>,
) -> Result<Diagram<D::Name, D::Shown>, RunError> {
    let (parts, plan) = (tiles_of(&task.over().grid, control, |block, tick| task.compute(block, tick))?, &task.plan);
    let mut steps = parts.into_iter().flat_map(|(_, steps)| steps).collect::<Result<Vec<_>, _>>()?;
    if let SweepDirection::Scatter { .. } = plan.direction {
        // a tile holds several starts at several values; sort by value, and at each value by start
        sort_by_key(&mut steps, |step| (step.index, step.sweep));
    }
    Ok(Diagram { plan: plan.clone(), steps })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagram::{DiagramPlan, DiagramPoint, DiagramStep, MotionKind, Sweep};
    use crate::{Parameter, Span, Stretch, SystemPlan, Values};

    const S: SystemPlan = SystemPlan::from_inverse_beta(1.3, 0.0, 0.5);

    fn span(over: &str) -> Values {
        over.parse::<Span>().unwrap().into()
    }

    fn plan(over: &str) -> DiagramPlan {
        DiagramPlan { transient: 200, keep: 40, ..DiagramPlan::new(Parameter::Gap, span(over)) }
    }

    fn run(system: &SystemPlan, plan: &DiagramPlan) -> Diagram {
        diagram(&SweepFill::new(system, plan, Some(DIAGRAM_TILE)), &Control::default()).unwrap()
    }

    /// A list has the points of the range with the same values, and its sweeps skip nothing but values that are left out.
    #[test]
    fn listed_values_give_the_points_of_a_range() {
        let scatter = SweepDirection::Scatter { starts: 3, seed: 2 };
        for direction in [SweepDirection::Both, SweepDirection::Down, scatter] {
            for over in ["0.1:1.5:8", "1.5:0.1:8"] {
                let even = DiagramPlan { direction, ..plan(over) };
                let listed = DiagramPlan { over: Values::Listed(even.over.all()), ..even.clone() };
                assert_ne!(listed.over, even.over);
                assert_eq!(run(&S, &listed).steps, run(&S, &even).steps);
            }
        }
        // where no state is carried, the points at some of the values are those at all of them
        let even = DiagramPlan { direction: scatter, ..plan("0.1:1.5:8") };
        let all = run(&S, &even);
        for few in [[0, 1, 4, 7], [7, 4, 1, 0]] {
            let over = Values::Listed(few.iter().map(|k| even.over.at(*k)).collect());
            let found = run(&S, &DiagramPlan { over, ..even.clone() });
            assert_eq!(found.steps.len(), 12);
            for step in &found.steps {
                let same = |of: &&DiagramStep| of.index as usize == few[step.index as usize] && of.sweep == step.sweep;
                let other = all.steps.iter().find(same).unwrap();
                assert_eq!((step.kind, &step.points), (other.kind, &other.points));
            }
        }
        // sweeps rise and fall however the values are written
        let listed = [vec![0.0, 0.5, 0.6, 2.0], vec![2.0, 0.6, 0.5, 0.0]].map(Values::Listed);
        for [rising, falling] in [listed, ["0:3:4", "3:0:4"].map(span)] {
            let [one, other] = [&rising, &falling].map(|over| {
                let plan = DiagramPlan { over: over.clone(), ..plan("0:1:2") };
                let steps = run(&S, &plan).steps.into_iter();
                steps.map(|step| (plan.over.at(step.index as usize), step.sweep, step.points)).collect::<Vec<_>>()
            });
            let order: Vec<f64> = one.iter().map(|(value, ..)| *value).collect();
            assert_eq!(order, [rising.all(), falling.all()].concat());
            assert_eq!(one, other);
        }
    }

    /// At S of the 1971 paper, 1/1 and 2/1 coexist. A sweep that begins where only one of them exists stays on that
    /// one.
    #[test]
    fn a_carried_sweep_shows_hysteresis() {
        let plan = plan("0:2:81");
        let found = run(&S, &plan);
        let here = |sweep| {
            let step = found.steps.iter().find(|s| s.sweep == sweep && plan.over.at(s.index as usize) == 0.75).unwrap();
            let mut speeds: Vec<f64> = step
                .points
                .iter()
                .filter_map(|p| if let DiagramPoint::Impact { speed, .. } = p { Some(*speed) } else { None })
                .collect();
            speeds.sort_by(f64::total_cmp);
            speeds
        };
        let close = |got: Vec<f64>, want: &[f64]| {
            assert!(got.len() == want.len() && got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-9), "{got:?}");
        };
        close(here(Sweep::Up), &[0.777_626_654_634_881_8, 2.644_018_587_785_435]);
        close(here(Sweep::Down), &[2.797_349_151_953_767_4]);
    }

    #[test]
    fn scattered_starts_find_both() {
        let plan = DiagramPlan { direction: SweepDirection::Scatter { starts: 12, seed: 1 }, ..plan("0.75:0.75:1") };
        let found = run(&S, &plan);
        let mut sizes: Vec<usize> = found.steps.iter().map(|step| step.points.len()).collect();
        sizes.sort_unstable();
        sizes.dedup();
        assert_eq!(sizes, [1, 2]);
        assert_eq!(found.steps[7].sweep, Sweep::Start(7));
    }

    /// Along a line through two parameters each motion is that of the system at its point.
    #[test]
    fn a_line_through_two_parameters() {
        let also = Stretch { parameter: Parameter::InverseBeta, from: 1.1, to: 1.5 };
        let line = DiagramPlan {
            also: Some(also),
            direction: SweepDirection::Scatter { starts: 3, seed: 1 },
            ..plan("0:2:5")
        };
        let found = run(&S, &line);
        assert_eq!(found.steps.len(), 15);
        for k in 0..5_u32 {
            let value = f64::from(k) / 2.0;
            let system = SystemPlan { inverse_beta: line.values(k).last(), ..S };
            let over = span(&format!("{value}:{value}:1"));
            let alone = run(&system, &DiagramPlan { also: None, over, ..line.clone() });
            let here: Vec<_> = found.steps.iter().filter(|step| step.index == k).map(|step| &step.points).collect();
            assert_eq!(here, alone.steps.iter().map(|step| &step.points).collect::<Vec<_>>(), "at {value}");
        }
        // the state is also carried when the frequency changes
        let carried = run(&S, &DiagramPlan { direction: SweepDirection::Both, ..line.clone() });
        assert!(carried.steps.iter().all(|step| step.kind != MotionKind::Undecided));
    }

    /// With damping and below resonance: a sweep from a large gap stays on the motion without impacts down to the gap
    /// where it grazes. The opposite sweep reaches that motion only at a larger gap.
    #[test]
    fn a_motion_without_impacts_is_carried_too() {
        let system = SystemPlan { inverse_beta: Some(0.7), restitution: 0.8, damping: 0.01, ..S };
        let plan = plan("0:3:61");
        let found = run(&system, &plan);
        let free = plan.cut().oscillator(&system, 1.0).unwrap().free_amplitude();
        for step in found.steps.iter().filter(|step| step.sweep == Sweep::Down) {
            let gap = plan.over.at(step.index as usize);
            assert_eq!(step.kind == MotionKind::NoImpact, gap > free, "gap {gap}: {:?}", step.kind);
        }
        let lost = |sweep| found.steps.iter().filter(|s| s.sweep == sweep && s.kind == MotionKind::NoImpact).count();
        assert!(lost(Sweep::Up) < lost(Sweep::Down), "{} {}", lost(Sweep::Up), lost(Sweep::Down));
    }
}
