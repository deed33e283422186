use crate::case::cases;
use vibroimpact::events::{MachineLimits, MachineMotion};
#[test]
fn debug() {
    let name = std::env::var("CASE").unwrap_or_default();
    for (_, all) in cases() {
        for case in all {
            if case.name == name {
                let mut m =
                    MachineMotion::new(&case.machine, &case.start, MachineLimits { time: 1e3, ..Default::default() })
                        .unwrap();
                for e in m.by_ref().take(std::env::var("N").map_or(30, |n| n.parse().unwrap())) {
                    println!(
                        "{} {} {:.12} {:e} q {:?} v {:?}",
                        e.kind.name(),
                        case.machine.name_of(e.place),
                        e.time,
                        e.speed,
                        e.q,
                        e.qdot
                    );
                }
                println!("{:?}", m.end());
            }
        }
    }
}
