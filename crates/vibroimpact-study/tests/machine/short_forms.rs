//! The short forms expand to the matrices that a hand calculation gives.

use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact_study::machine::{MachineSource, no_files};

fn machine(text: &str) -> Machine {
    MachineSource::from_text(text, no_files).and_then(|source| source.machine()).unwrap()
}

/// The example of the documentation, in matrices and in bodies.
#[test]
fn bodies_and_links() {
    let matrices = machine(
        r#"
        [machine]
        coordinates = ["body", "shoe"]
        mass = [[1, 0], [0, 2]]
        stiffness = [[1, -1], [-1, 3]]
        damping = [[0.25, -0.25], [-0.25, 0.75]]
        constant = [0, -9.5]
        frequency = 0.66
        [[machine.force]]
        order = 1
        cos = [0, 0.1]
        [[machine.stop]]
        name = "wall"
        direction = [1, 0]
        gap = 1.0
        restitution = 0.8
        [[machine.stop]]
        name = "floor"
        direction = [-1, 1]
        gap = 0.5
        stiffness = 100
        opening = "position"
        [[machine.friction]]
        name = "ground"
        direction = [0, 1]
        sliding = 0.2
        static = 0.3"#,
    );
    let bodies = machine(
        r#"
        [machine]
        bodies = { body = 1, shoe = 2 }
        constant = { shoe = -9.5 }
        frequency = 0.66
        link = [
            { between = ["body", "shoe"], stiffness = 1, damping = 0.25 },
            { between = ["shoe", "ground"], stiffness = 2, damping = 0.5 },
        ]
        force = [{ at = "shoe", cos = 0.1 }]
        stop = [
            { name = "wall", between = ["body", "ground"], gap = 1, restitution = 0.8 },
            { name = "floor", between = ["shoe", "body"], gap = 0.5, stiffness = 100, opening = "position" },
        ]
        friction = [{ name = "ground", at = "shoe", sliding = 0.2, static = 0.3 }]"#,
    );
    assert_eq!(bodies, matrices);
    let built = MachineParts::new(["body", "shoe"])
        .with_mass(0, 1.0)
        .with_mass(1, 2.0)
        .with_link(&[1.0, -1.0], 1.0, 0.25)
        .with_link(&[0.0, 1.0], 2.0, 0.5)
        .with_constant(1, -9.5)
        .with_frequency(0.66)
        .with_force(1, 1, 0.1, 0.0)
        .with_rigid_stop("wall", &[1.0, 0.0], 1.0, 0.8)
        .with_stop(
            "floor",
            &[-1.0, 1.0],
            0.5,
            StopLaw::Compliant { stiffness: 100.0, damping: 0.0, preload: 0.0, opening: Opening::Position },
        )
        .with_joint("ground", &[0.0, 1.0], 0.2, 0.3, 0.0);
    assert_eq!(Machine::new(built).unwrap(), matrices);
    let same = machine(&MachineSource::from(&matrices).to_toml());
    assert_eq!(same, matrices);
}

#[test]
fn modes_and_points() {
    let text = r#"
        [machine]
        bodies = { hammer = 3 }
        frequency_hz = 0.5
        [[machine.mode]]
        frequency = 2
        damping_ratio = 0.25
        shape = { tip = 2, middle = 0.5 }
        [[machine.mode]]
        frequency = 10
        modal_mass = 0.5
        shape = { middle = -0.5, tip = 1 }
        [[machine.force]]
        at = "middle"
        sin = 4
        [[machine.force]]
        sin = { tip = 1, hammer = 7 }
        [[machine.stop]]
        name = "wall"
        between = ["tip", "hammer"]
        gap = 0.1
        restitution = 1
        motion = [{ sin = 0.125 }]"#;
    let machine = machine(text);
    let parts = machine.parts();
    assert_eq!(parts.coordinates, ["mode1", "mode2", "hammer"]);
    let diagonal = |matrix: &vibroimpact::math::Matrix| (0..3).map(|i| matrix[(i, i)]).collect::<Vec<_>>();
    assert_eq!(diagonal(&parts.mass), [1.0, 0.5, 3.0]);
    assert_eq!(diagonal(&parts.stiffness), [4.0, 50.0, 0.0]);
    assert_eq!(diagonal(&parts.damping), [1.0, 0.0, 0.0]);
    assert_eq!(parts.frequency, Some(core::f64::consts::PI));
    assert_eq!(parts.forces.len(), 1);
    assert_eq!(parts.forces[0].sin, [0.5 * 4.0 + 2.0, -0.5 * 4.0 + 1.0, 7.0]);
    assert_eq!(parts.stops[0].direction, [2.0, 1.0, -1.0]);
    assert_eq!(parts.stops[0].motion[0].sin, 0.125);
    // the same modes from a table
    let table = "frequency,damping_ratio,modal_mass,tip,middle\n2,0.25,1,2,0.5\n10,0,0.5,1,-0.5\n";
    let start = text.find("[[machine.mode]]").unwrap();
    let end = text.find("[[machine.force]]").unwrap();
    let short = format!("{}modes = \"modes.csv\"\n{}", &text[..start], &text[end..]);
    let source = MachineSource::from_text(&short, |name| {
        assert_eq!(name, "modes.csv");
        Ok(table.to_owned())
    });
    assert_eq!(source.unwrap().machine().unwrap(), machine);
}

/// Ratios of the modes of a chain: each mode decays with its own ratio, so C in modal coordinates is diagonal.
#[test]
fn modal_damping_is_that_of_the_modes() {
    let machine = machine(
        r#"
        [machine]
        bodies = { a = 1, b = 1 }
        link = [{ between = ["a", "ground"], stiffness = 1 }, { between = ["a", "b"], stiffness = 4 }, { between = ["b", "ground"], stiffness = 1 }]
        modal_damping = [0.1, 0.01]"#,
    );
    // modes (1, 1) with frequency 1 and (1, -1) with frequency 3
    let damping = &machine.parts().damping;
    let (sum, difference) = (damping[(0, 0)] + damping[(0, 1)], damping[(0, 0)] - damping[(0, 1)]);
    assert!((sum - 2.0 * 0.1).abs() < 1e-15 && (difference - 2.0 * 0.01 * 3.0).abs() < 1e-15, "{sum} {difference}");
}
