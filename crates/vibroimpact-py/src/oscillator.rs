//! `Oscillator` and `Units`, which are checked at construction and immutable.

use crate::error::Trouble;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use std::collections::hash_map::DefaultHasher;
use std::fmt::Write;
use std::hash::{Hash, Hasher};
use vibroimpact::{Frequency, Machine, Scales, Side};
use vibroimpact_study::{SecondStop, SystemPlan};

/// A hash of numbers that is equal for equal numbers (0 and -0 are equal).
fn hash_of(numbers: impl Iterator<Item = f64>) -> u64 {
    let mut hasher = DefaultHasher::new();
    numbers.for_each(|number| (number + 0.0).to_bits().hash(&mut hasher));
    hasher.finish()
}

/// The physical units of length, time and mass of an oscillator.
///
/// Multiply a nondimensional result by a unit to get a physical value; divide a physical start by it to get a
/// nondimensional one.
///
/// >>> from vibroimpact import Oscillator
/// >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
/// >>> osc.units.length_m, osc.units.time_s
/// (0.005, 0.05)
#[pyclass(frozen, from_py_object, module = "vibroimpact")]
#[derive(Clone, Copy)]
pub(crate) struct Units(Scales);

#[pymethods]
impl Units {
    #[new]
    #[pyo3(signature = (*, length_m, time_s, mass_kg))]
    fn new(length_m: f64, time_s: f64, mass_kg: f64) -> Result<Self, Trouble> {
        for (name, value, meaning) in [
            ("length_m", length_m, "F/k in m"),
            ("time_s", time_s, "1/omega_n in s"),
            ("mass_kg", mass_kg, "the moving mass in kg"),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Trouble::question(format!(
                    "{name} = {value} lies outside 0 < {name} < infinity\nhint: it is {meaning}"
                )));
            }
        }
        Ok(Self(Scales { length_m, time_s, mass_kg }))
    }

    /// One unit of length, F/k, in m.
    #[getter]
    const fn length_m(&self) -> f64 {
        self.0.length_m
    }

    /// One unit of time, 1/omega_n, in s.
    #[getter]
    const fn time_s(&self) -> f64 {
        self.0.time_s
    }

    /// The moving mass, in kg.
    #[getter]
    const fn mass_kg(&self) -> f64 {
        self.0.mass_kg
    }

    /// One unit of velocity, in m/s.
    #[getter]
    fn velocity_m_per_s(&self) -> f64 {
        self.0.velocity_m_per_s()
    }

    fn __repr__(&self) -> String {
        let Scales { length_m, time_s, mass_kg } = self.0;
        format!("Units(length_m={length_m:?}, time_s={time_s:?}, mass_kg={mass_kg:?})")
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| other.get().0 == self.0)
    }

    fn __hash__(&self) -> u64 {
        hash_of([self.0.length_m, self.0.time_s, self.0.mass_kg].into_iter())
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("length_m", self.0.length_m)?;
        keywords.set_item("time_s", self.0.time_s)?;
        keywords.set_item("mass_kg", self.0.mass_kg)?;
        Ok((PyTuple::empty(py), keywords))
    }
}

/// An oscillator that hits a stop: x'' + 2 zeta x' + x = sin(beta t + phase), x <= gap, u+ = -eps u-.
///
/// All values are nondimensional: lengths in units of F/k, times in units of 1/omega_n, phases in radians. The
/// parameters are checked at construction and cannot be changed.
///
/// Parameters
/// ----------
/// beta : float
///     Frequency ratio omega/omega_n, positive. Give exactly one of `beta` and `inverse_beta`.
/// inverse_beta : float
///     Inverse frequency ratio omega_n/omega, the abscissa of the 1971 paper.
/// gap : float
///     Distance of the stop from the rest position; if it is negative, the spring presses the mass against the stop.
/// restitution : float
///     Coefficient of restitution: speed after an impact over speed before it, 0 to 1.
/// damping : float
///     Damping ratio c / (2 sqrt(k m)), 0 or more.
/// second_gap, second_restitution : float
///     Gap and restitution of a second stop at x = -second_gap. Default restitution: that of the first stop.
/// units : Units
///     The physical units of length and time, if the oscillator has any.
///
/// Examples
/// --------
/// >>> from vibroimpact import Oscillator
/// >>> osc = Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
/// >>> osc
/// Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
/// >>> osc.replace(gap=0.5).gap
/// 0.5
/// >>> Oscillator(beta=1, gap=0, restitution=1.4)
/// Traceback (most recent call last):
///     ...
/// vibroimpact.QuestionError: restitution eps = 1.4 lies outside 0 <= eps <= 1
/// hint: eps is the ratio of velocities, not of energies
#[pyclass(frozen, from_py_object, module = "vibroimpact")]
#[derive(Clone, Copy)]
pub(crate) struct Oscillator {
    pub(crate) plan: SystemPlan,
    pub(crate) osc: vibroimpact::Oscillator,
    units: Option<Units>,
}

impl Oscillator {
    fn checked(plan: SystemPlan, units: Option<Units>) -> Result<Self, Trouble> {
        Ok(Self { plan, osc: plan.oscillator()?, units })
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let second = self.osc.stop(Side::Lower);
        [self.osc.beta(), self.osc.gap(), self.osc.restitution(), self.osc.damping()]
            .into_iter()
            .chain(second.into_iter().flat_map(|stop| [stop.gap, stop.restitution]))
    }

    /// Converts changes given by the keywords of `Oscillator` to nondimensional ones; gaps in metres are divided by
    /// F/k. For an oscillator with physical units, numbers whose unit is ambiguous are refused.
    fn nondimensional<'py>(&self, changes: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
        let own = changes.copy()?;
        for (name, metres) in [("gap", "gap_m"), ("second_gap", "second_gap_m")] {
            let Some(gap) = own.get_item(metres)? else { continue };
            let Some(Units(scales)) = self.units.filter(|_| !own.contains("units").unwrap_or(true)) else {
                return Err(Trouble::question(format!(
                    "{metres} needs the system in physical units\nhint: {name} is its nondimensional twin"
                ))
                .into());
            };
            if own.contains(name)? {
                return Err(
                    Trouble::question(format!("{name} and {metres} are one parameter, and both are given")).into()
                );
            }
            own.del_item(metres)?;
            own.set_item(name, gap.extract::<f64>()? / scales.length_m)?;
        }
        if self.units.is_none() || changes.contains("units")? {
            return Ok(own);
        }
        for (name, ours, theirs, hint) in [
            ("gap", "in F/k", "m", "gap_m=... takes metres"),
            ("second_gap", "in F/k", "m", "second_gap_m=... takes metres"),
            ("damping", "as a ratio", "N s/m", "make the machine anew with Oscillator.from_units"),
        ] {
            if let Some(value) = changes.get_item(name)?.filter(|value| !value.is_none()) {
                return Err(Trouble::question(format!(
                    "{name} = {value} of a machine may be meant {ours} or in {theirs}\nhint: {hint}; {name}=..., units=osc.units is nondimensional"
                ))
                .into());
            }
        }
        Ok(own)
    }

    /// The keyword arguments that construct an equal oscillator.
    fn keywords<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let keywords = PyDict::new(py);
        for (name, value) in self.given() {
            keywords.set_item(name, value)?;
        }
        if let Some(units) = self.units {
            keywords.set_item("units", units)?;
        }
        Ok(keywords)
    }

    /// The numbers among these arguments.
    fn given(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let plan = self.plan;
        let second = plan.second_stop;
        [
            ("beta", plan.beta),
            ("inverse_beta", plan.inverse_beta),
            ("gap", Some(plan.gap)),
            ("restitution", Some(plan.restitution)),
            ("damping", Some(plan.damping).filter(|damping| *damping != 0.0)),
            ("second_gap", second.map(|stop| stop.gap)),
            ("second_restitution", second.map(|stop| stop.restitution).filter(|e| *e != plan.restitution)),
        ]
        .into_iter()
        .filter_map(|(name, value)| Some((name, value?)))
    }
}

fn second_stop(gap: Option<f64>, restitution: Option<f64>, first: f64) -> Result<Option<SecondStop>, Trouble> {
    match (gap, restitution) {
        (None, Some(_)) => Err(Trouble::question(
            "the second stop has a restitution but no gap\nhint: second_gap, its distance from the rest position",
        )),
        (gap, restitution) => Ok(gap.map(|gap| SecondStop { gap, restitution: restitution.unwrap_or(first) })),
    }
}

#[pymethods]
impl Oscillator {
    #[new]
    #[pyo3(signature = (*, beta=None, inverse_beta=None, gap, restitution, damping=0.0, second_gap=None, second_restitution=None, units=None))]
    #[allow(clippy::too_many_arguments)] // keywords
    fn new(
        beta: Option<f64>,
        inverse_beta: Option<f64>,
        gap: f64,
        restitution: f64,
        damping: f64,
        second_gap: Option<f64>,
        second_restitution: Option<f64>,
        units: Option<Units>,
    ) -> Result<Self, Trouble> {
        let second_stop = second_stop(second_gap, second_restitution, restitution)?;
        Self::checked(SystemPlan { beta, inverse_beta, gap, restitution, damping, second_stop }, units)
    }

    /// Create an oscillator from physical units.
    ///
    /// Parameters
    /// ----------
    /// mass : float
    ///     Mass in kg.
    /// stiffness : float
    ///     Stiffness in N/m.
    /// force : float
    ///     Amplitude of the force in N.
    /// gap : float
    ///     Distance of the stop from the rest position in m.
    /// restitution : float
    ///     Coefficient of restitution: speed after an impact over speed before it, 0 to 1.
    /// frequency : float
    ///     Frequency of the force in Hz. Give exactly one of `frequency` and `omega`.
    /// omega : float
    ///     Angular frequency of the force in rad/s.
    /// damping : float
    ///     Viscous damping in N s/m.
    /// second_gap, second_restitution : float
    ///     Distance in m and restitution of a second stop on the other side.
    ///
    /// Examples
    /// --------
    /// >>> from vibroimpact import Oscillator
    /// >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
    /// >>> osc.beta, osc.gap
    /// (1.25, 2.0)
    #[classmethod]
    #[pyo3(signature = (*, mass, stiffness, force, gap, restitution, frequency=None, omega=None, damping=0.0, second_gap=None, second_restitution=None))]
    #[allow(clippy::too_many_arguments)] // keywords
    fn from_units(
        _class: &Bound<'_, PyType>,
        mass: f64,
        stiffness: f64,
        force: f64,
        gap: f64,
        restitution: f64,
        frequency: Option<f64>,
        omega: Option<f64>,
        damping: f64,
        second_gap: Option<f64>,
        second_restitution: Option<f64>,
    ) -> Result<Self, Trouble> {
        let frequency = match (frequency, omega) {
            (Some(hertz), None) => Frequency::Hz(hertz),
            (None, Some(omega)) => Frequency::RadPerS(omega),
            (both, _) => {
                let how = if both.is_some() { "twice" } else { "nowhere" };
                return Err(Trouble::question(format!(
                    "the frequency is given {how}: exactly one of frequency and omega is needed\nhint: frequency in Hz, omega in rad/s"
                )));
            }
        };
        let machine = Machine {
            mass_kg: mass,
            damping_ns_per_m: damping,
            stiffness_n_per_m: stiffness,
            force_n: force,
            frequency,
            gap_m: gap,
            restitution,
        };
        let (osc, scales) = machine.nondimensional()?;
        let second_gap = second_gap.map(|gap| gap / scales.length_m);
        let plan = SystemPlan {
            beta: Some(osc.beta()),
            inverse_beta: None,
            gap: osc.gap(),
            restitution,
            damping: osc.damping(),
            second_stop: second_stop(second_gap, second_restitution, restitution)?,
        };
        Self::checked(plan, Some(Units(scales)))
    }

    /// Return the same oscillator with other values of some parameters, given by the keywords of `Oscillator`.
    ///
    /// A new `beta` or `inverse_beta` replaces whichever was given. `second_gap=None` removes the second stop. For an
    /// oscillator with physical units, gaps are given in metres as `gap_m` or `second_gap_m`. The keywords `gap`,
    /// `second_gap` and `damping` are ambiguous there and are refused, unless `units` is given too; then they are
    /// nondimensional.
    ///
    /// >>> from vibroimpact import Oscillator
    /// >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
    /// >>> osc.replace(gap_m=0.005).gap, osc.replace(gap=1, units=osc.units).gap
    /// (1.0, 1.0)
    #[pyo3(signature = (**changes))]
    fn replace<'py>(&self, py: Python<'py>, changes: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyAny>> {
        let keywords = self.keywords(py)?;
        if let Some(changes) = changes {
            let changes = &self.nondimensional(changes)?;
            let given = |name| changes.get_item(name).map(|value| value.is_some_and(|value| !value.is_none()));
            let drop_if = |condition: bool, name| if condition { keywords.set_item(name, py.None()) } else { Ok(()) };
            drop_if(given("beta")?, "inverse_beta")?;
            drop_if(given("inverse_beta")?, "beta")?;
            drop_if(changes.contains("second_gap")? && !given("second_gap")?, "second_restitution")?;
            keywords.update(changes.as_mapping())?;
        }
        py.get_type::<Self>().call((), Some(&keywords))
    }

    /// Frequency ratio omega/omega_n.
    #[getter]
    const fn beta(&self) -> f64 {
        self.osc.beta()
    }

    /// Inverse frequency ratio omega_n/omega, exactly as given if it was given.
    #[getter]
    fn inverse_beta(&self) -> f64 {
        self.plan.inverse_beta.unwrap_or(1.0 / self.osc.beta())
    }

    /// Distance of the stop from the rest position, in units of F/k.
    #[getter]
    const fn gap(&self) -> f64 {
        self.osc.gap()
    }

    /// Coefficient of restitution: speed after an impact over speed before it.
    #[getter]
    const fn restitution(&self) -> f64 {
        self.osc.restitution()
    }

    /// Damping ratio.
    #[getter]
    const fn damping(&self) -> f64 {
        self.osc.damping()
    }

    /// Distance of the second stop, or None.
    #[getter]
    fn second_gap(&self) -> Option<f64> {
        self.osc.stop(Side::Lower).map(|stop| stop.gap)
    }

    /// Restitution of the second stop, or None.
    #[getter]
    fn second_restitution(&self) -> Option<f64> {
        self.osc.stop(Side::Lower).map(|stop| stop.restitution)
    }

    /// The physical units of length and time, or None.
    #[getter]
    const fn units(&self) -> Option<Units> {
        self.units
    }

    /// Forcing period 2 pi/beta, in units of 1/omega_n.
    #[getter]
    fn period(&self) -> f64 {
        self.osc.period()
    }

    /// Amplitude of the motion without impacts, in units of F/k; infinite at undamped resonance.
    #[getter]
    fn free_amplitude(&self) -> f64 {
        self.osc.free_amplitude()
    }

    fn __repr__(&self) -> String {
        let mut text = String::from("Oscillator(");
        for (k, (name, value)) in self.given().enumerate() {
            let comma = if k == 0 { "" } else { ", " };
            let _ = write!(text, "{comma}{name}={value:?}");
        }
        if let Some(units) = &self.units {
            let _ = write!(text, ", units={}", units.__repr__());
        }
        text + ")"
    }

    /// Whether both are equivalent: the same numbers, in whichever form the frequency was given, and the same units.
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| {
            let other = other.get();
            other.osc == self.osc && other.units.map(|units| units.0) == self.units.map(|units| units.0)
        })
    }

    fn __hash__(&self) -> u64 {
        hash_of(self.numbers())
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        Ok((PyTuple::empty(py), self.keywords(py)?))
    }
}
