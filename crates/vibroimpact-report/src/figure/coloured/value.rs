//! The value of a quantity at a point of a figure, or the reason why there is none.

use vibroimpact_plot::{ClassStyle, Colour, Hatch, Pattern, class_style};

/// A quantity in colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Coloured {
    /// The name of the quantity, as in the fields of a plan; of a machine its path.
    pub field: String,
    /// Which of several motions at a point has the colour.
    pub of: Of,
    /// The values at the ends of the colours; by default the smallest and the largest value of the figure.
    pub range: Option<(f64, f64)>,
}

/// Which of several motions at a point has the colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Of {
    /// The one with the largest value, usually the worst one.
    #[default]
    Largest,
    /// The one with the smallest value.
    Smallest,
    /// The one to which most starts lead, with or without a value.
    Likeliest,
}

/// The value of a quantity of a motion, in the units of the figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A finite number.
    Finite(f64),
    /// Infinite, such as the number of impacts of a complete chatter.
    Infinite,
    /// The quantity of this motion is not defined.
    Undefined,
    /// The motion is undecided.
    Undecided,
    /// Nothing was computed at this point.
    NotComputed,
}

impl Value {
    /// The value of a motion with this label.
    pub(crate) fn of(label: &str, number: Option<f64>) -> Self {
        match number {
            Some(number) if number.is_finite() => Self::Finite(number),
            Some(number) if number.is_infinite() => Self::Infinite,
            _ if label == "undecided" => Self::Undecided,
            _ => Self::Undefined,
        }
    }

    /// The finite number, if it is one.
    pub(crate) const fn finite(self) -> Option<f64> {
        if let Self::Finite(number) = self { Some(number) } else { None }
    }

    /// All values that are no finite number, in the order of a legend.
    pub const MISSING: [Self; 4] = [Self::Infinite, Self::Undefined, Self::Undecided, Self::NotComputed];

    /// The look of a value that is no finite number, and its text in the legend.
    #[must_use]
    pub fn look(self) -> (ClassStyle, &'static str) {
        let grey = ClassStyle {
            colour: Colour::hex(0xb8_b8b8),
            hatch: Some(Hatch::new(Pattern::Rising, Colour::hex(0x60_6060))),
        };
        match self {
            Self::Infinite => (class_style("inf/n"), "infinite"),
            Self::Finite(_) | Self::Undefined => (grey, "not defined"),
            Self::Undecided => (class_style("undecided"), "undecided"),
            Self::NotComputed => (ClassStyle::plain(Colour::WHITE), "not computed"),
        }
    }
}

impl Of {
    /// The word of `--of`.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Largest => "largest",
            Self::Smallest => "smallest",
            Self::Likeliest => "likeliest",
        }
    }

    /// That with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Largest, Self::Smallest, Self::Likeliest].into_iter().find(|of| of.name() == name)
    }

    /// The value that is shown of the motions at a point, the most frequent one first. Motions without a value are passed
    /// over if another motion has one, except by [`Of::Likeliest`].
    pub(crate) fn among(self, mut values: impl Iterator<Item = Value>) -> Value {
        if self == Self::Likeliest {
            return values.next().unwrap_or(Value::NotComputed);
        }
        let rank = |value: Value| match (value, self) {
            (Value::Infinite, Self::Largest) => (4, 0.0),
            (Value::Finite(number), Self::Largest) => (3, number),
            (Value::Finite(number), _) => (3, -number),
            (Value::Infinite, _) => (2, 0.0),
            (Value::Undecided, _) => (1, 0.0),
            (Value::Undefined | Value::NotComputed, _) => (0, 0.0),
        };
        let best = values.reduce(|a, b| if rank(b) > rank(a) { b } else { a });
        best.unwrap_or(Value::NotComputed)
    }

    /// The sentence of the figure that says what is shown.
    pub(crate) const fn sentence(self) -> &'static str {
        match self {
            Self::Largest => "where motions coexist: the largest value",
            Self::Smallest => "where motions coexist: the smallest value",
            Self::Likeliest => "where motions coexist: the most frequent motion",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Value::{Finite, Infinite, NotComputed, Undecided, Undefined};

    #[test]
    fn one_of_several_values() {
        for (values, largest, smallest, likeliest) in [
            (vec![Finite(2.0), Finite(3.0)], Finite(3.0), Finite(2.0), Finite(2.0)),
            (vec![Undecided, Finite(-3.0), Finite(-2.0)], Finite(-2.0), Finite(-3.0), Undecided),
            (vec![Finite(1.0), Infinite, Undefined], Infinite, Finite(1.0), Finite(1.0)),
            (vec![Undefined, Undecided], Undecided, Undecided, Undefined),
            (vec![Undefined, Infinite], Infinite, Infinite, Undefined),
            (vec![], NotComputed, NotComputed, NotComputed),
        ] {
            for (of, want) in [(Of::Largest, largest), (Of::Smallest, smallest), (Of::Likeliest, likeliest)] {
                assert_eq!(of.among(values.iter().copied()), want, "{of:?} {values:?}");
            }
        }
    }

    #[test]
    fn missing_values_differ_from_each_other_and_from_all_colours() {
        assert_eq!(Value::of("undecided", None), Undecided);
        assert_eq!(Value::of("1/1", Some(f64::NAN)), Undefined);
        assert_eq!(Value::of("inf/1", Some(f64::INFINITY)), Infinite);
        for (k, a) in Value::MISSING.into_iter().enumerate() {
            let (style, text) = a.look();
            for b in &Value::MISSING[k + 1..] {
                assert!(style != b.look().0 && text != b.look().1);
                // told apart in grey print too
                assert!(style.hatch.map(|h| h.pattern) != b.look().0.hatch.map(|h| h.pattern));
            }
            let nearest = (0..=100).map(|k| vibroimpact_plot::colour_at(f64::from(k) / 100.0).delta_e(style.colour));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest > 25.0, "{text} is {nearest:.0} from a colour of the bar");
        }
    }
}
