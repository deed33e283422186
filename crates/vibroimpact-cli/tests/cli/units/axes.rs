//! Axes over numbers of a body.

use super::MACHINE;
use crate::{Folder, json, printed, refuse, rows};

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
    // what does not vary is listed in the units of the machine
    let fixed =
        serde_json::json!({ "mass_kg": 1.0, "stiffness_n_per_m": 64.0, "force_n": 32.0, "damping_ratio": 0.05 });
    let system = json(&si)["system"].clone();
    assert!(fixed.as_object().unwrap().iter().all(|(name, value)| &system[name] == value), "{system}");
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
