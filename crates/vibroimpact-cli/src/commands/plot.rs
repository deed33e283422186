//! `vibro plot`: the figure of a store.

use super::stored;
use crate::args::{ColourArgs, FigureArgs};
use crate::failure::Failure;
use crate::picture::Picture;
use crate::session::Session;
use clap::Args;
use std::path::PathBuf;
use vibroimpact_report::figure::stored::figure;

/// Draw the figure of a store; of an incomplete store, the tiles that are done
#[derive(Clone, Debug, Args)]
pub(crate) struct Plot {
    /// The store
    #[arg(value_name = "STORE")]
    store: String,

    /// The file, .svg, .png or .pdf
    #[arg(value_name = "FILE")]
    file: PathBuf,

    #[command(flatten)]
    colour: ColourArgs,
    #[command(flatten)]
    look: FigureArgs,
}

pub(super) fn run(args: &Plot, session: &Session) -> Result<(), Failure> {
    let store = stored::open(&args.store)?;
    let colour = args.colour.coloured(true)?;
    let picture = Picture::reserve(&args.file, &args.look, session.force)?;
    picture.write(figure::<_, Failure>(&store, colour.as_ref())?)?;
    session.note(&format!("wrote {}", args.file.display()));
    Ok(())
}
