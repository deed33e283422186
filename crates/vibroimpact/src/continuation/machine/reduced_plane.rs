//! The plane of the oscillators that the machines of a plane of two numbers are.

use super::curves::Plane;
use super::reduced_branch::oscillator;
use crate::continuation::curves::Frame;
use crate::system::{Oscillator, OscillatorFamily};

/// Points along each side of the frame at which the machine must be an oscillator.
const POINTS: u32 = 3;

impl Plane {
    /// The oscillator that the machine is at these values of both numbers, and the frame in the plane of oscillators; `None` if
    /// a machine is no oscillator, there or somewhere in the frame. Curves and [regions](crate::continuation::region) of the
    /// oscillators are those of the machines, in the same two numbers.
    ///
    /// ```
    /// use vibroimpact::Label;
    /// use vibroimpact::continuation::{RegionKind, RegionOptions, machine::Plane, region};
    /// use vibroimpact::machine::{Machine, MachineParts};
    /// let parts = MachineParts::new(["body"]).with_mass(0, 2.0).with_link(&[1.0], 800.0, 4.0).with_frequency(40.0);
    /// let machine = Machine::new(parts.with_force(0, 1, 0.0, 4.0).with_rigid_stop("wall", &[1.0], 0.005, 0.5))?;
    /// let ranges = (30.0..=60.0, 1e-3..=1e-2);
    /// let plane = Plane::of_paths(&machine, ("frequency", "stop.wall.gap"), ranges)?;
    /// let (osc, frame) = plane.reduced((40.0, 0.005)).expect("one coordinate, one rigid stop");
    /// let found = region(&osc, Label::new(0, 1), RegionKind::Existence, &frame, RegionOptions::default());
    /// // the amplitude at 40 rad/s is 1.66 mm
    /// assert!(found.contains((40.0, 1.7e-3)) && !found.contains((40.0, 1.6e-3)));
    /// # Ok::<(), vibroimpact::machine::MachineError>(())
    /// ```
    #[must_use]
    pub fn reduced(&self, values: (f64, f64)) -> Option<(Oscillator, Frame)> {
        let (family, (across, up)) = (self.family.clone(), &self.ranges);
        let reduction = family.reduction(values.into())?;
        let at = |range: &core::ops::RangeInclusive<f64>, k: u32| {
            range.start() + (range.end() - range.start()) * f64::from(k) / f64::from(POINTS - 1)
        };
        let same = |k: u32| {
            let there = family.reduction([at(across, k % POINTS), at(up, k / POINTS)]);
            there.is_some_and(|other| other.same_sides(&reduction))
        };
        if !(0..POINTS * POINTS).all(same) {
            return None;
        }
        let over = OscillatorFamily::new(move |values| oscillator(&family, values), values.into());
        Some((reduction.oscillator, Frame { plane: over.into(), ranges: self.ranges.clone() }))
    }
}
