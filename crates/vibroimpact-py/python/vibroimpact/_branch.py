"""Branches of periodic orbits in one number of the system, and curves of their events in two."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._events import Events, complex_of
from vibroimpact._oscillator import Oscillator
from vibroimpact._region import pair, pairs, ranges
from vibroimpact._result import Answer, Floats, Made, View, column, field, parts


def _orbit(found: Mapping[str, Any] | None) -> tuple[int, int] | None:
    """The number of an orbit, and how many there are."""
    return None if found is None else (found["number"], found["count"])


def _multipliers(points: list[dict[str, Any]]) -> NDArray[np.complex128]:
    """The multipliers of all points, in rows."""
    each = len(points[0]["multipliers"]) if points else 0
    return complex_of([of for point in points for of in point["multipliers"]]).reshape(len(points), each)


class _Followed(Answer):
    """What branches and curves have in common: a cycle at each point, and the orbit at which they begin."""

    orbit = field(_orbit)
    multipliers: Made[NDArray[np.complex128]] = Made(lambda of: _multipliers(of._rows))
    cycles: Made[list[Events]] = Made(lambda of: [Events.of(at["cycle"], of.system) for at in of._rows])

    def __len__(self) -> int:
        return len(self._rows)


class BranchEvent(View, schema="branch BranchEventObject"):
    """An event at a point of a branch, or the reason why the branch ends.

    Attributes
    ----------
    kind : str
        "fold", "flip", "torus", "branch point", "grazing", "loss of contact", "sticking begins", "soft landing", ..., or the reason
        why the branch ends: "end of range", "closed", "halving", "step limit", "impact limit", "no convergence".
    """

    kind: str
    parameter: float
    values: list[float] | None
    point: int
    ends: bool
    before: str
    after: str | None
    stop: str | None
    appears: bool | None
    turns: bool | None
    impact: int | None
    phase: float | None
    also: dict[str, Any] | None

    def __repr__(self) -> str:
        return f"<BranchEvent {self.kind} at {self.parameter:.9g}>"


class Origin(NamedTuple):
    """The event at which a further branch begins."""

    kind: str
    parameter: float
    #: Number of the branch on which the event lies, counted from 1; the branch of the chosen orbit is number 1.
    branch: int


class Branch(_Followed, schema="branch BranchObject PointObject"):
    """A branch of periodic orbits; each point is one step along it.

    Attributes
    ----------
    ends : (float, float)
        The ends of the range of the number that varies.
    second : ndarray or None
        The value of the number that varies with it, at each point.
    speed : ndarray
        The largest speed of a closing at each point; 0 without closings.
    quantity, value : str or None, ndarray or None
        Of a machine without stops the path of the quantity that the figure shows, and its value at each point.
    cycles : list of Events
        The events at each point.
    origin : Origin or None
        The event at which it begins; None for the branch of the chosen orbit.
    followed : list of Branch
        The branches that begin on it, the branches that begin on those, and so on.
    number : int
        The number of the branch: 0 for that of the chosen orbit, from 1 for those that begin on it.
    """

    vary: str
    period, parameter, label = column(np.float64), column(np.float64), column(np.str_)
    stable, admissible, stability = column(np.bool_), column(np.bool_), column(np.str_)
    _one: Made[dict[str, Any]] = Made(lambda of: of._of["branches"][of.number])
    _rows: Made[list[dict[str, Any]]] = Made(lambda of: of._one["points"])
    #: Whose branch it is: 0 for that of the chosen orbit.
    number: int
    ends: Made[tuple[float, float]] = Made(lambda of: (of._of["from"], of._of["to"]))
    start: Made[int] = Made(lambda of: of._one.get("start", 0))
    also: Made[tuple[str, float, float] | None] = field(lambda of: of and (of["parameter"], of["from"], of["to"]))
    second: Made[Floats | None] = Made(lambda of: None if of.also is None else np.array([at["values"][1] for at in of._rows]))
    origin: Made[Origin | None] = Made(lambda of: of._one["from"] and Origin(**{"branch": 1, **of._one["from"]}))
    events: Made[list[BranchEvent]] = Made(lambda of: [BranchEvent(one, of.system) for one in of._one["events"]])
    speed: Made[Floats] = Made(lambda of: np.array([cycle.speed[cycle.closes].max(initial=0.0) for cycle in of.cycles]))
    drift: Made[Floats] = Made(lambda of: np.array([of._drift(at) for at in of._rows], dtype=np.float64))
    quantity: Made[str | None] = Made(lambda of: next((next(iter(at["quantities"])) for at in of._rows if "quantities" in at), None))
    value: Made[Floats | None] = Made(lambda of: of.quantity and np.array([at["quantities"][of.quantity] for at in of._rows]))

    def __init__(
        self, of: dict[str, Any] | None, system: Any, answer: _core.Answer | None = None, start: Any = None, number: int = 0
    ) -> None:
        super().__init__(of, system, answer)
        self.number = number

    def _drift(self, point: Mapping[str, Any]) -> list[float]:
        return list(point["drift"].values()) if "drift" in point else [0.0] * len(self._of["system"]["coordinates"])

    @cached_property
    def followed(self) -> "list[Branch]":
        """The branches that begin on it."""
        further = range(1, len(self._of["branches"])) if self.number == 0 else range(0)
        return [Branch(self._of, self.system, self._answer, None, k) for k in further]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Branch) and self.number == other.number and super().__eq__(other)

    def __repr__(self) -> str:
        more = f", {len(self.followed)} more begin on it" if self.followed else ""
        along = f" and {self.also[0]}" if self.also else ""
        return f"<Branch of {self.label[0]} over {self.vary}{along}, {len(self)} points, {len(self.events)} events{more}>"

    def plot(
        self, ax: Any = None, *, diagram: bool = True, inadmissible: bool = False, si: bool = False, legend: bool = True,
        title: str | None = None, **line: Any,
    ) -> Any:
        """Draw the bifurcation diagram: speeds of closings, or of a machine without stops the `quantity`, solid if stable, dashed and
        dotted if neutral, dashed if unstable, with the events.

        Parameters
        ----------
        ax : matplotlib Axes
            The axes to draw on; by default those of a new figure.
        diagram : bool
            Whether to draw the orbit diagram from simulation in grey behind the branch.
        inadmissible : bool
            Whether to draw inadmissible solutions too, as dotted lines.
        si : bool
            Whether to draw in metres and seconds, for an oscillator with units.
        """
        figure = self._figure(si=si, diagram=diagram, inadmissible=inadmissible, branch=self.number or None)
        return self._painted(figure, ax, legend, title, line)

    def _draw(self, ax: Any) -> None:
        self.plot(ax, diagram=False)

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        second = {} if self.also is None or self.second is None else {self.also[0]: self.second}
        shown = {} if self.quantity is None or self.value is None else {self.quantity: self.value}
        modulus = np.abs(self.multipliers).max(axis=1) if len(self) else np.empty(0)
        return {
            self.vary: self.parameter, **second, "label": self.label, "period": self.period, "stable": self.stable,
            "stability": self.stability, "admissible": self.admissible, "speed": self.speed, **shown, "multiplier": modulus,
        }

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json; of a branch that begins on another one, its part of it."""
        return copy.deepcopy(self._of if self.number == 0 else self._one)


class CurveEvent(View, schema="curve CurveEventObject"):
    """A point of codimension two on a curve, or an end of the curve."""

    kind: str
    values: list[float]
    point: int
    stop: str | None

    def __repr__(self) -> str:
        return f"<CurveEvent {self.kind} at {self.values[0]:.9g}, {self.values[1]:.9g}>"


class Curve(_Followed, schema="curve PointObject"):
    """A curve of an event of an orbit, from one end to the other.

    Attributes
    ----------
    ranges : ((float, float), (float, float))
        The ranges of both numbers.
    values : ndarray, shape (points, 2)
        Values of the two numbers.
    cycles : list of Events
        The events at each point; on a grazing curve of an oscillator including the impact of speed zero.
    """

    label: str
    kind: str
    of: list[str] | None
    found_at: list[float]
    through: Made[tuple[int, int]] = field(lambda of: (of["event"], of["point"]))
    parameters: Made[tuple[str, str]] = field(pair)
    ranges = field(lambda task: ranges(task["vary"], task["and"]), "plan.task.curve")
    admissible, residual = column(np.bool_), column(np.float64)
    values: Made[Floats] = Made(lambda of: pairs([at["values"] for at in of._rows]))
    events = parts(CurveEvent)

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<Curve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.events)} events>"

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        columns = {p: self.values[:, 0], q: self.values[:, 1], "admissible": self.admissible}
        return columns if isinstance(self.system, Oscillator) else {**columns, "residual": self.residual}
