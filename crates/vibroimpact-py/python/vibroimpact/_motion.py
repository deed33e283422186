"""A steady motion of any system: its kind, the events of its cycle, its stability and its quantities."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import QuestionError
from vibroimpact._events import Events
from vibroimpact._figure import named
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Field, Made, View
from vibroimpact._waveform import Waveform, waveform

if TYPE_CHECKING:
    from vibroimpact._simulate import Simulation

#: Minimum number of forcing periods, and of cycles without forcing, in a figure of a periodic motion.
_SHOWN, _CYCLES = 6, 3
#: What the paths of the quantities of the parts of a machine begin with.
_HEADS = {"forces": "force", "stops": "stop", "joints": "friction", "coordinates": "q"}


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


class Motion(View):
    """A steady motion.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    kind : str
        "periodic", "no_impact", "chaotic", "stuck" or "undecided". All of these are results; none is an error.
    label : str
        m/n for m closings of stops in n forcing periods, such as "4/1", "inf/1" with a complete chatter, m/T without forcing; or
        "0", "chaotic", "stuck", "undecided".
    impacts, periods : int or None
        m and n.
    period : float or None
        The time of one period of a cycle.
    sticks : int or None
        Rests on stops, and holds of joints, in each period.
    counts : dict
        The closings of each stop in one period; None for infinitely many.
    stable : bool or None
        Whether it is stable; None if this is not decided.
    stability : str or None
        "stable", "neutral" (a multiplier on the unit circle to rounding and none outside, as of every elastic motion) or
        "unstable"; None if this is not decided.
    multipliers : ndarray of complex128
        Floquet multipliers, two for each coordinate, the largest first. In a machine that can be translated as a whole, the 1 that
        belongs to this is left out.
    drift, drift_velocity : dict or None
        By how much each coordinate moves on in one period, and the mean velocity of this; None if the system cannot be translated.
    cycle : Events
        The events of one period; empty unless it is periodic. Impacts of a complete chatter that are summed are not listed.
    state : dict or None
        A state of the cycle between two events: `q`, `qdot`, `phase`, and of a machine its contacts and all digits, which
        `Machine.starting` takes.
    residual : float or None
        The distance between the states before and after one period of the cycle.
    stops : tuple of str
        The stops that stay closed for ever, of a motion without a further event.
    stop : str or None
        For a stuck motion: the stop on which it rests.
    seen_events : int or None
        For a chaotic or undecided motion: the events (of an oscillator: impacts) that were followed. Chaos may be a longer
        transient.
    exponents : tuple of Measured or None
        Lyapunov exponents of a chaotic or undecided motion, if they were measured, per unit of time.
    lyapunov : Measured or None
        The largest of them.
    horizon : dict or None
        Why an oscillator has no more impacts, and for how many periods (None: for ever).
    why : str or None
        Why a motion is undecided.
    quantities : dict or None
        Quantities of the motion, in the units of the system: "impact_speed_max", "work_per_period", "displacement_rms" and others;
        of the parts of a machine by path, as "stop.anvil.impulse_per_period". nan where one is not defined. None for an undecided
        motion.
    quantities_error : dict or None
        For a chaotic motion: three standard errors of those of its quantities that are means. None for other motions, whose
        quantities are exact to rounding.

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
    stops: Field[tuple[str, ...]] = Field(lambda of: tuple(of or ()))
    counts: Field[dict[str, int | None]] = Field(lambda of: dict(of or {}))
    multipliers, exponents, lyapunov = Field(complex_of), Field(all_measured), Field(maybe_measured)
    quantities, quantities_error = Field(_by_path), Field(_by_path)

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

    cycle: Made[Events] = Made(lambda of: Events.of(of._of["cycle"], of.system))

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
        if isinstance(self.system, Oscillator):
            start = self.start()
            return waveform(self.system, (start["x"], start["v"], start["phase"]), until, step, events)
        if self.state is None:
            raise QuestionError(f"the motion {self.label} has no state to start from\nhint: simulate it from its start")
        machine = self.system.starting(self.state)
        return waveform(machine, machine.start_of(), until, step, events)

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

        turns = self.periods or 1
        if isinstance(self.system, Oscillator):
            return simulate(self.system, **self.start(), periods=turns * max(2, math.ceil(_SHOWN / turns)))
        if self.state is None:
            raise QuestionError(f"the motion {self.label} has no cycle to draw\nhint: simulate(...).plot() draws it from its start")
        impacts = max(_CYCLES * len(self.cycle), 1) if self.system.period is None else None
        periods = None if impacts else turns * max(2, math.ceil(_SHOWN / turns))
        return simulate(self.system.starting(self.state), impacts=impacts, periods=periods)
