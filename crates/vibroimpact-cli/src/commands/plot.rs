//! `vibro plot`: the figure of a store.

use super::stored;
use crate::args::{ColourArgs, FigureArgs, OverlayArgs};
use crate::failure::Failure;
use crate::picture::Picture;
use crate::session::Session;
use clap::Args;
use std::path::PathBuf;
use vibroimpact_report::figure::stored::figure;
use vibroimpact_study::Control;

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
    overlay: OverlayArgs,
    #[command(flatten)]
    look: FigureArgs,
}

pub(super) fn run(args: &Plot, session: &Session) -> Result<(), Failure> {
    let store = stored::open(&args.store)?;
    let colour = args.colour.coloured(true)?;
    let overlay = args.overlay.overlay(true, colour.is_some())?;
    stored::check_overlay(&overlay, store.plan(), colour.is_some())?;
    let picture = Picture::reserve(&args.file, &args.look, session.force)?;
    let drawn = |control: &Control<'_>| figure::<_, Failure>(&store, colour.as_ref(), &overlay, control);
    picture.write(session.watched(None, drawn)?)?;
    session.note(&format!("wrote {}", args.file.display()));
    Ok(())
}
