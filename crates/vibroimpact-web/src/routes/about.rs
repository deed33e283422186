//! The data that the page needs before its first request.

use crate::bounds::{MOST_IMPACTS, MOST_POINTS, MOST_STARTS};
use crate::packed::Named;
use crate::workshop::processors;
use axum::Json;
use serde_json::{Value, json};
use vibroimpact::quantities::Quantity;
use vibroimpact::scenario::{PAPER, Scenario};
use vibroimpact_plot::{Colour, ColourBar, GROUPS};
use vibroimpact_report::figure::coloured;

/// The points discussed in the 1971 paper, every group of labels in the order of a legend, every quantity of a motion with its SI
/// unit, the colours of the values of a quantity from the smallest to the largest, and the looks of values that are no finite
/// number; `hatch` is the colour of the lines over one.
pub(super) async fn about() -> Json<Value> {
    let point = |s: &Scenario| {
        json!({
            "name": s.name,
            "inverse_beta": s.inverse_beta,
            "gap": s.gap,
            "restitution": s.oscillator().restitution(),
            "motions": s.motions,
        })
    };
    let quantity = |quantity: Quantity| json!({ "name": quantity.name(), "description": quantity.description(), "unit": quantity.kind().unit() });
    let missing = |value: coloured::Value| {
        let (style, name) = value.look();
        let hatch = style.hatch.map(|hatch| hatch.colour.to_hex());
        json!({ "name": name, "colour": style.colour.to_hex(), "hatch": hatch })
    };
    Json(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "threads": processors(),
        "limits": { "points": MOST_POINTS, "starts": MOST_STARTS, "impacts": MOST_IMPACTS },
        "points": PAPER.iter().map(point).collect::<Value>(),
        "groups": GROUPS.map(Named::new),
        "quantities": Quantity::ALL.into_iter().map(quantity).collect::<Value>(),
        "colours": ColourBar::palette().into_iter().map(Colour::to_hex).collect::<Value>(),
        "missing": coloured::Value::MISSING.map(missing),
    }))
}
