"""Simulation of a motion event by event."""

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core, _machine_simulation
from vibroimpact._ask import MachineLike, Start, System
from vibroimpact._core import Oscillator
from vibroimpact._machine_simulation import MachineSimulation
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result
from vibroimpact._whole import SIMULATED, maybe

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Kinds of events by their code.
_KINDS = np.array(["impact", "graze", "stick", "release"])


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Simulation(Result):
    """The events of a motion of an oscillator as columns, and the reason why the list ends.

    Attributes
    ----------
    system : Oscillator
        The system.
    start : (float or None, float, float)
        Position (None: at rest, or on the stop), velocity and phase of the start.
    kind, stop : ndarray of str
        "impact", "graze", "stick" or "release"; "upper" or "lower".
    time, phase : ndarray
        Time and phase of each event; phases in radians in [0, 2 pi).
    speed : ndarray
        Speed of an impact before it; 0 at other events.
    q, qdot : ndarray, events x 1
        Position, and velocity after the event.
    depth : ndarray
        For a graze: the remaining distance to the stop, which is 0 within rounding. Otherwise nan.
    chatter : ndarray of bool
        For a stick: whether it is the end of a complete chatter.
    error : ndarray
        For a stick: the bound on the error of its time. Otherwise nan.
    end : str
        Why the list ends: "impact_limit", "time_limit", "no_more_impacts", "stuck" or "search_limit".
    end_time : float
        The time at which the list ends.
    horizon : dict or None
        Why there are no more impacts, if this is decided.
    plan : str
        The plan as JSON.
    """

    system: Oscillator
    start: tuple[float | None, float, float]
    code: NDArray[np.uint8]
    time: NDArray[np.float64]
    phase: NDArray[np.float64]
    side: NDArray[np.int8]
    speed: NDArray[np.float64]
    q: NDArray[np.float64]
    qdot: NDArray[np.float64]
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
        """The kind of each event."""
        return _KINDS[self.code]

    @property
    def stop(self) -> NDArray[np.str_]:
        """The stop of each event."""
        return np.where(self.side > 0, "upper", "lower")

    def waveform(
        self, points_per_period: float = 100
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Times, positions and velocities from the start to the end, with a point on each side of every event."""
        return _core.waveform(self.system, self.start, self.shown_until, points_per_period)

    def plot(self, ax: "Axes | None" = None, *, si: bool = False) -> "Axes":
        """Draw the position over time, with the stops and the impacts. `si` selects metres and seconds."""
        from vibroimpact import _figure

        fine = max(240.0, 240.0 * self.system.beta**-1) if self.system.beta < 1 else 240.0
        points = min(fine, 400_000 * self.system.period / max(self.shown_until, 1e-300))
        t, x, _ = self.waveform(max(points, 1.0))
        struck = self.code == 0
        return _figure.waveform(self.system, (t, x), (self.time[struck], self.q[struck, 0]), None, ax, si)

    def _table(self) -> dict[str, Any]:
        """One row for each event."""
        names = ("kind", "stop", "time", "phase", "speed")
        columns = {name: getattr(self, name) for name in names} | {"x": self.q[:, 0], "v": self.qdot[:, 0]}
        return columns | {name: getattr(self, name) for name in ("depth", "chatter", "error")}


@overload
def simulate(
    system: Oscillator, *, x: float | None = None, v: float | None = None, phase: float | None = None,
    impacts: int | None = None, periods: float | None = None, progress: Progress = None,
) -> Simulation: ...


@overload
def simulate(
    system: MachineLike, *, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
    impacts: int | None = None, periods: float | None = None, progress: Progress = None,
) -> MachineSimulation: ...


def simulate(
    system: System,
    *,
    x: float | None = None,
    v: float | None = None,
    q: ArrayLike | None = None,
    qdot: ArrayLike | None = None,
    phase: float | None = None,
    impacts: int | None = None,
    periods: float | None = None,
    progress: Progress = None,
) -> Simulation | MachineSimulation:
    """Follow a motion event by event: impacts, grazing contacts, sticking and release, contact and slip.

    Parameters
    ----------
    system : Oscillator or Machine
        The system.
    x, v, phase : float
        Start of an oscillator: position in units of F/k, not beyond a stop (default: at rest, or on the stop), velocity, phase of the
        force in radians.
    q, qdot, phase : array, array, float
        Start of a machine: coordinates, velocities and phase. Default: those of its `start`, or 0.
    impacts : int
        Stop after this number of impacts, of a machine of events, 1 to 1e7. Default: 100, or 1e6 with `periods`.
    periods : float
        Stop after this number of forcing periods, up to 1e9.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> sim = vi.simulate(vi.Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5), impacts=20)
    >>> sim.kind[:3].tolist(), sim.time[:3].round(4).tolist()
    (['impact', 'impact', 'impact'], [1.4598, 2.2409, 2.6025])
    >>> t, position, velocity = sim.waveform()
    >>> bool(position.max() <= 0.25 + 1e-12)
    True
    >>> motion = vi.Machine.named("sdnd101").simulate(impacts=2)
    >>> motion.kind.tolist(), motion.time.round(6).tolist()
    (['close', 'open'], [0.0, 0.03126])
    >>> wave = motion.waveform(1e-4)
    >>> float(wave.force[:, 0].max().round())          # 9950.37 N in closed form
    9950.0
    """
    limit = maybe("impacts", impacts, SIMULATED)
    of = Start(system, x, v, q, qdot, phase)
    if not isinstance(system, Oscillator):
        return _machine_simulation.simulate(system, of.of_machine or ([], [], 0.0), limit, periods, progress)
    start = (x, v or 0.0, phase or 0.0)
    with watched(progress, "impacts") as tell:
        fields = _core.simulate(system, start, limit, periods, tell)
    horizon = fields.pop("horizon")
    return Simulation(
        system=system, start=start, end=fields.pop("reason"), horizon=horizon and json.loads(horizon), **fields
    )
