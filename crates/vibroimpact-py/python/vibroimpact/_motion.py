"""The motion after the transient: its kind, its impacts and its stability."""

import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import Oscillator
from vibroimpact._cycle import Cycle
from vibroimpact._result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Minimum number of forcing periods in a figure of a periodic motion.
_SHOWN = 6


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Motion(Result):
    """The result of settling a motion.

    Attributes
    ----------
    osc : Oscillator
        The system.
    kind : str
        "periodic", "no_impact", "chaotic", "stuck" or "undecided". All of these are results; none is an error.
    label : str
        m/n for m impacts in n forcing periods, such as "4/1", or "inf/1" with a complete chatter; or "0", "chaotic", "stuck", "undecided".
    impacts, periods : int or None
        m and n.
    by_stop : bool
        Whether there are two stops and the numbers of impacts on each are known.
    impacts_upper, impacts_lower : int or None
        With two stops, the numbers of impacts on each; None for infinitely many, and with one stop.
    sticks : int or None
        Number of phases of sticking in each period of the motion.
    stable : bool or None
        Whether it is stable; None if this is not decided.
    stability : str or None
        "stable", "neutral" (a multiplier on the unit circle to rounding and none outside, as of every elastic motion) or
        "unstable"; None if this is not decided.
    multipliers : ndarray of complex128 or None
        Floquet multipliers, the larger first.
    cycle : Cycle
        The impacts of one period of the motion; empty unless it is periodic.
    rests : list of dict
        Phases of sticking: "side", "chatter" (whether a chatter precedes it), and the phases of the force "begin" and "release".
    residual : float or None
        The distance between the states before and after one period of the cycle.
    lyapunov : (float, float) or None
        For a chaotic motion: the larger exponent per unit of time, and its error.
    seen_impacts : int or None
        For a chaotic motion: number of impacts over which no cycle, no second phase of sticking and no fading impacts were
        found. The chaos may still be a longer transient.
    chaotic_transient : (int, (float, float)) or None
        Chaos before the motion settled: the number of the impact by which it had ended, and the exponent with its error.
    horizon : dict or None
        Why there are no more impacts, and for how many periods (None: for ever).
    side, stop : str or None
        For a stuck motion: the stop, "upper" or "lower".
    tried : dict or None
        For an undecided motion: the budget used and the measurements made.
    quantities : dict or None
        Quantities of the motion by name, nondimensional, from the closed form of its flights: "impact_speed_max",
        "work_per_period", "displacement_rms" and others; nan where one is not defined. None for an undecided motion.
    quantities_error : dict or None
        For a chaotic motion: three standard errors of those of its quantities that are means, by name. They come from blocks
        of the impacts over which the quantities are measured. None for other motions, whose quantities are exact to rounding.

    Examples
    --------
    >>> from vibroimpact import Oscillator, settle
    >>> motion = settle(Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5))
    >>> motion
    <Motion 4/1, stable>
    >>> motion.cycle.velocity_before.round(4).tolist()
    [1.5131, 1.0992, 0.5139, 0.1792]
    """

    osc: Oscillator
    kind: str
    label: str
    impacts: int | None
    by_stop: bool
    impacts_upper: int | None
    impacts_lower: int | None
    periods: int | None
    sticks: int | None
    stable: bool | None
    stability: str | None
    multipliers: NDArray[np.complex128] | None
    cycle: Cycle
    rests: list[dict[str, Any]]
    residual: float | None
    lyapunov: tuple[float, float] | None
    seen_impacts: int | None
    chaotic_transient: tuple[int, tuple[float, float]] | None
    horizon: dict[str, Any] | None
    side: str | None
    tried: dict[str, Any] | None
    quantities: dict[str, float] | None
    quantities_error: dict[str, float] | None
    _told: str

    def __repr__(self) -> str:
        stability = "" if self.kind in ("chaotic", "stuck") or self.stability is None else f", {self.stability}"
        return f"<{type(self).__name__} {self.label}{stability}{self._remark()}>"

    @property
    def stop(self) -> str | None:
        """The stop of a stuck motion."""
        return self.side

    def _remark(self) -> str:
        return ""

    def to_dict(self) -> dict[str, Any]:
        """The object of the motion in the JSON of the command."""
        found: dict[str, Any] = json.loads(self._told)
        return found

    def _table(self) -> dict[str, Any]:
        """One row for each impact of the cycle."""
        return self.cycle._table()

    def start(self) -> tuple[float, float, float]:
        """A start on the motion: position, velocity and phase just after the first impact of its cycle."""
        if not len(self.cycle):
            raise _core.QuestionError(f"the motion {self.label} has no impacts to start from\nhint: simulate it from its start")
        first = (array[0] for array in (self.cycle.phase, self.cycle.velocity_before, self.cycle.side))
        phase, speed, sign = (float(number) for number in first)
        gap, restitution = self.osc.gap, self.osc.restitution
        if sign < 0:
            gap, restitution = self.osc.second_gap or 0.0, self.osc.second_restitution or 0.0
        return sign * gap, -sign * restitution * speed, phase

    def waveform(
        self, points_per_period: float = 200, periods: float | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Times, positions and velocities along the periodic motion, from just after its first impact.

        Parameters
        ----------
        points_per_period : float
            Number of points in each forcing period. Every impact has one point before and one after it in addition.
        periods : float
            Number of forcing periods; by default those of one period of the motion.
        """
        start = self.start()
        turns = self.periods or 1
        return _core.waveform(self.osc, start, (periods or turns) * self.osc.period, points_per_period)

    def plot(self, ax: "Axes | None" = None, *, si: bool = False) -> "Axes":
        """Draw the position over time along the periodic motion, with the stops. `si` selects metres and seconds."""
        from vibroimpact import _figure

        turns = self.periods or 1
        periods = turns * max(2, math.ceil(_SHOWN / turns))
        t, x, _ = self.waveform(periods=periods)
        ends = np.concatenate([[0.0], np.cumsum(np.tile(self.cycle.interval, periods // turns))])
        count = len(self.cycle)
        sides = np.concatenate([np.tile(self.cycle.side, periods // turns), self.cycle.side[:1]])
        if self.rests or count == 0:
            ends, sides = ends[:0], sides[:0]
        return _figure.waveform(self.osc, (t, x), (ends, sides), self.label, ax, si)


def fields_of(osc: Oscillator, fields: dict[str, Any]) -> dict[str, Any]:
    """The keyword arguments of a Motion, from the fields returned by the compiled module."""
    named = {name: None if fields[name] is None else dict(fields[name]) for name in ("quantities", "quantities_error")}
    kept = {name: value for name, value in fields.items() if name != "told"}
    return {**kept, "osc": osc, "_told": fields["told"], "cycle": Cycle(**fields["cycle"]), **named}
