//! Limits for a single request. The page never needs more; larger questions are studies for `vibro run`.

use crate::refusal::Refusal;
use vibroimpact_study::{Plan, Task};

/// Maximum number of points of one grid, about one for each pixel of a screen.
pub(crate) const MOST_POINTS: u64 = 800_000;
/// Maximum number of starts settled for one answer, at all points together.
pub(crate) const MOST_STARTS: u64 = 2_000_000;
/// Maximum number of impacts followed for one answer, if the plan sets the number.
pub(crate) const MOST_IMPACTS: u64 = 2_000_000;
/// Maximum number of forcing periods of one waveform, and its longest time.
const MOST_PERIODS: f64 = 10_000.0;
const LONGEST: f64 = 100_000.0;

/// Refuses a plan that exceeds the limits.
pub(crate) fn check(plan: &Plan) -> Result<(), Refusal> {
    let within = |what: &str, given: u64, most: u64| {
        if given <= most {
            return Ok(());
        }
        Err(Refusal::too_much(format!(
            "{what} = {given} is more than the explorer computes at once, {most}\nhint: `vibro run` computes studies of any size, and resumes them"
        )))
    };
    if plan.machine().is_some() {
        return Err(Refusal::machine());
    }
    match &plan.task {
        Task::Map(map) => {
            within("points", map.points(), MOST_POINTS)?;
            within("starts", map.points().saturating_mul(map.starts), MOST_STARTS)
        }
        Task::Basin(basin) => within("starts", basin.starts(), MOST_POINTS),
        Task::Attractors { starts, .. } => within("starts", *starts, 100_000),
        Task::Diagram(diagram) => {
            let motions = (diagram.over.count() as u64).saturating_mul(diagram.runs());
            within("motions", motions, 20_000)?;
            within("impacts", motions.saturating_mul(diagram.transient + diagram.keep), 20 * MOST_IMPACTS)
        }
        Task::Response(response) => within("motions", response.motions(), 2_000),
        Task::Lyapunov(lyapunov) => {
            // exponents over axes are a study, which is refused
            let (impacts, transient) = lyapunov.lengths();
            let impacts = impacts.saturating_add(transient);
            within("impacts", impacts.saturating_add(lyapunov.points.unwrap_or(0)), MOST_IMPACTS)
        }
        Task::Simulate(plan) => {
            within("impacts", plan.impacts.unwrap_or(0), 100_000)?;
            for (what, given, most) in [("periods", plan.periods, MOST_PERIODS), ("time", plan.time, LONGEST)] {
                if let Some(given) = given.filter(|given| *given > most) {
                    let text = format!("{what} = {given} is more than the explorer follows at once, {most}");
                    return Err(Refusal::too_much(text));
                }
            }
            Ok(())
        }
        Task::Branch(branch) => within("points", u64::from(branch.points), 20_000),
        Task::Region(region) => within("grid", u64::from(region.grid), 100),
        Task::Edge(edge) => within("laps", u64::from(edge.laps()), 1_000),
        Task::Margins(margins) => within("lines", u64::from(margins.lines()), 10_000),
        Task::Settle { .. } | Task::Orbit { .. } | Task::Curve(_) => Ok(()),
        Task::SettleMany(_) => Err(Refusal::machine()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(task: &str) -> Option<u16> {
        let text = format!(
            r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{{task}}}}}"#
        );
        check(&Plan::from_text(&text).unwrap()).err().map(|refusal| refusal.status.as_u16())
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
        let axis = |vary: &str| format!(r#"{{"vary":"{vary}","over":"0.1:0.9:65536"}}"#);
        let four = ["inverse_beta", "gap", "restitution", "damping"].map(axis).join(",");
        assert_eq!(status(&format!(r#""map":{{"axes":[{four}],"starts":1}}"#)), Some(422), "points beyond 64 bits");
        assert_eq!(status(r#""attractors":{"starts":1000000000,"seed":1}"#), Some(422));
        assert_eq!(status(r#""simulate":{"start":{},"impacts":null,"periods":1e8}"#), Some(422));
        assert_eq!(status(r#""settle":{"start":{}}"#), None);
    }
}
