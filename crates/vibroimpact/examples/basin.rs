//! A basin of attraction: which start leads to which motion, drawn with letters.
//!
//!     cargo run --release -p vibroimpact --example basin
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

use vibroimpact::lanes::Width;
use vibroimpact::verdict::{KnownAttractors, SettleOptions, settle_many};
use vibroimpact::{Oscillator, Start};

const COLUMNS: u64 = 72;
const ROWS: u64 = 32;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5)?;
    #[allow(clippy::cast_precision_loss, reason = "small whole numbers")]
    let start = |k: u64| {
        let (column, row) = ((k % COLUMNS) as f64 / (COLUMNS - 1) as f64, (k / COLUMNS) as f64 / (ROWS - 1) as f64);
        Start { x: -4.0 + 4.75 * column, v: 4.0 - 8.0 * row, phase: 0.0 }
    };
    let options = SettleOptions::default();
    let found =
        settle_many(&osc, 0..COLUMNS * ROWS, &start, &KnownAttractors::default(), &options, Width::best(), &|| false);
    let letters: Vec<char> = ('a'..='z').collect();
    for row in found.cells.chunks(usize::try_from(COLUMNS)?) {
        println!("{}", row.iter().map(|&motion| letters[motion as usize % 26]).collect::<String>());
    }
    for (letter, motion) in letters.iter().zip(&found.motions) {
        println!("{letter}: {}, {} starts", motion.verdict.label(), motion.count);
    }
    Ok(())
}
