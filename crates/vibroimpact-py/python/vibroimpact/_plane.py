"""A plane of two parameters in a figure, and polylines in it."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._figure import axis_of, heading, legend

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Range = tuple[float, float]


def frame(ax: "Axes", system: Any, parameters: tuple[str, str], ranges: tuple[Range, Range]) -> None:
    """Set the ranges of the axes, and write their labels, the title and the legend."""
    (p, q), (across, up) = parameters, ranges
    ax.set_xlim(*across)
    ax.set_ylim(*up)
    ax.set_xlabel(axis_of(system, p))
    ax.set_ylabel(axis_of(system, q))
    ax.set_title(heading(system, (p, q)))
    legend(ax)


def broken(values: NDArray[np.float64], drawn: NDArray[np.bool_]) -> tuple[list[float], list[float]]:
    """The coordinates of the steps of a polyline that are drawn; nan separates parts."""
    rows: list[NDArray[np.float64]] = []
    for k, draw in enumerate(drawn):
        if draw:
            if k == 0 or not drawn[k - 1]:
                rows += [np.full(2, np.nan), values[k]]
            rows.append(values[k + 1])
    return [float(row[0]) for row in rows], [float(row[1]) for row in rows]
