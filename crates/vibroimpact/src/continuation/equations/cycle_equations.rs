//! The equations of a cycle with one parameter, or a line through two parameters, among the unknowns.

use crate::continuation::trace::equations::{Equations, unit};
use crate::orbit::{Block, Ring, blocks, by_parameter, fill};
use crate::system::{Oscillator, Parameter, ParameterPath, Side};

/// The equations of the cycles with a given signature: the stop of each impact, and the number of forcing periods. The
/// unknowns are the phases and speeds of the impacts and, last, one parameter.
#[derive(Clone, Debug)]
pub(crate) struct CycleEquations {
    osc: Oscillator,
    varying: ParameterPath,
    sides: Vec<Side>,
    periods: u32,
    weights: Vec<f64>,
    scale: f64,
}

impl CycleEquations {
    /// The equations for the signature of `ring`. A change of the parameter by `scale` has the same length as a change
    /// of all phases by one radian.
    pub(crate) fn new(osc: &Oscillator, varying: ParameterPath, ring: &Ring, scale: f64) -> Self {
        let m = ring.len();
        // a mean over the impacts: lengths do not depend on their number
        let mut weights = vec![1.0 / m as f64; 2 * m];
        weights.push(1.0 / (scale * scale));
        Self { osc: *osc, varying, sides: ring.sides.clone(), periods: ring.periods, weights, scale }
    }

    /// The equations for the signature of another `ring`.
    pub(crate) fn with(&self, ring: &Ring) -> Self {
        Self::new(&self.osc, self.varying.clone(), ring, self.scale)
    }

    /// The number of impacts.
    pub(crate) fn impacts(&self) -> usize {
        self.sides.len()
    }

    /// The component of a tangent along the parameter; 1 if no other unknown changes.
    pub(crate) fn pace(&self, tangent: &[f64]) -> f64 {
        tangent.last().map_or(0.0, |p| p / self.scale)
    }

    /// The row that selects the parameter.
    pub(crate) fn parameter_row(&self) -> Vec<f64> {
        unit(self.weights.len(), self.weights.len() - 1, 1.0)
    }

    /// The vector of unknowns of a ring and a parameter value.
    pub(crate) fn join(ring: &Ring, value: f64) -> Vec<f64> {
        let mut w = ring.unknowns.clone();
        w.push(value);
        w
    }

    /// The oscillator and the ring that belong to these unknowns; `None` if the parameter value is invalid.
    pub(crate) fn split(&self, w: &[f64]) -> Option<(Oscillator, Ring)> {
        let (value, unknowns) = w.split_last()?;
        let osc = self.varying.set(&self.osc, *value).ok()?;
        Some((osc, Ring { sides: self.sides.clone(), unknowns: unknowns.to_vec(), periods: self.periods }))
    }

    /// The same at another value of the parameter.
    pub(crate) fn split_at(&self, w: &[f64], value: f64) -> Option<(Oscillator, Ring)> {
        let mut w = w.to_vec();
        *w.last_mut()? = value;
        self.split(&w)
    }

    /// The oscillator, the ring and the linearised flights that belong to these unknowns; `None` if the parameter value
    /// is invalid.
    pub(crate) fn flights(&self, w: &[f64]) -> Option<(Oscillator, Ring, Vec<Block>)> {
        let (osc, ring) = self.split(w)?;
        let flights = blocks(&osc, &ring)?;
        Some((osc, ring, flights))
    }
}

impl Equations for CycleEquations {
    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let (osc, ring, flights) = self.flights(w)?;
        let rates = self.varying.rates(*w.last()?).ok()?;
        let rows = slopes(&osc, &ring, &flights, &[rates])?;
        Some((flights.iter().flat_map(|b| b.miss).collect(), rows))
    }
}

/// The derivatives of the residuals of the flights, as a square matrix by rows: with respect to the phases and speeds
/// of the impacts, then to the unknowns with which parameters change at these rates. As many rows as there are such
/// unknowns are left zero at the end, for further equations.
pub(crate) fn slopes(
    osc: &Oscillator,
    ring: &Ring,
    flights: &[Block],
    rates: &[Vec<(Parameter, f64)>],
) -> Option<Vec<f64>> {
    let impacts = 2 * ring.len();
    let width = impacts + rates.len();
    let mut rows = vec![0.0; width * width];
    fill(&mut rows, width, flights);
    for (k, rates) in rates.iter().enumerate() {
        for (parameter, rate) in rates {
            for (row, slope) in by_parameter(osc, ring, *parameter)?.into_iter().enumerate() {
                rows[row * width + impacts + k] += rate * slope;
            }
        }
    }
    Some(rows)
}
