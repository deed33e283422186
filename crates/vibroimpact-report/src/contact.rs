//! The contact of a mass with a spring and a damper: its restitution, times, depths and forces, as JSON, table and figure.

use crate::number::{Number, short};
use crate::text::words::aligned;
use crate::{PROGRAM, ReportError, Table};
use core::f64::consts::TAU;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::machine::{Opening, SpringDamper};
use vibroimpact_plot::{Dash, Figure, FigureAxis, Legend, Line, Panel, SERIES};

/// The points of a curve of the figure.
const POINTS: u32 = 400;
/// A contact that never opens is drawn for so many radians of the mass on the spring.
const DRAWN: f64 = 20.0;

/// The question of a contact, in SI units: two of mass, stiffness and frequency, the frequency alone, or the mass and the contact
/// time; and what the contact loses.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "the names are those of `ContactObject`")]
pub struct ContactQuestion {
    pub mass: Option<f64>,
    pub stiffness: Option<f64>,
    pub frequency: Option<f64>,
    pub contact_time: Option<f64>,
    pub restitution: Option<f64>,
    pub damping: Option<f64>,
    pub damping_ratio: Option<f64>,
    pub speed: f64,
    /// When it opens; both ways when absent.
    pub opening: Option<Opens>,
}

/// When a contact opens.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Opens {
    /// When its force falls to zero.
    Force,
    /// Where its spring is relaxed again.
    Position,
}

impl ContactQuestion {
    /// The answer.
    ///
    /// # Errors
    /// [`ReportError::Contact`] for numbers out of their ranges, or that do not determine a contact.
    pub fn answer(&self) -> Result<ContactAnswer, ReportError> {
        let speed = self.speed;
        if !(1e-100..=1e100).contains(&speed) {
            return Err(ReportError::Contact(format!("speed = {speed} lies outside 1e-100 to 1e100")));
        }
        let openings = match self.opening {
            Some(Opens::Force) => vec![Opening::Force],
            Some(Opens::Position) => vec![Opening::Position],
            None => vec![Opening::Force, Opening::Position],
        };
        let contacts = openings.into_iter().map(|opening| self.contact(opening)).collect::<Result<Vec<_>, _>>()?;
        Ok(ContactAnswer::new(&contacts, speed))
    }

    /// The contact that opens so.
    fn contact(&self, opening: Opening) -> Result<SpringDamper, ReportError> {
        let refused = |said: &str| ReportError::Contact(said.to_owned());
        let of = |mass: f64, stiffness: f64| {
            let contact = match (self.restitution, self.damping, self.damping_ratio) {
                (Some(restitution), ..) => SpringDamper::with_restitution(mass, stiffness, restitution, opening),
                (_, Some(damping), _) => SpringDamper::new(mass, stiffness, damping, opening),
                (.., Some(ratio)) => SpringDamper::with_damping_ratio(mass, stiffness, ratio, opening),
                _ => {
                    return Err(refused(
                        "what does the contact lose?\nhint: --restitution, --damping-ns-per-m or --damping-ratio",
                    ));
                }
            };
            contact.map_err(|error| refused(&error.to_string()))
        };
        let square = self.frequency.map(|hertz| (TAU * hertz) * (TAU * hertz));
        match (self.mass, self.stiffness, square, self.contact_time) {
            (Some(_), Some(_), Some(_), _) => {
                Err(refused("mass, stiffness and frequency: two of them give the third\nhint: leave one away"))
            }
            (Some(mass), Some(stiffness), None, _) => of(mass, stiffness),
            (Some(mass), None, Some(square), _) => of(mass, mass * square),
            (None, Some(stiffness), Some(square), _) => of(stiffness / square, stiffness),
            // of each kilogram
            (None, None, Some(square), _) => of(1.0, square),
            (Some(_), None, None, Some(_)) if self.damping.is_some() => Err(refused(
                "--contact-time-s and --damping-ns-per-m do not determine a stiffness\nhint: --restitution or --damping-ratio",
            )),
            (Some(mass), None, None, Some(time)) => {
                // with a given ratio the time falls as the root of the stiffness
                let unit = of(mass, mass)?;
                let turned = unit.contact_time() / time;
                if !(turned > 0.0 && turned.is_finite()) {
                    return Err(ReportError::Contact(format!(
                        "no stiffness gives the contact time {time}: a contact with damping ratio {} does not open by position",
                        short(unit.damping_ratio())
                    )));
                }
                of(mass, mass * turned * turned)
            }
            _ => Err(refused(
                "the spring is not determined\nhint: --mass-kg with --stiffness-n-per-m, --frequency-hz or --contact-time-s",
            )),
        }
    }
}

/// The answer to `vibro contact`.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ContactAnswer {
    /// The speed of approach, to which depths and forces belong.
    pub speed: f64,
    /// One for each way to open.
    pub contacts: Vec<ContactObject>,
    units: ContactUnits,
    program: &'static str,
}

/// A contact.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ContactObject {
    /// When it opens: `force` or `position`.
    pub opening: &'static str,
    /// The quotient of the speeds of separation and approach.
    pub restitution: f64,
    /// The damping ratio.
    pub damping_ratio: f64,
    /// The mass.
    pub mass: f64,
    /// The stiffness.
    pub stiffness: f64,
    /// The damping.
    pub damping: f64,
    /// The frequency of the mass on the spring.
    pub frequency: f64,
    /// The time from closing to opening; `null` if it never opens.
    pub contact_time: Option<f64>,
    /// The largest depth.
    pub depth_max: f64,
    /// The largest force.
    pub force_max: f64,
    /// The depth at which it opens.
    pub residual_depth: f64,
    #[serde(skip)]
    contact: SpringDamper,
}

/// The units of the numbers.
#[derive(Clone, Debug, JsonSchema, Serialize)]
struct ContactUnits {
    mass: &'static str,
    stiffness: &'static str,
    damping: &'static str,
    frequency: &'static str,
    time: &'static str,
    length: &'static str,
    force: &'static str,
    speed: &'static str,
}

const SI: ContactUnits = ContactUnits {
    mass: "kg",
    stiffness: "N/m",
    damping: "N s/m",
    frequency: "Hz",
    time: "s",
    length: "m",
    force: "N",
    speed: "m/s",
};

/// The columns of the table.
const HEADER: &str = "opening,restitution,damping_ratio,mass_kg,stiffness_n_per_m,damping_ns_per_m,frequency_hz,contact_time_s,depth_max_m,force_max_n,residual_depth_m";

impl ContactAnswer {
    /// The answer for contacts that are approached at a speed.
    fn new(contacts: &[SpringDamper], speed: f64) -> Self {
        let object = |contact: &SpringDamper| ContactObject {
            opening: match contact.opening() {
                Opening::Force => "force",
                Opening::Position => "position",
            },
            restitution: contact.restitution(),
            damping_ratio: contact.damping_ratio(),
            mass: contact.mass(),
            stiffness: contact.stiffness(),
            damping: contact.damping(),
            frequency: contact.frequency() / TAU,
            contact_time: Some(contact.contact_time()).filter(|time| time.is_finite()),
            depth_max: contact.deepest(speed),
            force_max: contact.peak_force(speed),
            residual_depth: contact.residual_depth(speed),
            contact: *contact,
        };
        Self { speed, contacts: contacts.iter().map(object).collect(), units: SI, program: PROGRAM }
    }

    /// The table that `--csv` writes: a row for each way to open.
    #[must_use]
    pub fn table(&self) -> Table<'_> {
        let row = |of: &ContactObject| {
            let time = of.contact_time.map_or_else(String::new, |time| Number(time).to_string());
            let first = [of.restitution, of.damping_ratio, of.mass, of.stiffness, of.damping, of.frequency];
            let numbers = first.map(|value| Number(value).to_string()).join(",");
            let last = [of.depth_max, of.force_max, of.residual_depth].map(|value| Number(value).to_string()).join(",");
            format!("{},{numbers},{time},{last}", of.opening)
        };
        Table::new(HEADER.to_owned(), self.contacts.iter().map(row))
    }

    /// The text: a column for each way to open.
    #[must_use]
    pub fn text(&self) -> String {
        let all = &self.contacts;
        let line = |name: &str, value: &dyn Fn(&ContactObject) -> String| {
            let mut row = vec![name.to_owned()];
            row.extend(all.iter().map(value));
            row
        };
        let opens = all.iter().map(|of| format!("by {}", of.opening));
        let heads: Vec<String> = core::iter::once("<opens".to_owned()).chain(opens).collect();
        let rows = [
            line("restitution", &|of| short(of.restitution)),
            line("damping ratio", &|of| short(of.damping_ratio)),
            line("damping (N s/m)", &|of| short(of.damping)),
            line("mass (kg)", &|of| short(of.mass)),
            line("stiffness (N/m)", &|of| short(of.stiffness)),
            line("frequency (Hz)", &|of| short(of.frequency)),
            line("contact time (s)", &|of| of.contact_time.map_or_else(|| "never opens".to_owned(), short)),
            line("largest depth (m)", &|of| short(of.depth_max)),
            line("largest force (N)", &|of| short(of.force_max)),
            line("depth at opening (m)", &|of| short(of.residual_depth)),
        ];
        format!("approach at {} m/s\n{}", short(self.speed), aligned(&heads, &rows))
    }

    /// The figure: the force over the depth from closing to opening.
    #[must_use]
    pub fn figure(&self) -> Figure {
        let mut panel = Panel::new(FigureAxis::new("depth (m)"), FigureAxis::new("contact force (N)"));
        let mut legend = Legend::below();
        for (of, (colour, dash)) in self.contacts.iter().zip(SERIES.into_iter().zip([Dash::Solid, Dash::Dashed])) {
            let end = of.contact_time.unwrap_or(DRAWN / of.contact.frequency());
            let at = |k: u32| of.contact.at(self.speed, end * f64::from(k) / f64::from(POINTS));
            let (depths, forces): (Vec<f64>, Vec<f64>) = (0..=POINTS).map(at).unzip();
            let line = Line::new(depths, forces, colour).dash(dash);
            let text = format!("opens by {}, *ε* = {}", of.opening, short(of.restitution));
            legend = legend.line(line.stroke, text);
            panel.add(line);
        }
        let approach = format!("approach at {} m/s", short(self.speed));
        Figure::new(panel).title(approach).legend(legend)
    }
}
