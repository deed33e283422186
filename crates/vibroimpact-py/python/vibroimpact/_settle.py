"""Settling of motions, from one start or from arrays of starts."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._attractors import Attractor
from vibroimpact._axis import numbers
from vibroimpact._core import Oscillator
from vibroimpact._motion import Motion, fields_of
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import BUDGET, THREADS, maybe, whole


def settle(
    osc: Oscillator, *, x: float | None = None, v: float = 0.0, phase: float = 0.0, impacts: int | None = None
) -> Motion:
    """Follow the motion from a start until it has settled, and confirm the result.

    Parameters
    ----------
    osc : Oscillator
        The system.
    x : float
        Position at the start, in units of F/k. Default: at rest, or on the stop.
    v, phase : float
        Velocity, and phase of the force in radians, at the start.
    impacts : int
        Budget of impacts, 1 to 1 000 000. A motion that has not settled by then is undecided. Default: 20 000.

    Examples
    --------
    >>> from vibroimpact import Oscillator, settle
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> settle(osc), settle(osc, x=-2)
    (<Motion 2/1, stable>, <Motion 1/1, stable>)
    """
    fields, _ = _core.settle(osc, (x, v, phase), maybe("impacts", impacts, BUDGET))
    return Motion(**fields_of(osc, fields))


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Settlement:
    """The motions to which many starts lead.

    Attributes
    ----------
    osc : Oscillator
        The system.
    motions : list of Attractor
        The distinct motions in the order of their first start, with their shares.
    cells : ndarray of uint32
        The motion of each start as an index into `motions`, in the shape of the starts.
    """

    osc: Oscillator
    motions: list[Attractor]
    cells: NDArray[np.uint32]

    def __repr__(self) -> str:
        return f"<Settlement of {self.cells.size} starts: {', '.join(m.label for m in self.motions)}>"

    @property
    def labels(self) -> NDArray[np.str_]:
        """The label of the motion of each start, in the shape of the starts."""
        names = np.array([motion.label for motion in self.motions], dtype=np.str_)
        return names[self.cells]


def settle_many(
    osc: Oscillator,
    x: ArrayLike,
    v: ArrayLike = 0.0,
    phase: ArrayLike = 0.0,
    *,
    threads: int = 0,
    progress: Progress = None,
) -> Settlement:
    """Follow the motions from many starts until they have settled.

    Arrays of doubles are not copied; other arrays are converted. The result does not depend on the number of threads.

    Parameters
    ----------
    osc : Oscillator
        The system.
    x, v, phase : array_like
        Positions, velocities and phases, broadcast to one shape.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Examples
    --------
    >>> import numpy as np
    >>> from vibroimpact import Oscillator, settle_many
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> found = settle_many(osc, np.linspace(-4, 0.75, 5), 0.0)
    >>> found.labels.tolist()
    ['1/1', '1/1', '1/1', '1/1', '2/1']
    """
    columns = [numbers(name, of) for name, of in (("x", x), ("v", v), ("phase", phase))]
    shape = np.broadcast_shapes(*(column.shape for column in columns))
    size = int(np.prod(shape))
    # the compiled module accepts one number or a full column; only partly broadcast arrays must be expanded
    flat = [
        column.reshape(-1)
        if column.size in (1, size) and (column.size == 1 or column.shape == shape)
        else np.ascontiguousarray(np.broadcast_to(column, shape)).reshape(-1)
        for column in columns
    ]
    if size > 0 and all(column.size == 1 for column in flat):
        flat[0] = np.ascontiguousarray(np.broadcast_to(flat[0], (size,)))
    threads = whole("threads", threads, THREADS)
    with watched(progress, "starts") as tell:
        found, cells = _core.settle_many(osc, flat[0], flat[1], flat[2], threads, tell)
    motions = [
        Attractor(**fields_of(osc, fields), share=count / max(size, 1), count=count) for fields, count in found
    ]
    return Settlement(osc, motions, cells.reshape(shape))
