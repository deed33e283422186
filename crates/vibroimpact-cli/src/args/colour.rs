//! COLOUR: the quantity whose values are the colours of a map or basin.

use super::{FieldsArgs, quantity};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use vibroimpact_report::figure::coloured::{Coloured, Of};
use vibroimpact_study::Quantity;

/// The quantity that a figure shows.
#[derive(Clone, Copy, Debug, Default, Args)]
#[command(next_help_heading = "Figure")]
pub(crate) struct ColourArgs {
    /// Draw the values of this quantity, one of --fields, instead of the labels: colours with a colour bar over two axes,
    /// dots over one. Where motions coexist, the colour is the largest value unless --of says otherwise. Points without a
    /// value (not defined, infinite, undecided, not computed) have looks of their own
    #[arg(long, alias = "color", value_name = "FIELD", value_parser = quantity)]
    colour: Option<Quantity>,

    /// Which of several motions at a point has the colour [default: largest]
    #[arg(long, value_enum, value_name = "WHICH")]
    of: Option<Which>,
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
        match self.colour {
            None if self.of.is_some() => {
                Err(Failure::bad("--of says which motion has the colour\nhint: --colour impact-speed-max"))
            }
            Some(_) if !drawn => Err(Failure::bad("--colour says what the figure shows\nhint: --plot FILE")),
            colour => Ok(colour.map(|quantity| Coloured { quantity, of })),
        }
    }

    /// The paths of quantities of a machine to compute, whose figures have no colours by a quantity.
    pub(crate) fn of_machine(&self, fields: &FieldsArgs) -> Result<Vec<String>, Failure> {
        if self.colour.is_some() || self.of.is_some() {
            return Err(Failure::bad(
                "figures of machines have no colours by a quantity yet\nhint: --fields has them in tables and stores, and `vibro diagram --show` draws one over a number",
            ));
        }
        Ok(fields.paths())
    }

    /// The quantities to compute: those of --fields, and that of the colours.
    pub(crate) fn fields(&self, fields: &[Quantity]) -> Vec<Quantity> {
        let mut all = fields.to_vec();
        all.extend(self.colour.filter(|quantity| !fields.contains(quantity)));
        all
    }
}
