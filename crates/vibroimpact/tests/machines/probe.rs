use crate::sticking::den_hartog;
use std::f64::consts::PI;
use vibroimpact::continuation::{BranchOptions, Direction, MachineBranch, MachineFamily};
use vibroimpact::events::MachineStart;
use vibroimpact::verdict::{MachineVerdict, SettleOptions, settle_machine};

#[test]
fn probe() {
    for beta in [0.8_f64, 0.7, 0.6, 0.55, 0.4, 0.3] {
        let (v, u) = (1.0 / (1.0 - beta * beta), (PI / beta).sin() / (beta * (1.0 + (PI / beta).cos())));
        let expected = beta * beta * v / (1.0 + beta.powi(4) * u * u).sqrt();
        println!("beta {beta} {expected}");
        for from in [0.5 * expected, 0.9 * expected, 0.5 * (1.0 + expected), 0.9] {
            for direction in [Direction::Up, Direction::Down] {
                let family = MachineFamily::new(move |value| Some(den_hartog(beta, value)));
                let verdict = settle_machine(&den_hartog(beta, from), &MachineStart::default(), &SettleOptions::default()).unwrap().verdict;
                let MachineVerdict::Periodic(cycle) = verdict else { println!("  {from} {}", verdict.label()); continue };
                match MachineBranch::new((&family, from), &cycle, &(0.001..=1.2), direction, BranchOptions::default()) {
                    Ok(branch) => {
                        println!("  {from} {direction:?} {}", cycle.events.len());
                        for p in branch { if let Some(e) = p.event { println!("     {e:?} {} {:e} {:?}", p.value, p.value - expected, p.cycle.events.iter().map(|e| (e.kind.name(), e.time)).collect::<Vec<_>>()); } }
                    }
                    Err(e) => println!("  {from} {direction:?} {e} {:?} {:?}", cycle.multipliers, cycle.events.iter().map(|e| (e.kind.name(), e.time, e.q[0])).collect::<Vec<_>>()),
                }
            }
        }
    }
}
