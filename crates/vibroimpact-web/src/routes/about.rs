//! The data that the page needs before its first request.

use crate::bounds::{MOST_IMPACTS, MOST_POINTS, MOST_STARTS};
use crate::packed::Named;
use crate::workshop::processors;
use axum::Json;
use serde::Serialize;
use vibroimpact::quantities::Quantity;
use vibroimpact::scenario::{PAPER, Scenario};
use vibroimpact_plot::{Colour, ColourBar, GROUPS};
use vibroimpact_report::figure::coloured::Value;

#[derive(Serialize)]
pub(super) struct About {
    version: &'static str,
    threads: usize,
    limits: Limits,
    /// The points discussed in the 1971 paper.
    points: Vec<Point>,
    /// Every group of labels in the order of a legend.
    groups: Vec<Named>,
    /// Every quantity of a motion, with its SI unit.
    quantities: Vec<QuantityName>,
    /// The colours of the values of a quantity, from the smallest to the largest.
    colours: Vec<String>,
    /// The looks of values that are no finite number.
    missing: Vec<Missing>,
}

#[derive(Serialize)]
struct Missing {
    name: &'static str,
    colour: String,
    /// The colour of the lines over it.
    hatch: Option<String>,
}

#[derive(Serialize)]
struct QuantityName {
    name: &'static str,
    description: &'static str,
    unit: &'static str,
}

#[derive(Serialize)]
struct Limits {
    points: u64,
    starts: u64,
    impacts: u64,
}

#[derive(Serialize)]
struct Point {
    name: &'static str,
    inverse_beta: f64,
    gap: f64,
    restitution: f64,
    motions: &'static [&'static str],
}

pub(super) async fn about() -> Json<About> {
    let point = |s: &Scenario| Point {
        name: s.name,
        inverse_beta: s.inverse_beta,
        gap: s.gap,
        restitution: s.oscillator().restitution(),
        motions: s.motions,
    };
    let quantity = |quantity: Quantity| QuantityName {
        name: quantity.name(),
        description: quantity.description(),
        unit: quantity.kind().unit(),
    };
    let missing = |value: Value| {
        let (style, name) = value.look();
        Missing { name, colour: style.colour.to_hex(), hatch: style.hatch.map(|hatch| hatch.colour.to_hex()) }
    };
    Json(About {
        version: env!("CARGO_PKG_VERSION"),
        threads: processors(),
        limits: Limits { points: MOST_POINTS, starts: MOST_STARTS, impacts: MOST_IMPACTS },
        points: PAPER.iter().map(point).collect(),
        groups: GROUPS.into_iter().map(Named::new).collect(),
        quantities: Quantity::ALL.into_iter().map(quantity).collect(),
        colours: ColourBar::palette().into_iter().map(Colour::to_hex).collect(),
        missing: Value::MISSING.map(missing).into(),
    })
}
