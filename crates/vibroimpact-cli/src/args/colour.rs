//! COLOUR: the quantity whose values are the colours of a map or basin.

use super::{Ends, FieldName, FieldsArgs};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use vibroimpact_report::figure::coloured::{Coloured, Of};

/// The quantity that a figure shows.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Figure")]
pub(crate) struct ColourArgs {
    /// Draw the values of this quantity, one of --fields, instead of the labels: colours with a colour bar over two axes,
    /// dots over one. Where motions coexist, the colour is the largest value unless --of says otherwise. Points without a
    /// value (not defined, infinite, undecided, not computed) have looks of their own
    #[arg(long, alias = "color", value_name = "FIELD", value_parser = FieldName::parse)]
    colour: Option<FieldName>,

    /// Which of several motions at a point has the colour [default: largest]
    #[arg(long, value_enum, value_name = "WHICH")]
    of: Option<Which>,

    /// The values at the ends of the colours [default: the smallest and the largest value in the figure]. Values beyond them
    /// have the colours of the ends
    #[arg(long, value_name = "LOW:HIGH", allow_hyphen_values = true)]
    colour_range: Option<Ends>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Which {
    /// The one with the largest value
    #[value(alias = "worst")]
    Largest,
    /// The one with the smallest value
    #[value(alias = "least")]
    Smallest,
    /// The one to which most starts lead
    Likeliest,
}

impl ColourArgs {
    /// The requested colours.
    pub(crate) fn coloured(&self, drawn: bool) -> Result<Option<Coloured>, Failure> {
        let of = self.of.map_or(Of::Largest, |which| match which {
            Which::Largest => Of::Largest,
            Which::Smallest => Of::Smallest,
            Which::Likeliest => Of::Likeliest,
        });
        match &self.colour {
            None if self.colour_range.is_some() => {
                Err(Failure::bad("--colour-range says which values the colours have\nhint: --colour impact-speed-max"))
            }
            None if self.of.is_some() => {
                Err(Failure::bad("--of says which motion has the colour\nhint: --colour impact-speed-max"))
            }
            Some(_) if !drawn => Err(Failure::bad("--colour says what the figure shows\nhint: --plot FILE")),
            colour => {
                let range = self.colour_range.map(|Ends(low, high)| (low, high));
                if let Some((low, high)) = range.filter(|(low, high)| low >= high) {
                    return Err(Failure::bad(format!("--colour-range {low}:{high} is not LOW:HIGH with LOW < HIGH")));
                }
                Ok(colour.as_ref().map(|field| Coloured { field: field.path(), of, range }))
            }
        }
    }

    /// The quantities to compute: those of --fields, and that of the colours.
    pub(crate) fn with(&self, fields: &FieldsArgs) -> FieldsArgs {
        let mut all = fields.clone();
        all.add(self.colour.as_ref());
        all
    }
}
