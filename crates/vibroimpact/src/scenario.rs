//! The points discussed in the 1971 paper, with restitution 0.5. Tests, benchmarks, figures and docs use them.

use crate::system::Oscillator;

/// A point of figure 4 with its steady motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenario {
    /// The letter of the point in the paper.
    pub name: &'static str,
    /// $`1/\beta`$.
    pub inverse_beta: f64,
    /// $`\delta`$.
    pub gap: f64,
    /// The labels of its steady motions.
    pub motions: &'static [&'static str],
}

impl Scenario {
    /// The oscillator at this point.
    ///
    /// # Panics
    /// Never for the points of this module.
    #[must_use]
    #[allow(clippy::expect_used)] // constants of this module
    pub fn oscillator(&self) -> Oscillator {
        Oscillator::from_inverse_beta(self.inverse_beta, self.gap, 0.5).expect("the paper's points are legal")
    }
}

/// Figure 5: a motion of order four with unequal intervals.
pub const N: Scenario = Scenario { name: "N", inverse_beta: 1.8, gap: 0.25, motions: &["4/1"] };
/// Figure 6: the fundamental motion or no impacts, depending on the start.
pub const P: Scenario = Scenario { name: "P", inverse_beta: 0.6, gap: 0.75, motions: &["1/1", "0"] };
/// Figure 7: the same with a larger gap.
pub const Q: Scenario = Scenario { name: "Q", inverse_beta: 0.7, gap: 2.5, motions: &["1/1", "0"] };
/// Figure 8: a motion of order two or no impacts, depending on the start.
pub const R: Scenario = Scenario { name: "R", inverse_beta: 1.7, gap: 2.25, motions: &["2/1", "0"] };
/// Figure 9: two motions with impacts coexist.
pub const S: Scenario = Scenario { name: "S", inverse_beta: 1.3, gap: 0.75, motions: &["1/1", "2/1"] };
/// Figure 10: the fundamental motion is unstable, 1/2 is stable.
pub const T: Scenario = Scenario { name: "T", inverse_beta: 1.11, gap: 2.0, motions: &["1/2"] };
/// Figure 11: a chaotic motion.
pub const U: Scenario = Scenario { name: "U", inverse_beta: 1.11, gap: 3.0, motions: &["chaotic"] };
/// All points.
pub const PAPER: [Scenario; 7] = [N, P, Q, R, S, T, U];
