//! How figures show events: colours, dashes and marks. The Python package draws with the same tables; the test `tables`
//! writes them for it.

use vibroimpact::continuation::Bound;
use vibroimpact_plot::{Colour, Dash, SERIES, Shape};
use vibroimpact_study::FollowedEvent;

/// The marks of events along branches by name, and whether the mark is at velocity zero, because an impact appears or
/// disappears there. Other events have no mark.
pub const BRANCH_MARKS: [(&str, Shape, bool); 15] = [
    ("fold", Shape::Square, false),
    ("flip", Shape::Diamond, false),
    ("branch point", Shape::Circle, false),
    ("grazing", Shape::TriangleUp, true),
    ("loss of contact", Shape::TriangleDown, true),
    ("soft landing", Shape::Plus, true),
    ("rest for ever", Shape::Cross, true),
    ("sticking begins", Shape::TriangleRight, false),
    ("sticking ends", Shape::TriangleLeft, false),
    // of machines only
    ("torus", Shape::Plus, false),
    ("corner", Shape::Cross, false),
    ("holding begins", Shape::Pentagon, false),
    ("holding ends", Shape::Bar, false),
    ("jump", Shape::Star, false),
    ("change", Shape::Cross, false),
];

/// The marks of points of codimension two on curves, by name. Ends of a curve have no mark.
pub const CURVE_MARKS: [(&str, Shape); 22] = [
    ("cusp", Shape::TriangleDown),
    ("resonant grazing", Shape::Diamond),
    ("double grazing", Shape::Square),
    ("degenerate grazing", Shape::TriangleUp),
    ("touch", Shape::Circle),
    ("1:2", Shape::Circle),
    ("degenerate flip", Shape::Cross),
    ("loss of contact", Shape::Plus),
    ("whole periods", Shape::Plus),
    ("speeds without bound", Shape::Plus),
    // of machines only
    ("fold-flip", Shape::Circle),
    ("1:1", Shape::Circle),
    ("1:3", Shape::Circle),
    ("1:4", Shape::Circle),
    ("fold-torus", Shape::Plus),
    ("flip-torus", Shape::Plus),
    ("fold-grazing", Shape::Diamond),
    ("flip-grazing", Shape::Diamond),
    ("torus-grazing", Shape::Diamond),
    ("degenerate rest", Shape::TriangleUp),
    ("corner", Shape::Cross),
    ("rest", Shape::Cross),
];

/// The colours of events.
pub const EVENT_COLOURS: [(FollowedEvent, Colour); 7] = [
    (FollowedEvent::Fold, SERIES[1]),
    (FollowedEvent::Flip, SERIES[0]),
    (FollowedEvent::Torus, SERIES[3]),
    (FollowedEvent::Grazing, SERIES[2]),
    (FollowedEvent::Corner, SERIES[5]),
    (FollowedEvent::Sticking, SERIES[4]),
    (FollowedEvent::Holding, SERIES[6]),
];

/// Colour, dash and text of each bound of a region, in the order of the legend. The frame is the edge of the figure and
/// is not drawn.
pub const BOUND_STYLES: [(Bound, Colour, Dash, &str); 7] = [
    (Bound::Fold, SERIES[1], Dash::Solid, "fold"),
    (Bound::Flip, SERIES[0], Dash::Dashed, "flip"),
    (Bound::NoSpeed, SERIES[2], Dash::DashDot, "an impact without speed"),
    (Bound::Touch, Colour::BLACK, Dash::Solid, "a touch on the way"),
    (Bound::Merging, SERIES[3], Dash::Dotted, "merging"),
    (Bound::Torus, SERIES[4], Dash::Dashed, "torus"),
    (Bound::Change, SERIES[5], Dash::DashDot, "another change of the events"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::continuation::BranchEvent;

    #[test]
    fn marks_on_curves_have_the_names_of_events() {
        use vibroimpact::continuation::CurveEvent as Event;
        let (stop, first, second, place) = (0, 0, 1, 0);
        let events = [
            Event::Cusp,
            Event::ResonantGrazing { stop },
            Event::DoubleGrazing { stop },
            Event::DegenerateGrazing { stop },
            Event::Touch { stop },
            Event::OneToTwo,
            Event::DegenerateFlip,
            Event::LossOfContact,
            Event::WholePeriods,
            Event::Unbounded,
            Event::FoldFlip,
            Event::OneToOne,
            Event::OneToThree,
            Event::OneToFour,
            Event::FoldTorus,
            Event::FlipTorus,
            Event::FoldGrazing,
            Event::FlipGrazing,
            Event::TorusGrazing,
            Event::DegenerateRest { place },
            Event::Corner { first, second },
            Event::Rest { place },
        ];
        assert_eq!(CURVE_MARKS.map(|(name, _)| name), events.map(|event| event.name()));
    }

    /// A renamed event would lose its mark without an error.
    #[test]
    fn marks_on_branches_have_the_names_of_events() {
        let (stop, joint, place, detail) = (0, 0, None, None);
        let events = [
            BranchEvent::Fold,
            BranchEvent::Flip,
            BranchEvent::BranchPoint,
            BranchEvent::Grazing { stop, also: None, appears: true, turns: false, detail },
            BranchEvent::LossOfContact { stop, detail },
            BranchEvent::SoftLanding { stop, detail },
            BranchEvent::RestForEver { stop },
            BranchEvent::Sticking { stop, begins: true, detail },
            BranchEvent::Sticking { stop, begins: false, detail },
            BranchEvent::Torus,
            BranchEvent::Corner { first: 0, second: 1 },
            BranchEvent::Holding { joint, begins: true },
            BranchEvent::Holding { joint, begins: false },
            BranchEvent::Jump,
            BranchEvent::Change { place },
        ];
        assert_eq!(BRANCH_MARKS.iter().map(|(name, ..)| *name).collect::<Vec<_>>(), events.map(|event| event.name()));
    }
}
