//! The file of a machine.

use core::fmt::Write;
use vibroimpact::events::Start;
use vibroimpact::machine::{ImpactLaw, MachineParts, Opening, StopLaw};
use vibroimpact::math::Matrix;

/// The file of a machine and its start, for `vibro --machine`.
pub(crate) fn text(parts: &MachineParts, start: &Start) -> String {
    let mut text = String::from("[machine]\n");
    let mut line = |words: core::fmt::Arguments<'_>| {
        // writing to a string does not fail
        let _ = writeln!(text, "{words}");
    };
    line(format_args!("coordinates = {:?}", parts.coordinates));
    for (name, of) in [("mass", &parts.mass), ("damping", &parts.damping), ("stiffness", &parts.stiffness)] {
        line(format_args!("{name} = {}", matrix(of)));
    }
    line(format_args!("constant = {:?}", parts.constant));
    if let Some(frequency) = parts.frequency {
        line(format_args!("frequency = {frequency:?}"));
    }
    if parts.impacts == ImpactLaw::InTurn {
        line(format_args!("impacts = \"in_turn\""));
    }
    for force in &parts.forces {
        line(format_args!("[[machine.force]]\norder = {}\ncos = {:?}\nsin = {:?}", force.order, force.cos, force.sin));
    }
    for stop in &parts.stops {
        let (name, direction, gap) = (&stop.name, &stop.direction, stop.gap);
        line(format_args!("[[machine.stop]]\nname = {name:?}\ndirection = {direction:?}\ngap = {gap:?}"));
        match stop.law {
            StopLaw::Rigid { restitution } => line(format_args!("restitution = {restitution:?}")),
            StopLaw::Compliant { stiffness, damping, preload, opening } => {
                let opening = if opening == Opening::Force { "force" } else { "position" };
                line(format_args!("stiffness = {stiffness:?}\ndamping = {damping:?}\npreload = {preload:?}"));
                line(format_args!("opening = {opening:?}"));
            }
        }
        for motion in &stop.motion {
            let (order, cos, sin) = (motion.order, motion.cos, motion.sin);
            line(format_args!("[[machine.stop.motion]]\norder = {order}\ncos = {cos:?}\nsin = {sin:?}"));
        }
    }
    for joint in &parts.joints {
        let (name, direction, belt) = (&joint.name, &joint.direction, joint.belt);
        line(format_args!("[[machine.friction]]\nname = {name:?}\ndirection = {direction:?}"));
        line(format_args!("sliding = {:?}\nstatic = {:?}\nbelt = {belt:?}", joint.sliding, joint.limit));
    }
    line(format_args!("[start]"));
    for (name, vector) in [("q", &start.q), ("qdot", &start.qdot)] {
        if !vector.is_empty() {
            line(format_args!("{name} = {vector:?}"));
        }
    }
    if start.phase != 0.0 {
        line(format_args!("phase = {:?}", start.phase));
    }
    text
}

fn matrix(of: &Matrix) -> String {
    let rows: Vec<String> = (0..of.rows()).map(|i| format!("{:?}", of.row(i))).collect();
    format!("[{}]", rows.join(", "))
}
