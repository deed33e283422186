//! Command lines with ranges: basin, map, diagram, region, curve, response and settle-many.

use super::parts::{Words, all, flag, flags, line, outputs, start, switch, word};
use crate::system::{parameter, system, without};
use crate::values::{ProptestText, count, interval, label, range};
use proptest::prelude::*;

/// Any of these command lines.
pub(super) fn lines() -> Words {
    prop_oneof![3 => basin(), 3 => map(), 3 => diagram(), 2 => region(), 2 => curve(), 1 => response(), 2 => many()]
        .boxed()
}

fn few() -> ProptestText {
    prop_oneof![5 => word(&["1", "2", "3"]), 1 => count()].boxed()
}

fn budget() -> ProptestText {
    prop_oneof![4 => word(&["1", "60", "200", "1500"]), 1 => count()].boxed()
}

/// The flags of a store in the current folder.
fn store() -> Words {
    let asked = all(vec![
        flag("store", 1.0, word(&["s.zarr", "s.zarr", "ünï.zarr", "none/s.zarr", "", "."])),
        flag("tile", 0.5, word(&["1", "2", "4096", "4097", "0", "-1"])),
        flag("refine", 0.2, word(&["2", "3", "64", "65", "0"])),
        flag("shard", 0.3, word(&["1", "2", "1024", "1025", "0"])),
        flag("budget", 0.2, word(&["0.001s", "1h", "0s", "8"])),
    ]);
    prop_oneof![4 => Just(Vec::new()), 1 => asked].boxed()
}

fn basin() -> Words {
    let system = super::parts::system();
    line(
        "basin",
        vec![
            system,
            flag("x", 0.98, range(-4.0, -0.5)),
            flag("v", 0.98, range(-4.0, 4.0)),
            flag("phase", 0.3, crate::values::number()),
            flag("impacts", 0.6, budget()),
            fields(),
            colour(),
            store(),
            outputs("csv"),
        ],
    )
}

/// Quantities to report.
fn fields() -> Words {
    flag("fields", 0.2, word(&["power", "impact-speed-max,displacement_rms", "speed", "", "power,power"]))
}

/// A system in which this number of parameters vary over ranges.
fn varied(
    most: usize,
    over: fn(f64, f64) -> ProptestText,
) -> BoxedStrategy<(Vec<(&'static str, String)>, crate::system::SystemValues)> {
    (
        prop::collection::vec(parameter().prop_flat_map(move |(name, low, high)| (Just(name), over(low, high))), most),
        system(),
    )
        .prop_map(|(mut over, system)| {
            let mut seen: Vec<&str> = Vec::new();
            // without this, nine of ten would be refused for a parameter that is given twice
            over.retain(|(name, _)| {
                let same = |other: &&str| other == name || other.ends_with("beta") && name.ends_with("beta");
                let new = !seen.iter().any(same);
                seen.push(*name);
                new
            });
            let names: Vec<&str> = over.iter().map(|(name, _)| *name).collect();
            let system = without(system, &names);
            (over, system)
        })
        .boxed()
}

/// The quantity in the colours of which a figure is drawn.
fn colour() -> Words {
    all(vec![
        flag("colour", 0.1, word(&["power", "impact-speed-max", "impact-speed-mean", "impacts-per-period", "speed"])),
        flag("of", 0.05, word(&["largest", "smallest", "likeliest", "worst", "all"])),
        flag("colour-range", 0.05, word(&["0:1", "-1:2", "1:1", "2:1", "a:b", ""])),
    ])
}

fn map() -> Words {
    let nondimensional = (1..3_usize)
        .prop_flat_map(|n| varied(n, range))
        .prop_map(|(over, system)| [flags(&over), flags(&system)].concat());
    let system = prop_oneof![3 => nondimensional, 1 => super::parts::machine_with_ranges()];
    line(
        "map",
        vec![
            system.boxed(),
            flag("starts", 0.97, few()),
            flag("seed", 0.2, count()),
            flag("impacts", 0.6, budget()),
            flag("axes", 0.05, word(&["gap,inverse-beta", "gap", "mass", ""])),
            fields(),
            colour(),
            overlay(),
            store(),
            outputs("csv"),
        ],
    )
}

/// What lies over the figure of a map.
fn overlay() -> Words {
    all(vec![
        flag("layers", 0.08, word(&["paper", "amplitude,stripes", "boundaries", "none", "none,paper", "lines", ""])),
        flag("mark", 0.08, word(&["1,1", "0.5,0.5", "-1,1", "1e300,0", "nan,1", "1", ""])),
        flag("line", 0.08, word(&["0,0:3,3", "1,1:1,1", "0,-1:1e300,2", "-5,0:-4,0", "1,2", ""])),
    ])
}

fn diagram() -> Words {
    let machine =
        (super::parts::machine(), word(&["force-n", "mass-kg", "gap-m", "frequency-hz", "gaps-m"]), range(0.1, 3.0))
            .prop_map(|(system, name, range)| {
                [system, vec![format!("--vary={name}"), format!("--over={range}")]].concat()
            });
    let values = |low: f64, high: f64| {
        let list = (range(low, high), 0..3_usize)
            .prop_map(|(text, k)| [&text, "0.2,0.5,1.1", "0.5,0.2,0.3"][k].replace(':', ","));
        prop_oneof![3 => range(low, high), 1 => list].boxed()
    };
    let nondimensional = varied(1, values).prop_map(|(over, system)| {
        let mut words = flags(&system);
        for (name, values) in over {
            words.extend([format!("--vary={}", name.replace('_', "-")), format!("--over={values}")]);
        }
        words
    });
    let system = prop_oneof![4 => nondimensional, 1 => machine];
    line(
        "diagram",
        vec![
            system.boxed(),
            flag("also", 0.1, word(&["gap=1:2", "restitution=0.5:0.4", "damping=0:0.1", "gap=1", "mass-kg=1:2"])),
            flag("direction", 0.5, word(&["up", "down", "both", "scatter", "left"])),
            flag("starts", 0.1, few()),
            flag("show", 0.4, word(&["velocity", "strobe", "power", "impact-speed-max", "all"])),
            flag("branches", 0.05, word(&["1/1", "1/1,2/1", "3/0", "inf/1", ""])),
            flag("transient", 0.9, word(&["0", "10", "100", "-1", "1000001"])),
            flag("keep", 0.7, word(&["1", "5", "64", "0", "100001"])),
            store(),
            outputs("csv"),
        ],
    )
}

fn region() -> Words {
    let system = varied(2, interval).prop_map(|(over, system)| [flags(&over), flags(&system)].concat());
    line(
        "region",
        vec![
            system.boxed(),
            flag("label", 0.98, label()),
            flag("grid", 0.97, word(&["2", "3", "4", "1", "401", "-1"])),
            flag("axes", 0.05, word(&["gap,inverse-beta", "gap", ""])),
            outputs("csv"),
        ],
    )
}

fn many() -> Words {
    let of_system = varied(2, interval).prop_map(|(over, system)| [flags(&over), flags(&system)].concat());
    let (drawn, machine) = (of_system.boxed(), super::parts::machine_with_ranges());
    let sample = flag("sample", 0.97, word(&["lhs:7", "sobol:4", "lhs:1", "sobol:0", "lhs:1e10", "sobol:x", "grid:3"]));
    let sampled = all(vec![prop_oneof![5 => drawn, 1 => machine].boxed(), sample]);
    let listed = all(vec![
        flag("points", 1.0, word(&["points.csv", "points.csv", "bad.csv", "none.csv", "plan.toml", ""])),
        flag("restitution", 0.9, crate::values::restitution()),
    ]);
    let start = || prop_oneof![3 => interval(-2.0, 0.0), 2 => crate::values::number()].boxed();
    line(
        "settle-many",
        vec![
            prop_oneof![3 => sampled, 1 => listed].boxed(),
            flag("x", 0.2, start()),
            flag("v", 0.4, start()),
            flag("phase", 0.2, start()),
            flag("seed", 0.2, count()),
            flag("impacts", 0.8, budget()),
            fields(),
            switch("transient", 0.2),
            store(),
            flag("csv", 0.3, word(&["-", "t.csv", ""])),
            switch("json", 0.4),
        ],
    )
}

fn response() -> Words {
    let nondimensional = varied(1, range).prop_map(|(over, system)| [flags(&over), flags(&system)].concat()).boxed();
    let machine = super::parts::machine_with_ranges();
    line(
        "response",
        vec![
            prop_oneof![3 => nondimensional, 1 => machine].boxed(),
            flag("quantity", 0.4, word(&["power", "impact-speed-max", "sticking_fraction", "speed", ""])),
            outputs("csv"),
        ],
    )
}

fn curve() -> Words {
    let system = (varied(2, interval), start()).prop_map(|((over, system), _)| {
        let names = ["--vary", "--and"];
        let ranges =
            over.iter().zip(names).map(|((name, range), flag)| format!("{flag}={}={range}", name.replace('_', "-")));
        // the orbit is searched in the middle of both ranges
        let middle = |(name, range): &(&'static str, String)| {
            let (a, b) = range.split_once(':')?;
            let at = 0.5 * (a.parse::<f64>().ok()? + b.parse::<f64>().ok()?);
            Some((*name, at.to_string()))
        };
        let values: Vec<_> = over.iter().filter_map(middle).chain(system).collect();
        ranges.chain(flags(&values)).collect::<Vec<_>>()
    });
    line(
        "curve",
        vec![
            system.boxed(),
            flag("label", 0.98, label()),
            flag("kind", 0.98, word(&["fold", "flip", "grazing", "cusp"])),
            flag("orbit", 0.05, count()),
            flag("event", 0.1, count()),
            switch("json", 0.3),
            outputs("csv"),
        ],
    )
}
