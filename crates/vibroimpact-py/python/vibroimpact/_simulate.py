"""Simulation of a motion event by event."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import Oscillator
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result
from vibroimpact._whole import SIMULATED, maybe

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Kinds of events by their code.
_KINDS = np.array(["impact", "graze", "stick", "release"])


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Simulation(Result):
    """The events of a motion as columns, and the reason why the list ends.

    Attributes
    ----------
    osc : Oscillator
        The system.
    start : (float or None, float, float)
        Position (None: at rest, or on the stop), velocity and phase of the start.
    time, phase : ndarray
        Time and phase of each event; phases in radians in [0, 2 pi).
    side : ndarray of int8
        +1 for the first stop, -1 for the second.
    velocity_before, velocity_after : ndarray
        For an impact: the velocities before and after it, positive towards the stop. Otherwise nan.
    depth : ndarray
        For a graze: the remaining distance to the stop, which is 0 within rounding.
    chatter : ndarray of bool
        For a stick: whether it is the end of a complete chatter.
    error : ndarray
        For a stick: the bound on the error of its time.
    end : str
        Why the list ends: "impact_limit", "time_limit", "no_more_impacts", "stuck" or "search_limit".
    end_time : float
        The time at which the list ends.
    horizon : dict or None
        Why there are no more impacts, if this is decided.
    plan : str
        The plan as JSON.
    """

    osc: Oscillator
    start: tuple[float | None, float, float]
    code: NDArray[np.uint8]
    time: NDArray[np.float64]
    phase: NDArray[np.float64]
    side: NDArray[np.int8]
    velocity_before: NDArray[np.float64]
    velocity_after: NDArray[np.float64]
    depth: NDArray[np.float64]
    chatter: NDArray[np.bool_]
    error: NDArray[np.float64]
    end: str
    end_time: float
    horizon: dict[str, Any] | None
    shown_until: float
    plan: str

    def __repr__(self) -> str:
        return f"<Simulation of {len(self)} events, ends with {self.end} at time {self.end_time:.6g}>"

    def __len__(self) -> int:
        return len(self.time)

    @property
    def kind(self) -> NDArray[np.str_]:
        """The kind of each event: "impact", "graze", "stick" or "release"."""
        return _KINDS[self.code]

    def waveform(
        self, points_per_period: float = 100
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Times, positions and velocities from the start to the end, with a point on each side of every event."""
        return _core.waveform(self.osc, self.start, self.shown_until, points_per_period)

    def plot(self, ax: "Axes | None" = None, *, si: bool = False) -> "Axes":
        """Draw the position over time, with the stops and the impacts. `si` selects metres and seconds."""
        from vibroimpact import _figure

        fine = max(240.0, 240.0 * self.osc.beta**-1) if self.osc.beta < 1 else 240.0
        points = min(fine, 400_000 * self.osc.period / max(self.shown_until, 1e-300))
        t, x, _ = self.waveform(max(points, 1.0))
        struck = self.code == 0
        return _figure.waveform(self.osc, (t, x), (self.time[struck], self.side[struck]), None, ax, si)

    def _table(self) -> dict[str, Any]:
        """One row for each event."""
        names = ("time", "phase", "side", "velocity_before", "velocity_after", "depth", "chatter", "error")
        return {"kind": self.kind, **{name: getattr(self, name) for name in names}}

def simulate(
    osc: Oscillator,
    *,
    x: float | None = None,
    v: float = 0.0,
    phase: float = 0.0,
    impacts: int | None = None,
    periods: float | None = None,
    progress: Progress = None,
) -> Simulation:
    """Follow a motion event by event: impacts, grazing contacts, sticking and release.

    Parameters
    ----------
    osc : Oscillator
        The system.
    x : float
        Position at the start, in units of F/k, not beyond a stop. Default: at rest, or on the stop.
    v : float
        Velocity at the start.
    phase : float
        Phase of the force at the start, radians.
    impacts : int
        Stop after this number of impacts, 1 to 1e7. Default: 100, or 1e6 with `periods`.
    periods : float
        Stop after this number of forcing periods, up to 1e9.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> from vibroimpact import Oscillator, simulate
    >>> sim = simulate(Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5), impacts=20)
    >>> sim.kind[:3].tolist(), sim.time[:3].round(4).tolist()
    (['impact', 'impact', 'impact'], [1.4598, 2.2409, 2.6025])
    >>> t, position, velocity = sim.waveform()
    >>> bool(position.max() <= 0.25 + 1e-12)
    True
    """
    start = (x, v, phase)
    limit = maybe("impacts", impacts, SIMULATED)
    with watched(progress, "impacts") as tell:
        fields = _core.simulate(osc, start, limit, periods, tell)
    return Simulation(osc=osc, start=start, end=fields.pop("reason"), **fields)
