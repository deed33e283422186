//! `vibro explore`: the explorer, a page on a local port.

use crate::failure::Failure;
use crate::session::Session;
use crate::signal;
use clap::Args;
use vibroimpact_web::{BoundServer, PORT};

/// Explore the map of motions on a page in the browser
///
/// The server serves one page to this machine only, opens it in the browser and prints its address. On the page you zoom
/// into the map of motions over any two parameters, click on a point to see its motion, its basin and the motions that
/// coexist, and draw a line for a bifurcation diagram. The address of the page holds everything that is shown. Ctrl-C
/// ends the server.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro explore [--port N] [--no-open]",
    after_help = "Examples:\n  vibro explore\n  vibro explore --no-open --port 0"
)]
pub(crate) struct Explore {
    /// The port; one of the next where it is busy, and 0 for any that is free
    #[arg(long, value_name = "N", default_value_t = PORT)]
    port: u16,

    /// Print the address only
    #[arg(long)]
    no_open: bool,
}

pub(super) fn run(args: &Explore, session: &Session) -> Result<(), Failure> {
    let cannot = |error: std::io::Error| Failure::Failed(format!("cannot serve the page: {error}"));
    let bound = BoundServer::new(args.port).map_err(cannot)?;
    let url = bound.url();
    session.print(&format!("{url}\n"))?;
    session.note("Ctrl-C ends the explorer");
    if !args.no_open && open::that_detached(&url).is_err() {
        session.note("hint: no browser could be opened here; open the address yourself");
    }
    bound.serve(session.threads(), signal::flag()).map_err(cannot)
}
