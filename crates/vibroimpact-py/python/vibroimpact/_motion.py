"""Motions of any system as views of the JSON of the command: their events, their course in time, and where they lead."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._oscillator import Oscillator
from vibroimpact._paint import named
from vibroimpact._result import Answer, Listed, Made, Result, View, column, field, parts

_Floats = NDArray[np.float64]

#: Minimum number of forcing periods, and of cycles without forcing, in a figure of a periodic motion.
_SHOWN, _CYCLES = 6, 3
#: Steps of a waveform in a forcing period, and in the whole time of a motion without forcing.
_PER_PERIOD, _WHOLE = 100, 1000
#: What the paths of the quantities of the parts of a machine begin with.
_HEADS = {"forces": "force", "stops": "stop", "joints": "friction", "coordinates": "q"}
#: The columns of a table of events before those of the states, and of a table of motions.
_OF_EVENTS = ("kind", "stop", "time", "phase", "speed")
_OF_MOTIONS = ("label", "kind", "stable", "stability", "seen_events", "impacts", "periods", "share", "starts")


class Measured(NamedTuple):
    """A number and its error bar, which is three standard errors; 0 if the number is exact."""

    value: float
    error: float


def measured(given: Mapping[str, Any]) -> Measured:
    """Of the JSON object; null stands for an infinite or an undefined number."""
    value, error = given["value"], given["error"]
    if value is None:
        value = {"minus_infinity": -math.inf, "infinity": math.inf}.get(given.get("why", ""), math.nan)
    # an infinite number is exact
    return Measured(value, error if error is not None else 0.0 if math.isinf(value) else math.nan)


def maybe_measured(given: Mapping[str, Any] | None) -> Measured | None:
    """Of the JSON object; None if there is none."""
    return None if given is None else measured(given)


def all_measured(given: Sequence[Mapping[str, Any]] | None) -> tuple[Measured, ...] | None:
    """Of a list of them; None if there is none."""
    return None if given is None else tuple(measured(one) for one in given)


def complex_of(pairs: Sequence[Sequence[float | None]] | None) -> NDArray[np.complex128]:
    """Complex numbers of pairs; null is infinite."""
    numbers = [complex(*(math.inf if part is None else part for part in pair)) for pair in pairs or ()]
    return np.array(numbers, dtype=np.complex128)


def _by_path(given: Mapping[str, Any] | None) -> dict[str, float] | None:
    """Quantities by path, from the objects of the parts of a machine; null is infinite or not defined."""
    if given is None:
        return None
    found = {name: value for name, value in given.items() if name not in _HEADS}
    for kind, head in _HEADS.items():
        for part, own in given.get(kind, {}).items():
            found |= {f"{head}.{part}.{name}": value for name, value in own.items()}
    return {path: math.nan if value is None else value for path, value in found.items()}


def names_of(system: Any) -> tuple[list[str], list[str]]:
    """The names of the columns of coordinates and of velocities."""
    if isinstance(system, Oscillator):
        return ["x"], ["v"]
    return [f"q.{name}" for name in system.coordinates], [f"qdot.{name}" for name in system.coordinates]


def _stops_of(system: Any) -> tuple[str, ...]:
    """The names of the stops."""
    if isinstance(system, Oscillator):
        return ("upper",) if system.second_gap is None else ("upper", "lower")
    stops: tuple[str, ...] = system.stops
    return stops


def _columns(of: Any, first: Sequence[str], states: tuple[list[str], list[str]]) -> dict[str, Any]:
    """Columns of a result, and then its coordinates and velocities by these names."""
    positions, velocities = states
    own = {name: getattr(of, name) for name in first}
    return {**own, **dict(zip(positions, of.q.T)), **dict(zip(velocities, of.qdot.T))}


def columns_of(found: Mapping[str, Any], n: int) -> dict[str, Any]:
    """The columns of events of the compiled module, of a system with `n` coordinates."""
    time, phase, speed, *states = found["real"]
    kinds, stops = (np.array(found[name], dtype=np.str_) for name in ("kinds", "stops"))
    kind, stop = (names[codes] if len(names) else np.empty(0, np.str_) for names, codes in ((kinds, found["kind"]), (stops, found["stop"])))
    q, qdot = (np.stack(of, axis=1) for of in (states[:n], states[n:]))
    return {"kind": kind, "stop": stop, "time": time, "phase": phase, "speed": speed, "q": q, "qdot": qdot}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Events(Result):
    """The events of a cycle in order of time, beginning with the fastest closing of a stop.

    Attributes
    ----------
    kind, stop : ndarray of str
        Kind of each event: "impact", "close", "open", "stick", "release", "slip", "hold", "graze" or "collapse"; the name of the
        stop or joint, of an oscillator "upper" or "lower".
    time, phase, speed : ndarray
        Time since the first event, phase of the force in radians, speed of closing before the event.
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
    _names: tuple[list[str], list[str]]

    def __repr__(self) -> str:
        return f"<Events: {len(self)}>"

    def __len__(self) -> int:
        return len(self.kind)

    @classmethod
    def of(cls, events: Sequence[Mapping[str, Any]], system: Any) -> "Events":
        """The events of the JSON of the command."""
        names = names_of(system)

        def floats(name: str) -> _Floats:
            return np.array([event.get(name, math.nan) for event in events], dtype=np.float64)

        def rows(name: str) -> _Floats:
            return np.array([event[name] for event in events], dtype=np.float64).reshape(len(events), len(names[0]))

        kind, stop = (np.array([event[name] for event in events], dtype=np.str_) for name in ("kind", "stop"))
        return cls(kind, stop, floats("time"), floats("phase"), floats("speed"), rows("q"), rows("qdot"), names)

    @property
    def closes(self) -> NDArray[np.bool_]:
        """Whether each event is the closing of a stop: an impact, or the beginning of compliant contact."""
        closing: NDArray[np.bool_] = np.isin(self.kind, ("impact", "close"))
        return closing

    def _table(self) -> dict[str, Any]:
        """One row for each event."""
        return _columns(self, _OF_EVENTS, self._names)


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Waveform(Result):
    """A motion over time.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    time, phase : ndarray
        Time, and phase of the force in radians in [0, 2 pi).
    q, qdot : ndarray, points x coordinates
        Coordinates and velocities.
    gap : ndarray, points x stops
        The gap of each stop; negative where a compliant stop is pushed in.
    force : ndarray, points x (stops and joints)
        The force of each stop, against its direction, and of each joint, against positive relative velocity. Forces of
        impacts are infinite and are not told.
    contact : ndarray of bool, points x stops
        Whether a stop is closed or rested on.
    """

    system: Any
    time: _Floats
    phase: _Floats
    q: _Floats
    qdot: _Floats
    gap: _Floats
    force: _Floats
    contact: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<Waveform of {len(self)} points>"

    def __len__(self) -> int:
        return len(self.time)

    def _table(self) -> dict[str, Any]:
        """One row for each point; coordinates, velocities, gaps and forces by their paths."""
        columns = _columns(self, ("time", "phase"), names_of(self.system))
        columns |= {f"gap.{name}": self.gap[:, k] for k, name in enumerate(_stops_of(self.system))}
        joints = () if isinstance(self.system, Oscillator) else self.system.joints
        contacts = _stops_of(self.system) + joints
        return columns | {f"force.{name}": self.force[:, k] for k, name in enumerate(contacts)}


def waveform(system: Any, start: Any, until: float, step: float | None, events: bool) -> Waveform:
    """The motion from a start, as the compiled module takes it, until a time."""
    usual = until / _WHOLE or 1.0 if system.period is None else system.period / _PER_PERIOD
    asked = (start, until, usual if step is None else float(step), events)
    if not isinstance(system, Oscillator):
        return Waveform(system=system, **_core.machine_waveform(system._file, *asked))
    time, x, v = _core.waveform(system._file, *asked)
    phase = (start[2] + system.beta * time) % (2 * math.pi)
    walls = [(system.gap, 1.0)] + ([] if system.second_gap is None else [(system.second_gap, -1.0)])
    gap = np.stack([at - side * x for at, side in walls], axis=1)
    # where the mass rests, the stop takes what the force and the spring leave
    contact = (gap == 0.0) & (v == 0.0)[:, None]
    force = np.stack([side * (np.sin(phase) - x) for _, side in walls], axis=1)
    return Waveform(system, time, phase, x[:, None], v[:, None], gap, np.where(contact, np.maximum(force, 0.0), 0.0), contact)


class Simulation(Answer, schema="simulate EventObject EndObject"):
    """The events of a motion as columns, and the reason why the list ends.

    Attributes
    ----------
    start : tuple
        The start: position (None: at rest, or on the stop), velocity and phase; of a machine coordinates, velocities and phase.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    with_ : tuple of tuples of str
        Other stops of a machine that take part at the same time.
    end : str
        Why the list ends: "impact_limit", "event_limit", "time_limit", "no_more_impacts", "stuck", "search_limit", "inconsistent" or
        "collapse".
    end_time, shown_until : float
        The time at which the list ends, and that up to which figures and waveforms show the motion.
    """

    start: tuple[Any, Any, float]
    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: _Floats
    phase: _Floats
    speed: _Floats
    q: _Floats
    qdot: _Floats
    with_: tuple[tuple[str, ...], ...]
    tie: NDArray[np.bool_]
    depth: _Floats
    chatter: NDArray[np.bool_]
    error: _Floats
    end: str
    end_time: float
    horizon: dict[str, Any] | None
    shown_until: float

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        found = answer.columns() or {}
        found |= columns_of(found.pop("events"), len(names_of(self.system)[0]))
        horizon, with_ = found["horizon"], tuple(map(tuple, found["with_"]))
        of = {"horizon": horizon and json.loads(horizon), "with_": with_, "plan": json.loads(answer.plan)}
        return {**found, **of, "start": self._start.given}

    def __repr__(self) -> str:
        return f"<Simulation of {len(self)} events, ends with {self.end} at time {self.end_time:.6g}>"

    def __len__(self) -> int:
        return len(self.time)

    def state(self, event: int = -1) -> dict[str, Any]:
        """The state from which the motion goes on after an event, the last by default: `q`, `qdot`, `phase`; of a machine also what
        stops and joints do (`contacts`), and the digits that these leave out (`exact`). `Machine.starting` takes it.

        Parameters
        ----------
        event : int
            Number of the event, counted from 0, or from the end if it is negative.
        """
        number = range(len(self))[event]
        if isinstance(self.system, Oscillator):
            return {"q": self.q[number].tolist(), "qdot": self.qdot[number].tolist(), "phase": float(self.phase[number])}
        found: dict[str, Any] = json.loads(_core.machine_state(self.plan, number))
        return found

    def waveform(self, step: float | None = None, *, events: bool = True) -> Waveform:
        """The motion over time, up to `shown_until`.

        Parameters
        ----------
        step : float
            Time between two points, at most. Default: a hundredth of a forcing period; without forcing a thousandth of the whole time.
        events : bool
            Whether to add both sides of each event, at the same time, and the end. Without them the steps are equal.
        """
        return waveform(self.system, self.start, self.shown_until, step, events)

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json."""
        found: dict[str, Any] = json.loads(self._whole.json(False))
        return found

    def _painted(self, *how: Any) -> Any:
        # that of a machine may have two panels
        drawn = super()._painted(*how)
        return drawn if isinstance(self.system, Oscillator) else np.atleast_1d(drawn)

    def _table(self) -> dict[str, Any]:
        """One row for each event; coordinates and velocities by their paths."""
        columns = _columns(self, _OF_EVENTS, names_of(self.system))
        if isinstance(self.system, Oscillator):
            return columns | {"depth": self.depth, "chatter": self.chatter, "error": self.error}
        return columns | {"with": [", ".join(names) for names in self.with_], "tie": self.tie}


class Motion(View, schema="settle MotionObject"):
    """A steady motion.

    Attributes
    ----------
    cycle : Events
        The events of one period; empty unless it is periodic. Impacts of a complete chatter that are summed are not listed.
    quantities : dict or None
        Quantities of the motion, in the units of the system: "impact_speed_max", "work_per_period", "displacement_rms" and others;
        of the parts of a machine by path, as "stop.anvil.impulse_per_period". nan where one is not defined. None for an undecided
        motion.
    lyapunov : Measured or None
        The largest of the exponents.

    Examples
    --------
    >>> from vibroimpact import Oscillator, attractors
    >>> motion = attractors(Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5), starts=4)[0]
    >>> motion
    <Attractor 4/1, stable, 100 %>
    >>> motion.cycle.speed.round(4).tolist()
    [1.5131, 1.0992, 0.5139, 0.1792]
    """

    kind: str
    label: str
    impacts: int | None
    periods: int | None
    period: float | None
    sticks: int | None
    stable: bool | None
    stability: str | None
    drift: dict[str, float] | None
    drift_velocity: dict[str, float] | None
    state: dict[str, Any] | None
    residual: float | None
    stop: str | None
    seen_events: int | None
    horizon: dict[str, Any] | None
    why: str | None
    stops: Made[tuple[str, ...]] = field(lambda of: tuple(of or ()))
    counts: Made[dict[str, int | None]] = field(lambda of: dict(of or {}))
    multipliers, exponents, lyapunov = field(complex_of), field(all_measured), field(maybe_measured)
    quantities, quantities_error = field(_by_path), field(_by_path)

    cycle: Made[Events] = Made(lambda of: Events.of(of._of["cycle"], of.system))

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._words()}{self._remark()}>"

    def _words(self) -> str:
        """The label, and what it does not say: the stops of a rest, for how long chaos was seen, the stability."""
        stops = f" on {', '.join(self.stops)}" if self.stops else ""
        if self.kind == "chaotic":
            return f"chaotic, seen over {self.seen_events} events"
        return f"{self.label}{stops}" + ("" if self.stability is None else f", {self.stability}")

    def _remark(self) -> str:
        return ""

    def _table(self) -> dict[str, Any]:
        """One row for each event of the cycle."""
        return self.cycle._table()

    def start(self) -> dict[str, Any]:
        """A start on the motion, just after the first event of its cycle, as arguments of `simulate` and other functions."""
        if not len(self.cycle):
            raise QuestionError(f"the motion {self.label} has no events to start from\nhint: simulate it from its start")
        q, qdot, phase = self.cycle.q[0], self.cycle.qdot[0], float(self.cycle.phase[0])
        if isinstance(self.system, Oscillator):
            return {"x": float(q[0]), "v": float(qdot[0]), "phase": phase}
        return {"q": q.tolist(), "qdot": qdot.tolist(), "phase": phase}

    def waveform(self, step: float | None = None, *, periods: float | None = None, events: bool = True) -> Waveform:
        """The motion over time: of an oscillator from just after the first event of its cycle, of a machine from its `state`.

        Parameters
        ----------
        step : float
            Time between two points, at most. Default: a hundredth of a forcing period; without forcing a thousandth of the whole time.
        periods : float
            Number of forcing periods, without forcing of cycles; by default those of one period of the motion.
        events : bool
            Whether to add both sides of each event, at the same time, and the end. Without them the steps are equal.
        """
        turns = 1 if periods is None else periods / (self.periods or 1)
        until = turns * (self.period or self.system.period or 0.0)
        if not until > 0.0:
            raise QuestionError(f"the motion {self.label} has no period to show\nhint: simulate(...).waveform() shows it from its start")
        system, start = self._begin("state to start from\nhint: simulate it from its start")
        return waveform(system, tuple(start.values()) or system.start_of(), until, step, events)

    def _begin(self, lacking: str) -> tuple[Any, dict[str, Any]]:
        """A system and a start on the motion: those of an oscillator, or a machine that starts in a state."""
        if isinstance(self.system, Oscillator):
            return self.system, self.start()
        if self.state is None:
            raise QuestionError(f"the motion {self.label} has no {lacking}")
        return self.system.starting(self.state), {}

    def plot(self, ax: Any = None, *, si: bool = False, legend: bool = True, title: str | None = None, **line: Any) -> Any:
        """Draw some periods of the motion: of an oscillator the position with the stops, of a machine the coordinates, and below
        them the contact forces, if there are any.

        `ax` is the axes to draw into, of a machine one or two. Returns the axes. `si` selects metres and seconds for an
        oscillator with units.
        """
        shown = self._some_periods()
        figure = shown._figure(si=si)
        figure["title"] = f"{(figure['title'] or 'machine').split(': ')[0]}: {named(self.label)}"
        return shown._painted(figure, ax, legend, title, line)

    def _some_periods(self) -> "Simulation":
        """The motion over some of its periods."""
        from vibroimpact._questions import simulate

        system, start = self._begin("cycle to draw\nhint: simulate(...).plot() draws it from its start")
        if system.period is None:
            return simulate(system, impacts=max(_CYCLES * len(self.cycle), 1))
        turns = self.periods or 1
        return simulate(system, **start, periods=turns * max(2, math.ceil(_SHOWN / turns)))


class Attractor(Motion, schema="attractors SharedMotion"):
    """A motion, with the share (0 to 1) and the number of the `starts` that lead to it.

    `share_interval` is Wilson's interval of the share at a confidence of 95 %, for random starts. Starts of a sequence of
    low discrepancy, which these are, are more even.
    """

    share: float
    starts: int

    def __init__(self, of: dict[str, Any], system: Any, interval: tuple[float, float]) -> None:
        super().__init__(of, system)
        self.share_interval = interval

    def _remark(self) -> str:
        return f", {100 * self.share:.4g} %"


class Attractors(Listed[Attractor], schema="attractors"):
    """A sequence of `Attractor`, the most frequent first.

    Attributes
    ----------
    motions : list of Attractor
        The motions.
    share : ndarray
        The share of the starts that lead to each.
    """

    starts: int
    seed: int
    box: dict[str, list[float]] | None
    missed_below: float
    motions: Made[list[Attractor]] = Made(
        lambda of: [Attractor(one, of.system, tuple(ends)) for one, ends in zip(of._of["motions"], of._of["share_intervals"])]
    )
    share: Made[_Floats] = Made(lambda of: np.array([motion.share for motion in of], dtype=np.float64))
    _items: Made[list[Attractor]] = Made(lambda of: of.motions)

    def __repr__(self) -> str:
        return f"<Attractors of {self.starts} starts: {', '.join(f'{m._words()}, {100 * m.share:.3g} %' for m in self)}>"

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        columns = {name: [getattr(motion, name) for motion in self] for name in _OF_MOTIONS}
        return {**columns, "stop": [" ".join(motion.stops) for motion in self]}


class Settled(Motion, Answer, schema="settle"):
    """What a motion settles into: a `Motion`, and how far it was followed."""

    _object: Made[dict[str, Any]] = Made(lambda of: of._read(of._answer))
    _of: Made[dict[str, Any]] = Made(lambda of: of._object["motion"])
    motion: Made[Motion] = Made(lambda of: Motion(of._of, of.system))
    events_followed: Made[int] = Made(lambda of: of._object["events_followed"])
    time_followed: Made[float] = Made(lambda of: of._object["time_followed"])
    chaotic_transient: Made[dict[str, Any] | None] = Made(lambda of: _chaos(of._object.get("chaotic_transient")))
    harmonics: Made[list[dict[str, float]]] = Made(lambda of: of._complete.get("harmonics", []))
    transient: Made[dict[str, Any] | None] = Made(lambda of: of._complete.get("transient"))
    # the object that the command prints: its harmonics and transient take another settling
    _complete: Made[dict[str, Any]] = Made(lambda of: json.loads(of._whole.json(False)))

    @property
    def plan(self) -> str:
        """The plan as JSON."""
        return json.dumps(self._object["plan"])

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json."""
        return copy.deepcopy(self._complete)


def _chaos(of: dict[str, Any] | None) -> dict[str, Any] | None:
    return None if of is None else {**of, "exponents": all_measured(of["exponents"])}


class Settlement(Attractors):
    """The motions to which many starts lead, in the order of their first start, with their shares.

    Attributes
    ----------
    cells : ndarray of uint32
        The motion of each start as an index into `motions`, in the shape of the starts.
    labels : ndarray of str
        The label of the motion of each start, in the shape of the starts.
    """

    cells: NDArray[np.uint32]

    def __repr__(self) -> str:
        return f"<Settlement of {self.cells.size} starts: {', '.join(m.label for m in self)}>"

    def to_dict(self) -> dict[str, Any]:
        """The motions as in the JSON of the command, and the number of the motion of each start."""
        return {"motions": [motion.to_dict() for motion in self], "cells": self.cells.tolist()}

    def _figure(self, **shown: Any) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(_core.shares_figure(self.system._file, [(motion.label, motion.share) for motion in self]))
        return found

    labels: Made[NDArray[np.str_]] = Made(lambda of: np.array([motion.label for motion in of], dtype=np.str_)[of.cells])


class EarlierContact(NamedTuple):
    """The first contact of an inadmissible solution with a stop before its next impact."""

    #: The number of the impact before the contact, counted from 1; None if the solution has no impacts.
    after_impact: int | None
    #: "upper" or "lower".
    stop: str
    #: Time from that impact, or from phase 0, to the contact.
    time: float


class Orbit(Motion, schema="orbit OrbitObject"):
    """A periodic orbit. `admissible` is False for a solution of the equations of an oscillator that passes through a stop;
    `earlier_contact` is its first contact with a stop before its next impact.
    """

    admissible: bool
    earlier_contact: Made[EarlierContact | None] = field(lambda of: of and EarlierContact(**of))

    def _remark(self) -> str:
        return "" if self.admissible else ", inadmissible"

    def _begin(self, lacking: str) -> tuple[Any, dict[str, Any]]:
        if not self.admissible:
            raise QuestionError(f"this solution {self.label} is inadmissible: it passes through a stop on its way")
        return super()._begin(lacking)


class Orbits(Listed[Orbit], schema="orbit"):
    """A sequence of `Orbit`, the fastest last."""

    orbits = parts(Orbit)
    _items: Made[list[Orbit]] = Made(lambda of: of.orbits)

    def __repr__(self) -> str:
        return f"<Orbits: {', '.join(map(repr, self)) or 'none found'}>"

    def _table(self) -> dict[str, Any]:
        """One row for each event of each orbit."""
        tables = [of.cycle._table() for of in self]
        names = tables[0] if tables else {}
        number = np.repeat(np.arange(1, len(self) + 1), [len(of.cycle) for of in self])
        return {"orbit": number, **{name: np.concatenate([table[name] for table in tables]) for name in names}}

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draw the speed and the phase of each closing of a stop, for all orbits; options as for other results."""
        if not len(self):
            raise QuestionError("there are no orbits to draw")
        return super().plot(ax, **options)


class Edge(Answer, schema="edge TrackObject"):
    """The border between two motions, and the motion on it.

    Attributes
    ----------
    q, qdot : ndarray, shape (len(time), coordinates)
        The coordinates and velocities of the states.
    """

    part: float
    sides = parts(Motion)
    saddle: Made[Motion | None] = Made(lambda of: of._of["saddle"] and Motion(of._of["saddle"], of.system))
    time, phase, apart = column(np.float64), column(np.float64), column(np.float64)
    q, qdot = column(np.float64), column(np.float64)
    _rows: Made[list[dict[str, Any]]] = Made(lambda of: of._of["track"])

    def __repr__(self) -> str:
        one, other = (side.label for side in self.sides)
        saddle = "no saddle" if self.saddle is None else f"saddle {self.saddle.label}"
        return f"<Edge of {one} and {other}, {saddle}>"

    def _table(self) -> dict[str, Any]:
        """One row for each state on the border."""
        names = self._of["system"]["coordinates"]
        states = tuple([f"{kind}.{name}" for name in names] for kind in ("q", "qdot"))
        return {**_columns(self, ("time",), states), "phase": self.phase, "apart": self.apart}  # type: ignore[arg-type]
