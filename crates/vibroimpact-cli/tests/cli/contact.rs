//! `vibro contact`: restitution, stiffness and damping of a contact.

use crate::{has, json, number, printed, refuse, rows};

const GIVEN: &str = "contact --restitution 0.6 --mass 0.8kg --stiffness 200N/mm";

#[test]
fn there_and_back() {
    let answer = json(GIVEN);
    let contacts = answer["contacts"].as_array().unwrap();
    assert_eq!(contacts.len(), 2);
    for contact in contacts {
        let [opening, damping] = ["opening", "damping"].map(|name| contact[name].to_string().replace('"', ""));
        let back = json(&format!(
            "contact --damping-ns-per-m {damping} --mass-kg 0.8 --stiffness-n-per-m 2e5 --opening {opening}"
        ));
        assert!((number(&back["contacts"][0]["restitution"]) - 0.6).abs() < 1e-14, "{back}");
        let time = contact["contact_time"].to_string();
        let by_time =
            json(&format!("contact --restitution 0.6 --mass-kg 0.8 --contact-time-s {time} --opening {opening}"));
        assert!((number(&by_time["contacts"][0]["stiffness"]) / 2e5 - 1.0).abs() < 1e-13, "{by_time}");
    }
}

#[test]
fn text_and_table() {
    has(&printed(GIVEN), &["by force", "by position", "contact time (s)"]);
    let table = printed(&format!("{GIVEN} --csv -"));
    let rows = rows(&table);
    assert!(rows.len() == 3 && rows.iter().all(|row| row.len() == rows[0].len()), "{table}");
    let never = printed("contact --damping-ratio 1.2 --mass-kg 1 --stiffness-n-per-m 10");
    assert!(never.contains("never opens"), "{never}");
}

#[test]
fn what_is_refused() {
    refuse([
        ("contact --mass-kg 1 --stiffness-n-per-m 5", "what does the contact lose?"),
        ("contact --restitution 0.5 --mass-kg 1", "the spring is not determined"),
        ("contact --restitution 0 --mass-kg 1 --stiffness-n-per-m 5", "0 lies outside 0 < value <= 1"),
        ("contact --restitution 0.5 --mass-kg -1 --stiffness-n-per-m 5", "-1 lies outside 1e-100 to 1e100"),
        ("contact --restitution 0.5 --mass-kg 1 --stiffness-n-per-m 5 --frequency-hz 3", "two of them give the third"),
        ("contact --damping-ratio 1.2 --mass-kg 1 --contact-time-s 0.1", "does not open by position"),
        ("contact --restitution 0.5 --frequency-hz 3 --speed-m-per-s 0", "speed = 0 lies outside"),
    ]);
}
