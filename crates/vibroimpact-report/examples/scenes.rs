//! Draws every scene into a folder, for visual inspection.
//!
//! `cargo run -p vibroimpact-report --example scenes -- FOLDER`

use std::error::Error;
use std::path::Path;
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Scales, Start};
use vibroimpact_plot::Figure;
use vibroimpact_report::scene::{View, Viewed};
use vibroimpact_report::{Asked, Units, scene};
use vibroimpact_study::{Control, DiagramPlan, Parameter, Span, SystemPlan};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("a folder is needed")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    let save = |name: &str, figure: &Figure| -> Result<(), Box<dyn Error>> {
        Ok(std::fs::write(folder.join(format!("{name}.png")), figure.to_png(1.0)?)?)
    };
    let system = |inverse: f64, gap: f64| SystemPlan::from_inverse_beta(inverse, gap, 0.5);
    let si = Units { scales: Some(Scales { length: 0.005, time: 0.05, mass: 1.0 }), si: true, ..Units::default() };
    let two = SystemPlan {
        second_stop: Some(vibroimpact_study::SecondStop { gap: 0.5, restitution: 0.6 }),
        ..system(1.3, 0.75)
    };
    for (name, system, units) in [
        ("four", system(1.8, 0.25), Units::default()),
        ("two", system(1.3, 0.75), si),
        ("both-stops", two, Units::default()),
        ("chaos", system(1.11, 3.0), Units::default()),
        ("chatter", SystemPlan { beta: Some(0.9), inverse_beta: None, ..system(1.0, -0.5) }, Units::default()),
    ] {
        let (asked, osc) = (Asked { system, units }, system.oscillator()?);
        let start = Start::at_rest(&osc);
        let settled = settle(&osc, start, &SettleOptions::default());
        let periods = |n: f64| n * osc.period();
        save(&format!("{name}-transient"), &scene::phase_portrait(&asked, &osc, start, (0.0, periods(8.0))))?;
        let span = (settled.time, settled.time + periods(if name == "chaos" { 200.0 } else { 4.0 }));
        save(&format!("{name}-steady"), &scene::phase_portrait(&asked, &osc, start, span))?;
        save(&format!("{name}-sections"), &Viewed::new(View::Sections, (&osc, start), &settled, &asked)?.figure())?;
        if let Verdict::Periodic(cycle) = &settled.verdict {
            save(&format!("{name}-multipliers"), &scene::multipliers(&cycle.multipliers, &cycle.stabilities()))?;
        }
    }
    for (name, system, vary, over, few) in [
        ("gap", system(1.11, 1.0), Parameter::Gap, "0.5:3:400", 6),
        ("frequency", system(1.0, 0.75), Parameter::InverseBeta, "0.8:1.8:400", 8),
    ] {
        let (asked, control) = (Asked { system, units: Units::default() }, Control::default());
        let plan = DiagramPlan::new(vary, over.parse::<Span>()?);
        let mut labels = scene::labels(&asked, &plan, 40, &control)?;
        labels.truncate(few);
        save(&format!("bifurcation-{name}"), &scene::bifurcation(&asked, &plan, Some(&labels), &control)?.figure()?)?;
    }
    Ok(())
}
