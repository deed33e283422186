//! `vibro region`: the regions of a plane of two parameters in which a motion exists and in which it is stable.

use crate::args::{
    AxesArgs, Convention, FigureArgs, ParameterFlag, PhysicalArgs, Place, SystemArgs, of_oscillator, whole,
};
use crate::commands::outputs::Outputs;
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use std::path::PathBuf;
use vibroimpact_report::{Asked, Shown};
use vibroimpact_study::{DEFAULT_GRID, Parameter, Plan, RegionPlan, Stretch, Task};

/// Where a motion exists and where it is stable, over two parameters: closed polygons
///
/// Two parameters are given as ranges A:B, the others as values; ranges replace values of a machine in physical units.
/// Orbits are searched for on a grid. From each orbit the boundary of its part of the region is followed along the curves
/// that bound it: fold (two orbits meet), flip (a multiplier is -1), no speed (an impact has speed zero), touch (a flight
/// touches a stop), merging (with an orbit of half the period), frame. The surface of orbits folds, so polygons of
/// different sheets may overlap. The region of the motion without impacts, label 0, is known in closed form: its
/// amplitude exceeds no gap, and a touch bounds it.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro region --label m/n --inverse-beta A:B --gap A:B --restitution E [OPTIONS]",
    after_help = "Examples:\n  \
        vibro region --label 1/1 --inverse-beta 0.4:2 --gap -1:5 --restitution 0.5 --csv region.csv --plot region.png\n  \
        vibro region --label 1/2 --inverse-beta 1.11 --gap 0:3 --restitution 0.2:0.9 --plot plane.png"
)]
pub(crate) struct Region {
    /// m impacts in n forcing periods, for example 2/1; 0 for the motion without impacts
    #[arg(long, value_name = "m/n", allow_hyphen_values = true, help_heading = "Motion")]
    label: String,

    /// Frequency ratio: forcing over natural frequency, a value or a range A:B
    #[arg(long, value_name = "B", allow_hyphen_values = true, conflicts_with = "inverse_beta", help_heading = "Plane")]
    beta: Option<Place>,

    /// Its inverse omega_n/omega instead
    #[arg(long, value_name = "X", allow_hyphen_values = true, help_heading = "Plane")]
    inverse_beta: Option<Place>,

    /// Distance of the stop from the rest position in units of F/k
    #[arg(long, value_name = "D", allow_hyphen_values = true, help_heading = "Plane")]
    gap: Option<Place>,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_name = "E", allow_hyphen_values = true, help_heading = "Plane")]
    restitution: Place,

    /// Damping ratio zeta, 0 or more [default: 0]
    #[arg(long, value_name = "Z", allow_hyphen_values = true, help_heading = "Plane")]
    damping: Option<Place>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_name = "D2", allow_hyphen_values = true, help_heading = "Plane")]
    second_gap: Option<Place>,

    /// Restitution of the second stop [default: that of the first]
    #[arg(long, value_name = "E2", allow_hyphen_values = true, requires = "second_gap", help_heading = "Plane")]
    second_restitution: Option<Place>,

    #[command(flatten, next_help_heading = "Plane")]
    axes: AxesArgs,

    #[command(flatten)]
    machine: PhysicalArgs,

    /// Units of ranges and results
    #[arg(long, value_enum, value_name = "UNITS", default_value_t = Convention::Nondimensional, help_heading = "Plane")]
    units: Convention,

    /// Points of the grid at which orbits are looked for, in each direction, 2 to 400: smaller parts may be missed
    #[arg(long, value_parser = whole::<u32>, value_name = "N", default_value_t = DEFAULT_GRID, allow_hyphen_values = true, help_heading = "Plane")]
    grid: u32,

    /// Write one row a vertex to this file; - for stdout. Columns: region (existence or stability), polygon, hole, sheet
    /// (below: multipliers below +1, or above), both parameters, and what bounds the region from here to the next vertex
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Draw both regions into this file, .svg, .png or .pdf; edges of the sheet "above" are thin
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,

    #[command(flatten)]
    figure: FigureArgs,

    /// Print one JSON object with the polygons instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,
}

impl Region {
    fn places(&self) -> [(Parameter, Option<Place>); 7] {
        [
            (Parameter::Beta, self.beta),
            (Parameter::InverseBeta, self.inverse_beta),
            (Parameter::Gap, self.gap),
            (Parameter::Restitution, Some(self.restitution)),
            (Parameter::Damping, self.damping),
            (Parameter::SecondGap, self.second_gap),
            (Parameter::SecondRestitution, self.second_restitution),
        ]
    }

    /// The system, with the smallest values of the parameters that vary, and these parameters. A system in physical units
    /// must be given completely, because its units depend on all quantities; ranges replace its values.
    fn asked(&self) -> Result<(Asked, Vec<Stretch>), Failure> {
        let machine = self.machine.any();
        let restitution = |p: Parameter| matches!(p, Parameter::Restitution | Parameter::SecondRestitution);
        let own = |(parameter, place): (Parameter, Option<Place>)| {
            let replaces =
                machine && !restitution(parameter) && place.is_some_and(|place| place.over(parameter).is_some());
            (parameter, place.filter(|_| !replaces).map(Place::first))
        };
        let physical: Vec<(ParameterFlag, (f64, f64))> = self.machine.ends()?;
        let units = if physical.is_empty() { self.units } else { Convention::Si };
        let mut asked = SystemArgs::of(&self.places().map(own), self.machine.clone(), units).first(&[])?;
        let flags: Vec<ParameterFlag> = physical.iter().map(|(named, _)| *named).collect();
        let parameters = of_oscillator(&mut asked, &flags);
        let ranges = parameters.into_iter().zip(physical).map(|(parameter, (_, ends))| (parameter, ends));
        let plain = self.places().into_iter().filter_map(|(parameter, place)| {
            let Stretch { from, to, .. } = place?.over(parameter)?;
            Some((parameter, (from, to)))
        });
        let stretch = |(parameter, (from, to))| {
            let unit = asked.units.of(parameter);
            Stretch { parameter, from: from / unit, to: to / unit }
        };
        let over: Vec<Stretch> = plain.chain(ranges).map(stretch).collect();
        let of_machines = over.iter().any(|stretch| matches!(stretch.parameter, Parameter::Physical(_)));
        if of_machines {
            let first = over.iter().map(|stretch| (stretch.parameter, stretch.from));
            asked.system = asked.system.with_all(first)?;
            asked = asked.refreshed();
        } else if machine {
            // the plane has parameters of the oscillator, in the units of the machine
            asked.system.machine = None;
            for stretch in &over {
                asked.system = asked.system.with(stretch.parameter, stretch.from)?;
            }
        }
        Ok((asked, over))
    }

    /// The two parameters with ranges, the abscissa first.
    fn plane(&self, asked: &Asked, over: Vec<Stretch>) -> Result<(Stretch, Stretch), Failure> {
        if asked.system.second_stop.is_some()
            && self.second_restitution.is_none()
            && self.restitution.over(Parameter::Gap).is_some()
        {
            return Err(Failure::bad(
                "the restitution varies and that of the second stop is not given\nhint: --second-restitution E2",
            ));
        }
        let over = self.axes.order(over, |stretch| stretch.parameter)?;
        match over.as_slice() {
            [across, up] => Ok((*across, *up)),
            _ => Err(Failure::bad(format!(
                "a plane has two parameters, and ranges A:B are given for {}\nhint: --inverse-beta 0.4:2 --gap -1:5",
                over.len()
            ))),
        }
    }
}

pub(super) fn run(args: &Region, session: &Session) -> Result<(), Failure> {
    let (asked, over) = args.asked()?;
    let (across, up) = args.plane(&asked, over)?;
    let task = RegionPlan { label: args.label.clone(), across, up, grid: args.grid };
    let plan = Plan::new(asked.system, Task::Region(task));
    plan.check()?;
    let outputs = Outputs::reserve(args.csv.as_deref(), (args.plot.as_deref(), &args.figure), args.json, session)?;
    respond::run(&plan, asked.units, (outputs, Shown::default()), None, session)
}
