//! Axes over numbers of a body.

use super::{MACHINE, Machine, both, near, unit};
use crate::{Folder, json, list, printed, refuse, rows};
use serde_json::Value;

/// A map in physical units, in memory and in a store: each number is the nondimensional one times its unit.
#[test]
fn a_map_in_hertz() {
    let folder = Folder::new();
    // omega_n = 8 rad/s
    let hertz = 8.0 / std::f64::consts::TAU;
    let tail = "--restitution 0.5 --starts 4 --fields impact-speed-max,power,displacement-rms,impulse-max";
    let machine = "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --damping-ratio 0.05";
    let si = format!("map {machine} --frequency-hz 0.8:1.6:3 --gap-m 0.25:0.75:3 {tail}");
    let (low, high) = (0.8 / hertz, 1.6 / hertz);
    let plain = printed(&format!("map --beta {low:?}:{high:?}:3 --gap 0.5:1.5:3 --damping 0.05 {tail} --csv -"));
    let table = printed(&format!("{si} --csv -"));
    let (plain, found) = (rows(&plain), rows(&table));
    let head = "frequency_hz,gap_m,label,share,impact_speed_max_m_per_s,power_w,displacement_rms_m,impulse_max_n_s";
    assert_eq!(found[0].join(","), head);
    assert_eq!(found[1][0], "0.8");
    assert_eq!(plain.len(), found.len());
    let (length, time, velocity) = (MACHINE.length(), MACHINE.time(), MACHINE.velocity());
    let factors = [hertz, length, 1.0, 1.0, velocity, velocity * velocity / time, length, velocity];
    for (a, b) in plain.iter().zip(&found).skip(1) {
        for ((a, b), factor) in a.iter().zip(b).zip(factors) {
            match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(a), Ok(b)) => assert!((a * factor / b - 1.0).abs() < 1e-12, "{a} {b} {factor}"),
                _ => assert_eq!(a, b),
            }
        }
    }
    folder.printed(&format!("{si} --store map.zarr --quiet"));
    assert_eq!(folder.printed(&format!("{si} --store map.zarr --csv -")), table);
}

/// A sweep in Hz moves the frequency ratio alone, in every command that varies a parameter.
#[test]
fn frequencies_in_hertz() {
    let hertz = 8.0 / std::f64::consts::TAU;
    let same = |si: &str, plain: &str, head: &str| {
        let [a, b] = [si, plain].map(|line| printed(&format!("{line} --csv -")));
        assert!(a.starts_with(head), "{si}: {a}");
        assert!(a.lines().count() == b.lines().count() && a.lines().count() > 3, "{si}");
    };
    let machine = "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --gap-m 0.75 --restitution 0.5";
    let (low, high) = (0.8 / hertz, 1.2 / hertz);
    same(
        &format!("diagram {machine} --vary frequency-hz --over 0.8:1.2:5 --keep 8"),
        &format!("diagram --gap 1.5 --restitution 0.5 --vary beta --over {low:?}:{high:?}:5 --keep 8"),
        "frequency_hz,sweep,kind,stop,phase,speed_m_per_s",
    );
    let begin = 1.146 / hertz;
    same(
        &format!("branch {machine} --frequency-hz 1.146 --label 1/1 --vary frequency-hz --to 1.2"),
        &format!("branch --gap 1.5 --restitution 0.5 --beta {begin:?} --label 1/1 --vary beta --to {high:?}"),
        "branch,frequency_hz,label",
    );
    same(
        "region --mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --restitution 0.5 --label 1/1 --frequency-hz 1.1:1.2 --gap-m 0.5:1.25 --grid 3",
        &format!("region --restitution 0.5 --label 1/1 --beta {:?}:{high:?} --gap 1:2.5 --grid 3", 1.1 / hertz),
        "region,polygon,hole,sheet,frequency_hz,gap_m,bound",
    );
    refuse([("diagram --gap 1 --restitution 0.5 --vary frequency-hz --over 1:2:3", "physical units")]);
}

/// The object of a command over the gaps of a machine, and over those of the oscillator; `extra` names what is asked.
fn over_gaps(machine: &Machine, (name, extra): (&str, &str), gaps: [f64; 2]) -> [Value; 2] {
    let gaps = gaps.map(|part| part * machine.length());
    let by_hand = gaps.map(|gap| gap / machine.length());
    let line = |flag: &str, [low, high]: [f64; 2]| format!("{flag} {low:?}:{high:?}:2 {extra}");
    let plain = format!("{name} {} {}", machine.by_hand(&["--gap"]), line("--gap", by_hand));
    let si = format!("{name} {} {}", machine.in_si(&["--gap-m"]), line("--gap-m", gaps));
    [json(&plain), json(&si)]
}

/// Random machines: a map and the sweeps of a response over the gap have the values of the nondimensional ones times
/// their units.
#[test]
fn random_machines_over_their_gap() {
    for machine in Machine::random() {
        let [plain, si] = over_gaps(&machine, ("map", "--starts 4"), [0.4, 1.1]);
        assert_eq!((&plain["labels"], &plain["coexisting"]), (&si["labels"], &si["coexisting"]), "{machine:?}");
        assert_eq!(si["axes"][0]["over"]["to"], 1.1 * machine.length());
        // what does not vary is listed in the units of the machine
        let fixed = ["mass_kg", "stiffness_n_per_m", "force_n", "omega_rad_per_s", "damping_ratio", "restitution"];
        let stated = [machine.mass, machine.stiffness, machine.force, machine.omega, machine.damping_ratio];
        for (name, value) in fixed.iter().zip(stated.into_iter().chain([machine.restitution])) {
            assert_eq!(si["system"][name], value, "{name}: {}", si["system"]);
        }
        for quantity in ["impact_speed_max", "power", "displacement_rms"] {
            let extra = format!("--quantity {quantity}");
            let [plain, si] = over_gaps(&machine, ("response", &extra), [0.4, 1.1]);
            let factor = unit(&machine, quantity).unwrap();
            for (a, b) in points(&plain).iter().zip(points(&si)) {
                assert_eq!(a["label"], b["label"], "{machine:?}");
                let both = (a["value"].as_f64(), b["value"].as_f64());
                let same = matches!(both, (Some(a), Some(b)) if near(a * factor, b)) || both == (None, None);
                assert!(same, "{quantity} of {}: {both:?} {machine:?}", a["label"]);
            }
        }
    }
}

/// The points of the sweeps of a response.
fn points(response: &Value) -> Vec<Value> {
    let points = list(&response["sweeps"]).iter().flat_map(|sweep| list(&sweep["points"]));
    let points: Vec<Value> = points.cloned().collect();
    assert_eq!(points.len(), 4);
    points
}

/// Random machines: the margins of a gap are those of the oscillator times the unit of length.
#[test]
fn random_machines_have_the_margins_of_the_oscillator() {
    let mut events = 0;
    for machine in Machine::random().filter(|machine| machine.damping_ratio > 0.0) {
        let plain = format!("margins {} --vary gap --lines 2", machine.by_hand(&[]));
        let si = format!("margins {} --vary gap-m --lines 2", machine.in_si(&[]));
        // the motion may be chaotic or have no branch
        let Some([plain, si]) = both(&plain, &si) else { continue };
        for way in ["down", "up"] {
            let [plain, si] = [&plain, &si].map(|found| &found["parameters"][0][way]);
            assert_eq!(plain["event"]["kind"], si["event"]["kind"], "{machine:?}");
            if let (Some(a), Some(b)) = (plain["at"].as_f64(), si["at"].as_f64()) {
                assert!((a * machine.length() / b - 1.0).abs() < 1e-9, "{a} {b}");
                events += 1;
            }
        }
    }
    assert!(events > 3, "{events} events");
}
