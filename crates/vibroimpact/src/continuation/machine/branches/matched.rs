//! The events of a motion beside those of a signature: how many impacts of a chatter are followed before the rest is no property of
//! a cycle, and what happens at one time in the signature can be apart by the error of a solution.

use crate::orbit::RingEvent;

/// For each of these events the rest after the chatter to which it belongs: its place, and the stop.
fn rests<'a>(
    events: impl DoubleEndedIterator<Item = &'a RingEvent> + ExactSizeIterator,
) -> Vec<Option<(usize, usize)>> {
    let mut next = None;
    let mut rests: Vec<Option<(usize, usize)>> = Vec::with_capacity(events.len());
    for (i, event) in events.enumerate().rev() {
        let own = event.rests_on().map(|stop| (i, stop));
        next = own.or(next.filter(|(_, stop)| event.struck() == Some(*stop)));
        rests.push(next);
    }
    rests.reverse();
    rests
}

/// The longest flight, as a phase, between impacts that are left out.
const SOON: f64 = 0.05;

/// The events of a motion, where a chatter has as many impacts as in the signature if it has all those before the rest of the
/// signature begins. Events are given with their phases since the beginning of the motion.
pub(crate) fn matched(wanted: &[(f64, &RingEvent)], seen: &[(f64, RingEvent)]) -> Vec<RingEvent> {
    let mut events: Vec<RingEvent> = Vec::with_capacity(seen.len());
    let (wanted_rests, seen_rests) =
        (rests(wanted.iter().map(|(_, event)| *event)), rests(seen.iter().map(|(_, event)| event)));
    let (mut i, mut j) = (0, 0);
    while j < seen.len() {
        match (wanted_rests.get(i).copied().flatten(), seen_rests[j]) {
            (Some((rest, stop)), Some((end, same))) if stop == same => {
                let (impacts, followed) = (rest - i, end - j);
                let before = if rest > 0 { wanted[rest - 1].0 } else { 0.0 };
                let until = 0.5 * (before + wanted[rest].0);
                let early = seen[j..j + followed].iter().filter(|(phase, _)| *phase < until).count();
                let soon = seen[j + early..=j + followed].windows(2).all(|pair| pair[1].0 - pair[0].0 < SOON);
                // the motion itself can have gone over to its rest before
                if early == impacts && soon || followed < impacts && seen[j + followed].0 < until {
                    events.extend(wanted[i..=rest].iter().map(|(_, event)| (*event).clone()));
                } else {
                    let own = j..j + if early == impacts { followed } else { early };
                    events.extend(seen[own].iter().map(|(_, event)| event.clone()));
                    events.push(seen[j + followed].1.clone());
                }
                (i, j) = (rest + 1, j + followed + 1);
            }
            _ => {
                let (event, parts) = wanted
                    .get(i)
                    .and_then(|(_, event)| Some((*event, parts(event, &seen[j..])?)))
                    .unwrap_or((&seen[j].1, 1));
                events.push(event.clone());
                (i, j) = (i + 1, j + parts);
            }
        }
    }
    events
}

/// Phases that differ by less are one within the errors of a solution.
const AT_ONCE: f64 = 1e-8;

/// Over how many events a motion has what happens at one time in the signature: of equal parts each solution has its own error, so that
/// either can be first. `None` if it has something else.
fn parts(wanted: &RingEvent, seen: &[(f64, RingEvent)]) -> Option<usize> {
    let all = wanted.guards().count();
    let own = |event: &RingEvent| event.guards().all(|guard| wanted.has(guard));
    let (begin, _) = seen.first()?;
    let count = seen.iter().take(all).take_while(|(phase, event)| phase - begin < AT_ONCE && own(event)).count();
    let (_, last) = &seen[count.checked_sub(1)?];
    let told: usize = seen[..count].iter().map(|(_, event)| event.guards().count()).sum();
    let alike = count > 1 || last.pushed == wanted.pushed && last.rounds == wanted.rounds;
    (alike && told == all && last.after == wanted.after && last.back == wanted.back).then_some(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::Push;
    use crate::regime::{ContactState, GuardKind};

    fn impact(still: bool) -> RingEvent {
        let after = vec![if still { ContactState::Resting } else { ContactState::Open }];
        RingEvent {
            guard: GuardKind::Gap(0),
            with: Vec::new(),
            rounds: Vec::new(),
            after,
            pushed: vec![(0, if still { Push::Summed } else { Push::Rebounds })],
            back: vec![false],
        }
    }

    fn release() -> RingEvent {
        RingEvent {
            with: Vec::new(),
            rounds: Vec::new(),
            guard: GuardKind::Reaction(0),
            after: vec![ContactState::Open],
            pushed: Vec::new(),
            back: vec![false],
        }
    }

    /// A motion whose chatter has impacts at these phases, the last of which begins its rest, until the release at 3.
    fn motion(phases: &[f64]) -> Vec<(f64, RingEvent)> {
        let last = phases.len() - 1;
        let impacts = phases.iter().enumerate().map(|(k, phase)| (*phase, impact(k == last)));
        impacts.chain([(3.0, release())]).collect()
    }

    #[test]
    fn how_many_impacts_are_followed_does_not_matter() {
        let ring = motion(&[1.0, 1.5, 1.52, 1.525]);
        let wanted: Vec<(f64, &RingEvent)> = ring.iter().map(|(phase, event)| (*phase, event)).collect();
        let alike = |phases: &[f64]| {
            let events = matched(&wanted, &motion(phases));
            events.iter().eq(wanted.iter().map(|(_, event)| *event))
        };
        assert!(
            alike(&[1.0, 1.5, 1.52, 1.525]) && alike(&[1.0, 1.5, 1.52, 1.525, 1.526, 1.5265]) && alike(&[1.0, 1.5])
        );
        // an impact between the first ones, one that is missing, and impacts that go on for long
        assert!(!alike(&[1.0, 1.2, 1.5, 1.52, 1.525]) && !alike(&[1.5, 1.52, 1.525]));
        assert!(!alike(&[1.0, 1.5, 1.52, 1.525, 1.8, 1.9]));
    }
}
