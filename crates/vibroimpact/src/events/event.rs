//! An event of a machine, and the start of a motion.

use crate::regime::ContactState;

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A rigid stop is struck.
    Impact,
    /// A compliant stop closes.
    Close,
    /// A compliant stop opens.
    Open,
    /// The structure comes to rest on a stop.
    Stick,
    /// It leaves a stop on which it rested.
    Release,
    /// A friction joint begins to slide, or reverses.
    Slip,
    /// A friction joint holds.
    Hold,
    /// A stop is touched within rounding, without effect.
    Graze,
    /// Impacts on several stops in turn have accumulated: the structure comes to rest on this stop and on those of
    /// [`with`](Event::with).
    Collapse,
}

impl EventKind {
    /// Its name in JSON and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Close => "close",
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Release => "release",
            Self::Slip => "slip",
            Self::Hold => "hold",
            Self::Graze => "graze",
            Self::Collapse => "collapse",
        }
    }
}

/// An event.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// What happens.
    pub kind: EventKind,
    /// The stop, or the joint, which are counted after the stops. [`Machine::name_of`](crate::machine::Machine::name_of)
    /// has its name.
    pub place: usize,
    /// Time since the start.
    pub time: f64,
    /// Phase of the forcing, in $`[0, 2\pi)`$.
    pub phase: f64,
    /// Speed of closing before the event, $`-\dot g \ge 0`$; of an opening that of separation, $`\dot g \ge 0`$; of a slip
    /// the direction, 1 or -1. A release and a hold begin without speed.
    pub speed: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Velocities after the event.
    pub qdot: Vec<f64>,
    /// Other stops that take part at the same time: struck too, at rest and pushed through, or of the same collapse.
    pub with: Vec<usize>,
    /// Of impacts on several stops: whether they would lead elsewhere if one of the stops were struck before the others by
    /// however little. What follows then holds for impacts at exactly one time, as of a symmetric structure.
    pub tie: bool,
    /// The state from which the motion goes on, if it was asked to [keep states](super::Motion::with_states). Events
    /// that happen together have one state.
    pub state: Option<Box<Start>>,
}

impl Event {
    /// Whether it is the closing of a stop: an impact, or the beginning of a compliant contact.
    #[must_use]
    pub const fn closes(&self) -> bool {
        matches!(self.kind, EventKind::Impact | EventKind::Close)
    }
}

/// What a stop or a friction joint does at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactStart {
    /// The stop, or the joint, which are counted after the stops.
    pub place: usize,
    /// What it does.
    pub state: ContactState,
    /// How far the surface of a damped stop stands back that has opened by force, and that recovers by
    /// $`c\dot s + ks = 0`$ (with a preload $`p`$: $`c\dot s + ks + p = 0`$, until $`s = 0`$). The stop closes on its surface,
    /// at the gap $`-s`$. 0 of any other stop.
    pub surface: f64,
}

/// The state from which a motion starts, at time 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// Coordinates; all 0 if empty.
    pub q: Vec<f64>,
    /// Velocities; all 0 if empty.
    pub qdot: Vec<f64>,
    /// Phase of the forcing in radians.
    pub phase: f64,
    /// What stops and joints do. What those that are absent do follows from coordinates and velocities, with surfaces that
    /// do not stand back.
    pub contacts: Vec<ContactStart>,
    /// The digits that coordinates, velocities and contacts leave out, by name. With them a motion goes on from a state of
    /// another motion to the last bit. They count only together with the numbers with which they came, and may be left out.
    pub exact: Vec<(String, Vec<f64>)>,
}

/// Why a motion has no further event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// There is none for ever.
    Never,
    /// There is none for ever, and the structure rests on a stop.
    Stuck,
    /// None within the longest flight that is searched ([`Limits::time`]).
    NoEventWithin,
    /// The search has used all its steps.
    SearchLimit,
    /// No state of the stops and joints is consistent.
    Inconsistent,
    /// Too many events at one time: impacts that accumulate, but not into rest on their stops.
    Collapse,
}

/// The limits of a search for the next event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The longest flight.
    pub time: f64,
    /// The largest number of windows in one flight.
    pub steps: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { time: 1e4, steps: 200_000 }
    }
}
