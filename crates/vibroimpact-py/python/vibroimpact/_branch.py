"""Branches of periodic orbits in one number or along a line through two, with their events."""

import copy
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact._ask import Start, System, ask, given
from vibroimpact._axis import beside
from vibroimpact._core import Answer, QuestionError
from vibroimpact._events import Events
from vibroimpact._motion import complex_of
from vibroimpact._oscillator import Oscillator
from vibroimpact._progress import Progress
from vibroimpact._result import Column, Field, View
from vibroimpact._whole import BRANCH, FOLLOW, NUMBER, maybe, whole

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

    def __init__(self, of: dict[str, Any], system: Any, answer: Answer | None = None, number: int = 0) -> None:
        super().__init__(of, system, answer)
        self.number = number
        self._one: dict[str, Any] = of["branches"][number]

    @property
    def _rows(self) -> list[dict[str, Any]]:
        points: list[dict[str, Any]] = self._one["points"]
        return points

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Branch) and self.number == other.number and super().__eq__(other)

    __hash__ = None

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        more = f", {len(self.followed)} more begin on it" if self.followed else ""
        along = f" and {self.also[0]}" if self.also else ""
        return f"<Branch of {self.label[0]} over {self.vary}{along}, {len(self)} points, {len(self.events)} events{more}>"

    @property
    def ends(self) -> tuple[float, float]:
        """The ends of the range."""
        return self._of["from"], self._of["to"]

    @property
    def start(self) -> int:
        """The index of the point at which it was followed."""
        return int(self._one.get("start", 0))

    @property
    def also(self) -> tuple[str, float, float] | None:
        """The second number of a line."""
        found = self._of.get("also")
        return None if found is None else (found["parameter"], found["from"], found["to"])

    @property
    def origin(self) -> Origin | None:
        """The event at which it begins."""
        found = self._one["from"]
        return None if found is None else Origin(found["kind"], found["parameter"], found.get("branch", 1))

    @cached_property
    def followed(self) -> "list[Branch]":
        """The branches that begin on it."""
        further = range(1, len(self._of["branches"])) if self.number == 0 else range(0)
        return [Branch(self._of, self.system, self._answer, k) for k in further]

    @cached_property
    def events(self) -> list[BranchEvent]:
        """The events."""
        return [BranchEvent(of, self.system) for of in self._one["events"]]

    @cached_property
    def cycles(self) -> list[Events]:
        """The events at each point."""
        return [Events.of(point["cycle"], self.system) for point in self._rows]

    @cached_property
    def second(self) -> _Floats | None:
        """The value of the second number."""
        return None if self.also is None else np.array([point["values"][1] for point in self._rows], dtype=np.float64)

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers in rows."""
        return rows_of(self._rows)

    @cached_property
    def speed(self) -> _Floats:
        """The largest speed of a closing."""
        return np.array([cycle.speed[cycle.closes].max(initial=0.0) for cycle in self.cycles], dtype=np.float64)

    @cached_property
    def drift(self) -> _Floats:
        """By how much each coordinate moves on."""
        width = len(self._of["system"]["coordinates"])
        rows = [list(point["drift"].values()) if "drift" in point else [0.0] * width for point in self._rows]
        return np.array(rows, dtype=np.float64).reshape(len(self), width)

    @property
    def quantity(self) -> str | None:
        """The quantity of a machine without stops."""
        return next((next(iter(point["quantities"])) for point in self._rows if "quantities" in point), None)

    @property
    def value(self) -> _Floats | None:
        """Its value."""
        name = self.quantity
        if name is None:
            return None
        return np.array([point["quantities"][name] for point in self._rows if "quantities" in point], dtype=np.float64)

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


def rows_of(points: list[dict[str, Any]]) -> NDArray[np.complex128]:
    """The multipliers of all points, in rows."""
    each = len(points[0]["multipliers"]) if points else 0
    return complex_of([pair for point in points for pair in point["multipliers"]]).reshape(len(points), each)


def branch(
    system: System,
    vary: str,
    to: float | tuple[float, float],
    *,
    label: str | None = None,
    also: Mapping[str, float] | None = None,
    orbit: int | None = None,
    follow: int = 0,
    points: int = 5000,
    q: ArrayLike | None = None,
    qdot: ArrayLike | None = None,
    phase: float | None = None,
    progress: Progress = None,
) -> Branch:
    """Follow a periodic orbit, stable or not, in one number and through its events.

    The orbit is searched at `system` and followed by pseudo-arclength continuation to the value `to`. Events are located to
    rounding. At a grazing event the branch continues with the orbit on the other side of the event.

    Parameters
    ----------
    system : Oscillator or Machine
        The system at which the branch begins.
    vary : str
        What varies: "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution" of an oscillator,
        with physical units also "mass_kg" and others; of a machine the path of a number, as "frequency" or "stop.wall.gap".
    to : float or (float, float)
        The other end of its range; or both ends, for a branch that is followed both ways from `system`.
    label : str
        "m/n" of the orbit there, "m/T" without forcing. Default, of a machine only: that of the motion from the start.
    also : dict
        A second number that varies in proportion to the first, and its value where the first is `to`: {"inverse_beta": 1.05}. Its
        value at the beginning is that of `system`. So a branch can follow any line in two numbers.
    orbit : int
        Number of the orbit, counted from 1 in the order of `orbits`. Default: the stable orbit, or else the fastest admissible one.
    follow : int
        Maximum number of branches, 0 to 100, to follow from flips and branch points.
    points : int
        Maximum number of points of each branch, 2 to 100000.
    q, qdot, phase : array, array, float
        Start of a machine: coordinates, velocities and phase. Default: those of its `start`, or 0.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.branch(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), "gap", 2.5, label="1/1", follow=1)
    >>> [(event.kind, round(event.parameter, 9)) for event in found.events]
    [('flip', 1.82900619), ('end of range', 2.5)]
    >>> [event.kind for event in found.followed[0].events]
    ['fold', 'grazing', 'end of range']
    >>> found = vi.branch(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), "gap", (0.2, 2.5), label="1/1")
    >>> found.parameter[[0, found.start, -1]].tolist(), [event.kind for event in found.events]
    ([0.2, 1.5, 2.5], ['end of range', 'fold', 'grazing', 'flip', 'end of range'])
    >>> [(of.kind, of.stop) for of in vi.Machine.named("two-mass-hammer").branch("frequency", 1.05).events]
    [('grazing', 'anvil'), ('fold', None), ('end of range', None)]
    """
    if label is None and isinstance(system, Oscillator):
        raise QuestionError('the branch of an oscillator needs the label of its orbit\nhint: label="1/1"')
    back, end = map(float, to) if isinstance(to, Sequence) else (None, to)
    second = beside(also)
    named = "parameter" if isinstance(system, Oscillator) else "path"
    task = given(
        label=label, orbit=maybe("orbit", orbit, NUMBER), vary=vary, to=float(end), back=back,
        also=second and {named: second[0], "to": float(second[1])},
        follow=whole("follow", follow, FOLLOW), points=whole("points", points, BRANCH),
    )
    start = Start(system, None, None, q, qdot, phase if not isinstance(system, Oscillator) else None)
    return Branch.answering(ask(system, "branch", task, start, progress=progress, what="branches"), system)
