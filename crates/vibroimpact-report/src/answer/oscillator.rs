//! What is told of the answers of an oscillator.

use super::AnswerOf;
use super::told::Told;
use crate::json::branch::{self, Along, EventOf};
use crate::json::event::StateObject;
use crate::json::motion::MotionObject;
use crate::json::system::SystemObject;
use crate::scene::{self, SECTION_POINTS, View, phase_portrait};
use crate::task::attractors::Area;
use crate::task::basin::MeasureFields;
use crate::task::curve;
use crate::task::lyapunov::LyapunovAnswer;
use crate::task::orbit::OrbitObject;
use crate::task::response::ResponseView;
use crate::task::settle::SettleAnswer;
use crate::task::simulate::Events;
use crate::{AnswerError, Asked, ReportError, ShownValue as _, Table, Units, figure, table, task};
use vibroimpact::Start;
use vibroimpact::chaos::{self, Exponents};
use vibroimpact::continuation::{CurvePoint, SolutionPoint};
use vibroimpact::math::Multiplier;
use vibroimpact::verdict::{Settled, Verdict};
use vibroimpact_plot::Figure;
use vibroimpact_study::diagram::Show;
use vibroimpact_study::{
    Basin, CurvePlan, Cut, Name as _, Orbit, Parameter, PlanError, ResponseCurves, SectionPoints, Simulated,
    SystemPlan, Task,
};

/// Number of impacts and forcing periods after a motion has settled and before the points of its sections, so that the rest of the
/// transient is not visible.
const TRANSIENT: u64 = 200;

impl AnswerOf<SystemPlan> {
    /// The system, and the units of all reported values.
    pub(crate) const fn asked(&self) -> Asked {
        Asked { system: self.written, units: self.units }
    }

    /// Both sections of a settled motion: a few dots for a cycle, a cloud for chaos.
    fn sections(&self, settled: &Settled) -> SectionPoints {
        let (from, _) = figure::waveform::last_event(&self.system, self.start, settled.time);
        SectionPoints::of_oscillator(&self.system, &chaos::section(&self.system, from, TRANSIENT, SECTION_POINTS))
    }
}

impl Told for SystemPlan {
    fn period(of: &AnswerOf<Self>) -> Option<f64> {
        Some(of.system.period())
    }

    fn system(of: &AnswerOf<Self>) -> SystemObject<'_> {
        let parameter = |vary: &str| Parameter::from_name(vary);
        let varied: Vec<Parameter> = match &of.plan.task {
            Task::Map(map) => map.axes.iter().filter_map(|axis| parameter(axis.vary.text())).collect(),
            Task::Region(region) => {
                [&region.across, &region.up].into_iter().filter_map(|side| parameter(side.parameter.text())).collect()
            }
            Task::Response(response) => parameter(response.vary.text()).into_iter().collect(),
            _ => Vec::new(),
        };
        SystemObject::of_oscillator(&of.asked(), &of.system, &varied)
    }

    /// Coordinates of a basin that are on no axis may lie beyond a stop.
    fn state(of: &AnswerOf<Self>) -> StateObject<'_> {
        let start = match &of.plan.task {
            Task::Basin(basin) => {
                let given = basin.start.unwrap_or_default();
                Start { x: given.x.unwrap_or(of.start.x), v: given.v, phase: given.phase }
            }
            _ => of.start,
        };
        StateObject::of_oscillator(&start, &of.units)
    }

    fn numbers(of: &AnswerOf<Self>, start: &Start) -> (Vec<f64>, Vec<f64>) {
        (vec![start.x * of.units.length()], vec![start.v * of.units.velocity()])
    }

    fn names(of: &AnswerOf<Self>) -> (Vec<String>, Vec<String>) {
        of.units.states()
    }

    fn motion<'a>(of: &'a AnswerOf<Self>, verdict: &'a Verdict) -> MotionObject<'a> {
        MotionObject::of_oscillator(verdict, &of.system, &of.units)
    }

    fn multipliers(of: &AnswerOf<Self>, verdict: &Verdict) -> Vec<Multiplier> {
        verdict.multipliers(&of.system).map_or_else(Vec::new, Vec::from)
    }

    fn orbit<'a>(of: &'a AnswerOf<Self>, orbit: &'a Orbit) -> OrbitObject<'a> {
        OrbitObject::of_oscillator(orbit, &of.system, &of.units)
    }

    fn events<'a>(of: &'a AnswerOf<Self>, found: &'a Simulated) -> Events<'a> {
        Events::Oscillator(&of.system, &found.events, Box::new(of.units))
    }

    fn settled<'a>(of: &'a AnswerOf<Self>, found: &'a Settled, brief: bool) -> SettleAnswer<'a> {
        if brief { SettleAnswer::brief(of, found) } else { SettleAnswer::of_oscillator(of, found) }
    }

    fn exponents_object<'a>(of: &'a AnswerOf<Self>, found: &'a Exponents) -> LyapunovAnswer<'a> {
        LyapunovAnswer::of_oscillator(of, found)
    }

    fn area(of: &AnswerOf<Self>) -> Option<Area> {
        Some(Area::natural(&of.system, &of.units))
    }

    fn measures(found: &Basin) -> Option<MeasureFields> {
        MeasureFields::of(found)
    }

    fn branch_point<'a>(
        (system, _, units): Along<'a, Self>,
        point: &'a SolutionPoint,
        cut: &Cut,
        show: Option<&Show>,
    ) -> (branch::PointObject<'a>, EventOf<'a>) {
        let asked = Asked { system: *system, units: *units };
        (branch::PointObject::of_oscillator(point, cut, &asked, show), EventOf::Oscillator(point))
    }

    fn curve_point<'a>(of: &'a AnswerOf<Self>, point: &'a CurvePoint, plan: &CurvePlan) -> curve::PointObject<'a> {
        curve::PointObject::of_oscillator(point, plan, &of.asked())
    }

    fn response<'a>(of: &'a AnswerOf<Self>, found: &'a ResponseCurves) -> Result<ResponseView<'a>, PlanError> {
        let Task::Response(plan) = &of.plan.task else { return Err(PlanError::NoLabel) };
        ResponseView::of_oscillator(found, plan, &of.units)
    }

    fn title(&self, _: &str, units: &Units, varied: &[&str]) -> String {
        let varied: Vec<Parameter> = varied.iter().filter_map(|name| Parameter::from_name(name)).collect();
        figure::title_without(&Asked { system: *self, units: *units }, &varied)
    }

    fn speeds(of: &AnswerOf<Self>) -> [String; 2] {
        [of.units.named("speed before the impact", "m/s"), Show::Velocity.ordinate(&of.units)]
    }

    fn simulated_figure(of: &AnswerOf<Self>, found: &Simulated, view: View) -> Result<Option<Figure>, ReportError> {
        let (osc, start, span) = (&of.system, of.start, (0.0, found.shown_until));
        Ok(match view {
            View::Phase => Some(phase_portrait(&of.asked(), osc, start, span)),
            View::Waveform => Some(figure::waveform::figure(osc, start, span, &of.units, figure::title(&of.asked()))),
            View::Multipliers | View::Sections => None,
        })
    }

    fn settled_figure(of: &AnswerOf<Self>, found: &Settled, view: View) -> Result<Figure, AnswerError> {
        let (osc, start, asked) = (&of.system, of.start, &of.asked());
        Ok(match view {
            View::Waveform => figure::waveform::settled(osc, start, found, asked),
            View::Phase => {
                let (_, (from, shown)) = figure::waveform::steady(osc, start, found);
                phase_portrait(asked, osc, start, (from, from + shown))
            }
            View::Multipliers => {
                let each = found.verdict.stabilities(osc).unwrap_or_default();
                scene::multipliers(&of.multipliers(&found.verdict)?, &each)
            }
            View::Sections => figure::section::figure(&of.sections(found), osc, asked),
        })
    }

    fn section_figure(of: &AnswerOf<Self>, _: &Exponents, points: &SectionPoints) -> Figure {
        figure::section::figure(points, &of.system, &of.asked())
    }

    fn waveform_table<'a>(of: &'a AnswerOf<Self>, from: &Start, span: (f64, f64)) -> Result<Table<'a>, ReportError> {
        table::waveform::table(&of.system, *from, span, of.units)
    }

    fn settled_table<'a>(of: &'a AnswerOf<Self>, found: &'a Settled, view: View) -> Result<Table<'a>, ReportError> {
        if view == View::Sections {
            return Ok(task::lyapunov::table(&of.sections(found), &of.system, &of.units.states(), of.units).kept());
        }
        table::waveform::steady(&of.system, of.start, found, of.units)
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::View;
    use crate::{Answer, AnswerError, ReportError, Shown, Units, answer};
    use core::sync::atomic::AtomicBool;
    use core::sync::atomic::Ordering;
    use vibroimpact_study::{Control, Plan, PlanError, StartPlan, SystemPlan, Task};

    const S: SystemPlan = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);

    #[test]
    fn an_answer_goes_to_another_thread() {
        const fn sends<T: Send + Sync + 'static>() {}
        sends::<Answer>();
        sends::<AnswerError>();
    }

    #[test]
    fn f10_each_view_has_a_figure_and_a_table_of_its_own() {
        let (control, task) = (Control::default(), Task::Settle { start: Some(StartPlan::default()), impacts: None });
        let answer = answer(&Plan::new(S, task), Units::default(), &control).unwrap();
        let shown = View::ALL.map(|view| {
            let (options, mut text) = (Shown { view: Some(view), ..Shown::default() }, Vec::new());
            answer.table(&options).unwrap().unwrap().write(&mut text).unwrap();
            let figure = answer.figure(&options, &control).unwrap().unwrap();
            (figure.to_svg(), String::from_utf8(text).unwrap())
        });
        for (k, (word, (svg, _))) in ["τ", "velocity ", "Re ", "states at phase 0"].iter().zip(&shown).enumerate() {
            assert!(svg.contains(word), "{k} {word}");
            assert!(shown.iter().enumerate().all(|(j, other)| j == k || other.0 != *svg), "{k}");
        }
        let heads = shown.each_ref().map(|(_, table)| table.lines().next().unwrap());
        assert_eq!(heads, ["time,x,v,phase", "time,x,v,phase", "re,im", "section,stop,phase,speed,x,v"]);
        assert_eq!(shown[2].1.lines().count(), 3, "{}", shown[2].1);
        assert_eq!(shown[3].1.lines().count(), 1 + 2 * 2000);
    }

    #[test]
    fn stopped_before_it_begins() {
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        let start = StartPlan::default();
        for task in [
            Task::Settle { start: Some(start), impacts: None },
            Task::Orbit { label: "1/1".into() },
            Task::Attractors { starts: 9, seed: 1, impacts: None },
        ] {
            let end = answer(&Plan::new(S, task), Units::default(), &control);
            assert!(matches!(end, Err(AnswerError::Stopped(_))), "{end:?}");
        }
    }

    /// Without the stop flag each of these takes minutes: exponents and sections of a motion with chatter.
    #[test]
    fn stopped_on_the_way() {
        let two = r#""system":{"inverse_beta":7.3,"gap":0.05,"restitution":0.5,"damping":1e-4,"second_stop":{"gap":0.065,"restitution":0.55}}"#;
        let u = r#""system":{"inverse_beta":1.11,"gap":3,"restitution":0.5}"#;
        for (system, task) in [
            (two, r#""lyapunov":{"impacts":10000000,"transient":1000000,"points":100000}"#),
            (u, r#""lyapunov":{"impacts":10000000,"transient":1000000}"#),
        ] {
            let plan: Plan = serde_json::from_str(&format!(r#"{{"version":1,{system},"task":{{{task}}}}}"#)).unwrap();
            let stop = AtomicBool::new(false);
            std::thread::scope(|scope| {
                scope.spawn(|| {
                    std::thread::sleep(std::time::Duration::from_millis(100));
                    stop.store(true, Ordering::Relaxed);
                });
                let end = answer(&plan, Units::default(), &Control { stop: &stop, ..Control::default() });
                assert!(matches!(end, Err(AnswerError::Stopped(_))), "{task}");
            });
        }
    }

    /// A figure over three axes is an error of the report, not of the plan.
    #[test]
    fn what_is_refused() {
        let ask = |text: &str| answer(&serde_json::from_str(text).unwrap(), Units::default(), &Control::default());
        let basin = |axes: &str| {
            format!(
                r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{"basin":{{"axes":[{axes}]}}}}}}"#
            )
        };
        let x = r#"{"vary":"x","over":"0:0.7:2"}"#;
        let line = ask(&basin(x)).unwrap();
        assert!(line.figure(&Shown::default(), &Control::default()).is_ok());
        let others = r#"{"vary":"v","over":"0:1:2"},{"vary":"phase","over":"0:1:2"}"#;
        let undrawn = ask(&basin(&format!("{x},{others}"))).unwrap().figure(&Shown::default(), &Control::default());
        assert!(matches!(undrawn, Err(AnswerError::Report(ReportError::Axes(3)))), "{undrawn:?}");
        let mut text = Vec::new();
        line.table(&Shown::default()).unwrap().unwrap().write(&mut text).unwrap();
        assert!(text.starts_with(b"x,label\n0,"));
        assert!(
            line.json()
                .contains(r#""axes":[{"vary":"x","over":{"from":0.0,"to":0.7,"count":2}}],"refused":0,"cells":[0,0]"#),
            "{}",
            line.json()
        );
        let beyond = ask(&basin(&x.replace("0.7", "0.8")));
        assert!(matches!(beyond, Err(AnswerError::Plan(PlanError::System(_)))), "{beyond:?}");
        let gap = r#"{"vary":"gap","over":"1:2:2"}"#;
        let varied = ask(&basin(&format!("{x},{gap}")));
        assert!(matches!(varied, Err(AnswerError::Plan(PlanError::WrongAxis { .. }))), "{varied:?}");
        let exponents = basin(gap).replace("basin", "lyapunov");
        assert!(ask(&exponents).unwrap_err().to_string().contains("no axis gap"));
    }
}
