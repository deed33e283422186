"""Lyapunov exponents of a motion and the dimension of its attractor."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core, _exponents
from vibroimpact._core import Oscillator
from vibroimpact._figure import named, title
from vibroimpact._motion import Motion, fields_of
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result
from vibroimpact._sections import Impacts, Strobes, sections
from vibroimpact._whole import MEASURED, SECTION, TRANSIENT, maybe, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Measured(NamedTuple):
    """A number and its error bar, which is three standard errors; 0 if the number is exact."""

    value: float
    error: float

@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Lyapunov(Result):
    """Both Lyapunov exponents of a motion with error bars, and sections of its attractor.

    Attributes
    ----------
    osc : Oscillator
        The system.
    motion : Motion
        The motion after the transient.
    exponents, exponents_per_period : tuple of Measured
        The exponents, the larger one first, per unit of time and per forcing period.
    sum : Measured
        The measured sum of both exponents.
    identity : float
        The exact value of the sum: 2 ln(eps) times the rate of impacts, minus 2 zeta.
    impacts_per_period : Measured
        Number of impacts per forcing period.
    dimension : Measured or None
        Kaplan-Yorke dimension of the stroboscopic section; None if the larger exponent is not known to differ from 0.
    flow_dimension : Measured or None
        Kaplan-Yorke dimension of the flow in the space of position, velocity and phase.
    grounds : dict
        How the exponents were obtained: "kind" is "measured", "no_impact", "sticks", "stuck", "touches" or "undecided".
    impacts, strobes : named tuples of ndarray
        Points of both sections; empty unless requested.
    plan : str
        The plan as JSON.
    """

    osc: Oscillator
    motion: Motion
    exponents: tuple[Measured, Measured]
    exponents_per_period: tuple[Measured, Measured]
    sum: Measured
    identity: float
    impacts_per_period: Measured
    dimension: Measured | None
    flow_dimension: Measured | None
    grounds: dict[str, Any]
    impacts: Impacts
    strobes: Strobes
    plan: str

    def __repr__(self) -> str:
        one, two = self.exponents
        return f"<Lyapunov {one.value:.5g} +- {one.error:.1g}, {two.value:.5g} +- {two.error:.1g}, {self.motion.label}>"

    def _table(self) -> dict[str, Any]:
        """One row for each measured number."""
        measured = {
            "exponent 1": self.exponents[0], "exponent 2": self.exponents[1], "sum": self.sum,
            "impacts per period": self.impacts_per_period, "dimension": self.dimension,
            "dimension of the flow": self.flow_dimension,
        }
        known = {name: of for name, of in measured.items() if of is not None}
        return {
            "name": list(known), "value": [of.value for of in known.values()], "error": [of.error for of in known.values()],
        }

    def plot(self, axes: "tuple[Axes, Axes] | None" = None) -> "tuple[Axes, Axes]":
        """Draw both sections of the attractor: phase and speed of its impacts, and its states at phase 0."""
        if not len(self.impacts.phase) and not len(self.strobes.x):
            raise _core.QuestionError("there are no points of the sections\nhint: lyapunov(..., points=5000)")
        return sections(self.osc, self.impacts, self.strobes, axes)

    def _draw(self, ax: Any) -> None:
        exact = not any(of.error for of in self.exponents)
        _exponents.plot(self.exponents, exact, f"{title(self.osc)}: {named(self.motion.label)}", ax)

def lyapunov(
    osc: Oscillator,
    *,
    x: float | None = None,
    v: float = 0.0,
    phase: float = 0.0,
    impacts: int = 100_000,
    transient: int = 1000,
    points: int | None = None,
    progress: Progress = None,
) -> Lyapunov:
    """Measure both Lyapunov exponents of a motion, with error bars, and the dimension of its attractor.

    Parameters
    ----------
    osc : Oscillator
        The system.
    x, v, phase : float
        Start: position in units of F/k (default: at rest, or on the stop), velocity, phase of the force in radians.
    impacts : int
        Number of impacts of the measurement, 1000 to 1e7; the error bar decreases with its square root.
    transient : int
        Number of impacts before the measurement, and of forcing periods before the stroboscopic section.
    points : int
        Number of points of each section of the attractor, 1 to 100000; by default no sections.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> from vibroimpact import Oscillator, lyapunov
    >>> found = lyapunov(Oscillator(inverse_beta=1.11, gap=3, restitution=0.5), impacts=10_000)
    >>> found.motion.label, found.exponents[0].value > found.exponents[0].error
    ('chaotic', True)
    >>> abs(found.sum.value - found.identity) < 1e-9
    True
    """
    impacts, transient = whole("impacts", impacts, MEASURED), whole("transient", transient, TRANSIENT)
    section = maybe("points", points, SECTION)
    with watched(progress, "impacts") as tell:
        fields = _core.lyapunov(osc, (x, v, phase), impacts, transient, section, tell)

    def measured(name: str) -> Measured | None:
        return None if fields[name] is None else Measured(*fields[name])

    def both(name: str) -> tuple[Measured, Measured]:
        one, two = fields[name]
        return Measured(*one), Measured(*two)

    return Lyapunov(
        osc=osc,
        motion=Motion(**fields_of(osc, fields["motion"])),
        exponents=both("exponents"),
        exponents_per_period=both("exponents_per_period"),
        sum=Measured(*fields["sum"]),
        identity=fields["identity"],
        impacts_per_period=Measured(*fields["impacts_per_period"]),
        dimension=measured("section_dimension"),
        flow_dimension=measured("flow_dimension"),
        grounds=fields["grounds"],
        impacts=Impacts(*fields["impacts"]),
        strobes=Strobes(*fields["strobes"]),
        plan=fields["plan"],
    )
