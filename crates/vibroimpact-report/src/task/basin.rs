//! The motions of a basin and their shares of its starts.

use crate::answer::BasinOf;
use crate::json::AxisObject;
use crate::json::motion::SharedMotion;
use crate::number::{Number, percent, short};
use crate::table::cycles::finite;
use crate::table::remarks;
use crate::task::certainty::{Certainty, certainty};
use crate::text::Teller;
use crate::text::words::aligned;
use crate::text::words::leading;
use crate::units::shown;
use crate::{AnswerOf, FieldName, Table, Told, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::verdict::Verdict;
use vibroimpact_study::basin::BasinMeasures;
use vibroimpact_study::{Basin, PlanError, counted};

/// The answer to `vibro basin`. Coordinates on no axis are those of the start.
#[derive(JsonSchema, Serialize)]
pub(crate) struct BasinAnswer<'a> {
    motions: Vec<SharedMotion<'a>>,
    starts: usize,
    axes: Vec<AxisObject>,
    /// Starts beyond a rigid stop.
    refused: usize,
    /// The number of the motion of each start, the first axis varying fastest; null beyond a rigid stop.
    cells: Vec<Option<usize>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    measures: Option<MeasureFields>,
}

/// Measures of the basins in a plane.
#[derive(JsonSchema, Serialize)]
pub struct MeasureFields {
    #[serde(flatten)]
    measures: Measures,
    #[serde(flatten)]
    certainty: Certainty,
}

/// Those that do not depend on the number of starts.
#[derive(JsonSchema, Serialize)]
pub struct Measures {
    /// Side of the boxes of the entropies, in starts.
    box_side: usize,
    entropy: f64,
    boundary_entropy: Option<f64>,
    uncertainty_exponent: Option<ExponentFields>,
    /// The comparison of the boundaries of at least three basins.
    #[serde(skip_serializing_if = "Option::is_none")]
    merging: Option<MergingFields>,
}

#[derive(JsonSchema, Serialize)]
struct ExponentFields {
    value: f64,
    error: f64,
}

/// How far the boundaries of the basins are from each other, in starts, and whether they count as one.
#[derive(JsonSchema, Serialize)]
struct MergingFields {
    motions: usize,
    radius: usize,
    limit: usize,
    common: f64,
    wada: bool,
}

impl From<BasinMeasures> for Measures {
    fn from(found: BasinMeasures) -> Self {
        Self {
            box_side: found.side,
            entropy: found.entropy,
            boundary_entropy: found.boundary_entropy,
            uncertainty_exponent: found.uncertainty.map(|of| ExponentFields { value: of.value, error: of.error }),
            merging: found.merging.map(|of| MergingFields {
                motions: of.motions,
                radius: of.radius,
                limit: of.limit,
                common: of.common,
                wada: of.wada(),
            }),
        }
    }
}

impl MeasureFields {
    pub(crate) fn of(found: &Basin) -> Option<Self> {
        let counts = found.by_count().into_iter().map(|m| found.motions[m].count);
        let certainty = Certainty::of(counts, found.cells.len() as u64);
        Some(Self { measures: found.measures()?.into(), certainty })
    }
}

impl<'a> BasinAnswer<'a> {
    /// The motions in order of falling numbers of starts.
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a BasinOf<D>) -> Self {
        let order = found.by_count();
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, motion)| places[*motion] = place);
        let shared = order.into_iter().map(|m| SharedMotion {
            motion: D::motion(of, &found.motions[m].verdict),
            share: found.share(m),
            starts: found.motions[m].count,
        });
        Self {
            motions: shared.collect(),
            starts: found.cells.len(),
            axes: AxisObject::all(&found.plan.axes, &of.units),
            refused: found.refused(),
            cells: (0..found.cells.len()).map(|k| found.motion(k).map(|number| places[number])).collect(),
            measures: D::measures(found),
        }
    }
}

/// Bytes of an ordinary row.
const ROW: usize = 64;

/// The table of `vibro basin`: what varies, in the units and with exactly the numbers of the question, the label, what stops and events
/// say more of it, and the quantities that the plan asks for; `refused` beyond a rigid stop.
pub(crate) fn table<'a, D: Told>(of: &'a AnswerOf<D>, found: &'a BasinOf<D>) -> Result<Table<'a>, PlanError> {
    let (axes, fields, units) = (&found.plan.axes, &found.plan.fields, &of.units);
    let remarks = remarks::<D>(found.motions.iter().map(|motion| &motion.verdict));
    let texts = axes.iter().map(|axis| {
        let values = shown(&axis.over, axis.vary.unit(units))?;
        Ok(values.all().into_iter().map(|value| format!("{},", Number(value))).collect())
    });
    let texts = texts.collect::<Result<Vec<Vec<String>>, PlanError>>()?;
    let cells = |values: &Vec<f64>| {
        let value =
            |(k, field): (usize, &D::Quantity)| values.get(k).map_or(f64::NAN, |value| value * field.unit(units));
        finite(&fields.iter().enumerate().map(value).collect::<Vec<_>>())
    };
    let quantities: Vec<String> = found.quantities.iter().map(cells).collect();
    // the label of each motion once, because a basin has millions of starts and few motions
    let labels: Vec<String> = found.motions.iter().map(|motion| motion.verdict.label().into_owned()).collect();
    let rows = (0..found.cells.len()).map(move |k| {
        let mut rest = k;
        let mut row = String::with_capacity(ROW);
        for values in &texts {
            row.push_str(&values[rest % values.len()]);
            rest /= values.len();
        }
        let motion = found.motion(k);
        match motion {
            Some(number) => row.push_str(&labels[number]),
            None => row.push_str(&found.label(k)),
        }
        let (stops, _) = motion.map(|number| D::remark(&found.motions[number].verdict)).unwrap_or_default();
        row.push_str(&remarks.cells(&of.system, &(stops, found.seen_events.get(k).copied().flatten())));
        match motion {
            Some(number) => row.push_str(&quantities[number]),
            None => (0..fields.len()).for_each(|_| row.push(',')),
        }
        row
    });
    let varied = axes.iter().map(|axis| axis.vary.column(units).to_owned());
    let own = ["label"].into_iter().chain(remarks.heads()).map(str::to_owned);
    let header: Vec<String> = varied.chain(own).chain(fields.iter().map(|field| field.column(units))).collect();
    Ok(Table::new(header.join(","), rows))
}

/// One row for each motion with the number and the share of its starts, how certain the shares are, and what is told beside it.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &Basin<D::System, D::Coordinate, D::Quantity>) -> String {
    let motion = |m: usize| (&found.motions[m].verdict, found.motions[m].count, found.share(m));
    let motions: Vec<_> = found.by_count().into_iter().map(motion).collect();
    let counts: Vec<u64> = motions.iter().map(|motion| motion.1).collect();
    let heads = ["share", "starts", "<label", "<meaning"].map(str::to_owned);
    let row = |(verdict, count, share): &(&Verdict<D::System>, u64, f64)| {
        let meaning = D::meaning(of, verdict) + &D::by_stop(of, verdict);
        vec![percent(*share), count.to_string(), verdict.label().into_owned(), meaning]
    };
    let motions = leading(motions, |motion| motion.2, |motion| matches!(motion.0, Verdict::Undecided(_)));
    let total = counts.iter().sum();
    let table = aligned(&heads, &motions.rows(row, "motion", (2, 0, heads.len())));
    table + &certainty(counts.into_iter(), total) + &D::of_basin(found)
}

/// The entropies and the uncertainty exponent.
pub(crate) fn sentences(of: &BasinMeasures) -> String {
    let Some(boundary) = of.boundary_entropy else { return String::new() };
    let mut text = format!(
        "\n  basin entropy {}, boundary entropy {} in boxes of {} x {} starts\n",
        short(of.entropy),
        short(boundary),
        of.side,
        of.side
    );
    if boundary > core::f64::consts::LN_2 {
        text.push_str("  the boundary entropy exceeds ln 2: the boundary is fractal at this resolution\n");
    }
    if let Some(exponent) = &of.uncertainty {
        text.push_str(&format!(
            "  uncertainty exponent {} +- {} (1 for a smooth boundary)\n",
            short(exponent.value),
            short(exponent.error)
        ));
    }
    if let Some(of) = &of.merging {
        let said = if of.wada() { "all basins have one boundary (Wada)" } else { "the basins have several boundaries" };
        text.push_str(&format!(
            "  merging method, {} motions: boundaries differ by up to {}, {} of their starts lie within {} of all: {said} at this resolution\n",
            of.motions,
            counted(of.radius as u64, "start"),
            percent(of.common),
            of.limit
        ));
    }
    text
}
