"""Lyapunov exponents of a motion and the dimension of its attractor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._events import all_measured, maybe_measured
from vibroimpact._motion import Motion
from vibroimpact._oscillator import Oscillator
from vibroimpact._paint import named
from vibroimpact._result import Answer, Floats, Made, equal, field, part

if TYPE_CHECKING:
    from matplotlib.axes import Axes
#: The first colour of series.
_BLUE = "#0072b2"


class Closings(NamedTuple):
    """The section of an attractor at the closings of stops: stop, phase and speed, and coordinates and velocities after it."""

    stop: NDArray[np.str_]
    phase: Floats
    speed: Floats
    #: Closings x coordinates.
    q: Floats
    qdot: Floats


class Strobes(NamedTuple):
    """The stroboscopic section: coordinates and velocities at phase 0 of the force, states x coordinates."""

    q: Floats
    qdot: Floats


class Lyapunov(Answer, schema="lyapunov"):
    """The Lyapunov exponents of a motion with error bars, two for each coordinate, and sections of its attractor.

    Attributes
    ----------
    dimension, flow_dimension : Measured or None
        Kaplan-Yorke dimension of the stroboscopic section, and of the flow; None if the largest exponent is not known to differ from 0.
    closings, strobes : named tuples of ndarray
        Points of both sections; empty unless requested.
    """

    identity: float | None
    exact: bool
    grounds: dict[str, Any] | None
    exponents, exponents_per_period = field(all_measured), field(all_measured)
    sum, impacts_per_period = field(maybe_measured), field(maybe_measured)
    motion = part(Motion)
    dimension, flow_dimension = field(maybe_measured, "dimension.section"), field(maybe_measured, "dimension.flow")

    _points: Made[dict[str, Any]] = Made(lambda of: (of._answer and of._answer.columns()) or _no_points(of._of))
    closings: Made[Closings] = Made(
        lambda of: Closings(np.array(of._points["stop"], np.str_), *(of._points[name] for name in ("phase", "speed", "q", "qdot")))
    )
    strobes: Made[Strobes] = Made(lambda of: Strobes(of._points["strobe_q"], of._points["strobe_qdot"]))

    def __getstate__(self) -> dict[str, Any]:
        return {**super().__getstate__(), "_points": self._points}

    def __eq__(self, other: object) -> bool:
        same = super().__eq__(other)
        return same if same is not True else equal((self.closings, self.strobes), (other.closings, other.strobes))  # type: ignore[attr-defined]

    def __repr__(self) -> str:
        first = f"{self.exponents[0].value:.5g} +- {self.exponents[0].error:.1g}" if self.exponents else "unknown"
        return f"<Lyapunov, largest {first}, {self.motion.label}>"

    def _table(self) -> dict[str, Any]:
        """One row for each measured number."""
        found = {f"exponent {k + 1}": of for k, of in enumerate(self.exponents or ())}
        more = {
            "sum": self.sum, "impacts per period": self.impacts_per_period, "dimension": self.dimension,
            "dimension of the flow": self.flow_dimension,
        }
        found |= {name: of for name, of in more.items() if of is not None}
        return {"name": list(found), "value": [of.value for of in found.values()], "error": [of.error for of in found.values()]}

    def plot(
        self, ax: Any = None, *, si: bool = False, legend: bool = True, title: str | None = None, **line: Any
    ) -> "Axes":
        """Draw the exponents with their error bars, per unit of time of the system."""
        if not self.exponents:
            raise _core.QuestionError("there are no exponents: the motion ended before they could be measured")
        known = [(k + 1, of.value, np.nan_to_num(of.error)) for k, of in enumerate(self.exponents) if np.isfinite(of.value)]
        if not known:
            raise _core.QuestionError("there are no finite exponents to draw")
        place, value, error = np.array(known).T
        bars = [[low, high, np.nan] for low, high in zip(value - error, value + error)]
        look = {"colour": _BLUE, "size": 10, "shape": "circle", "filled": True, "rim": None}
        stroke = {"colour": _BLUE, "width": 2.5, "dash": "solid"}
        marks = [
            {"h_line": {"y": 0.0, "stroke": {"colour": "#999999", "width": 1.2, "dash": "solid"}}},
            {"points": {"xs": place, "ys": value, "style": look}},
            {"line": {"xs": np.repeat(place, 3), "ys": np.concatenate(bars), "stroke": stroke}},
        ]
        system = self.system
        heading = _core.title_of(system._file) if isinstance(system, Oscillator) else str(system.title or "machine").split(": ")[0]
        count, name = len(self.exponents), "exact" if self.exact else "with three standard errors"
        ticks = [{"value": k, "label": str(k)} for k in range(1, count + 1)]
        across = {"label": "number of the exponent", "scale": "linear", "range": (0.5, count + 0.5), "ticks": ticks}
        up = {"label": "exponent per unit of time", "scale": "linear", "range": None, "ticks": None}
        figure = {
            "panels": [{"marks": marks, "x": across, "y": up, "caption": None}], "columns": 1, "width": 640, "height": 360,
            "title": f"{heading}: {named(self.motion.label)}", "legend": {"entries": [{"key": {"point": look}, "label": name}]},
        }
        drawn: Axes = self._painted(figure, ax, legend, title, line)
        return drawn

    def plot_sections(
        self, axes: Any = None, *, legend: bool = True, title: str | None = None, **line: Any
    ) -> "NDArray[Any]":
        """Draw both sections of the attractor: the phase and speed of closings, and the plane of each coordinate and its velocity
        at phase 0.

        `axes` are as many as there are panels. Returns the axes.
        """
        if not len(self.closings.phase) and not len(self.strobes.q):
            raise _core.QuestionError("there are no points of the sections\nhint: lyapunov(..., points=5000)")
        drawn: NDArray[Any] = self._painted(self._figure(), axes, legend, title, line)
        return drawn


def _no_points(of: dict[str, Any]) -> dict[str, Any]:
    none, states = np.empty(0), np.empty((0, len(of["system"]["coordinates"])))
    return {"stop": [], "phase": none, "speed": none, **dict.fromkeys(("q", "qdot", "strobe_q", "strobe_qdot"), states)}
