//! Lines over the plane of a map: the boundaries of the regions of stability of motions, and the line where the motion
//! without impacts grazes a stop. All coordinates are in the units of the axes of the figure.

use crate::Units;
use vibroimpact::continuation::{Polygon, Region};
use vibroimpact_study::{
    Axis, BodyNumber, Control, Coordinate, MapPlan, Parameter, Plan, PlanError, RunError, Stretch, System, SystemPlan,
    Task, stability_regions,
};

/// Motions whose regions are drawn by default: those of the 1971 paper, and those that begin at their flips.
pub const REGION_LABELS: [&str; 9] = ["1/1", "2/1", "3/1", "4/1", "1/2", "1/3", "2/2", "3/2", "2/4"];
/// Number of grid points, in each direction, at which orbits are searched.
const GRID: u32 = 20;
/// Number of points of a line.
const POINTS: u32 = 600;

/// The outlines of a region.
pub type Rings = Vec<Vec<(f64, f64)>>;

/// The two parameters of a map.
#[derive(Clone, Copy, Debug)]
pub struct LayerPlane {
    system: SystemPlan,
    units: Units,
    across: Stretch,
    up: Stretch,
}

impl LayerPlane {
    /// The plane of a plan; `None` if it is no map over two parameters.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid plan.
    pub fn of(plan: &Plan) -> Result<Option<Self>, PlanError> {
        let plan = plan.complete()?;
        let (System::Oscillator(system), Task::Map(map)) = (&plan.system, &plan.task) else { return Ok(None) };
        let map: MapPlan = map.typed()?;
        let stretch = |axis: &Axis| match (axis.vary, axis.over.extent()) {
            (Coordinate::Parameter(parameter), (from, to)) => Some(Stretch { parameter, from, to }),
            _ => None,
        };
        Ok(match map.axes.iter().map(stretch).collect::<Option<Vec<_>>>().as_deref() {
            Some([across, up]) => {
                Some(Self { system: *system, units: Units::of_plan(&plan), across: *across, up: *up })
            }
            _ => None,
        })
    }

    /// The label and the outlines of each region of stability of some motions. Motions without a region are left out.
    ///
    /// # Errors
    /// [`RunError`] for an invalid label or plane, or when stopped.
    pub fn regions(&self, labels: &[String], control: &Control<'_>) -> Result<Vec<(String, Rings)>, RunError> {
        let found = stability_regions(&self.system, labels, (&self.across, &self.up), GRID, control)?;
        let (x, y) = (self.units.of(self.across.parameter), self.units.of(self.up.parameter));
        let point = |(across, up): (f64, f64)| (across * x, up * y);
        let ring = |polygon: &Polygon| polygon.vertices.iter().map(|vertex| point(vertex.values)).collect();
        let rings = |region: Region| region.polygons.iter().map(ring).collect::<Vec<_>>();
        let named = labels.iter().cloned().zip(found.into_iter().map(rings));
        Ok(named.filter(|(_, rings)| !rings.is_empty()).collect())
    }

    /// The gap on an axis, the other parameter, and whether the gap is the ordinate.
    fn gap(&self) -> Option<(&Stretch, &Stretch, bool)> {
        use BodyNumber::{Gap, Gaps};
        let is_gap = |parameter| matches!(parameter, Parameter::Gap | Parameter::Body(Gap | Gaps));
        match (is_gap(self.across.parameter), is_gap(self.up.parameter)) {
            (_, true) => Some((&self.up, &self.across, true)),
            (true, false) => Some((&self.across, &self.up, false)),
            _ => None,
        }
    }

    /// Whether a gap is on an axis.
    pub(crate) fn has_gap(&self) -> bool {
        self.gap().is_some()
    }

    /// The gap that equals the amplitude of the motion without impacts, in the unit of its parameter.
    fn amplitude_at(&self, gap: &Stretch, other: Parameter, at: f64) -> Option<f64> {
        let amplitude = self.system.with(other, at).ok()?.oscillator().ok()?.free_amplitude();
        if !matches!(gap.parameter, Parameter::Body(_)) {
            return Some(amplitude);
        }
        // the nondimensional gap is a linear function of that of the machine
        let gap_at = |value| {
            let system = self.system.with_all([(other, at), (gap.parameter, value)]).ok()?;
            Some(system.oscillator().ok()?.gap())
        };
        let (low, high) = (gap_at(gap.from)?, gap_at(gap.to)?);
        Some(gap.from + (amplitude - low) / (high - low) * (gap.to - gap.from))
    }

    /// The lines where the gap equals the amplitude of the motion without impacts; none in a plane without a gap axis.
    #[must_use]
    pub fn amplitude(&self) -> Vec<Vec<(f64, f64)>> {
        let Some((gap, other, upwards)) = self.gap() else { return Vec::new() };
        let (low, high) = (gap.from.min(gap.to), gap.from.max(gap.to));
        let mut lines = vec![Vec::new()];
        for k in 0..=POINTS {
            let at = other.from + (other.to - other.from) * f64::from(k) / f64::from(POINTS);
            let amplitude = self.amplitude_at(gap, other.parameter, at).unwrap_or(f64::INFINITY);
            // slightly beyond the frame, so that the line reaches it
            if amplitude >= low - (high - low) && amplitude <= high + (high - low) {
                let (at, amplitude) = (at * self.units.of(other.parameter), amplitude * self.units.of(gap.parameter));
                let point = if upwards { (at, amplitude) } else { (amplitude, at) };
                lines.last_mut().into_iter().for_each(|line| line.push(point));
            } else if lines.last().is_some_and(|line| !line.is_empty()) {
                lines.push(Vec::new());
            }
        }
        lines.retain(|line| line.len() > 1);
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The line of a machine is that of its oscillator, in Hz and m.
    #[test]
    fn the_amplitude_of_a_machine_is_in_its_units() {
        let machine = r#"{"version":1,"system":{"machine":{"mass_kg":2,"stiffness_n_per_m":800,"force_n":4,"restitution":0.5,"frequency_hz":3,"gap_m":0.01}},
            "task":{"map":{"axes":[{"vary":"frequency_hz","over":"3.5:5:9"},{"vary":"gap_m","over":"0.001:0.03:9"}],"starts":1}}}"#;
        let plane = LayerPlane::of(&serde_json::from_str(machine).unwrap()).unwrap().unwrap();
        let (natural, length) = (20.0 / core::f64::consts::TAU, 4.0 / 800.0);
        let lines = plane.amplitude();
        assert!(lines.len() == 1 && lines[0].len() > 300, "{}", lines.len());
        for (hertz, gap) in &lines[0] {
            let beta = hertz / natural;
            assert!((gap / length * (beta * beta - 1.0) - 1.0).abs() < 1e-9, "{hertz} {gap}");
        }
    }
}
