"""Curves of an event of an orbit in a plane of two numbers."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact._ask import Start, System, ask, given
from vibroimpact._axis import Interval, plane
from vibroimpact._branch import orbit_of, rows_of
from vibroimpact._core import QuestionError
from vibroimpact._events import Events
from vibroimpact._oscillator import Oscillator
from vibroimpact._progress import Progress
from vibroimpact._result import Column, Field, View
from vibroimpact._whole import BRANCH, NUMBER, maybe

class CurveEvent(View):
    """A point of codimension two on a curve, or an end of the curve.

    Attributes
    ----------
    kind : str
        "cusp", "resonant grazing", "double grazing", "1:1", "1:2", "fold-flip", "end of box" ...
    values : list of float
        Values of both numbers.
    point : int
        Index among the points of the curve.
    stop : str or None
        The stop or joint, if there is one.
    """

    kind: str
    values: list[float]
    point: int
    stop: str | None

    def __repr__(self) -> str:
        return f"<CurveEvent {self.kind} at {self.values[0]:.9g}, {self.values[1]:.9g}>"


class Curve(View):
    """A curve of an event of an orbit, from one end to the other.

    Attributes
    ----------
    system : Oscillator or Machine
        The system at which the orbit was searched.
    label, kind : str
        The label of the orbit; "fold", "flip", "grazing", of a machine also "torus", "corner", "sticking" or "holding".
    of : list of str or None
        The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    parameters : (str, str)
        The two numbers.
    ranges : ((float, float), (float, float))
        Their ranges.
    values : ndarray, shape (points, 2)
        Values of the two numbers.
    admissible : ndarray of bool
        Whether the orbit is admissible.
    multipliers : ndarray of complex128
        Floquet multipliers; on a curve of grazing of a machine those of the cycle without the contact.
    residual : ndarray
        Of a machine: by how much the condition of the curve fails at each point. nan of an oscillator.
    cycles : list of Events
        The events at each point; on a grazing curve of an oscillator including the impact of speed zero.
    events : list of CurveEvent
        The events, in order along the curve.
    found_at : list of float
        Values of the first number at the events of this kind on the branch of the orbit.
    through : (int, int)
        The number, counted from 1, of the event through which the curve passes, and its index among the points.
    orbit : (int, int) or None
        The number of the orbit, and the number of orbits with its label; None for the motion from the start.
    plan : str
        The plan as JSON.
    """

    label: str
    kind: str
    of: list[str] | None
    found_at: list[float]
    orbit = Field(orbit_of)
    through: Field[tuple[int, int]] = Field(lambda of: (of["event"], of["point"]))
    admissible, residual = Column(np.bool_), Column(np.float64)

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<Curve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.events)} events>"

    def __len__(self) -> int:
        return len(self._rows)

    @property
    def parameters(self) -> tuple[str, str]:
        """The two numbers."""
        one, two = self._of["parameters"]
        return one, two

    @property
    def ranges(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Their ranges."""
        task = self._of["plan"]["task"]["curve"]
        one, two = ((task[name]["from"], task[name]["to"]) for name in ("vary", "and"))
        return one, two

    @cached_property
    def values(self) -> NDArray[np.float64]:
        """Values of the two numbers."""
        return np.array([point["values"] for point in self._rows], dtype=np.float64).reshape(len(self), 2)

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers in rows."""
        return rows_of(self._rows)

    @cached_property
    def cycles(self) -> list[Events]:
        """The events at each point."""
        return [Events.of(point["cycle"], self.system) for point in self._rows]

    @cached_property
    def events(self) -> list[CurveEvent]:
        """The points of codimension two and the ends."""
        return [CurveEvent(of, self.system) for of in self._of["events"]]

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        columns = {p: self.values[:, 0], q: self.values[:, 1], "admissible": self.admissible}
        return columns if isinstance(self.system, Oscillator) else {**columns, "residual": self.residual}


def curve(
    system: System,
    kind: str,
    over: Mapping[str, Interval],
    *,
    label: str | None = None,
    orbit: int | None = None,
    event: int | None = None,
    points: int | None = None,
    q: ArrayLike | None = None,
    qdot: ArrayLike | None = None,
    phase: float | None = None,
    progress: Progress = None,
) -> Curve:
    """Follow an event of an orbit in a plane of two numbers.

    The orbit is searched at `system` and followed in the first number to both ends of its range, as long as it keeps its
    label. From an event of the given kind the curve is followed in both directions to the edge of the plane.

    Parameters
    ----------
    system : Oscillator or Machine
        The system at which the orbit is searched; it must lie in the plane.
    kind : str
        "fold", "flip" or "grazing"; of a machine also "torus", "corner", and "sticking" and "holding", the begin and the end of sticking
        on a stop and of holding of a friction joint.
    over : mapping
        Two numbers and their ranges; the orbit is followed in the first one:
        {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}. With physical units also {"gap_m": (0.001, 0.01), "force_n": (20, 60)}; the
        velocities of the impacts are in the units at each point, which depend on the mass, the stiffness and what drives it. Of a
        machine paths.
    label : str
        "m/n" of the orbit there, "m/T" without forcing. Default, of a machine only: that of the motion from the start.
    orbit : int
        Number of the orbit, as for `branch`.
    event : int
        Number of the event, counted from 1 in order of rising values. Default: the event nearest to `system`.
    points : int
        Of a machine the largest number of points in each direction, 2 to 100 000.
    q, qdot, phase : array, array, float
        Start of a machine: coordinates, velocities and phase. Default: those of its `start`, or 0.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> osc = vi.Oscillator(inverse_beta=0.7, gap=2, restitution=0.5)
    >>> fold = vi.curve(osc, "fold", {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}, label="1/1")
    >>> [(event.kind, round(event.values[0], 6)) for event in fold.events]
    [('resonant grazing', 0.333333), ('end of box', 5.0)]
    >>> found = vi.Machine.named("two-mass-hammer").curve("grazing", {"frequency": (0.9, 1.3), "b": (0.4, 0.6)})
    >>> found.kind, [event.kind for event in found.events]
    ('grazing', ['end of box', 'end of box'])
    """
    if label is None and isinstance(system, Oscillator):
        raise QuestionError('the curve of an oscillator needs the label of its orbit\nhint: label="1/1"')
    name = "parameter" if isinstance(system, Oscillator) else "path"
    vary, and_ = ({name: path, "from": first, "to": last} for path, first, last in plane(over))
    task = given(label=label, kind=kind, vary=vary, orbit=maybe("orbit", orbit, NUMBER), event=maybe("event", event, NUMBER),
                 points=maybe("points", points, BRANCH))
    start = Start(system, None, None, q, qdot, phase if not isinstance(system, Oscillator) else None)
    return Curve.answering(ask(system, "curve", {**task, "and": and_}, start, progress=progress, what="curves"), system)
