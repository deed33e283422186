"""Steady motions, as views of the JSON of the command."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Mapping
from typing import Any

from vibroimpact._core import QuestionError
from vibroimpact._events import Events, all_measured, complex_of, maybe_measured
from vibroimpact._oscillator import Oscillator
from vibroimpact._paint import named
from vibroimpact._result import Answer, Made, View, field
from vibroimpact._simulation import Simulation, Waveform, waveform

#: Minimum number of forcing periods, and of cycles without forcing, in a figure of a periodic motion.
_SHOWN, _CYCLES = 6, 3
#: What the paths of the quantities of the parts of a machine begin with.
_HEADS = {"forces": "force", "stops": "stop", "joints": "friction", "coordinates": "q"}


def _by_path(given: Mapping[str, Any] | None) -> dict[str, float] | None:
    """Quantities by path, from the objects of the parts of a machine; null is infinite or not defined."""
    if given is None:
        return None
    found = {name: value for name, value in given.items() if name not in _HEADS}
    for kind, head in _HEADS.items():
        for part, own in given.get(kind, {}).items():
            found |= {f"{head}.{part}.{name}": value for name, value in own.items()}
    return {path: math.nan if value is None else value for path, value in found.items()}


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
