//! What a stop or a joint does in a regime.

/// The state of a stop or of a friction joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContactState {
    /// A stop that is open.
    Open,
    /// A compliant stop that is closed and pushes.
    Closed,
    /// A stop on which the structure rests: a rigid one, or a compliant one whose preload is not overcome.
    Resting,
    /// A stop that is closed without force: its gap stays zero by itself, as between equal bodies under equal forces, or
    /// because other contacts hold it. It has no guard; it is decided anew at each event.
    Touching,
    /// A joint that slides with positive relative velocity.
    Forward,
    /// A joint that slides with negative relative velocity.
    Backward,
    /// A joint that holds.
    Holding,
}

impl ContactState {
    /// Whether it takes a degree of freedom away, or lies where another contact does so already.
    pub(crate) const fn constrains(self) -> bool {
        matches!(self, Self::Resting | Self::Touching | Self::Holding)
    }
}
