//! How fast the core is, question by question: `cargo bench -p vibroimpact`, or with a word of a name behind it.
//!
//! | what | file |
//! |---|---|
//! | one flight to its first contact | `first_contact` |
//! | one impact after another | `impact` |
//! | many motions side by side | `lanes` |
//! | which motion each start of a plane leads to | `basin` |
//! | which motions there are in the paper's plane | `map` |
//! | a chaotic motion measured and recognised | `chaos` |
//! | a motion with complete chatter | `chatter` |
//! | orbits found and followed | `branch` |
//! | events of machines | `machine`, `machine_problems` |
//!
//! Where a throughput is given, an element is an impact (a flight, a start, a point of the map where the name says so).

mod basin;
mod branch;
mod chaos;
mod chatter;
mod first_contact;
mod impact;
mod lanes;
mod machine;
mod machine_problems;
mod map;

use criterion::Criterion;
use std::time::Duration;
use vibroimpact::lanes::Width;

/// The widths of this machine, with the name each has in the reports.
fn widths() -> impl Iterator<Item = (Width, String)> {
    Width::ALL.into_iter().filter(|width| width.available()).map(|width| (width, format!("{width:?}").to_lowercase()))
}

fn main() {
    let mut criterion = Criterion::default()
        .sample_size(15)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_millis(1500))
        .configure_from_args();
    first_contact::bench(&mut criterion);
    impact::bench(&mut criterion);
    lanes::bench(&mut criterion);
    basin::bench(&mut criterion);
    map::bench(&mut criterion);
    chaos::bench(&mut criterion);
    chatter::bench(&mut criterion);
    branch::bench(&mut criterion);
    machine::bench(&mut criterion);
    criterion.final_summary();
}
