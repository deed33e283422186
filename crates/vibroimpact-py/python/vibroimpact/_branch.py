"""Branches of periodic orbits in one parameter or along a line through two, with their events."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._axis import beside
from vibroimpact._core import Oscillator
from vibroimpact._cycle import Cycles
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result, answer
from vibroimpact._whole import BRANCH, FOLLOW, NUMBER, maybe, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True)
class BranchEvent:
    """An event at a point of a branch.

    `kind` is "fold", "flip", "branch point", "grazing", "loss of contact", "stick", "soft landing", "end of
    rest", "rest for ever", "chatter", or the reason why the branch ends: "end of range",
    "closed", "halving", "step limit", "impact limit", "no convergence". A grazing event has the number of the impact
    (counted from 1) that appears or disappears, its side, its phase, and whether the parameter turns back.
    """

    kind: str
    parameter: float
    #: Index among the points of the branch.
    point: int
    ends: bool
    label_before: str
    label_after: str | None
    change: str | None = None
    impact: int | None = None
    side: str | None = None
    phase: float | None = None
    turns: bool | None = None
    #: For two identical stops, the simultaneous grazing contact with the other one: impact, side and phase.
    also: tuple[int | None, str, float] | None = None
    #: Values of both parameters, on a line through two.
    values: tuple[float, float] | None = None

class Origin(NamedTuple):
    """The event at which a further branch begins."""

    kind: str
    parameter: float
    #: Number of the branch on which the event lies, counted from 1; the branch of the chosen orbit is number 1.
    branch: int


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Branch(Result):
    """A branch of periodic orbits; each point is one step along it.

    Attributes
    ----------
    osc : Oscillator
        The system at which the branch begins.
    vary : str
        The parameter that varies.
    parameter : ndarray
        Its value at each point.
    also : (str, float, float) or None
        The parameter that varies with it along a line, and its values at the ends of the range.
    second : ndarray or None
        The value of that parameter at each point.
    label : list of str
        m/n at each point.
    stable, physical : ndarray of bool
        Whether the orbit is stable; whether it is admissible.
    stability : ndarray of str
        "stable", "neutral" (a multiplier on the unit circle to rounding and none outside) or "unstable".
    multipliers : ndarray of complex128, shape (points, 2)
        Floquet multipliers; infinite at a grazing impact.
    speed : ndarray
        The largest speed before an impact at each point; 0 without impacts.
    cycles : sequence of Cycle
        The impacts at each point.
    events : list of BranchEvent
        The events, in order along the branch.
    origin : Origin or None
        The event at which it begins; None for the branch of the chosen orbit.
    followed : list of Branch
        The branches that begin on it, the branches that begin on those, and so on.
    orbit : (int, int)
        The number of the orbit at which it begins, and the number of orbits with its label.
    number : int
        The number of the branch: 0 for that of the chosen orbit, from 1 for those that begin on it.
    plan : str
        The plan as JSON.
    """

    osc: Oscillator
    vary: str
    ends: tuple[float, float]
    also: tuple[str, float, float] | None
    parameter: NDArray[np.float64]
    second: NDArray[np.float64] | None
    label: list[str]
    stable: NDArray[np.bool_]
    stability: NDArray[np.str_]
    physical: NDArray[np.bool_]
    cycles: Cycles
    events: list[BranchEvent]
    origin: Origin | None
    followed: "list[Branch]"
    orbit: tuple[int, int]
    number: int
    plan: str

    def __repr__(self) -> str:
        more = f", {len(self.followed)} more begin on it" if self.followed else ""
        along = f" and {self.also[0]}" if self.also else ""
        return f"<Branch of {self.label[0]} over {self.vary}{along}, {len(self)} points, {len(self.events)} events{more}>"

    def __len__(self) -> int:
        return len(self.parameter)

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """Both multipliers at each point."""
        return self.cycles.multipliers

    @property
    def rests(self) -> list[list[dict[str, Any]]]:
        """The phases of sticking at each point, as in a Motion."""
        return self.cycles.rests or [[] for _ in range(len(self))]

    @property
    def speed(self) -> NDArray[np.float64]:
        """The largest speed before an impact at each point; 0 without impacts."""
        return self.cycles.fastest()

    def plot(
        self, ax: "Axes | None" = None, *, diagram: bool = True, virtual: bool = False, si: bool = False
    ) -> "Axes":
        """Draw the bifurcation diagram: speeds before impacts (solid if stable, dashed and dotted if neutral, dashed if unstable) and events.

        Parameters
        ----------
        ax : matplotlib Axes
            The axes to draw on; by default those of a new figure.
        diagram : bool
            Whether to draw the orbit diagram from simulation in grey behind the branch.
        virtual : bool
            Whether to draw inadmissible solutions too, as dotted lines.
        si : bool
            Whether to draw in metres and seconds.
        """
        from vibroimpact import _tracks

        behind = None
        if diagram:
            from vibroimpact._grid import orbit_diagram

            also = None if self.also is None else {self.also[0]: self.also[1:]}
            first, last = map(float, self.ends)
            behind = orbit_diagram(self.osc, self.vary, f"{first!r}:{last!r}:{_tracks.VALUES}", also=also)
        return _tracks.plot(self, ax, behind, virtual, si)

    def _draw(self, ax: Any) -> None:
        self.plot(ax, diagram=False)

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        second = {} if self.also is None or self.second is None else {self.also[0]: self.second}
        modulus = np.abs(self.multipliers).max(axis=1) if len(self) else np.empty(0)
        return {
            self.vary: self.parameter, **second, "label": self.label, "stable": self.stable, "stability": self.stability,
            "physical": self.physical,
            "speed": self.speed, "multiplier": modulus,
        }

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json; of a branch that begins on another one, its part of it."""
        whole_answer = answer(self.plan)
        return whole_answer if self.number == 0 else whole_answer["branches"][self.number]


def branch(
    osc: Oscillator,
    label: str,
    vary: str,
    to: float,
    *,
    also: Mapping[str, float] | None = None,
    orbit: int | None = None,
    follow: int = 0,
    points: int = 5000,
    progress: Progress = None,
) -> Branch:
    """Follow a periodic orbit, stable or not, in one parameter and through its events.

    The orbit is searched at `osc` and followed by pseudo-arclength continuation to the value `to`. Events are located to
    rounding. At a grazing event the branch continues with the orbit on the other side of the event.

    Parameters
    ----------
    osc : Oscillator
        The system at which the branch begins.
    label : str
        "m/n" of the orbit there.
    vary : str
        "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution".
    to : float
        The other end of its range.
    also : dict
        A second parameter that varies in proportion to the first, and its value where the first is `to`:
        {"inverse_beta": 1.05}. Its value at the beginning is that of `osc`. So a branch can follow any line in two parameters.
    orbit : int
        Number of the orbit, counted from 1 in the order of `orbits`. Default: the stable orbit, or else the fastest admissible one.
    follow : int
        Maximum number of branches, 0 to 100, to follow from flips and branch points.
    points : int
        Maximum number of points of each branch, 2 to 100000.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> from vibroimpact import Oscillator, branch
    >>> found = branch(Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), "1/1", "gap", 2.5, follow=1)
    >>> [(event.kind, round(event.parameter, 9)) for event in found.events]
    [('flip', 1.82900619), ('end of range', 2.5)]
    >>> [event.kind for event in found.followed[0].events]
    ['fold', 'grazing', 'end of range']
    """
    orbit = maybe("orbit", orbit, NUMBER)
    follow, points = whole("follow", follow, FOLLOW), whole("points", points, BRANCH)
    with watched(progress, "branches") as tell:
        found = _core.branch(osc, label, vary, to, beside(also), orbit, follow, points, tell)

    def of(number: int, fields: dict[str, Any], followed: list[Branch]) -> Branch:
        return Branch(
            osc=osc,
            vary=vary,
            ends=(found["from"], to),
            also=found["also"],
            parameter=fields["parameter"],
            second=fields["second"],
            label=fields["label"],
            stable=fields["stable"],
            stability=np.array(fields["stability"], dtype=np.str_),
            physical=fields["physical"],
            cycles=Cycles.of(fields["cycles"]),
            events=[BranchEvent(**event) for event in fields["events"]],
            origin=None if fields["origin"] is None else Origin(*fields["origin"]),
            followed=followed,
            orbit=found["orbit"],
            number=number,
            plan=found["plan"],
        )

    first, *others = found["branches"]
    return of(0, first, [of(number, fields, []) for number, fields in enumerate(others, start=1)])
