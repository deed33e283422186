"""Oscillators, their units, and what they have in common with machines: all questions are methods."""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._documented import completed, of_field, schema

if TYPE_CHECKING:
    from vibroimpact import _continuation, _grids, _questions, _settle_many, _simulate_many

T = TypeVar("T")
F = TypeVar("F", bound=Callable[..., Any])

#: What a numerical keyword of `Oscillator.from_units` is in SI units.
_BODY = {
    "mass": "mass_kg", "stiffness": "stiffness_n_per_m", "force": "force_n", "frequency": "frequency_hz", "omega": "omega_rad_per_s",
    "damping": "damping_ns_per_m", "damping_ratio": "damping_ratio", "log_decrement": "log_decrement", "gap": "gap_m",
    "restitution": "restitution", "second_gap": "second_gap_m", "second_restitution": "second_restitution",
    "base_displacement": "base_displacement_m", "base_velocity": "base_velocity_m_per_s",
    "base_acceleration": "base_acceleration_m_per_s2", "base_phase": "base_phase", "stop_displacement": "stop_displacement_m",
    "stop_phase": "stop_phase", "unbalance": "unbalance_kg_m", "constant_force": "constant_force_n", "gravity": "gravity_m_per_s2",
}
#: Keywords of `replace` that may be meant in two units for a body: in both, and what helps.
_AMBIGUOUS = {
    "gap": ("in F/k", "m", "gap_m=... takes metres"), "second_gap": ("in F/k", "m", "second_gap_m=... takes metres"),
    "damping": ("as a ratio", "N s/m", "make the body anew with Oscillator.from_units"),
}
_NO_SECOND_GAP = "the second stop has a restitution but no gap\nhint: second_gap, its distance from the rest position"


def _documented(function: F) -> F:
    """A function of numbers of a body, whose documentation describes them in the words of plans."""
    known = schema()["$defs"]["Body"]["properties"]

    def told(name: str) -> tuple[str, str]:
        kind, words = of_field(known[_BODY.get(name, name)])
        return kind, words.replace(" and `omega_rad_per_s`", " and `omega`").replace("one of this", "one of it")

    names = ("mass", *(name for name in _BODY if name != "mass"), "stop_in_space")
    function.__doc__ = completed((function.__doc__ or "").replace("\n    ", "\n"), "Parameters", names, told)
    return function


class Questions:
    """What oscillators and machines have in common: the functions of the package, whose first argument is the system."""

    __slots__ = ()

    if TYPE_CHECKING:
        simulate = _questions.simulate
        simulate_many = _simulate_many.simulate_many
        settle = _questions.settle
        settle_many = _settle_many.settle_many
        attractors = _questions.attractors
        lyapunov = _questions.lyapunov
        orbits = _questions.orbits
        branch = _continuation.branch
        curve = _continuation.curve
        region = _continuation.region
        margins = _continuation.margins
        response = _continuation.response
        edge = _questions.edge
        basin = _grids.basin
        map = _grids.region_map
        diagram = _grids.orbit_diagram


@dataclass(frozen=True, slots=True, kw_only=True)
class Units:
    """The physical units of length, time and mass of an oscillator: F/k in m, 1/omega_n in s, and the moving mass in kg.

    Multiply a nondimensional result by a unit to get a physical value; divide a physical start by it to get a
    nondimensional one.

    >>> from vibroimpact import Oscillator
    >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
    >>> osc.units.length_m, osc.units.time_s
    (0.005, 0.05)
    """

    length_m: float
    time_s: float
    mass_kg: float

    def __post_init__(self) -> None:
        meanings = {"length_m": "F/k in m", "time_s": "1/omega_n in s", "mass_kg": "the moving mass in kg"}
        for name, meaning in meanings.items():
            value = float(getattr(self, name))
            if not (value > 0.0 and math.isfinite(value)):
                raise QuestionError(f"{name} = {value:g} lies outside 0 < {name} < infinity\nhint: it is {meaning}")
            object.__setattr__(self, name, value)

    @property
    def velocity_m_per_s(self) -> float:
        """One unit of velocity, in m/s."""
        return self.length_m / self.time_s


class _Number(Generic[T]):
    """An attribute that is a number of the oscillator."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, of: Any, owner: object = None) -> T:
        found: T = of._numbers[self._name]
        return found


class Oscillator(Questions):
    """An oscillator that hits a stop: x'' + 2 zeta x' + x = sin(beta t + phase), x <= gap, u+ = -eps u-.

    All values are nondimensional: lengths in units of F/k, times in units of 1/omega_n, phases in radians. The
    parameters are checked at construction and cannot be changed.

    Parameters
    ----------
    beta : float
        Frequency ratio omega/omega_n, positive. Give exactly one of `beta` and `inverse_beta`.
    inverse_beta : float
        Inverse frequency ratio omega_n/omega, the abscissa of the 1971 paper.
    gap : float
        Distance of the stop from the rest position; if it is negative, the spring presses the mass against the stop.
    restitution : float
        Coefficient of restitution: speed after an impact over speed before it, 0 to 1.
    damping : float
        Damping ratio c / (2 sqrt(k m)), 0 or more.
    second_gap, second_restitution : float
        Gap and restitution of a second stop at x = -second_gap. Default restitution: that of the first stop.
    units : Units
        The physical units of length and time, if the oscillator has any.

    Attributes
    ----------
    beta, inverse_beta, gap, restitution, damping, second_gap, second_restitution, units
        As given; None for an absent second stop or absent units.
    period : float
        Forcing period 2 pi/beta, in units of 1/omega_n.
    free_amplitude : float
        Amplitude of the motion without impacts, in units of F/k; infinite at undamped resonance.

    Examples
    --------
    >>> from vibroimpact import Oscillator
    >>> osc = Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
    >>> osc
    Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
    >>> osc.replace(gap=0.5).gap
    0.5
    >>> Oscillator(beta=1, gap=0, restitution=1.4)
    Traceback (most recent call last):
        ...
    vibroimpact.QuestionError: restitution eps = 1.4 lies outside 0 <= eps <= 1
    hint: eps is the ratio of velocities, not of energies
    """

    __slots__ = ("_file", "_numbers", "_units")
    _file: _core.OscillatorFile
    _numbers: dict[str, Any]
    _units: Units | None

    beta, inverse_beta, gap, restitution, damping = (_Number[float]() for _ in range(5))
    second_gap, second_restitution = _Number[float | None](), _Number[float | None]()
    period, free_amplitude = _Number[float](), _Number[float]()

    def __init__(
        self, *, beta: float | None = None, inverse_beta: float | None = None, gap: float, restitution: float, damping: float = 0.0,
        second_gap: float | None = None, second_restitution: float | None = None, units: Units | None = None,
    ) -> None:
        if second_gap is None and second_restitution is not None:
            raise QuestionError(_NO_SECOND_GAP)
        second = None if second_gap is None else (second_gap, restitution if second_restitution is None else second_restitution)
        self._set(_core.OscillatorFile(beta, inverse_beta, gap, restitution, damping, second), units)

    def _set(self, file: _core.OscillatorFile, units: Units | None) -> None:
        self._file, self._numbers, self._units = file, file.numbers(), units

    @classmethod
    def _of(cls, file: _core.OscillatorFile, units: Units | None) -> "Oscillator":
        made = cls.__new__(cls)
        made._set(file, units)
        return made

    @classmethod
    def _read(cls, json_: str, units: Units | None = None) -> "Oscillator":
        """The system of a plan."""
        return cls._of(_core.OscillatorFile.read(json_), units)

    @classmethod
    def _body(cls, file: _core.OscillatorFile) -> "Oscillator":
        """That of a body, with its units."""
        return cls._of(file, Units(**dict(zip(("length_m", "time_s", "mass_kg"), file.scales() or ()))))

    @classmethod
    @_documented
    def from_units(
        cls, *, mass: float, stiffness: float, gap: float, restitution: float, force: float = 0.0, frequency: float | None = None,
        omega: float | None = None, damping: float | None = None, damping_ratio: float | None = None,
        log_decrement: float | None = None, second_gap: float | None = None, second_restitution: float | None = None,
        base_displacement: float | None = None, base_velocity: float | None = None, base_acceleration: float | None = None,
        base_phase: float = 0.0, stop_in_space: bool = False, stop_displacement: float | None = None, stop_phase: float = 0.0,
        unbalance: float | None = None, constant_force: float | None = None, gravity: float | None = None,
    ) -> "Oscillator":
        """Create an oscillator from physical units.

        Give exactly one of `frequency` and `omega`, and at most one form of damping and one of the motion of the base.
        Positions are those relative to the motion of the stop, from the equilibrium under constant force and gravity.

        Examples
        --------
        >>> from vibroimpact import Oscillator
        >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
        >>> osc.beta, osc.gap
        (1.25, 2.0)
        """
        given = locals()
        if (frequency is None) == (omega is None):
            how = "nowhere" if frequency is None else "twice"
            hint = "hint: frequency in Hz, omega in rad/s"
            raise QuestionError(f"the frequency is given {how}: exactly one of frequency and omega is needed\n{hint}")
        if second_gap is None and second_restitution is not None:
            raise QuestionError(_NO_SECOND_GAP)
        numbers = {unit: given[name] for name, unit in _BODY.items() if given[name] is not None}
        return cls._body(_core.OscillatorFile.physical(numbers, stop_in_space))

    def replace(self, **changes: float | Units | None) -> "Oscillator":
        """Return the same oscillator with other values of some parameters, given by the keywords of `Oscillator`, or for a
        machine by their names in SI units, such as `force_n`, `mass_kg`, `frequency_hz`, `gap_m`.

        A new `beta` or `inverse_beta` replaces whichever was given. `second_gap=None` removes the second stop. For an
        oscillator with physical units, gaps are given in metres as `gap_m` or `second_gap_m`. The keywords `gap`,
        `second_gap` and `damping` are ambiguous there and are refused, unless `units` is given too; then they are
        nondimensional.

        >>> from vibroimpact import Oscillator
        >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
        >>> osc.replace(gap_m=0.005).gap, osc.replace(gap=1, units=osc.units).gap
        (1.0, 1.0)
        """
        if self._is_body and (changed := self._changed_body(changes)) is not None:
            return changed
        new = self._nondimensional(changes)
        keywords: dict[str, Any] = {**self._keywords(), "units": self._units}
        for one, other in (("beta", "inverse_beta"), ("inverse_beta", "beta")):
            if new.get(one) is not None:
                keywords.pop(other, None)
        if "second_gap" in new and new["second_gap"] is None:
            keywords.pop("second_restitution", None)
        return Oscillator(**{**keywords, **new})

    @property
    def _is_body(self) -> bool:
        return "machine" in json.loads(self._file.json)

    def _changed_body(self, changes: dict[str, Any]) -> "Oscillator | None":
        """The same body with other numbers; None if something else is to change."""
        allowed = {"restitution", "second_restitution", "beta", "inverse_beta", *_core.body_parameters()}
        # a second stop that is new has the restitution of the first, as for any oscillator
        new = {"second_gap_m", "second_restitution"} if self.second_gap is None else set()
        if not all(name in allowed - new and isinstance(value, (int, float)) for name, value in changes.items()):
            return None
        file = self._file
        for name, value in changes.items():
            file = file.with_number(name, value)
        return self._body(file)

    def _nondimensional(self, changes: dict[str, Any]) -> dict[str, Any]:
        """Changes with gaps in metres divided by F/k. For an oscillator with units, numbers whose unit is ambiguous are refused."""
        new = dict(changes)
        for name, metres in (("gap", "gap_m"), ("second_gap", "second_gap_m")):
            if metres not in new:
                continue
            if self._units is None or "units" in changes:
                raise QuestionError(f"{metres} needs the system in physical units\nhint: {name} is its nondimensional twin")
            if name in new:
                raise QuestionError(f"{name} and {metres} are one parameter, and both are given")
            new[name] = new.pop(metres) / self._units.length_m
        for name, (ours, theirs, hint) in _AMBIGUOUS.items():
            if self._units is not None and "units" not in changes and changes.get(name) is not None:
                raise QuestionError(
                    f"{name} = {changes[name]} of a body may be meant {ours} or in {theirs}\n"
                    f"hint: {hint}; {name}=..., units=osc.units is nondimensional"
                )
        return new

    def _keywords(self) -> dict[str, float]:
        """The numbers among the arguments of an equal oscillator."""
        given = {name: of for name, of in json.loads(self._file.json).items() if of is not None and name != "machine"}
        second = given.pop("second_stop", None)
        if not given["damping"]:
            del given["damping"]
        if second is not None:
            given["second_gap"] = second["gap"]
            if second["restitution"] != given["restitution"]:
                given["second_restitution"] = second["restitution"]
        return given

    @property
    def units(self) -> Units | None:
        """The physical units of length and time, or None."""
        return self._units

    def __repr__(self) -> str:
        given = {**self._keywords(), **({} if self._units is None else {"units": self._units})}
        return f"Oscillator({', '.join(f'{name}={value!r}' for name, value in given.items())})"

    def _key(self) -> tuple[Any, ...]:
        # the same numbers, in whichever form the frequency was given
        names = ("beta", "gap", "restitution", "damping", "second_gap", "second_restitution")
        return (*(self._numbers[name] for name in names), self._units)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Oscillator) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> tuple[Any, ...]:
        return Oscillator._read, (self._file.json, self._units)
