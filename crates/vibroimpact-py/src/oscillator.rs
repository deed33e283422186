//! `Oscillator` and `Units`, which are checked at construction and immutable.

use crate::error::Trouble;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use std::collections::hash_map::DefaultHasher;
use std::fmt::Write;
use std::hash::{Hash, Hasher};
use vibroimpact::{PhysicalParameter, Scales, Side};
use vibroimpact_study::{Parameter, PhysicalPlan, SecondStop, SystemPlan};

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
pub(crate) struct Units(pub(crate) Scales);

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
        if let Some(machine) = &self.plan.machine {
            let text = serde_json::to_string(&PhysicalPlan::from(machine));
            keywords.set_item("machine", text.map_err(|_| Trouble::Defect("writing the machine"))?)?;
        }
        Ok(keywords)
    }

    /// The same machine with other numbers; `None` if it is no machine, or if something else is to change.
    fn changed_machine(&self, changes: &Bound<'_, PyDict>) -> PyResult<Option<Self>> {
        let mut plan = self.plan;
        for (name, value) in changes {
            let (name, value) = (name.extract::<String>()?, value.extract::<f64>());
            let parameter = match name.as_str() {
                "restitution" => Some(Parameter::Restitution),
                "second_restitution" => Some(Parameter::SecondRestitution),
                "beta" => Some(Parameter::Beta),
                "inverse_beta" => Some(Parameter::InverseBeta),
                name => Parameter::from_name(name).filter(|parameter| matches!(parameter, Parameter::Physical(_))),
            };
            // a second stop that is new has the restitution of the first, as for any oscillator
            let second = [Parameter::Physical(PhysicalParameter::SecondGap), Parameter::SecondRestitution];
            let new = |of: Parameter| second.contains(&of) && plan.second_stop.is_none();
            let (Some(parameter), Ok(value), true) = (parameter.filter(|of| !new(*of)), value, plan.machine.is_some())
            else {
                return Ok(None);
            };
            plan = plan.with(parameter, value).map_err(Trouble::from)?;
        }
        Ok(Some(Self::checked(plan, plan.scales().map(Units))?))
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
        (None, Some(_)) => Err(no_second_gap()),
        (gap, restitution) => Ok(gap.map(|gap| SecondStop { gap, restitution: restitution.unwrap_or(first) })),
    }
}

fn no_second_gap() -> Trouble {
    Trouble::question(
        "the second stop has a restitution but no gap\nhint: second_gap, its distance from the rest position",
    )
}

#[pymethods]
impl Oscillator {
    #[new]
    #[pyo3(signature = (*, beta=None, inverse_beta=None, gap, restitution, damping=0.0, second_gap=None, second_restitution=None, units=None, machine=None))]
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
        machine: Option<&str>,
    ) -> Result<Self, Trouble> {
        // the form in which the oscillator of a machine is pickled
        if let Some(text) = machine {
            let machine: PhysicalPlan = serde_json::from_str(text)
                .map_err(|error| Trouble::question(format!("machine = {text} does not read: {error}")))?;
            return Self::checked(SystemPlan::of_machine(machine.driven()?)?, units);
        }
        let second_stop = second_stop(second_gap, second_restitution, restitution)?;
        let machine = None;
        Self::checked(SystemPlan { beta, inverse_beta, gap, restitution, damping, second_stop, machine }, units)
    }

    /// Create an oscillator from physical units.
    ///
    /// Parameters
    /// ----------
    /// mass : float
    ///     Mass in kg.
    /// stiffness : float
    ///     Stiffness in N/m.
    /// gap : float
    ///     Distance of the stop from the rest position in m.
    /// restitution : float
    ///     Coefficient of restitution: speed after an impact over speed before it, 0 to 1.
    /// force : float
    ///     Amplitude of the force in N; 0 only if something else drives the machine.
    /// frequency : float
    ///     Frequency of the force in Hz. Give exactly one of `frequency` and `omega`.
    /// omega : float
    ///     Angular frequency of the force in rad/s.
    /// damping, damping_ratio, log_decrement : float
    ///     Viscous damping in N s/m, or as damping ratio, or as logarithmic decrement; one of them, or none.
    /// second_gap, second_restitution : float
    ///     Distance in m and restitution of a second stop on the other side.
    /// base_displacement, base_velocity, base_acceleration : float
    ///     Amplitude of the motion of the base in m, m/s or m/s^2; one of them, or none. The stop is on the base.
    /// base_phase : float
    ///     Phase of the base relative to the force, in radians.
    /// stop_in_space : bool
    ///     The stop is fixed in space and does not move with the base.
    /// stop_displacement, stop_phase : float
    ///     Amplitude in m and phase of the motion of the stop, if the base is at rest.
    /// unbalance : float
    ///     Rotating unbalance in kg m, whose force grows as the square of the frequency.
    /// constant_force : float
    ///     Constant force in N towards the stop.
    /// gravity : float
    ///     Acceleration of gravity in m/s^2 towards the stop; negative away from it.
    ///
    /// Positions are those relative to the motion of the stop, from the equilibrium under constant force and gravity.
    ///
    /// Examples
    /// --------
    /// >>> from vibroimpact import Oscillator
    /// >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
    /// >>> osc.beta, osc.gap
    /// (1.25, 2.0)
    #[classmethod]
    #[pyo3(signature = (*, mass, stiffness, gap, restitution, force=0.0, frequency=None, omega=None, damping=None, damping_ratio=None, log_decrement=None, second_gap=None, second_restitution=None, base_displacement=None, base_velocity=None, base_acceleration=None, base_phase=0.0, stop_in_space=false, stop_displacement=None, stop_phase=0.0, unbalance=None, constant_force=None, gravity=None))]
    #[allow(clippy::too_many_arguments)] // keywords
    fn from_units(
        _class: &Bound<'_, PyType>,
        mass: f64,
        stiffness: f64,
        gap: f64,
        restitution: f64,
        force: f64,
        frequency: Option<f64>,
        omega: Option<f64>,
        damping: Option<f64>,
        damping_ratio: Option<f64>,
        log_decrement: Option<f64>,
        second_gap: Option<f64>,
        second_restitution: Option<f64>,
        base_displacement: Option<f64>,
        base_velocity: Option<f64>,
        base_acceleration: Option<f64>,
        base_phase: f64,
        stop_in_space: bool,
        stop_displacement: Option<f64>,
        stop_phase: f64,
        unbalance: Option<f64>,
        constant_force: Option<f64>,
        gravity: Option<f64>,
    ) -> Result<Self, Trouble> {
        if frequency.is_some() == omega.is_some() {
            let how = if frequency.is_some() { "twice" } else { "nowhere" };
            return Err(Trouble::question(format!(
                "the frequency is given {how}: exactly one of frequency and omega is needed\nhint: frequency in Hz, omega in rad/s"
            )));
        }
        if second_gap.is_none() && second_restitution.is_some() {
            return Err(no_second_gap());
        }
        let machine = PhysicalPlan {
            mass_kg: Some(mass),
            stiffness_n_per_m: Some(stiffness),
            force_n: Some(force),
            frequency_hz: frequency,
            omega_rad_per_s: omega,
            damping_ns_per_m: damping,
            damping_ratio,
            log_decrement,
            gap_m: Some(gap),
            restitution: Some(restitution),
            second_gap_m: second_gap,
            second_restitution,
            base_displacement_m: base_displacement,
            base_velocity_m_per_s: base_velocity,
            base_acceleration_m_per_s2: base_acceleration,
            base_phase,
            stop_in_space,
            stop_displacement_m: stop_displacement,
            stop_phase,
            unbalance_kg_m: unbalance,
            constant_force_n: constant_force,
            gravity_m_per_s2: gravity,
        };
        let machine = machine.driven()?;
        let scales = machine.reduced()?.scales;
        Self::checked(SystemPlan::of_machine(machine)?, Some(Units(scales)))
    }

    /// Return the same oscillator with other values of some parameters, given by the keywords of `Oscillator`, or for a
    /// machine by their names in SI units, such as `force_n`, `mass_kg`, `frequency_hz`, `gap_m`.
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
            if let Some(changed) = self.changed_machine(changes)? {
                return Ok(Bound::new(py, changed)?.into_any());
            }
            if keywords.contains("machine")? {
                keywords.del_item("machine")?;
            }
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
