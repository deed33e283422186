"""Branches of periodic orbits in one number or along a line through two, with their events."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import Answer
from vibroimpact._events import Events
from vibroimpact._motion import complex_of
from vibroimpact._result import Column, Field, Made, View

_Floats = NDArray[np.float64]


def orbit_of(found: Mapping[str, Any] | None) -> tuple[int, int] | None:
    """The number of an orbit, and how many there are."""
    return None if found is None else (found["number"], found["count"])


class BranchEvent(View):
    """An event at a point of a branch, or the reason why the branch ends.

    Attributes
    ----------
    kind : str
        "fold", "flip", "torus", "branch point", "grazing", "loss of contact", "stick", "soft landing", "chatter", ..., or the reason
        why the branch ends: "end of range", "closed", "halving", "step limit", "impact limit", "no convergence".
    parameter : float
        The value of the number there.
    values : (float, float) or None
        The values of both numbers, on a line through two.
    point : int
        Index among the points of the branch.
    ends : bool
        Whether the branch ends there.
    before, after : str or None
        The labels before and after the event, on the way from the start of the branch.
    stop : str or None
        The stop, or joint, of the event.
    appears, turns : bool or None
        At a grazing event, on the way from the start: whether a closing appears or disappears there, and whether the number turns back.
    impact, phase : int or None, float or None
        At a grazing event of an oscillator: the number of the impact, counted from 1, and its phase.
    also : dict or None
        For two identical stops, the simultaneous contact with the other one: "impact", "stop", "phase".
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


def origin_of(of: dict[str, Any] | None) -> Origin | None:
    """The event at which a branch begins."""
    return None if of is None else Origin(of["kind"], of["parameter"], of.get("branch", 1))


class Branch(View):
    """A branch of periodic orbits; each point is one step along it.

    Attributes
    ----------
    system : Oscillator or Machine
        The system at which the branch begins.
    vary : str
        The number that varies.
    ends : (float, float)
        The ends of its range.
    start : int
        The index of the point at which the branch was followed: 0, unless it was followed both ways.
    parameter : ndarray
        Its value at each point.
    also : (str, float, float) or None
        The number that varies with it along a line, and its values at the ends of the range.
    second : ndarray or None
        The value of that number at each point.
    label : ndarray of str
        m/n at each point, or m/T without forcing.
    period : ndarray
        The time of one period at each point.
    stable, admissible : ndarray of bool
        Whether the orbit is stable; whether it is admissible.
    stability : ndarray of str
        "stable", "neutral" (a multiplier on the unit circle to rounding and none outside) or "unstable".
    multipliers : ndarray of complex128, points x (two for each coordinate)
        Floquet multipliers, without the 1 of each free translation; infinite at a grazing impact.
    speed : ndarray
        The largest speed of a closing at each point; 0 without closings.
    quantity, value : str or None, ndarray or None
        Of a machine without stops the path of the quantity that the figure shows, and its value at each point.
    drift : ndarray, points x coordinates
        By how much each coordinate moves on in one period; 0 if the system cannot be translated.
    cycles : list of Events
        The events at each point.
    events : list of BranchEvent
        The events of the branch, in order along it.
    origin : Origin or None
        The event at which it begins; None for the branch of the chosen orbit.
    followed : list of Branch
        The branches that begin on it, the branches that begin on those, and so on.
    orbit : (int, int) or None
        The number of the orbit at which it begins, and the number of orbits with its label; None for the motion from the start.
    number : int
        The number of the branch: 0 for that of the chosen orbit, from 1 for those that begin on it.
    plan : str
        The plan as JSON.
    """

    vary: str
    orbit = Field(orbit_of)
    period, parameter, label = Column(np.float64), Column(np.float64), Column(np.str_)
    stable, admissible, stability = Column(np.bool_), Column(np.bool_), Column(np.str_)
    _one: Made[dict[str, Any]] = Made(lambda of: of._of["branches"][of.number])
    _rows: Made[list[dict[str, Any]]] = Made(lambda of: of._one["points"])
    #: Whose branch it is: 0 for that of the chosen orbit.
    number: int
    ends: Made[tuple[float, float]] = Made(lambda of: (of._of["from"], of._of["to"]))
    start: Made[int] = Made(lambda of: of._one.get("start", 0))
    also: Field[tuple[str, float, float] | None] = Field(lambda of: of and (of["parameter"], of["from"], of["to"]))
    second: Made[_Floats | None] = Made(lambda of: None if of.also is None else np.array([at["values"][1] for at in of._rows]))
    origin: Made["Origin | None"] = Made(lambda of: origin_of(of._one["from"]))
    events: Made[list[BranchEvent]] = Made(lambda of: [BranchEvent(one, of.system) for one in of._one["events"]])
    cycles: Made[list[Events]] = Made(lambda of: [Events.of(at["cycle"], of.system) for at in of._rows])
    multipliers: Made[NDArray[np.complex128]] = Made(lambda of: rows_of(of._rows))
    speed: Made[_Floats] = Made(lambda of: np.array([cycle.speed[cycle.closes].max(initial=0.0) for cycle in of.cycles]))
    drift: Made[_Floats] = Made(lambda of: drift_of(of._rows, len(of._of["system"]["coordinates"])))
    quantity: Made[str | None] = Made(lambda of: next((next(iter(at["quantities"])) for at in of._rows if "quantities" in at), None))
    value: Made[_Floats | None] = Made(lambda of: of.quantity and np.array([at["quantities"][of.quantity] for at in of._rows]))

    def __init__(
        self, of: dict[str, Any] | None, system: Any, answer: Answer | None = None, start: Any = None, number: int = 0
    ) -> None:
        super().__init__(of, system, answer)
        self.number = number

    @cached_property
    def followed(self) -> "list[Branch]":
        """The branches that begin on it."""
        further = range(1, len(self._of["branches"])) if self.number == 0 else range(0)
        return [Branch(self._of, self.system, self._answer, None, k) for k in further]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Branch) and self.number == other.number and super().__eq__(other)

    __hash__ = None

    def __len__(self) -> int:
        return len(self._rows)

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


def drift_of(points: list[dict[str, Any]], width: int) -> _Floats:
    """By how much each coordinate moves on at each point."""
    rows = [list(at["drift"].values()) if "drift" in at else [0.0] * width for at in points]
    return np.array(rows, dtype=np.float64).reshape(len(points), width)


def rows_of(points: list[dict[str, Any]]) -> NDArray[np.complex128]:
    """The multipliers of all points, in rows."""
    each = len(points[0]["multipliers"]) if points else 0
    return complex_of([pair for point in points for pair in point["multipliers"]]).reshape(len(points), each)
