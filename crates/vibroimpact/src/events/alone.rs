//! Events that change one stop and nothing else: no joint is there, and nothing rests. They are what most motions consist
//! of; the general way (`motion`, `strike`) does the same with them.

use super::advance::Approach;
use super::chatter::is_far_from_an_end;
use super::event::EventKind;
use super::motion::Motion;
use super::passage::Blow;
use crate::machine::StopLaw;
use crate::math::add_scaled;
use crate::regime::{ContactState, GuardKind};

impl Motion<'_> {
    /// Whether the event at this guard was one of them. `fastest` is the rate of the structure before it.
    pub(super) fn happen_alone(&mut self, kind: GuardKind, fastest: f64) -> bool {
        let turns = self.scratch.turns_at(&self.place, &self.normal);
        match kind {
            GuardKind::Gap(j) => {
                let (gap, rate) = self.place.gap_and_rate(&self.normal, turns, j);
                if !matches!(self.approach(j, rate), Approach::Strikes) {
                    return false;
                }
                let speed = (-rate).max(0.0);
                let w = &self.normal.directions[j];
                let square = self.normal.squares[j];
                match self.machine.stops()[j].law {
                    StopLaw::Rigid { restitution } => {
                        // the impact can end a contact elsewhere
                        let presses = self.place.states.contains(&ContactState::Closed);
                        if restitution * speed <= 0.0 || presses {
                            return false;
                        }
                        // on the stop exactly, without the rounding error of the time
                        add_scaled(&mut self.place.x, gap / square, w);
                        let impulse = -((1.0 + restitution) * -speed) / square;
                        add_scaled(&mut self.place.v, -impulse, w);
                        self.largest_impact = self.largest_impact.max(speed);
                        self.place.jolt();
                        self.place.note(GuardKind::Gap(j), 1);
                        self.record(&[(j, restitution)]);
                        if let Some(passage) = &mut self.passage {
                            passage.blows.push(Blow {
                                stop: j,
                                speed,
                                impulse,
                                loss: 0.5 * (1.0 - restitution) * speed * impulse,
                            });
                        }
                        self.instants.keep(EventKind::Impact, j, speed);
                        self.struck.push((j, speed));
                        self.announce(EventKind::Impact, j, speed, Vec::new());
                        // the state that is announced tells of the impact; whether a chatter ends with it is decided
                        // below
                        self.struck.clear();
                        let open = self.place.states.iter().all(|state| *state == ContactState::Open);
                        let turns = self.scratch.turns_at(&self.place, &self.normal);
                        if !(open
                            && is_far_from_an_end(
                                &self.place,
                                &self.normal,
                                (j, restitution, restitution * speed),
                                fastest,
                                turns,
                            ))
                        {
                            let turns = turns.to_vec();
                            self.end_chatter(&[(j, speed)], &turns);
                        } else if self.instants.are_close() {
                            self.accumulate();
                        }
                    }
                    StopLaw::Compliant { .. } => {
                        // what rounding errors have left of a motion ends in the general way
                        if self.instants.may_be_noise(speed, square) {
                            return false;
                        }
                        if self.place.close(j) {
                            add_scaled(&mut self.place.x, gap / square, w);
                        }
                        self.record(&[]);
                        self.instants.keep(EventKind::Close, j, speed);
                        self.announce(EventKind::Close, j, speed, Vec::new());
                    }
                }
            }
            GuardKind::Depth(j) | GuardKind::Force(j) if self.place.states[j] == ContactState::Closed => {
                let (gap, rate) = self.place.gap_and_rate(&self.normal, turns, j);
                self.place.open(&self.machine.stops()[j].law, kind, j, (gap, rate));
                self.record(&[]);
                self.instants.keep(EventKind::Open, j, rate.max(0.0));
                self.announce(EventKind::Open, j, rate.max(0.0), Vec::new());
            }
            _ => return false,
        }
        true
    }
}
