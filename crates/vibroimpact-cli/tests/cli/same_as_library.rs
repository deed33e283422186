//! The command prints, writes and draws exactly what the library answers to the same plan, to the byte.

use crate::{S, vibro};
use serde_json::Value;
use vibroimpact::Scales;
use vibroimpact_plot::Figure;
use vibroimpact_report::{Shown, Table, Units, answer};
use vibroimpact_study::{Control, Plan};

/// A system in physical units: omega_n = 20 rad/s, F/k = 0.005 m.
const MACHINE: &str =
    "--mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 2.5 --gap-m 0.003 --restitution 0.6 --units si";

/// The units of an object.
fn units(object: &Value) -> Units {
    let scales = &object["system"]["scales"];
    let number = |key: &str| scales[key].as_f64();
    let scales = || Some(Scales { length: number("length_m")?, time: number("time_s")?, mass: number("mass_kg")? });
    let hertz = object["plan"]["units"]["hertz"] == true;
    // a plan in SI units has its machine; the units of other plans have none
    Units { scales: scales(), si: object["units"] == "si", hertz, ..Units::default() }
}

/// What a command prints and writes with all its outputs.
struct Written {
    printed: String,
    object: Value,
    table: Option<Vec<u8>>,
    figure: Option<Vec<u8>>,
}

impl Written {
    fn by(line: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let (csv, svg) = (folder.path().join("table.csv"), folder.path().join("figure.svg"));
        let mut command = vibro(line);
        command.arg("--json").arg("--csv").arg(&csv).arg("--plot").arg(&svg);
        let output = command.output().expect("vibro runs");
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let printed = String::from_utf8(output.stdout).expect("text");
        let object = serde_json::from_str(&printed).expect("one object");
        Self { printed, object, table: std::fs::read(&csv).ok(), figure: std::fs::read(&svg).ok() }
    }

    /// Compares it with the answer of the library.
    fn is(&self, line: &str, json: String, table: Option<Table<'_>>, figure: Option<Figure>) {
        assert_eq!(json + "\n", self.printed, "{line}");
        let table = table.map(|table| {
            let mut text = Vec::new();
            table.write(&mut text).expect("memory takes it");
            text
        });
        assert!(table == self.table, "the table of {line}");
        assert!(figure.map(|figure| figure.to_svg().into_bytes()) == self.figure, "the figure of {line}");
    }
}

/// Compares what a command prints and writes with the answer of the library to the printed plan.
fn same(line: &str) {
    let written = Written::by(line);
    let plan: Plan = serde_json::from_value(written.object["plan"].clone()).expect("a plan");
    let control = Control::default();
    let told = answer(&plan, units(&written.object), &control).expect("it was answered before");
    // a machine of the catalogue is called by its name
    let told = told.named(written.object["system"]["name"].as_str().unwrap_or_default());
    let (table, figure) = (told.table(&Shown::default()), told.figure(&Shown::default(), &control));
    written.is(line, told.json(), table.expect("it was written before"), figure.expect("it was drawn before"));
}

#[test]
fn of_machines() {
    let hammer = "--machine two-mass-hammer --set frequency=1.06";
    same(&format!("simulate {hammer} --impacts 20"));
    same(&format!("attractors {hammer} --starts 10"));
    same(&format!("orbit {hammer} --label 1/1"));
    same(&format!("margins {hammer} --vary b"));
    same("response --machine two-mass-hammer --axis frequency=1:1.2:3");
    same(&format!("lyapunov {hammer} --impacts 100 --points 30"));
    same("lyapunov --machine impact-pair --impacts 1000 --points 300");
    same(&format!("branch {hammer} --label 2/1 --orbit 1 --vary frequency --to 1.1 --also b=0.52 --follow 1"));
    same(&format!("diagram {hammer} --vary b --over 0.4:0.6:5 --also frequency=1:1.06 --transient 50"));
    same(&format!("curve {hammer} --label 2/1 --orbit 2 --kind fold --vary frequency=1:1.1 --and b=0.45:0.55"));
    let one = "--machine fukaya-irie-1971 --set inverse_beta=1.11";
    same(&format!("region {one} --label 1/1 --axis inverse_beta=1.05:1.2 --axis delta=1:2.5 --grid 4"));
    same(&format!("branch {one} --set delta=1 --label 1/1 --vary delta --to 2.5 --follow 1"));
    same("map --machine two-mass-hammer --axis frequency=0.9:1.2:4 --starts 2");
    same(&format!("basin {hammer} --axis q.head=-1:0.5:4"));
}

#[test]
fn of_one_motion() {
    same(&format!("simulate {S} --v 1 --impacts 20"));
    same("simulate --beta 0.9 --gap -0.5 --restitution 0.5 --periods 3");
    same(&format!("simulate {MACHINE} --x -0.01 --impacts 5"));
    same(&format!("settle {S} --v 1"));
    same(&format!("settle {MACHINE} --v 0.1"));
    same("lyapunov --inverse-beta 1.11 --gap 3 --restitution 0.5 --second-gap 4 --impacts 1000 --points 300");
    same(&format!("lyapunov {MACHINE} --impacts 1000 --points 30"));
}

#[test]
fn of_many_starts() {
    same(&format!("attractors {S} --starts 40 --seed 3"));
    same(&format!("attractors {MACHINE} --starts 10"));
    same(&format!("basin {S} --x -2:0.75:12 --v -2:2:9 --phase 1 --impacts 300"));
    same(&format!("basin {MACHINE} --x -0.0123:0.003:9 --v -0.13:0.17:7"));
}

#[test]
fn over_parameters() {
    same("map --inverse-beta 1:1.5:5 --gap 0:1:4 --restitution 0.5 --starts 3 --seed 2");
    same(
        "map --beta 0.1:10:4:log --restitution 0.2,0.5,0.9 --gap 1 --second-gap 2 --second-restitution 0.4 --starts 2",
    );
    same("diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0:3:31 --transient 100 --keep 16");
    same(&format!("diagram {MACHINE} --vary gap --over 0.001:0.0123:14 --direction up --transient 50"));
    same("diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0,0.2,0.75,3 --transient 100 --keep 16");
    same("diagram --gap 0 --restitution 0.8 --vary beta --over 2.5:3:7 --direction scatter --starts 3 --show strobe");
}

#[test]
fn of_orbits() {
    same(&format!("orbit {S} --label 1/1"));
    same(&format!("orbit {MACHINE} --label 1/1"));
    same("branch --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 --vary gap --to 1.9 --follow 1");
    same(
        "curve --inverse-beta 1.11 --gap 1.5 --restitution 0.5 --label 1/1 --kind flip --vary gap=1:2 --and inverse-beta=1.1:1.12",
    );
    same("region --label 1/1 --inverse-beta 1.05:1.2 --gap 1:2.5 --restitution 0.5 --grid 4");
    same(&format!("margins {S} --lines 20"));
    same(&format!("margins {MACHINE} --lines 20"));
}
