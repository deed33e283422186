//! A motion over time: one row for each point.

use super::Table;
use crate::figure;
use crate::number::Number;
use crate::{ReportError, Units};
use vibroimpact::motion::sample;
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, QuantityKind, Start};

/// Maximum number of points of a waveform.
const MOST_POINTS: f64 = 1e7;

/// The table of `vibro simulate`: the motion from a start until a time, at equal steps and at its events.
///
/// # Errors
/// [`ReportError::Points`] for more than ten million points.
pub fn table(
    osc: &Oscillator,
    start: Start,
    (until, step): (f64, f64),
    units: Units,
) -> Result<Table<'static>, ReportError> {
    if until / step > MOST_POINTS || until.is_nan() {
        return Err(ReportError::Points { step, until, most: MOST_POINTS });
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 1e7
    let wave = sample(osc, start, until, step, 3 * MOST_POINTS as usize);
    let rows = wave.into_iter().map(move |point| {
        format!(
            "{},{},{}",
            Number(point.time * units.time()),
            Number(point.x * units.length()),
            Number(point.v * units.velocity())
        )
    });
    let time = if units.si { "time_s" } else { "time" };
    let (x, v) = (units.column("x", QuantityKind::Length), units.column("v", QuantityKind::Velocity));
    Ok(Table::new(format!("{time},{x},{v}"), rows))
}

/// The table of `vibro settle`: the settled motion, from its last event before it was recognised, for the duration
/// shown in the figure.
///
/// # Errors
/// [`ReportError::Points`] for more than ten million points.
pub fn steady(osc: &Oscillator, start: Start, settled: &Settled, units: Units) -> Result<Table<'static>, ReportError> {
    let (from, (_, shown)) = figure::settle::steady(osc, start, settled);
    table(osc, from, (shown, osc.period() / 100.0), units)
}
