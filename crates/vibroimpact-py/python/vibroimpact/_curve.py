"""A fold, flip or grazing of an orbit over a plane of two parameters."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._axis import Interval, plane
from vibroimpact._core import Oscillator
from vibroimpact._cycle import Cycles, pairs
from vibroimpact._whole import NUMBER, maybe

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class CurveEvent(NamedTuple):
    """A point of codimension two on a curve, or its end."""

    #: "cusp", "resonant grazing", "double grazing", "degenerate grazing", "touch", "1:2", "end of box" ...
    kind: str
    #: Of both parameters.
    values: tuple[float, float]
    #: Place among the points.
    point: int


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Curve:
    """A curve of events, from one end to the other.

    Attributes
    ----------
    osc : Oscillator
        The system the orbit was looked for at.
    label, kind : str
        m/n of the orbit; "fold", "flip" or "grazing".
    parameters : (str, str)
        The two parameters.
    ranges : ((float, float), (float, float))
        The box that was looked at.
    values : ndarray, shape (points, 2)
        Values of the two parameters.
    physical : ndarray of bool
        Whether the orbit is a possible motion.
    cycles : sequence of Cycle
        The impacts at each point, on a grazing curve with the one of speed zero.
    events : list of CurveEvent
        In order along the curve.
    found_at : list of float
        Values of the first parameter at the events of that kind on the branch of the orbit.
    through : (int, int)
        Which of these the curve goes through, counted from 1, and its place among the points.
    orbit : (int, int)
        The number of the orbit, and how many there are.
    plan : str
        The question as JSON.
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
        """The curve in its plane, dotted where the orbit is inadmissible, with its points of codimension two."""
        from vibroimpact import _plane

        return _plane.curve(self, ax)

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON, a number that is not finite as None."""
        points = zip(self.values.tolist(), self.physical.tolist(), self.cycles, self.multipliers)
        return {
            "label": self.label,
            "kind": self.kind,
            "parameters": list(self.parameters),
            "orbit": {"number": self.orbit[0], "count": self.orbit[1]},
            "found_at": self.found_at,
            "through": {"event": self.through[0], "point": self.through[1]},
            "points": [
                {"values": values, "physical": physical, "cycle": cycle.to_list(), "multipliers": pairs(multipliers)}
                for values, physical, cycle, multipliers in points
            ],
            "events": [{"kind": e.kind, "values": list(e.values), "point": e.point} for e in self.events],
        }


def curve(
    osc: Oscillator,
    label: str,
    kind: str,
    over: Mapping[str, Interval],
    *,
    orbit: int | None = None,
    event: int | None = None,
) -> Curve:
    """Follow an event of an orbit over a plane of two parameters: where it folds, flips or grazes.

    The orbit is looked for at `osc` and followed in the first parameter to both ends of its range, while it keeps its
    label; from an event of that kind the curve is followed both ways to the edge of the plane.

    Parameters
    ----------
    osc : Oscillator
        The system the orbit is looked for at; it lies in the plane.
    label : str
        "m/n" of the orbit there.
    kind : str
        "fold", "flip" or "grazing".
    over : mapping
        Two parameters and their ranges, the one in which the orbit is followed first:
        {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}.
    orbit : int
        Which of several orbits, as for `branch`.
    event : int
        Which of several events, counted from 1 from small values to large; the nearest unless given.

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
    found = _core.curve(osc, label, kind, first, second, orbit, event)
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
