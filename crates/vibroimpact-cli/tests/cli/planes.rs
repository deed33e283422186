//! Tests of `vibro curve` and `vibro region` in a plane of two parameters.

use crate::{has, json, list, number, printed, refuse, refused, rows};
use serde_json::Value;

const FOLD: &str = "curve --inverse-beta 0.7 --gap 2 --restitution 0.5 --label 1/1 --kind fold --vary gap=0:5 \
                    --and inverse-beta=0.45:0.9";

#[test]
fn one_of_several_events() {
    let line = "curve --inverse-beta 1.3 --gap 1 --restitution 0.5 --label 1/1 --kind grazing --vary gap=-0.5:4 \
                --and inverse-beta=1.2:1.4";
    let nearest = json(line);
    assert_eq!((&nearest["through"]["event"], list(&nearest["found_at"]).len()), (&1.into(), 2));
    let other = json(&format!("{line} --event 2"));
    assert_eq!(other["through"]["event"], 2);
    let place = usize::try_from(other["through"]["point"].as_u64().unwrap()).unwrap();
    assert!((number(&other["points"][place]["values"][0]) - number(&other["found_at"][1])).abs() < 1e-9);
    refused(&format!("{line} --event 3"));
}

#[test]
fn text_and_tables() {
    let sentences = ["fold of 1/1 (orbit 2 of 2, stable there)", "found at gap 3.14214107148", "resonant grazing"];
    has(&printed(FOLD), &sentences);
    let table = printed(&format!("{FOLD} --csv -"));
    assert!(table.starts_with("gap,inverse_beta,label,admissible,event,multiplier_1_re"), "{table}");
    has(&table, &[",resonant grazing,"]);
    let rows = rows(&table);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
}

const REGION: &str = "region --label 1/1 --inverse-beta 1.05:1.2 --gap 1:2.5 --restitution 0.5 --grid 4";

#[test]
fn the_regions_of_one_impact_a_period() {
    let answer = json(REGION);
    assert_eq!((&answer["label"], &answer["parameters"][0]), (&"1/1".into(), &"inverse_beta".into()));
    assert_eq!((&answer["system"]["gap"], &answer["system"]["restitution"]), (&Value::Null, &0.5.into()));
    let polygon = &answer["stability"]["polygons"][0];
    let bounds = list(&polygon["bounds"]);
    assert_eq!(bounds.len(), list(&polygon["vertices"]).len());
    assert!(bounds.contains(&"flip".into()) && bounds.contains(&"frame".into()));
    let task = &answer["plan"]["task"]["region"];
    assert_eq!((&task["across"]["parameter"], &task["up"]["to"]), (&"inverse_beta".into(), &2.5.into()));
}

#[test]
fn a_region_as_text_and_table_for_any_threads() {
    let head = "1/1 over inverse beta from 1.05 to 1.2, gap from 1 to 2.5";
    has(&printed(REGION), &[head, "existence\n", "stability\n", "flip"]);
    let table = printed(&format!("{REGION} --csv - --threads 1"));
    assert!(table.starts_with("region,polygon,hole,sheet,inverse_beta,gap,bound\nexistence,1,false,below,"), "{table}");
    assert_eq!(printed(&format!("{REGION} --csv - --threads 2")), table);
    // ranges replace the values of the system
    let body = "--mass-kg 1 --stiffness-n-per-m 100 --force-n 2 --omega-rad-per-s 9 --gap-m 0.03 --restitution 0.5";
    let si = printed(&format!("region --label 1/1 {body} --units si --inverse-beta 1.05:1.2 --gap 0.02:0.05 --grid 4"));
    has(&si, &["1/1 over inverse beta from 1.05 to 1.2, gap (m) from 0.02 to 0.05\n"]);
    let other = printed("region --label 1/2 --inverse-beta 1.11 --gap 2:3 --restitution 0.4:0.6 --grid 3 --csv -");
    assert!(other.starts_with("region,polygon,hole,sheet,gap,restitution,bound\n") && other.lines().count() > 10);
}

/// The oscillator as a machine has the same regions, over numbers with paths.
#[test]
fn a_region_of_a_machine() {
    let line = "region --machine fukaya-irie-1971 --label 1/1 --axis inverse_beta=1.05:1.2 --axis delta=1:2.5 --grid 4";
    let (own, plain) = (json(line), json(REGION));
    assert_eq!(own["parameters"], serde_json::json!(["inverse_beta", "delta"]));
    assert_eq!((&own["label"], &own["neutrally_stable"]), (&plain["label"], &plain["neutrally_stable"]));
    let count = |answer: &Value| list(&answer["stability"]["polygons"]).len();
    assert_eq!(count(&own), count(&plain));
    has(&printed(line), &["1/1 over inverse_beta from 1.05 to 1.2, delta from 1 to 2.5\n"]);
    let head = "region,polygon,hole,sheet,inverse_beta,delta,bound\nexistence,1,false,below,";
    has(&printed(&format!("{line} --csv -")), &[head]);
    let one = "region --machine fukaya-irie-1971 --label 1/1 --axis delta=1:2.5";
    refuse([(one, "--axis PATH=A:B is given 1 times")]);
}

/// Regression test (item 6): "existence: none found" for the motion without impacts, which `orbit --label 0` finds
/// stable.
#[test]
fn f06_the_region_of_the_motion_without_impacts() {
    let line = "region --label 0 --damping 0.05 --beta 1.5:3 --gap 0.5:2 --restitution 0.5";
    let text = printed(line);
    assert!(text.contains("touch") && !text.contains("none"), "{text}");
    // the same in other planes, and without loss of energy
    let undamped = printed(&line.replace("--damping 0.05 ", ""));
    has(&undamped, &["stability: none, the motion is neutral where", "existence\n"]);
    let never = printed("region --label 0 --damping 0:0.1 --beta 1:1.1 --gap 0.5 --restitution 0.5");
    has(&never, &["existence: none, the amplitude of the motion without impacts exceeds a gap"]);
}

/// A related regression test: without damping, `branch` and `curve` of label 0 reported that there was nothing to
/// follow.
#[test]
fn f06b_what_begins_with_no_impact_without_damping() {
    for line in [
        "branch --label 0 --beta 2 --gap 1 --restitution 0.5 --vary gap --to 0.1",
        "curve --label 0 --beta 2 --gap 1 --restitution 0.5 --kind grazing --vary gap=0:2 --and beta=1.5:3",
    ] {
        let many = "without damping the steady motion without impacts is one of many";
        has(&refused(line), &[many, "hint: a damping above 0"]);
    }
}

/// Regression test (item 10): refused with "the cycle given does not solve its equations at these parameters".
#[test]
fn f10_a_grazing_curve_over_the_restitution() {
    let answer = json(
        "curve --inverse-beta=0.6326450838473209 --gap=1.422755681087771 --restitution=0.5 --label 1/1 --kind grazing \
         --vary gap=-0.8:3.0 --and restitution=0.3:0.7 --event 2",
    );
    let points = list(&answer["points"]);
    // delta = |f| for any restitution
    assert!(points.iter().all(|point| (number(&point["values"][0]) - 0.667_333_049_989_617_4).abs() < 1e-12));
    for (at, value) in [(0, 0.3), (points.len() - 1, 0.7)] {
        let end = number(&points[at]["values"][1]);
        assert!((end - value).abs() < 1e-12 || (end - (1.0 - value)).abs() < 1e-12, "{end}");
    }
}

/// Regression test (item 12): took 46 s and found nothing.
#[test]
fn f12_a_region_over_tiny_restitutions() {
    let line = "region --label 1/1 --inverse-beta=0.8366542825959349 --gap=1e-9:1 --restitution=0:1e-12 --grid=8";
    let answer = json(line);
    for kind in ["existence", "stability"] {
        assert_eq!(list(&answer[kind]["polygons"]).len(), 1);
        assert_eq!(list(&answer[kind]["unresolved"]).len(), 0);
    }
}
