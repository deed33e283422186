//! States are whole: a motion that goes on from the state of any of its events is the motion, to the last bit.

use vibroimpact::events::{Event, EventKind, Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 33).unwrap()) / f64::from(1_u32 << 31)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}

/// A random machine of one to three coordinates, with damped compliant stops, rigid ones and friction joints.
fn random_machine(random: &mut Random) -> Machine {
    let names = ["a", "b", "c"];
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 3")]
    let n = 1 + (random.unit() * 3.0) as usize;
    let mut parts = MachineParts::new(names[..n].iter().copied()).with_frequency(random.within(0.5, 2.0));
    for i in 0..n {
        parts = parts.with_mass(i, random.within(0.3, 2.0));
        let mut direction = vec![0.0; n];
        direction[i] = 1.0;
        if i > 0 {
            direction[i - 1] = -1.0;
        }
        parts = parts.with_link(&direction, random.within(0.3, 3.0), random.within(0.0, 0.2));
        parts = parts.with_force(i, 1, random.within(-1.0, 1.0), random.within(-1.0, 1.0));
    }
    if n > 1 && random.chance(0.3) {
        // masses couple coordinates
        let off = random.within(-0.25, 0.25);
        parts.mass[(0, 1)] += off;
        parts.mass[(1, 0)] += off;
    }
    for (j, name) in ["s0", "s1", "s2"].iter().enumerate() {
        let mut direction = vec![0.0; n];
        direction[j % n] = if random.chance(0.5) { 1.0 } else { -1.0 };
        let law = if random.chance(0.3) {
            StopLaw::Rigid { restitution: random.within(0.0, 0.9) }
        } else {
            let opening = if random.chance(0.8) { Opening::Force } else { Opening::Position };
            let preload = if random.chance(0.3) { random.within(0.0, 0.5) } else { 0.0 };
            StopLaw::Compliant {
                stiffness: random.within(1.0, 300.0),
                damping: random.within(0.0, 20.0),
                preload,
                opening,
            }
        };
        parts = parts.with_stop(name, &direction, random.within(0.0, 0.5), law);
    }
    if random.chance(0.4) {
        let mut direction = vec![0.0; n];
        direction[0] = 1.0;
        let sliding = random.within(0.05, 0.4);
        let belt = if random.chance(0.3) { random.within(-0.5, 0.5) } else { 0.0 };
        parts = parts.with_joint("joint", &direction, sliding, sliding * random.within(1.0, 1.5), belt);
    }
    Machine::new(parts).unwrap()
}

fn same_bits(one: &Event, other: &Event) -> bool {
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    one.kind == other.kind
        && one.place == other.place
        && one.with == other.with
        && one.speed.to_bits() == other.speed.to_bits()
        && one.phase.to_bits() == other.phase.to_bits()
        && bits(&one.q) == bits(&other.q)
        && bits(&one.qdot) == bits(&other.qdot)
}

/// The motion from the state of each event of random machines has the same events after it, bit by bit.
#[test]
fn motions_go_on_from_each_event_to_the_last_bit() {
    let mut random = Random(42);
    let (mut events_in_all, mut standing, mut resting, mut holding, mut preloaded) = (0, 0, 0, 0, 0);
    for case in 0..150 {
        let machine = random_machine(&mut random);
        let limits = Limits::default();
        let Ok(motion) = Motion::with_states(&machine, &Start::default(), limits) else { continue };
        let events: Vec<Event> = motion.take(40).collect();
        for (k, event) in events.iter().enumerate() {
            // a touch lies between two events
            if event.kind == EventKind::Graze {
                continue;
            }
            let state = event.state.as_deref().unwrap();
            assert_eq!((&state.q, &state.qdot, state.phase), (&event.q, &event.qdot, event.phase), "{case}, {k}");
            // events that happen together have one state
            let after = events[k + 1..].iter().skip_while(|next| next.state == event.state);
            let motion = Motion::new(&machine, state, limits);
            let mut motion = motion.unwrap_or_else(|error| panic!("{case}, {k}: {error} {state:?}"));
            for next in after {
                let Some(again) = motion.next() else { panic!("{case}, {k}: ends {:?}, not {next:?}", motion.end()) };
                assert!(same_bits(&again, next), "{case}, {k}: {state:?}\n{again:?}\n{next:?}");
            }
            events_in_all += 1;
            standing += u32::from(state.contacts.iter().any(|contact| contact.surface > 0.0));
            resting +=
                u32::from(state.contacts.iter().any(|of| of.state == vibroimpact::regime::ContactState::Resting));
            holding +=
                u32::from(state.contacts.iter().any(|of| of.state == vibroimpact::regime::ContactState::Holding));
            preloaded += u32::from(state.exact.iter().any(|(name, _)| name.starts_with("spring")));
        }
    }
    assert!(
        events_in_all > 5000 && standing > 2000 && resting > 40 && holding > 200 && preloaded > 300,
        "{events_in_all} events: {standing} {resting} {holding} {preloaded}"
    );
}
