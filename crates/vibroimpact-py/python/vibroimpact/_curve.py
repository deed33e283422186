"""Curves of folds, flips or grazing impacts of an orbit in a plane of two parameters."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._axis import Interval, plane
from vibroimpact._core import Oscillator
from vibroimpact._cycle import Cycles
from vibroimpact._figure import named, new_axes
from vibroimpact._plane import broken, frame
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result
from vibroimpact._tables import CURVE_MARKS, EVENT_COLOURS
from vibroimpact._whole import NUMBER, maybe

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class CurveEvent(NamedTuple):
    """A point of codimension two on a curve, or an end of the curve."""

    #: "cusp", "resonant grazing", "double grazing", "degenerate grazing", "touch", "1:2", "end of box" ...
    kind: str
    #: Values of both parameters.
    values: tuple[float, float]
    #: Index among the points of the curve.
    point: int


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Curve(Result):
    """A curve of events, from one end to the other.

    Attributes
    ----------
    osc : Oscillator
        The system at which the orbit was searched.
    label, kind : str
        The label m/n of the orbit; "fold", "flip" or "grazing".
    parameters : (str, str)
        The two parameters.
    ranges : ((float, float), (float, float))
        The ranges of the two parameters.
    values : ndarray, shape (points, 2)
        Values of the two parameters.
    physical : ndarray of bool
        Whether the orbit is admissible.
    cycles : sequence of Cycle
        The impacts at each point; on a grazing curve including the one of speed zero.
    events : list of CurveEvent
        The events, in order along the curve.
    found_at : list of float
        Values of the first parameter at the events of this kind on the branch of the orbit.
    through : (int, int)
        The number, counted from 1, of the event through which the curve passes, and its index among the points.
    orbit : (int, int)
        The number of the orbit, and the number of orbits with its label.
    plan : str
        The plan as JSON.
    """

    osc: Oscillator
    label: str
    kind: str
    parameters: tuple[str, str]
    ranges: tuple[tuple[float, float], tuple[float, float]]
    values: NDArray[np.float64]
    physical: NDArray[np.bool_]
    cycles: Cycles
    events: list[CurveEvent]
    found_at: list[float]
    through: tuple[int, int]
    orbit: tuple[int, int]
    plan: str

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<Curve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.events)} events>"

    def __len__(self) -> int:
        return len(self.values)

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """Both multipliers at each point."""
        return self.cycles.multipliers

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the curve in its plane, dotted where the orbit is inadmissible, and its points of codimension two."""
        return _draw(self, ax)

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        return {p: self.values[:, 0], q: self.values[:, 1], "physical": self.physical}

def _draw(of: Curve, ax: "Axes | None") -> "Axes":
    """Draw the curve, dotted where the orbit is inadmissible, and its points of codimension two."""
    ax = new_axes(ax, (7.2, 4.8))
    colour, events = EVENT_COLOURS[of.kind], {event.point for event in of.events}
    # an event separates two parts, so a step takes its look from the end that is no event
    steps = [k if k + 1 in events and k not in events else k + 1 for k in range(len(of) - 1)]
    for physical, dash, words in ((True, "-", ""), (False, ":", ", inadmissible")):
        xs, ys = (np.array(column, dtype=float) for column in broken(of.values, of.physical[steps] == physical))
        if len(xs):
            ax.plot(xs, ys, dash, color=colour, linewidth=1.8, label=f"{of.kind} of {named(of.label)}{words}")
    for kind, mark in CURVE_MARKS.items():
        places = [event.values for event in of.events if event.kind == kind]
        if places:
            xs, ys = np.array(places).T
            ax.plot(xs, ys, mark, color="white", markeredgecolor="black", markersize=8, label=kind, zorder=4, clip_on=False)
    begin = of.values[of.through[1]]
    ax.plot(*begin, "o", color="black", markersize=5, label="found on the branch", zorder=5)
    frame(ax, of.osc, of.parameters, of.ranges)
    return ax


def curve(
    osc: Oscillator,
    label: str,
    kind: str,
    over: Mapping[str, Interval],
    *,
    orbit: int | None = None,
    event: int | None = None,
    progress: Progress = None,
) -> Curve:
    """Follow a fold, flip or grazing impact of an orbit in a plane of two parameters.

    The orbit is searched at `osc` and followed in the first parameter to both ends of its range, as long as it keeps its
    label. From an event of the given kind the curve is followed in both directions to the edge of the plane.

    Parameters
    ----------
    osc : Oscillator
        The system at which the orbit is searched; it must lie in the plane.
    label : str
        "m/n" of the orbit there.
    kind : str
        "fold", "flip" or "grazing".
    over : mapping
        Two parameters and their ranges; the orbit is followed in the first one:
        {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}. Of a machine in physical units also two of its numbers:
        {"gap_m": (0.001, 0.01), "force_n": (20, 60)}. The velocities of the impacts are in the units of the machine at each
        point, which depend on its mass, its stiffness and what drives it.
    orbit : int
        Number of the orbit, as for `branch`.
    event : int
        Number of the event, counted from 1 in order of rising values. Default: the event nearest to `osc`.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> from vibroimpact import Oscillator, curve
    >>> osc = Oscillator(inverse_beta=0.7, gap=2, restitution=0.5)
    >>> fold = curve(osc, "1/1", "fold", {"gap": (0, 5), "inverse_beta": (0.45, 0.9)})
    >>> [(event.kind, round(event.values[0], 6)) for event in fold.events]
    [('resonant grazing', 0.333333), ('end of box', 5.0)]
    """
    first, second = plane(over)
    orbit, event = maybe("orbit", orbit, NUMBER), maybe("event", event, NUMBER)
    with watched(progress, "curves") as tell:
        found = _core.curve(osc, label, kind, first, second, orbit, event, tell)
    values = found["values"]
    return Curve(
        osc=osc,
        label=label.strip(),
        kind=kind,
        parameters=(first[0], second[0]),
        ranges=(first[1:], second[1:]),
        values=values,
        physical=found["physical"],
        cycles=Cycles.of(found["cycles"]),
        events=[CurveEvent(name, (float(values[k, 0]), float(values[k, 1])), k) for name, k in found["events"]],
        found_at=found["found_at"],
        through=found["through"],
        orbit=found["orbit"],
        plan=found["plan"],
    )
