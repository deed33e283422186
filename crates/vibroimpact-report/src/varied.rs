//! What varies in a plan and what a diagram shows, as reports name and scale them: those of an oscillator in the units of the
//! results, those of a machine by their paths and in its own units.

use crate::Units;
use crate::figure::symbol;
use vibroimpact::QuantityKind;
use vibroimpact_plot::plain;
use vibroimpact_study::diagram::{Show, Shown};
use vibroimpact_study::{Coordinate, Name, Parameter, Quantity};

/// What varies in a plan: a parameter, a coordinate of the start, or the path of a number of a machine.
pub trait Varied: Name {
    /// Its unit, as a factor for its values.
    fn unit(&self, units: &Units) -> f64;
    /// Its name in JSON.
    fn field(&self, units: &Units) -> &str;
    /// The name of its column in a table.
    fn column(&self, units: &Units) -> &str;
    /// Its symbol in a figure, as markup.
    fn mark(&self, units: &Units) -> String;
    /// The same with its unit, for an axis.
    fn axis(&self, units: &Units) -> String;
    /// Its name in a sentence, such as `gap` or `inverse beta`.
    fn words(&self, units: &Units) -> String;
    /// The units of the results where it has this value.
    fn units_at(&self, units: &Units, value: f64) -> Units;
}

impl Varied for Parameter {
    fn unit(&self, units: &Units) -> f64 {
        units.of(*self)
    }

    fn field(&self, units: &Units) -> &str {
        units.name_of(*self)
    }

    fn column(&self, units: &Units) -> &str {
        match self {
            Self::Gap if units.si => "gap_m",
            Self::SecondGap if units.si => "second_gap_m",
            _ => units.name_of(*self),
        }
    }

    fn mark(&self, units: &Units) -> String {
        if units.unit_of(*self) == "Hz" { "frequency" } else { symbol(*self) }.to_owned()
    }

    fn axis(&self, units: &Units) -> String {
        match units.unit_of(*self) {
            "" => symbol(*self).into(),
            unit if matches!(self, Self::Body(_)) => format!("{} ({unit})", symbol(*self)),
            "Hz" => "frequency (Hz)".into(),
            unit if *self == Self::SecondGap => format!("second gap ({unit})"),
            unit => format!("gap ({unit})"),
        }
    }

    fn words(&self, units: &Units) -> String {
        if let Self::Body(parameter) = self {
            let (name, unit) = (parameter.description(), parameter.unit());
            return if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") };
        }
        let name = self.name().replace('_', " ");
        match units.unit_of(*self) {
            "" => name,
            "Hz" => "frequency (Hz)".to_owned(),
            unit => units.named(&name, unit),
        }
    }

    fn units_at(&self, units: &Units, value: f64) -> Units {
        units.at(*self, value)
    }
}

impl Varied for Coordinate {
    fn unit(&self, units: &Units) -> f64 {
        match self {
            Self::Parameter(parameter) => units.of(*parameter),
            Self::X => units.length(),
            Self::V => units.velocity(),
            Self::Phase => 1.0,
        }
    }

    fn field(&self, units: &Units) -> &str {
        match self {
            Self::Parameter(parameter) => units.name_of(*parameter),
            start => start.name(),
        }
    }

    fn column(&self, units: &Units) -> &str {
        match self {
            Self::Parameter(parameter) => parameter.column(units),
            Self::X if units.si => "x_m",
            Self::V if units.si => "v_m_per_s",
            start => start.name(),
        }
    }

    fn mark(&self, units: &Units) -> String {
        match self {
            Self::Parameter(parameter) => parameter.mark(units),
            Self::X => "*ξ*_0".to_owned(),
            Self::V => "*ξ*_0′".to_owned(),
            Self::Phase => "phase *φ*".to_owned(),
        }
    }

    fn axis(&self, units: &Units) -> String {
        match self {
            Self::Parameter(parameter) => parameter.axis(units),
            Self::X => units.named(&self.mark(units), "m"),
            Self::V => units.named(&self.mark(units), "m/s"),
            Self::Phase => self.mark(units),
        }
    }

    fn words(&self, units: &Units) -> String {
        match self {
            Self::Parameter(parameter) => parameter.words(units),
            start => start.name().to_owned(),
        }
    }

    fn units_at(&self, units: &Units, value: f64) -> Units {
        match self {
            Self::Parameter(parameter) => units.at(*parameter, value),
            _ => *units,
        }
    }
}

impl Varied for String {
    fn unit(&self, _: &Units) -> f64 {
        1.0
    }

    fn field(&self, _: &Units) -> &str {
        self
    }

    fn column(&self, _: &Units) -> &str {
        self
    }

    fn mark(&self, _: &Units) -> String {
        plain(self)
    }

    fn axis(&self, _: &Units) -> String {
        plain(self)
    }

    fn words(&self, _: &Units) -> String {
        self.clone()
    }

    fn units_at(&self, units: &Units, _: f64) -> Units {
        *units
    }
}

/// A quantity of a motion that a plan asks for: of an oscillator, or by its path.
pub trait FieldName: Name {
    /// The name of its column in a table.
    fn column(&self, units: &Units) -> String;
    /// Its unit, as a factor for its values; not-a-number if it is not defined in the frame of these units.
    fn unit(&self, units: &Units) -> f64;
    /// Its name with its unit, for an axis.
    fn axis(&self, units: &Units) -> String;
}

impl FieldName for Quantity {
    fn column(&self, units: &Units) -> String {
        units.column(self.name(), self.kind())
    }

    fn unit(&self, units: &Units) -> f64 {
        units.of_quantity(*self)
    }

    fn axis(&self, units: &Units) -> String {
        match self.kind().unit() {
            "" => self.description().to_owned(),
            unit => units.named(self.description(), unit),
        }
    }
}

impl FieldName for String {
    fn column(&self, _: &Units) -> String {
        self.clone()
    }

    fn unit(&self, _: &Units) -> f64 {
        1.0
    }

    fn axis(&self, _: &Units) -> String {
        plain(self)
    }
}

/// What a diagram shows.
pub trait ShownValue: Shown {
    /// The ordinate of a figure, as markup.
    fn ordinate(&self, units: &Units) -> String;
    /// The columns of a table after the kind of the motion.
    fn columns(&self, units: &Units) -> Vec<String>;
    /// The unit of a quantity of the motion, as a factor for its values.
    fn quantity_unit(&self, units: &Units) -> f64;
}

/// The columns of closings of stops.
fn of_closings(units: &Units) -> Vec<String> {
    vec!["stop".to_owned(), "phase".to_owned(), units.column("speed", QuantityKind::Velocity)]
}

impl ShownValue for Show {
    fn ordinate(&self, units: &Units) -> String {
        match self {
            Self::Velocity => units.named("arrival velocity *u*_−", "m/s"),
            Self::Strobe => units.named("*ξ* at phase 0", "m"),
            Self::Quantity(quantity) => quantity.axis(units),
        }
    }

    fn columns(&self, units: &Units) -> Vec<String> {
        match self {
            Self::Velocity => of_closings(units),
            Self::Strobe => vec![units.column("x", QuantityKind::Length), units.column("v", QuantityKind::Velocity)],
            Self::Quantity(quantity) => vec![quantity.column(units)],
        }
    }

    fn quantity_unit(&self, units: &Units) -> f64 {
        if let Self::Quantity(quantity) = self { units.of_quantity(*quantity) } else { 1.0 }
    }
}

impl ShownValue for String {
    fn ordinate(&self, _: &Units) -> String {
        match self {
            _ if self.is_closings() => "speed of closing".to_owned(),
            _ if self.is_states() => format!("{} at phase 0", plain(self)),
            _ => plain(self),
        }
    }

    fn columns(&self, units: &Units) -> Vec<String> {
        if self.is_closings() { of_closings(units) } else { vec![self.clone()] }
    }

    fn quantity_unit(&self, _: &Units) -> f64 {
        1.0
    }
}
