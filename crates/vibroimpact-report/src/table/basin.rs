//! A basin: one row for each start, in the order of the cells.

use super::Table;
use super::orbits::finite;
use super::remarks::remarks;
use crate::answer::{AnswerOf, BasinOf, Told};
use crate::number::Number;
use crate::units::shown;
use crate::{FieldName, Varied};
use vibroimpact_study::PlanError;

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
