"""Sections of an attractor: at impacts, and at phase 0 of the force."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import Oscillator
from vibroimpact._figure import ARRIVAL, title
from vibroimpact._palette import SERIES

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Impacts(NamedTuple):
    """The section of the attractor at impacts: phase, speed before the impact and stop (+1 first, -1 second)."""

    phase: NDArray[np.float64]
    velocity_before: NDArray[np.float64]
    side: NDArray[np.int8]


class Strobes(NamedTuple):
    """The stroboscopic section: states at phase 0 of the force."""

    x: NDArray[np.float64]
    v: NDArray[np.float64]


def sections(
    osc: Oscillator, impacts: Impacts, strobes: Strobes, axes: "tuple[Axes, Axes] | None"
) -> "tuple[Axes, Axes]":
    """Draw both sections of an attractor side by side."""
    if axes is None:
        import matplotlib.pyplot as plt

        figure, pair = plt.subplots(1, 2, figsize=(10, 4.4), layout="constrained")
        figure.suptitle(title(osc))
        axes = (pair[0], pair[1])
    left, right = axes
    for sign, colour, name in ((1, SERIES[0], "stop"), (-1, SERIES[1], "second stop")):
        at = impacts.side == sign
        if np.any(at):
            dots(left, impacts.phase[at], impacts.velocity_before[at], color=colour, label=name)
    left.set_xlabel(r"phase $\theta$")
    left.set_ylabel(ARRIVAL)
    left.set_title("impacts")
    if osc.second_gap is not None:
        dot_legend(left)
    dots(right, strobes.x, strobes.v, color="black")
    right.set_xlabel(r"$\xi$")
    right.set_ylabel("velocity $u$")
    right.set_title("states at phase 0")
    room(left)
    room(right)
    return left, right


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
