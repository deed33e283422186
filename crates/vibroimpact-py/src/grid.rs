//! A study computed in memory, as arrays.

use crate::columns::column;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::plan::{points, read, text};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use std::collections::BTreeSet;
use vibroimpact_report::task::basin::Measures;
use vibroimpact_study::basin::measures;
use vibroimpact_study::study::{Cells, Sheet, StudyTable, in_memory, label_of, meaning_of};
use vibroimpact_study::{Column, Field, Study};

/// An array with its description, flat and in row-major order.
#[derive(IntoPyObject)]
pub(crate) struct Variable<'py> {
    name: String,
    dimensions: Vec<(String, usize)>,
    values: Bound<'py, PyAny>,
    long_name: String,
    units: &'static str,
    scale: &'static str,
    comment: &'static str,
    flags: Vec<(i32, String)>,
}

/// Coordinates and variables.
type Variables<'py> = (Vec<Variable<'py>>, Vec<Variable<'py>>);

fn array(py: Python<'_>, values: Column) -> Bound<'_, PyAny> {
    match values {
        Column::I8(values) => values.into_pyarray(py).into_any(),
        Column::I32(values) => values.into_pyarray(py).into_any(),
        Column::F64(values) => values.into_pyarray(py).into_any(),
    }
}

/// The special values of a field and their meanings, and the labels m/n that occur.
fn flags(field: &Field, values: &Column) -> Vec<(i32, String)> {
    let own = field.flags.iter().map(|(value, meaning)| (*value, (*meaning).to_owned()));
    let labels: BTreeSet<i32> = if field.name == "label" {
        values.whole().iter().copied().filter(|code| *code > 0).collect()
    } else {
        BTreeSet::new()
    };
    own.chain(labels.into_iter().filter_map(|code| Some((code, meaning_of(code)?)))).collect()
}

fn variables(py: Python<'_>, sheet: Sheet) -> PyResult<Variables<'_>> {
    let along = coordinates(py, &sheet.study);
    Ok((along, arrays(py, sheet)?))
}

/// The coordinates of a study.
fn coordinates<'py>(py: Python<'py>, study: &Study) -> Vec<Variable<'py>> {
    let of = study.coordinates().into_iter().map(|along| Variable {
        dimensions: vec![(along.dimension, along.values.len())],
        name: along.name,
        values: along.values.into_pyarray(py).into_any(),
        long_name: along.long_name.into_owned(),
        units: along.unit.name,
        scale: along.unit.scale,
        comment: "",
        flags: Vec::new(),
    });
    of.collect()
}

/// The fields and tables of a study that has been computed.
pub(crate) fn arrays(py: Python<'_>, sheet: Sheet) -> PyResult<Vec<Variable<'_>>> {
    let grid: Vec<(String, usize)> =
        sheet.study.grid().dimensions.iter().map(|along| (along.name.clone(), along.count)).collect();
    let fields = sheet.fields.into_iter().zip(sheet.columns).map(|(field, values)| Variable {
        name: field.name.clone().into_owned(),
        dimensions: grid
            .iter()
            .cloned()
            .chain(field.extra.iter().map(|extra| (extra.name.to_owned(), extra.count)))
            .collect(),
        flags: flags(&field, &values),
        values: array(py, values),
        long_name: field.long_name.into_owned(),
        units: field.unit.name,
        scale: field.unit.scale,
        comment: field.comment,
    });
    let mut all: Vec<Variable<'_>> = fields.collect();
    for table in sheet.tables {
        all.push(of_table(py, table)?);
    }
    Ok(all)
}

fn of_table(py: Python<'_>, table: StudyTable) -> PyResult<Variable<'_>> {
    Ok(Variable {
        name: table.name.to_owned(),
        dimensions: table.dimensions.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect(),
        values: match table.values {
            Cells::Numbers(values) => array(py, values),
            Cells::Text(words) => words.into_pyobject(py)?.into_any(),
        },
        long_name: table.long_name.to_owned(),
        units: table.unit.name,
        scale: table.unit.scale,
        comment: "",
        flags: Vec::new(),
    })
}

/// Computes a plan in memory.
#[pyfunction]
pub(crate) fn fill<'py>(
    py: Python<'py>,
    plan: &str,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<Variables<'py>, Trouble> {
    let plan = read(plan)?;
    let watch = Watch { what: "computing a study", total: points(&plan), progress, threads };
    let sheet = door::run(py, watch, move |control| Ok(in_memory(Study::new(&plan)?, control)?))?;
    Ok(variables(py, sheet)?)
}

/// The labels of codes: m/n, "0", "chaotic", "stuck" or "undecided"; an empty text where there is no motion.
#[pyfunction]
pub(crate) fn labels_of(codes: Vec<i32>) -> Vec<String> {
    codes.into_iter().map(|code| label_of(code).unwrap_or_default()).collect()
}

/// The measures of a plane of numbers of motions, with `width` of them in each row, as JSON.
#[pyfunction]
pub(crate) fn basin_measures(cells: PyReadonlyArray1<'_, i64>, width: usize) -> Result<String, Trouble> {
    text(&Measures::from(measures(&cells.as_array().to_vec(), width)))
}

/// The values of a span, exactly the numbers that are used in the computation.
#[pyfunction]
pub(crate) fn span_values<'py>(py: Python<'py>, over: &str) -> Result<Bound<'py, PyArray1<f64>>, Trouble> {
    let span: vibroimpact_study::Span = over.parse()?;
    Ok(column(py, span.values()))
}
