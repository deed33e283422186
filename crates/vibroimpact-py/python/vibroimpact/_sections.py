"""Sections of an attractor: at impacts, and at phase 0 of the force."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import Oscillator, QuestionError
from vibroimpact._figure import ARRIVAL, heading, named
from vibroimpact._palette import SERIES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Number of colours of stops; the others of the series are too light, or black.
_USABLE = 6


def sections(of: Any, axes: Any) -> "NDArray[Any]":
    """Draw the phase and speed of closings of each stop, and the plane of each coordinate and its velocity at phase 0."""
    import matplotlib.pyplot as plt

    system = of.system
    oscillator = isinstance(system, Oscillator)
    names = [(r"$\xi$", "velocity $u$")] if oscillator else [(f"q.{name}", f"qdot.{name}") for name in system.coordinates]
    if axes is None:
        rows = -(-(len(names) + 1) // 2)
        figure, grid = plt.subplots(rows, 2, figsize=(10, 4.2 * rows), layout="constrained", squeeze=False)
        figure.suptitle(f"{heading(system)}: {named(of.motion.label)}")
        axes = grid.ravel()
        for ax in axes[len(names) + 1 :]:
            ax.remove()
    drawn = np.asarray(axes, dtype=object).ravel()[: len(names) + 1]
    if len(drawn) != len(names) + 1:
        raise QuestionError(f"{len(names) + 1} axes are needed, for the closings and for each coordinate, not {len(drawn)}")
    first = drawn[0]
    stops = [stop for stop in (("upper", "lower") if oscillator else system.stops) if (of.closings.stop == stop).any()]
    for k, stop in enumerate(stops):
        at = of.closings.stop == stop
        dots(first, of.closings.phase[at], of.closings.speed[at], color=SERIES[k % _USABLE], label=stop)
    first.set(xlabel=r"phase $\theta$", ylabel=ARRIVAL if oscillator else "speed of closing", title="closings of stops")
    if len(stops) > 1:
        dot_legend(first)
    for i, (ax, (abscissa, ordinate)) in enumerate(zip(drawn[1:], names)):
        dots(ax, of.strobes.q[:, i], of.strobes.qdot[:, i], color="black")
        ax.set(xlabel=abscissa, ylabel=ordinate, title="states at phase 0")
    for ax in drawn:
        room(ax)
    return drawn


def dots(ax: "Axes", xs: NDArray[np.float64], ys: NDArray[np.float64], **look: Any) -> None:
    """Draw points: large dots for few distinct points, small dots for many."""
    few = len(np.unique(np.round(np.stack([xs, ys]), 6), axis=1).T) <= 200
    ax.plot(xs, ys, "o", markersize=5 if few else 1, markeredgewidth=0, **look)


def dot_legend(ax: "Axes") -> None:
    """A legend of points. A dot of a cloud is too small for it, so it has large ones."""
    for handle in ax.legend(loc="best").get_lines():
        handle.set_markersize(5)


def room(ax: "Axes") -> None:
    """Set the range of an axis whose values are all equal to rounding."""
    box = ax.dataLim
    for low, high, limit in ((box.x0, box.x1, ax.set_xlim), (box.y0, box.y1, ax.set_ylim)):
        if np.isfinite(low) and high - low < 1e-6 * max(abs(low), abs(high), 1.0):
            limit(low - 0.5, low + 0.5)
