"""The figure of Lyapunov exponents with their error bars."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from vibroimpact._core import QuestionError
from vibroimpact._figure import legend, new_axes
from vibroimpact._palette import SERIES

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot(found: Sequence[tuple[float, float]], exact: bool, heading: str, ax: "Axes | None") -> "Axes":
    """Draw exponents, each with its error, under a title. Those that are infinite or undefined have no point."""
    values, errors = np.array(found, dtype=np.float64).reshape(-1, 2).T
    known = np.isfinite(values)
    if not known.any():
        raise QuestionError("there are no finite exponents to draw")
    ax = new_axes(ax, (6.4, 3.6))
    places = np.arange(1, len(values) + 1)
    ax.axhline(0, color="0.6", linewidth=0.8)
    ax.errorbar(places[known], values[known], np.nan_to_num(errors[known]), fmt="o", color=SERIES[0], capsize=4,
                label="exact" if exact else "three standard errors")
    ax.set_xticks(places)
    ax.set_xlim(0.5, len(values) + 0.5)
    ax.set_xlabel("number of the exponent")
    ax.set_ylabel("exponent per unit of time")
    ax.set_title(heading)
    legend(ax)
    return ax
