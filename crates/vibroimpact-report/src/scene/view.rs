//! The views of a settled motion: over time, in the phase plane, by its multipliers, and in both sections. Each has a
//! figure and a table of the same data.

use super::sections::sections;
use super::{multipliers, phase_portrait};
use crate::figure::{section, settle};
use crate::table::{self, Table};
use crate::{Asked, ReportError};
use serde::Deserialize;
use vibroimpact::math::Multiplier;
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, Start};
use vibroimpact_plot::Figure;
use vibroimpact_study::SectionPoints;

/// Number of impacts and states of a section.
pub const SECTION_POINTS: u64 = 2000;

/// A view of a settled motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum View {
    /// Position over time.
    #[default]
    Waveform,
    /// Velocity over position.
    Phase,
    /// Floquet multipliers in the complex plane.
    Multipliers,
    /// Phase and speed of its impacts, and its states at phase 0 of the force.
    Sections,
}

impl View {
    /// All views.
    pub const ALL: [Self; 4] = [Self::Waveform, Self::Phase, Self::Multipliers, Self::Sections];

    /// Its name in commands and requests.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Waveform => "waveform",
            Self::Phase => "phase",
            Self::Multipliers => "multipliers",
            Self::Sections => "sections",
        }
    }
}

/// A settled motion in one view, with the data computed for this view.
pub struct Viewed<'a> {
    view: View,
    osc: &'a Oscillator,
    start: Start,
    settled: &'a Settled,
    asked: &'a Asked,
    multipliers: Option<[Multiplier; 2]>,
    section: SectionPoints,
}

impl<'a> Viewed<'a> {
    /// The view of the motion into which `start` settled.
    ///
    /// # Errors
    /// [`ReportError::NoMultipliers`] for the multipliers of a motion without any.
    pub fn new(
        view: View,
        (osc, start): (&'a Oscillator, Start),
        settled: &'a Settled,
        asked: &'a Asked,
    ) -> Result<Self, ReportError> {
        let multipliers = settled.verdict.multipliers(osc);
        if view == View::Multipliers && multipliers.is_none() {
            return Err(ReportError::NoMultipliers(settled.verdict.label().into_owned()));
        }
        let section = match view {
            View::Sections => sections(osc, start, settled, SECTION_POINTS),
            _ => SectionPoints::default(),
        };
        Ok(Self { view, osc, start, settled, asked, multipliers, section })
    }

    /// Its figure.
    #[must_use]
    pub fn figure(&self) -> Figure {
        let Self { osc, start, settled, asked, .. } = *self;
        match (self.view, &self.multipliers) {
            (View::Phase, _) => {
                let (_, (from, shown)) = settle::steady(osc, start, settled);
                phase_portrait(asked, osc, start, (from, from + shown))
            }
            (View::Multipliers, Some(both)) => multipliers(both, &settled.verdict.stabilities(osc).unwrap_or_default()),
            (View::Sections, _) => section::figure(&self.section, osc, asked),
            (View::Waveform | View::Multipliers, _) => settle::figure(osc, start, settled, asked),
        }
    }

    /// The table of the data in the figure.
    ///
    /// # Errors
    /// [`ReportError::Points`] for a waveform that is too long.
    pub fn table(&self) -> Result<Table<'_>, ReportError> {
        let Self { osc, start, settled, asked, .. } = *self;
        Ok(match (self.view, &self.multipliers) {
            (View::Multipliers, Some(both)) => table::multipliers(both),
            (View::Sections, _) => table::section::table(&self.section, osc, &asked.units.states(), asked.units),
            (View::Waveform | View::Phase | View::Multipliers, _) => {
                table::waveform::steady(osc, start, settled, asked.units)?
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact::verdict::{SettleOptions, settle};
    use vibroimpact_study::SystemPlan;

    #[test]
    fn f10_each_view_has_a_figure_and_a_table_of_its_own() {
        let system = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);
        let (asked, osc) = (Asked { system, units: Units::default() }, system.oscillator().unwrap());
        let start = Start::at_rest(&osc);
        let settled = settle(&osc, start, &SettleOptions::default());
        let shown = View::ALL.map(|view| {
            let viewed = Viewed::new(view, (&osc, start), &settled, &asked).unwrap();
            let mut text = Vec::new();
            viewed.table().unwrap().write(&mut text).unwrap();
            (viewed.figure().to_svg(), String::from_utf8(text).unwrap())
        });
        let words = ["*τ*", "velocity ", "Re ", "states at phase 0"].map(|word| word.trim_matches('*'));
        for (k, (word, (svg, _))) in words.iter().zip(&shown).enumerate() {
            assert!(svg.contains(word), "{k} {word}");
            assert!(shown.iter().enumerate().all(|(j, other)| j == k || other.0 != *svg), "{k}");
        }
        let heads = shown.each_ref().map(|(_, table)| table.lines().next().unwrap());
        assert_eq!(heads, ["time,x,v,phase", "time,x,v,phase", "re,im", "section,stop,phase,speed,x,v"]);
        assert_eq!(shown[2].1.lines().count(), 3, "{}", shown[2].1);
        assert_eq!(shown[3].1.lines().count(), 1 + 2 * 2000);
    }
}
