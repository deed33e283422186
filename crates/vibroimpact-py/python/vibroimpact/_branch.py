"""A periodic orbit over one parameter or along a line through two, through its events, and the branches that begin on it."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._axis import beside
from vibroimpact._core import Oscillator
from vibroimpact._cycle import Cycles, pairs
from vibroimpact._whole import BRANCH, FOLLOW, NUMBER, maybe, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True)
class BranchEvent:
    """What happens at a point of a branch.

    `kind` is "fold", "flip", "branch point", "grazing", "loss of contact", "stick", "soft landing", "end of
    rest", "rest for ever", "chatter", or why the branch ends: "end of range",
    "closed", "halving", "step limit", "impact limit", "no convergence". Grazing events say which impact (counted from 1)
    appears or disappears, on which side, at which phase, and whether the parameter turns back.
    """

    kind: str
    parameter: float
    #: Place among the points of the branch.
    point: int
    ends: bool
    label_before: str
    label_after: str | None
    change: str | None = None
    impact: int | None = None
    side: str | None = None
    phase: float | None = None
    turns: bool | None = None
    #: With two stops alike the touch of the other one: impact, side and phase.
    also: tuple[int | None, str, float] | None = None
    #: Of both parameters, on a line through two.
    values: tuple[float, float] | None = None

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON."""
        always = ("kind", "parameter", "point", "ends", "label_before", "label_after")
        fields = {name: getattr(self, name) for name in self.__dataclass_fields__}
        if self.also is not None:
            also = dict(zip(("impact", "side", "phase"), self.also))
            fields["also"] = {name: value for name, value in also.items() if value is not None}
        if self.values is not None:
            fields["values"] = list(self.values)
        return {name: value for name, value in fields.items() if name in always or value is not None}


class Origin(NamedTuple):
    """The event where a further branch begins."""

    kind: str
    parameter: float
    #: The branch it leaves, counted from 1, that of the orbit being the first.
    branch: int


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Branch:
    """A branch of periodic orbits, a point for each step along it.

    Attributes
    ----------
    osc : Oscillator
        The system it began with.
    vary : str
        The parameter that varies.
    parameter : ndarray
        Its value at each point.
    also : (str, float, float) or None
        The parameter that varies with it along a line, and its values at the ends of the range.
    second : ndarray or None
        Its value at each point.
    label : list of str
        m/n at each point.
    stable, physical : ndarray of bool
        Whether the orbit attracts its neighbourhood; whether it is a possible motion.
    multipliers : ndarray of complex128, shape (points, 2)
        Infinite at a grazing.
    speed : ndarray
        The largest speed of arrival at each point, 0 without impacts.
    cycles : sequence of Cycle
        The impacts at each point.
    events : list of BranchEvent
        In order along the branch.
    origin : Origin or None
        Where it begins; None for the branch of the orbit.
    followed : list of Branch
        The branches that begin on it, on those, and so on.
    orbit : (int, int)
        The number of the orbit it began with, and how many there are.
    plan : str
        The question as JSON.
    """

    osc: Oscillator
    vary: str
    ends: tuple[float, float]
    also: tuple[str, float, float] | None
    parameter: NDArray[np.float64]
    second: NDArray[np.float64] | None
    label: list[str]
    stable: NDArray[np.bool_]
    physical: NDArray[np.bool_]
    cycles: Cycles
    events: list[BranchEvent]
    origin: Origin | None
    followed: "list[Branch]"
    orbit: tuple[int, int]
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
        """The rests on a stop at each point, as in a Motion."""
        return self.cycles.rests or [[] for _ in range(len(self))]

    @property
    def speed(self) -> NDArray[np.float64]:
        """The largest speed of arrival at each point."""
        return self.cycles.fastest()

    def plot(
        self, ax: "Axes | None" = None, *, diagram: bool = True, virtual: bool = False, si: bool = False
    ) -> "Axes":
        """The bifurcation diagram: speeds of arrival, stable solid and unstable dashed, with the events.

        Parameters
        ----------
        ax : matplotlib Axes
            Where to draw; a new figure unless given.
        diagram : bool
            Whether what simulation finds lies behind it, in grey.
        virtual : bool
            Whether inadmissible solutions are drawn too, dotted.
        si : bool
            Metres and seconds.
        """
        from vibroimpact import _tracks

        return _tracks.plot(self, ax, diagram, virtual, si)

    def _points(self) -> list[dict[str, Any]]:
        rests = self.rests
        return [
            {
                "parameter": float(self.parameter[k]),
                **({} if self.second is None else {"values": [float(self.parameter[k]), float(self.second[k])]}),
                "label": self.label[k],
                "cycle": cycle.to_list(),
                **({"rests": rests[k]} if rests[k] else {}),
                "multipliers": pairs(self.multipliers[k]),
                "stable": bool(self.stable[k]),
                "physical": bool(self.physical[k]),
            }
            for k, cycle in enumerate(self.cycles)
        ]

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON, a number that is not finite as None."""
        own = {"points": self._points(), "events": [event.to_dict() for event in self.events]}
        if self.origin is not None:
            return {"from": self.origin._asdict(), **own}
        return {
            "label": self.label[0],
            "vary": self.vary,
            "from": self.ends[0],
            "to": self.ends[1],
            **({"also": dict(zip(("parameter", "from", "to"), self.also))} if self.also else {}),
            "orbit": {"number": self.orbit[0], "count": self.orbit[1]},
            **own,
            "branches": [branch.to_dict() for branch in self.followed],
            "plan": json.loads(self.plan),
        }


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
) -> Branch:
    """Follow a periodic orbit, stable or not, in one parameter through every event on the way.

    The orbit is looked for at `osc` and followed by pseudo-arclength to the value `to`. Events are located to rounding.
    At a grazing the branch goes on with the motion that takes over.

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
        A second parameter that varies with it in proportion, from its value in `osc` to the one given here when the first is
        at `to`: {"inverse_beta": 1.05}. So a branch goes along any line through two parameters.
    orbit : int
        Which of several orbits, counted from 1 as `orbits` lists them; the stable one, else the fastest motion, unless given.
    follow : int
        Follow up to this number of the branches that begin at flips and branch points, 0 to 100.
    points : int
        Points of each branch at most, 2 to 100000.

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
    found = _core.branch(osc, label, vary, to, beside(also), orbit, follow, points)

    def of(fields: dict[str, Any], followed: list[Branch]) -> Branch:
        return Branch(
            osc=osc,
            vary=vary,
            ends=(found["from"], to),
            also=found["also"],
            parameter=fields["parameter"],
            second=fields["second"],
            label=fields["label"],
            stable=fields["stable"],
            physical=fields["physical"],
            cycles=Cycles.of(fields["cycles"]),
            events=[BranchEvent(**event) for event in fields["events"]],
            origin=None if fields["origin"] is None else Origin(*fields["origin"]),
            followed=followed,
            orbit=found["orbit"],
            plan=found["plan"],
        )

    first, *others = found["branches"]
    return of(first, [of(fields, []) for fields in others])
