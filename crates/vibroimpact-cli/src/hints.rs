//! Hints with flags and commands, for errors of the library, whose messages name only parameters.

use std::fmt::Display;
use vibroimpact::SystemError;
use vibroimpact_report::ReportError;
use vibroimpact_report::number::short;
use vibroimpact_store::StoreError;
use vibroimpact_study::PlanError;

/// The text of an error. Its hint is replaced if the command has one of its own.
pub(crate) fn worded(error: &impl Display, hint: Option<String>) -> String {
    let text = error.to_string();
    match hint {
        Some(hint) => format!("{}\nhint: {hint}", text.split("\nhint: ").next().unwrap_or_default()),
        None => text,
    }
}

pub(crate) fn system(error: &SystemError) -> Option<String> {
    Some(match error {
        SystemError::Beta(_) => "beta = omega / omega_n; its inverse is given by --inverse-beta".to_owned(),
        SystemError::Quantity { name: "frequency omega", value, .. } => format!(
            "--frequency-hz takes a positive number of hertz; {} Hz was given",
            short(value / core::f64::consts::TAU)
        ),
        _ => return None,
    })
}

pub(crate) fn plan(error: &PlanError) -> Option<String> {
    Some(match error {
        PlanError::System(error) => return system(error),
        PlanError::Text(error) if !error.message.contains("\nhint: ") => {
            "`vibro schema` prints what may be in a plan".to_owned()
        }
        PlanError::Frequency(_) => "--beta B or --inverse-beta X, with X = 1/B".to_owned(),
        PlanError::Unforced => "--impacts N limits the number of events".to_owned(),
        PlanError::Size { .. } => "fewer values, or a store (--store), which holds any number".to_owned(),
        PlanError::Axes { .. } => "--axis PATH=A:B:N, once for each".to_owned(),
        PlanError::Nowhere { .. } => "--to another value".to_owned(),
        PlanError::NoOrbit { others, .. } => format!(
            "`vibro orbit` lists what there is; inadmissible solutions ({others} here) are followed only when their number is given"
        ),
        PlanError::NoSuchOrbit { .. } => "they are numbered from 1, as `vibro orbit` lists them".to_owned(),
        PlanError::NoEvent { .. } => "`vibro branch` lists the events".to_owned(),
        _ => return None,
    })
}

pub(crate) fn store(error: &StoreError) -> Option<String> {
    Some(match error {
        StoreError::Plan(error) => return plan(error),
        StoreError::Write { .. } => {
            "the tiles that are finished are kept; go on with `vibro resume` when that is mended".to_owned()
        }
        StoreError::Absent(place) => format!("`vibro run PLAN --store {place}` begins one"),
        StoreError::OtherPlan { place, .. } => {
            format!("`vibro status {place}` prints it; choose another folder for this one")
        }
        StoreError::DamagedTile { place, .. } => format!("`vibro resume {place}` computes the tile anew"),
        StoreError::Damaged { place, .. } => {
            format!("`vibro run PLAN --store {place}` with the plan it was made from mends it")
        }
        _ => return None,
    })
}

pub(crate) fn report(error: &ReportError) -> Option<String> {
    let hint = match error {
        ReportError::Plan(error) => return plan(error),
        ReportError::Order => "--csv takes any order",
        ReportError::Axes(_) => "--csv takes any number, and xarray opens a store",
        ReportError::Exponents => "`vibro export --csv`, or xarray, for more",
        ReportError::Scattered => "`vibro export --csv` has them all",
        ReportError::Points { .. } => "a longer --step, or fewer --periods or --impacts",
        _ => return None,
    };
    Some(hint.to_owned())
}
