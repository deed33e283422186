"""What is computed for a machine besides its events: settled motions, exponents, orbits, branches, basins and maps."""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._lyapunov import Measured
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result, answer
from vibroimpact._whole import THREADS, whole

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_Floats = NDArray[np.float64]
_Start: TypeAlias = tuple[list[float], list[float], float]
#: What varies by path: `(a, b, n)`, or the text "A:B:N" or "A:B:N:log".
MachineAxes: TypeAlias = Mapping[str, "str | tuple[float, float, int]"]


def answered(
    file: _core.MachineFile,
    start: _Start,
    task: Mapping[str, Any],
    total: int = 1,
    threads: int = 1,
    progress: Progress = None,
    what: str = "starts",
) -> dict[str, Any]:
    """The JSON object of the command for a task as "object", and what it does not have: the sections of an attractor as
    "section", and the points of an orbit diagram as "diagram"."""
    with watched(progress, what) as tell:
        threads = whole("threads", threads, THREADS)
        found = _core.machine_answer(file, start, json.dumps(task), total, threads, tell)
    return {"object": json.loads(found.pop("json")), **found}


def ask(file: _core.MachineFile, start: _Start, task: Mapping[str, Any], *further: Any) -> dict[str, Any]:
    """The JSON object of the command for a task."""
    found: dict[str, Any] = answered(file, start, task, *further)["object"]
    return found


def _measured(given: Mapping[str, Any]) -> Measured:
    value, error = given["value"], given["error"]
    if value is None:
        value = -math.inf if given.get("why") == "minus_infinity" else math.nan
    return Measured(value, math.nan if error is None else error)


def _all_measured(given: Sequence[Mapping[str, Any]] | None) -> tuple[Measured, ...] | None:
    return None if given is None else tuple(_measured(one) for one in given)


def _complex(pairs: Sequence[Sequence[float | None]]) -> NDArray[np.complex128]:
    """Complex numbers of pairs; null is infinite."""
    numbers = [complex(*(math.inf if part is None else part for part in pair)) for pair in pairs]
    return np.array(numbers, dtype=np.complex128)


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineCycle(Result):
    """The events of a cycle of a machine as columns, beginning with the fastest closing.

    Attributes
    ----------
    kind, stop : ndarray of str
        Kind of each event, and name of the stop or joint.
    time, phase, speed : ndarray
        Time since the first event, phase of the forcing, speed of closing.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    """

    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: _Floats
    phase: _Floats
    speed: _Floats
    q: _Floats
    qdot: _Floats

    def __repr__(self) -> str:
        return f"<MachineCycle of {len(self)} events>"

    def __len__(self) -> int:
        return len(self.time)

    def _table(self) -> dict[str, Any]:
        """One row for each event; coordinates and velocities by their numbers."""
        columns = {name: getattr(self, name) for name in ("kind", "stop", "time", "phase", "speed")}
        for name in ("q", "qdot"):
            columns |= {f"{name}.{k + 1}": of for k, of in enumerate(getattr(self, name).T)}
        return columns


def _cycle(events: Sequence[Mapping[str, Any]], width: int) -> MachineCycle:
    def floats(name: str) -> _Floats:
        return np.array([event.get(name, math.nan) for event in events], dtype=np.float64)

    def rows(name: str) -> _Floats:
        return np.array([event[name] for event in events], dtype=np.float64).reshape(len(events), width)

    kind, stop = (np.array([event[name] for event in events], dtype=np.str_) for name in ("kind", "stop"))
    return MachineCycle(kind, stop, floats("time"), floats("phase"), floats("speed"), rows("q"), rows("qdot"))


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineMotion(Result):
    """A steady motion of a machine.

    Attributes
    ----------
    label : str
        m/n for m closings of stops in n forcing periods, m/T without forcing, or "0", "stuck", "chaotic" or "undecided".
    kind : str
        "periodic", "no_impact", "stuck", "chaotic" or "undecided".
    stable : bool or None
        Whether small changes of the start die out; None if that is not known.
    stability : str or None
        "stable", "neutral" (a multiplier on the unit circle to rounding and none outside) or "unstable"; None if that is not
        known.
    stops : tuple of str
        The stops that stay closed for ever, of a motion without a further event. Where it is stuck it rests on one of them.
    seen_events : int or None
        For a chaotic or undecided motion: the events that were followed. Chaos may be a longer transient.
    impacts, periods, sticks : int or None
        Closings, forcing periods, and rests and holds of a cycle.
    period : float or None
        The time of one period of a cycle.
    counts : dict
        The closings of each stop in one period.
    multipliers : ndarray of complex128
        All Floquet multipliers of a cycle, two for each coordinate, the largest first. In a machine that can be translated as
        a whole, the 1 that belongs to this is left out.
    drift, drift_velocity : dict or None
        By how much each coordinate moves on in one period of a cycle, and the mean velocity of this; None if the machine
        cannot be translated.
    cycle : MachineCycle
        The events of a cycle.
    state : (list, list, float) or None
        Coordinates, velocities and phase between two events of a cycle.
    exponents : tuple of Measured or None
        Lyapunov exponents of a chaotic or undecided motion, if they were measured.
    why : str or None
        Why a motion is undecided.
    quantities : dict or None
        Quantities of the motion by path, in the units of the machine: "power", "stop.anvil.impulse_per_period",
        "friction.guide.force_max", "q.head.displacement_rms", "force.1.work_per_period" and others; nan where one is not
        defined, and for infinitely many impacts. None for an undecided motion.
    quantities_error : dict or None
        For a chaotic motion: three standard errors of those of its quantities that are means, by path. None for other
        motions, whose quantities are exact to rounding.
    """

    label: str
    kind: str
    stable: bool | None
    stability: str | None
    stops: tuple[str, ...]
    seen_events: int | None
    impacts: int | None
    periods: int | None
    sticks: int | None
    period: float | None
    counts: dict[str, int]
    multipliers: NDArray[np.complex128]
    drift: dict[str, float] | None
    drift_velocity: dict[str, float] | None
    cycle: MachineCycle
    state: tuple[list[float], list[float], float] | None
    exponents: tuple[Measured, ...] | None
    why: str | None
    quantities: dict[str, float] | None
    quantities_error: dict[str, float] | None
    _object: dict[str, Any]
    _machine: Any

    def __repr__(self) -> str:
        return f"<MachineMotion {self._words()}>"

    def _words(self) -> str:
        """The label, and what it does not say: the stops of a rest, for how long chaos was seen, the stability."""
        stops = f" on {', '.join(self.stops)}" if self.stops else ""
        if self.kind == "chaotic":
            return f"chaotic, seen over {self.seen_events} events"
        return f"{self.label}{stops}" + ("" if self.stability is None else f", {self.stability}")

    @property
    def whole_state(self) -> dict[str, Any] | None:
        """The `state` with its contacts and all digits, which `Machine.starting` takes."""
        state: dict[str, Any] | None = self._object.get("state")
        return state

    def to_dict(self) -> dict[str, Any]:
        """The object of the motion in the JSON of the command."""
        return dict(self._object)

    def _table(self) -> dict[str, Any]:
        """One row for each event of the cycle."""
        return self.cycle._table()

    def plot(self, axes: "Axes | Sequence[Axes] | None" = None) -> "NDArray[Any]":
        """Draw the coordinates over some periods of the motion, and below them the contact forces, if there are any.

        `axes` are one or two axes to draw into. Returns the axes.
        """
        from vibroimpact import _machine_plots

        return _machine_plots.motion(self, axes)


def _remarked(motion: MachineMotion) -> str:
    """Its label with what shares need to tell motions apart."""
    return motion._words() if motion.stops or motion.kind == "chaotic" else motion.label


#: What the paths of the parts of a machine begin with.
_HEADS = {"forces": "force", "stops": "stop", "joints": "friction", "coordinates": "q"}


def _by_path(given: Mapping[str, Any] | None) -> dict[str, float] | None:
    """Quantities of a machine by path, from the objects of its parts; null is infinite or not defined."""
    if given is None:
        return None
    found = {name: value for name, value in given.items() if name not in _HEADS}
    for kind, head in _HEADS.items():
        for part, own in given.get(kind, {}).items():
            found |= {f"{head}.{part}.{name}": value for name, value in own.items()}
    return {path: math.nan if value is None else value for path, value in found.items()}


def _motion(given: dict[str, Any], width: int, machine: Any) -> MachineMotion:
    state = given.get("state")
    return MachineMotion(
        **{name: given[name] for name in ("label", "kind", "stable", "stability", "impacts", "periods", "sticks")},
        stops=tuple(given.get("stops", ())),
        seen_events=given.get("seen_events"),
        period=given.get("period"),
        counts=given.get("counts", {}),
        multipliers=_complex(given["multipliers"] or []),
        drift=given.get("drift"),
        drift_velocity=given.get("drift_velocity"),
        cycle=_cycle(given["cycle"], width),
        state=state and (state["q"], state["qdot"], state["phase"]),
        exponents=_all_measured(given.get("exponents")),
        why=given.get("why"),
        quantities=_by_path(given["quantities"]),
        quantities_error=_by_path(given.get("quantities_error")),
        _object=given,
        _machine=machine,
    )


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineSettled(Result):
    """What a motion of a machine settles into.

    Attributes
    ----------
    motion : MachineMotion
        The steady motion.
    events, time : int, float
        Events and time that were followed.
    chaotic_transient : tuple of Measured or None
        Exponents of a chaotic transient that has ended.
    plan : str
        The plan as JSON.
    """

    motion: MachineMotion
    events: int
    time: float
    chaotic_transient: tuple[Measured, ...] | None
    plan: str

    def __repr__(self) -> str:
        return f"<MachineSettled {self.motion!r} after {self.events} events>"

    def _table(self) -> dict[str, Any]:
        """One row for each event of the cycle."""
        return self.motion._table()

    def plot(self, axes: "Axes | Sequence[Axes] | None" = None) -> "NDArray[Any]":
        """Draw the motion, as `MachineMotion.plot` does."""
        return self.motion.plot(axes)


def motion(found: Mapping[str, Any], machine: Any) -> MachineMotion:
    """The motion of the JSON object of a command."""
    return _motion(found["motion"], len(found["system"]["coordinates"]), machine)


def settled(found: Mapping[str, Any], machine: Any) -> MachineSettled:
    """Of the JSON object."""
    plan = json.dumps(found["plan"])
    return MachineSettled(
        motion(found, machine), found["events_followed"], found["time_followed"],
        _all_measured(found.get("chaotic_transient", {}).get("exponents")), plan,
    )


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineAttractors(Result):
    """The steady motions to which scattered starts lead, the most frequent first. It is a sequence of them.

    Attributes
    ----------
    motions : tuple of MachineMotion
        The motions.
    share, count : ndarray
        Share of the starts, and number of them.
    share_intervals : ndarray
        Interval of each share at a confidence of 95 %, for random starts.
    missed_below : float
        Largest share of a motion that no start has shown, at a confidence of 95 %.
    starts : int
        Number of starts.
    plan : str
        The plan as JSON.
    """

    motions: tuple[MachineMotion, ...]
    share: _Floats
    count: NDArray[np.int64]
    share_intervals: _Floats
    missed_below: float
    starts: int
    plan: str

    def __repr__(self) -> str:
        shares = ", ".join(f"{_remarked(m)} {100 * share:.3g} %" for m, share in zip(self.motions, self.share))
        return f"<MachineAttractors of {self.starts} starts: {shares}>"

    def __iter__(self) -> Iterator[MachineMotion]:
        return iter(self.motions)

    def __len__(self) -> int:
        return len(self.motions)

    def __getitem__(self, k: int) -> MachineMotion:
        return self.motions[k]

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        names = ("label", "kind", "stable", "stability", "seen_events", "impacts", "periods")
        return {**{name: [getattr(of, name) for of in self] for name in names}, "stop": [" ".join(of.stops) for of in self], "share": self.share, "count": self.count}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the shares as bars."""
        from vibroimpact import _figure, _machine_plots

        rows = [(motion.label, float(share)) for motion, share in zip(self.motions, self.share)]
        return _figure.shares(_machine_plots.title(self.plan), rows, ax)


def _shared(found: Mapping[str, Any], machine: Any) -> tuple[tuple[MachineMotion, ...], _Floats, NDArray[np.int64]]:
    width, motions = len(found["system"]["coordinates"]), found["motions"]
    share = np.array([motion.pop("share") for motion in motions], dtype=np.float64)
    count = np.array([motion.pop("starts") for motion in motions], dtype=np.int64)
    return tuple(_motion(motion, width, machine) for motion in motions), share, count


def attractors(found: Mapping[str, Any], machine: Any) -> MachineAttractors:
    """Of the JSON object."""
    intervals = np.array(found["share_intervals"], dtype=np.float64).reshape(-1, 2)
    shared = _shared(found, machine)
    return MachineAttractors(*shared, intervals, found["missed_below"], found["starts"], json.dumps(found["plan"]))


class Closings(NamedTuple):
    """The section of an attractor at the closings of stops: stop, phase and speed, and coordinates and velocities after it."""

    stop: NDArray[np.str_]
    phase: _Floats
    speed: _Floats
    #: Closings x coordinates.
    q: _Floats
    qdot: _Floats


class MachineStrobes(NamedTuple):
    """The stroboscopic section: coordinates and velocities at phase 0 of the forcing, states x coordinates."""

    q: _Floats
    qdot: _Floats


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineLyapunov(Result):
    """The Lyapunov exponents of a motion of a machine, two for each coordinate, the largest first, and sections of its attractor.

    Attributes
    ----------
    exponents : tuple of Measured or None
        The exponents per unit of time with error bars; None if the motion ended before.
    impacts_per_period : Measured or None
        Number of closings in a forcing period.
    exact : bool
        Whether the exponents are those of a cycle or of a motion without impacts, and not measured.
    motion : MachineMotion
        The motion.
    closings, strobes : named tuples of ndarray
        Points of both sections; empty unless requested.
    plan : str
        The plan as JSON.
    """

    exponents: tuple[Measured, ...] | None
    impacts_per_period: Measured | None
    exact: bool
    motion: MachineMotion
    closings: Closings
    strobes: MachineStrobes
    plan: str

    def __repr__(self) -> str:
        first = f"{self.exponents[0].value:.5g} +- {self.exponents[0].error:.1g}" if self.exponents else "unknown"
        return f"<MachineLyapunov, largest {first}, {self.motion.label}>"

    def _table(self) -> dict[str, Any]:
        """One row for each exponent."""
        of = self.exponents or ()
        return {"value": [one.value for one in of], "error": [one.error for one in of]}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the exponents with their error bars."""
        from vibroimpact import _machine_plots

        return _machine_plots.exponents(self, ax)

    def plot_sections(self, axes: "Sequence[Axes] | None" = None) -> "NDArray[Any]":
        """Draw both sections of the attractor: the phase and speed of closings, and the plane of each coordinate and its velocity
        at phase 0.

        `axes` are one axes more than there are coordinates. Returns the axes.
        """
        from vibroimpact import _machine_plots

        if not len(self.closings.phase) and not len(self.strobes.q):
            raise _core.QuestionError("there are no points of the sections\nhint: machine.lyapunov(points=5000)")
        return _machine_plots.sections(self, axes)


def lyapunov(found: Mapping[str, Any], machine: Any, points: Mapping[str, Any] | None) -> MachineLyapunov:
    """Of the JSON object, and the points of both sections."""
    rate, plan, width = found["impacts_per_period"], json.dumps(found["plan"]), len(found["system"]["coordinates"])
    none, states = np.empty(0), np.empty((0, width))
    given = points or {
        "stop": [], "phase": none, "speed": none, **{name: states for name in ("q", "qdot", "strobe_q", "strobe_qdot")},
    }
    closings = Closings(
        np.array(given["stop"], dtype=np.str_), *(given[name] for name in ("phase", "speed", "q", "qdot"))
    )
    return MachineLyapunov(
        _all_measured(found["exponents"]), rate and _measured(rate), found["exact"],
        _motion(found["motion"], width, machine), closings, MachineStrobes(given["strobe_q"], given["strobe_qdot"]), plan,
    )


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineOrbits(Result):
    """The orbits of a machine with a label, stable or not, the fastest last. It is a sequence of them.

    Attributes
    ----------
    orbits : tuple of MachineMotion
        The orbits.
    plan : str
        The plan as JSON.
    """

    orbits: tuple[MachineMotion, ...]
    plan: str

    def __repr__(self) -> str:
        return f"<MachineOrbits: {', '.join(map(repr, self.orbits)) or 'none found'}>"

    def __iter__(self) -> Iterator[MachineMotion]:
        return iter(self.orbits)

    def __len__(self) -> int:
        return len(self.orbits)

    def __getitem__(self, k: int) -> MachineMotion:
        return self.orbits[k]

    def _table(self) -> dict[str, Any]:
        """One row for each event of each orbit."""
        tables = [of.cycle._table() for of in self]
        names = tables[0] if tables else {}
        number = np.repeat(np.arange(1, len(self) + 1), [len(of.cycle) for of in self])
        return {"orbit": number, **{name: np.concatenate([table[name] for table in tables]) for name in names}}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the speed and the phase of each closing of a stop, for all orbits."""
        from vibroimpact import _machine_plots

        return _machine_plots.orbits(self, ax)


def orbits(found: Mapping[str, Any], machine: Any) -> MachineOrbits:
    """Of the JSON object."""
    width, plan = len(found["system"]["coordinates"]), json.dumps(found["plan"])
    return MachineOrbits(tuple(_motion(orbit, width, machine) for orbit in found["orbits"]), plan)


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineBranch(Result):
    """A branch of orbits of a machine over one number, or along a line through two; each point is one step along it.

    Attributes
    ----------
    vary : str
        The path of the number.
    parameter : ndarray
        Its value at each point.
    also : (str, float, float) or None
        The path of the number that varies with it along a line, and its values at the ends of the range.
    second : ndarray or None
        The value of that number at each point.
    label : ndarray of str
        m/n at each point, or m/T without forcing.
    period : ndarray
        The time of one period at each point.
    stable : ndarray of bool
        Whether the orbit is stable.
    stability : ndarray of str
        "stable", "neutral" (a multiplier on the unit circle to rounding and none outside) or "unstable".
    speed : ndarray
        The largest speed of a closing at each point.
    quantity : str or None
        Of a machine without stops the path of the quantity that the figure shows: the largest displacement of the first coordinate,
        or its largest velocity where the displacement is not defined.
    value : ndarray or None
        Its value at each point.
    multipliers : ndarray of complex128, points x (two for each coordinate)
        Floquet multipliers, without the 1 of each free translation.
    drift : ndarray, points x coordinates
        By how much each coordinate moves on in one period; 0 if the machine cannot be translated.
    cycles : tuple of MachineCycle
        The events at each point.
    event_kind, event_label, event_stop : ndarray of str
        The events of the branch: "fold", "flip", "torus", "branch point", "grazing", ... or why the branch ends; the label
        there, and the stop or joint, if there is one.
    event_parameter, event_point : ndarray
        Value of the number at each event, and the index of the point.
    flip, branch_point : float or None
        The value of the number at the flip or at the branch point at which it begins; both None for the branch of the orbit that
        was asked for.
    followed : list of MachineBranch
        The branches that begin at flips, with twice the period, and at branch points.
    orbit : (int, int) or None
        The number of the orbit at which it begins, and the number of orbits with its label; None for the motion from the start.
    number : int
        The number of the branch: 0 for that of the orbit that was asked for, from 1 for those that begin on it.
    plan : str
        The plan as JSON.
    """

    vary: str
    parameter: _Floats
    also: tuple[str, float, float] | None
    second: _Floats | None
    label: NDArray[np.str_]
    period: _Floats
    stable: NDArray[np.bool_]
    stability: NDArray[np.str_]
    speed: _Floats
    quantity: str | None
    value: _Floats | None
    multipliers: NDArray[np.complex128]
    drift: _Floats
    cycles: tuple[MachineCycle, ...]
    event_kind: NDArray[np.str_]
    event_parameter: _Floats
    event_point: NDArray[np.int64]
    event_label: NDArray[np.str_]
    event_stop: NDArray[np.str_]
    flip: float | None
    branch_point: float | None
    followed: "list[MachineBranch]"
    orbit: tuple[int, int] | None
    number: int
    plan: str
    _machine: Any

    def __repr__(self) -> str:
        more = f", {len(self.followed)} more begin on it" if self.followed else ""
        along = f" and {self.also[0]}" if self.also else ""
        return f"<MachineBranch over {self.vary}{along}, {len(self)} points, {len(self.event_kind)} events{more}>"

    def __len__(self) -> int:
        return len(self.parameter)

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json; of a branch that begins on another one, its part of it."""
        whole_answer = answer(self.plan)
        return whole_answer if self.number == 0 else whole_answer["branches"][self.number]

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        second = {} if self.also is None or self.second is None else {self.also[0]: self.second}
        shown = {} if self.quantity is None or self.value is None else {self.quantity: self.value}
        modulus = np.abs(self.multipliers).max(axis=1) if len(self) else np.empty(0)
        return {
            self.vary: self.parameter, **second, "label": self.label, "period": self.period, "stable": self.stable,
            "stability": self.stability, "speed": self.speed, **shown, "multiplier": modulus,
        }

    def plot(self, ax: "Axes | None" = None, *, diagram: bool = True) -> "Axes":
        """Draw the speeds of the closings of stops, of this branch and of those that begin on it, or without stops the `quantity`:
        solid if stable, dashed and dotted if neutral, dashed if unstable, with the events.

        Parameters
        ----------
        ax : matplotlib Axes
            The axes to draw on; by default those of a new figure.
        diagram : bool
            Whether to draw the orbit diagram from simulation in grey behind the branch.
        """
        from vibroimpact import _machine_plots, _tracks

        ends = (self._machine.number(self.vary), float(json.loads(self.plan)["task"]["branch"]["to"]))
        behind = None
        if diagram:
            task: dict[str, Any] = {"vary": self.vary, "over": f"{ends[0]!r}:{ends[1]!r}:{_tracks.VALUES}"}
            if self.also is not None:
                task["also"] = dict(zip(("path", "from", "to"), self.also))
            if self.quantity is not None:
                task["show"] = self.quantity
            # the sweeps use all cores
            behind = answered(self._machine._file, self._machine.start_of(), {"diagram": task}, threads=0)["diagram"]
        return _machine_plots.branch(self, ax, ends, behind)

    def _draw(self, ax: Any) -> None:
        self.plot(ax, diagram=False)


def _multipliers(points: Sequence[Mapping[str, Any]], width: int) -> NDArray[np.complex128]:
    """Those of all points, in rows."""
    each = len(points[0]["multipliers"]) if points else 2 * width
    return _complex([pair for point in points for pair in point["multipliers"]]).reshape(len(points), each)


def branch(found: Mapping[str, Any], machine: Any) -> MachineBranch:
    """Of the JSON object."""
    line, orbit = found.get("also"), found.get("orbit")
    whole_answer = {
        "vary": found["vary"],
        "also": line and (line["parameter"], line["from"], line["to"]),
        "orbit": orbit and (orbit["number"], orbit["count"]),
        "plan": json.dumps(found["plan"]),
        "_machine": machine,
    }
    width = len(found["system"]["coordinates"])
    first, *further = found["branches"]
    followed = [_branch(one, width, [], {**whole_answer, "number": k}) for k, one in enumerate(further, start=1)]
    return _branch(first, width, followed, {**whole_answer, "number": 0})


def _branch(
    found: Mapping[str, Any], width: int, followed: list[MachineBranch], whole_answer: dict[str, Any]
) -> MachineBranch:
    points, events = found["points"], found["events"]
    begins = found["from"] or {}

    def origin(kind: str) -> float | None:
        return begins["parameter"] if begins.get("kind") == kind else None

    def words(of: Sequence[Mapping[str, Any]], name: str) -> NDArray[np.str_]:
        return np.array([one.get(name, "") for one in of], dtype=np.str_)

    def closing(point: Mapping[str, Any]) -> float:
        return max((event["speed"] for event in point["cycle"] if event["kind"] in ("impact", "close")), default=0.0)

    drift = [list(point["drift"].values()) if "drift" in point else [0.0] * width for point in points]
    second = np.array([point["values"][1] for point in points if "values" in point], dtype=np.float64)
    shown = [point["quantities"] for point in points if "quantities" in point]
    quantity = next(iter(shown[0])) if shown else None
    value = None if quantity is None else np.array([of[quantity] for of in shown], dtype=np.float64)
    return MachineBranch(
        **whole_answer,
        parameter=np.array([point["parameter"] for point in points], dtype=np.float64),
        second=None if whole_answer["also"] is None else second,
        flip=origin("flip"),
        branch_point=origin("branch point"),
        followed=followed,
        label=words(points, "label"),
        period=np.array([point["period"] for point in points], dtype=np.float64),
        stable=np.array([point["stable"] for point in points], dtype=np.bool_),
        stability=words(points, "stability"),
        speed=np.array([closing(point) for point in points], dtype=np.float64),
        quantity=quantity,
        value=value,
        multipliers=_multipliers(points, width),
        drift=np.array(drift, dtype=np.float64).reshape(len(points), width),
        cycles=tuple(_cycle(point["cycle"], width) for point in points),
        event_kind=words(events, "kind"),
        event_parameter=np.array([event["parameter"] for event in events], dtype=np.float64),
        event_point=np.array([event["point"] for event in events], dtype=np.int64),
        event_label=words(events, "before"),
        event_stop=words(events, "stop"),
    )


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineCurve(Result):
    """A curve of an event of an orbit of a machine in a plane of two numbers, from one end to the other.

    Attributes
    ----------
    kind, label : str
        "fold", "flip", "torus", "grazing", "corner", "sticking" or "holding"; the label of the orbit whose branch contains the event.
    of : tuple of str
        The stop or joint of a curve of grazing, sticking or holding, or the stops and joints of a corner.
    parameters : (str, str)
        The paths of the two numbers.
    values : ndarray, points x 2
        Their values.
    multipliers : ndarray of complex128, points x (two for each coordinate)
        Floquet multipliers; on a curve of grazing those of the cycle without the contact.
    residual : ndarray
        By how much the condition of the curve fails at each point: the distance of a multiplier from +1 or -1, or of its
        modulus from 1; the speed at the touch divided by the largest velocity; the difference of the phases at a corner; of
        sticking or holding what is missing to the limit, divided by the size of its terms, or the rate of what is touched.
    cycles : tuple of MachineCycle
        The events at each point; on a curve of grazing without the touch.
    event_kind, event_stop : ndarray of str
        Points of codimension two and ends: "cusp", "1:1", "1:2", "fold-flip", "double grazing", "end of box", ...; the stop
        or joint, if there is one.
    event_point : ndarray
        The index of the point of each event.
    found_at : ndarray
        Values of the first number at the events of this kind on the branch.
    through : (int, int)
        The number, counted from 1, of the event through which the curve passes, and its index among the points.
    plan : str
        The plan as JSON.
    """

    kind: str
    label: str
    of: tuple[str, ...]
    parameters: tuple[str, str]
    values: _Floats
    multipliers: NDArray[np.complex128]
    residual: _Floats
    cycles: tuple[MachineCycle, ...]
    event_kind: NDArray[np.str_]
    event_stop: NDArray[np.str_]
    event_point: NDArray[np.int64]
    found_at: _Floats
    through: tuple[int, int]
    plan: str

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<MachineCurve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.event_kind)} events>"

    def __len__(self) -> int:
        return len(self.values)

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        return {p: self.values[:, 0], q: self.values[:, 1], "residual": self.residual}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the curve in its plane, with its points of codimension two."""
        from vibroimpact import _machine_plots

        return _machine_plots.curve(self, ax)


def curve(found: Mapping[str, Any]) -> MachineCurve:
    """Of the JSON object."""
    width, points, events = len(found["system"]["coordinates"]), found["points"], found["events"]
    one, two = found["parameters"]
    return MachineCurve(
        kind=found["kind"],
        label=found["label"],
        of=tuple(found.get("of", ())),
        parameters=(one, two),
        values=np.array([point["values"] for point in points], dtype=np.float64).reshape(len(points), 2),
        multipliers=_multipliers(points, width),
        residual=np.array([point["residual"] for point in points], dtype=np.float64),
        cycles=tuple(_cycle(point["cycle"], width) for point in points),
        event_kind=np.array([event["kind"] for event in events], dtype=np.str_),
        event_stop=np.array([event.get("stop", "") for event in events], dtype=np.str_),
        event_point=np.array([event["point"] for event in events], dtype=np.int64),
        found_at=np.array(found["found_at"], dtype=np.float64),
        through=(found["through"]["event"], found["through"]["point"]),
        plan=json.dumps(found["plan"]),
    )


def spans(axes: MachineAxes) -> list[dict[str, str]]:
    """The axes of a plan."""
    if not isinstance(axes, Mapping):
        raise TypeError("the axes are a dict of (a, b, n) by path")
    found = []
    for path, over in axes.items():
        if not isinstance(over, str):
            try:
                first, last, count = over
                over = f"{float(first)!r}:{float(last)!r}:{whole('n', count, THREADS)}"
            except (TypeError, ValueError):
                raise TypeError(f"the axis {path} is (a, b, n) or a text A:B:N, not {over!r}") from None
        found.append({"vary": path, "over": over})
    return found


def size(axes: Sequence[Mapping[str, str]]) -> int:
    """The number of points of the grid."""
    return math.prod(len(_core.span_values(axis["over"])) for axis in axes)


def _coordinates(found: Mapping[str, Any]) -> dict[str, _Floats]:
    (task,) = found["plan"]["task"].values()
    return {axis["vary"]: _core.span_values(axis["over"]) for axis in task["axes"]}


def _in_axes(values: NDArray[Any], axes: Mapping[str, _Floats]) -> NDArray[Any]:
    """Values in the order of the grid, whose first axis varies fastest, as an array with the axes in their order."""
    counts = [len(of) for of in axes.values()]
    further = range(len(counts), len(counts) + values.ndim - 1)
    slowest_first = values.reshape(*reversed(counts), *values.shape[1:])
    return np.transpose(slowest_first, (*reversed(range(len(counts))), *further))


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineBasin(Result):
    """The motion to which each start of a grid leads.

    Attributes
    ----------
    axes : dict of ndarray
        The values along each axis by path.
    motions : tuple of MachineMotion
        The motions, in the order of their first start.
    share, count : ndarray
        Share and number of the starts that lead to each.
    cells : ndarray of int, shaped by the axes
        The index of the motion of each start; -1 beyond a rigid stop.
    labels : ndarray of str, shaped by the axes
        Its label; "refused" beyond a rigid stop.
    plan : str
        The plan as JSON.
    """

    axes: dict[str, _Floats]
    motions: tuple[MachineMotion, ...]
    share: _Floats
    count: NDArray[np.int64]
    cells: NDArray[np.int64]
    labels: NDArray[np.str_]
    plan: str

    def __repr__(self) -> str:
        shape = " x ".join(str(n) for n in self.cells.shape)
        return f"<MachineBasin of {shape} starts over {', '.join(self.axes)}, {len(self.motions)} motions>"

    def xarray(self) -> "xr.DataArray":
        """The labels as a DataArray whose coordinates are the paths."""
        import xarray as xr

        return xr.DataArray(self.labels, coords=self.axes, dims=list(self.axes), name="label", attrs={"plan": self.plan})

    def _table(self) -> dict[str, Any]:
        """One row for each start."""
        places = np.meshgrid(*self.axes.values(), indexing="ij")
        return {**{path: of.ravel() for path, of in zip(self.axes, places)}, "label": self.labels.ravel()}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the motions over two axes, in colours."""
        from vibroimpact import _machine_plots

        return _machine_plots.cells(self.axes, self.labels, self.plan, ax, motion_of=self.cells)


def basin(found: Mapping[str, Any], machine: Any) -> MachineBasin:
    """Of the JSON object."""
    axes, (motions, share, count) = _coordinates(found), _shared(found, machine)
    flat = np.array([-1 if cell is None else cell for cell in found["cells"]], dtype=np.int64)
    cells = _in_axes(flat, axes)
    labels = np.array([*(motion.label for motion in motions), "refused"], dtype=np.str_)[cells]
    return MachineBasin(axes, motions, share, count, cells, labels, json.dumps(found["plan"]))


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineMap(Result):
    """The motions at each point of a grid of numbers of a machine.

    Attributes
    ----------
    axes : dict of ndarray
        The values along each axis by path.
    labels : ndarray of str, shaped by the axes, and by the motions of a point
        Labels at each point, the most frequent first; empty texts after the last one.
    share : ndarray, of the same shape
        Share of the starts that lead to each; NaN after the last one.
    stop : ndarray of str, of the same shape
        The stops that stay closed for ever in each motion; empty where there are none.
    seen_events : int or None
        The smallest number of events over which chaos was seen at a point; None without chaos.
    plan : str
        The plan as JSON.
    """

    axes: dict[str, _Floats]
    labels: NDArray[np.str_]
    share: _Floats
    stop: NDArray[np.str_]
    seen_events: int | None
    plan: str

    def __repr__(self) -> str:
        shape = " x ".join(str(n) for n in self.labels.shape[:-1])
        seen = "" if self.seen_events is None else f", chaos seen over at least {self.seen_events} events"
        return f"<MachineMap of {shape} points over {', '.join(self.axes)}{seen}>"

    def xarray(self) -> "xr.Dataset":
        """`label` and `share` as a Dataset whose coordinates are the paths."""
        import xarray as xr

        dims = [*self.axes, "motion"]
        variables = {"label": (dims, self.labels), "share": (dims, self.share), "stop": (dims, self.stop)}
        return xr.Dataset(variables, coords=self.axes, attrs={"plan": self.plan})

    def _table(self) -> dict[str, Any]:
        """One row for each motion at each point."""
        count = np.arange(self.labels.shape[-1])
        places = np.meshgrid(*self.axes.values(), count, indexing="ij")
        there = self.labels.ravel() != ""
        columns = {path: of.ravel()[there] for path, of in zip(self.axes, places)}
        own = {"label": self.labels, "share": self.share, "stop": self.stop}
        return {**columns, **{name: of.ravel()[there] for name, of in own.items()}}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the motions over two numbers, in colours, or their shares over one."""
        from vibroimpact import _machine_plots

        return _machine_plots.cells(self.axes, self.labels, self.plan, ax, share=self.share)


def mapped(found: Mapping[str, Any]) -> MachineMap:
    """Of the JSON object."""
    cells = [
        [(of["label"], of["share"], " ".join(of.get("stops", ()))) for of in point["motions"]] for point in found["points"]
    ]
    axes, most = _coordinates(found), max((len(cell) for cell in cells), default=0)
    rows = [cell + [("", math.nan, "")] * (most - len(cell)) for cell in cells]

    def column(k: int, kind: Any) -> NDArray[Any]:
        return _in_axes(np.array([[motion[k] for motion in row] for row in rows], dtype=kind).reshape(len(cells), most), axes)

    labels, share, stop = column(0, np.str_), column(1, np.float64), column(2, np.str_)
    return MachineMap(axes, labels, share, stop, found.get("seen_events"), json.dumps(found["plan"]))
