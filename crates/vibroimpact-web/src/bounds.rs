//! What may be asked at once. A page that is looked at needs no more, and what needs more is a study for `vibro run`.

use crate::refusal::Refusal;
use vibroimpact_study::{Plan, Task};

/// Points of one grid: a screen full.
pub(crate) const MOST_POINTS: u64 = 800_000;
/// Starts settled for one answer, at all points together.
pub(crate) const MOST_STARTS: u64 = 2_000_000;
/// Impacts followed for one answer, where the plan says how many.
pub(crate) const MOST_IMPACTS: u64 = 2_000_000;
/// Forcing periods of one waveform.
const MOST_PERIODS: f64 = 10_000.0;

/// The points of a plan, for progress; [`Refusal`] for more than is computed here at once.
pub(crate) fn points(plan: &Plan) -> Result<u64, Refusal> {
    let within = |what: &str, given: u64, most: u64| {
        if given <= most {
            return Ok(given);
        }
        Err(Refusal::too_much(format!(
            "{what} = {given} is more than the explorer computes at once, {most}\nhint: `vibro run` computes studies of any size, and resumes them"
        )))
    };
    match &plan.task {
        Task::Map(map) => {
            let points = within("points", map.points(), MOST_POINTS)?;
            within("starts", points.saturating_mul(map.starts), MOST_STARTS)?;
            Ok(points)
        }
        Task::Basin(basin) => within("starts", basin.starts(), MOST_POINTS),
        Task::Attractors { starts, .. } => within("starts", *starts, 100_000),
        Task::Diagram(diagram) => {
            let motions = u64::from(diagram.over.count()).saturating_mul(diagram.runs());
            within("motions", motions, 20_000)?;
            within("impacts", motions.saturating_mul(diagram.transient + diagram.keep), 20 * MOST_IMPACTS)?;
            Ok(motions)
        }
        Task::Lyapunov(lyapunov) => {
            let points: u64 = lyapunov.axes.iter().map(|axis| axis.over.count() as u64).product();
            let impacts =
                lyapunov.impacts.saturating_add(lyapunov.transient).saturating_add(lyapunov.points.unwrap_or(0));
            within("impacts", points.saturating_mul(impacts), MOST_IMPACTS)?;
            Ok(points)
        }
        Task::Simulate { impacts, periods, .. } => {
            within("impacts", impacts.unwrap_or(0), 100_000)?;
            match periods.filter(|periods| *periods > MOST_PERIODS) {
                Some(given) => Err(Refusal::too_much(format!(
                    "periods = {given} is more than the explorer follows at once, {MOST_PERIODS}"
                ))),
                None => Ok(1),
            }
        }
        Task::Branch(branch) => within("points", u64::from(branch.points), 20_000).map(|_| 1),
        Task::Region(region) => within("grid", u64::from(region.grid), 100).map(|_| 2),
        Task::Settle { .. } | Task::Orbit { .. } | Task::Curve(_) => Ok(1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(task: &str) -> Option<u16> {
        let text = format!(
            r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{{task}}}}}"#
        );
        points(&Plan::from_text(&text).unwrap()).err().map(|refusal| refusal.status.as_u16())
    }

    #[test]
    fn a_screen_full_and_no_more() {
        let map = |x: u32, y: u32, starts: u32| {
            format!(
                r#""map":{{"axes":[{{"vary":"inverse_beta","over":"0.5:2:{x}"}},{{"vary":"gap","over":"0:2:{y}"}}],"starts":{starts}}}"#
            )
        };
        assert_eq!(status(&map(1000, 700, 1)), None);
        assert_eq!(status(&map(1000, 1000, 1)), Some(422), "a million points");
        assert_eq!(status(&map(1000, 700, 4)), Some(422));
        assert_eq!(status(&map(1_000_000, 1_000_000, 1_000_000_000)), Some(422), "a product beyond 64 bits");
        assert_eq!(status(r#""attractors":{"starts":1000000000,"seed":1}"#), Some(422));
        assert_eq!(status(r#""simulate":{"start":{},"impacts":null,"periods":1e8}"#), Some(422));
        assert_eq!(status(r#""settle":{"start":{}}"#), None);
    }
}
