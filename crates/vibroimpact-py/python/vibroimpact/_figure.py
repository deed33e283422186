"""What figures share: axes, symbols, units; and those of one motion: waveform, shares, sections."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import Oscillator, QuestionError
from vibroimpact._palette import CLASSES, SERIES, legend_group

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

    from vibroimpact._lyapunov import Impacts, Strobes

SYMBOLS = {
    "beta": r"\beta",
    "inverse_beta": r"1/\beta",
    "gap": r"\delta",
    "restitution": r"\varepsilon",
    "damping": r"\zeta",
    "second_gap": r"\delta_2",
    "second_restitution": r"\varepsilon_2",
}

#: Speed of arrival.
ARRIVAL = r"arrival velocity $u_-$"
#: Impacts marked one by one; more would be a band.
_MARKED = 5000


class Scale:
    """One unit of results, and how axes name it."""

    def __init__(self, osc: Oscillator, si: bool) -> None:
        self.si = si
        self.length = self.time = self.velocity = 1.0
        if si:
            if osc.units is None:
                raise QuestionError("si=True needs the system in physical units\nhint: Oscillator.from_units")
            self.length, self.time = osc.units.length_m, osc.units.time_s
            self.velocity = osc.units.velocity_m_per_s

    def named(self, name: str, unit: str) -> str:
        """A name with its unit, where there is one."""
        return f"{name} ({unit})" if self.si else name

    def of(self, parameter: str) -> float:
        """One unit of a parameter."""
        return self.length if parameter in ("gap", "second_gap") else 1.0

    def axis(self, parameter: str) -> str:
        """A parameter's symbol with its unit."""
        name = f"${SYMBOLS[parameter]}$"
        return self.named(name, "m") if parameter in ("gap", "second_gap") else name

    def line(self, parameter: str, ends: tuple[float, float], also: tuple[str, float, float] | None) -> str:
        """What an axis along a line shows: its first parameter, and from where to where the second one goes with it."""
        if also is None:
            return self.axis(parameter)
        name, *values = also
        # an axis rises, whichever way the line was drawn
        first, last = values if ends[0] <= ends[1] else reversed(values)
        unit = self.of(name)
        return f"{self.axis(parameter)}, with {self.axis(name)} from {first * unit:.6g} to {last * unit:.6g}"


def new_axes(ax: "Axes | None", size: tuple[float, float]) -> "Axes":
    """The axes given, or those of a new figure."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=size, layout="constrained")[1]


def legend(ax: "Axes", handles: "list[Patch] | None" = None) -> None:
    """A legend to the right of the axes, where it hides nothing."""
    handles_of_axes = ax.get_legend_handles_labels()[0]
    if handles or handles_of_axes:
        of = handles or handles_of_axes
        ax.legend(handles=of, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, borderaxespad=0.0)


def equal(symbol: str, value: float) -> str:
    """A parameter and its value."""
    return rf"{symbol} $= {_number(value)}$" if not symbol.endswith("$") else f"{symbol[:-1]} = {_number(value)}$"


def span(symbol: str, low: float, high: float) -> str:
    """A parameter that has several values."""
    return f"{symbol} from {low:.6g} to {high:.6g}"


def _number(value: float) -> str:
    text = f"{value:.6g}"
    mantissa, e, exponent = text.partition("e")
    return text if not e else rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def title(osc: Oscillator, without: tuple[str, ...] = ()) -> str:
    """The parameters, without those that vary in the figure."""
    given = "inverse_beta" if "inverse_beta" in repr(osc) else "beta"
    values: dict[str, float] = {given: getattr(osc, given), "gap": osc.gap, "restitution": osc.restitution}
    if osc.damping > 0:
        values["damping"] = osc.damping
    if osc.second_gap is not None and osc.second_restitution is not None:
        values["second_gap"] = osc.second_gap
        if osc.second_restitution != osc.restitution or "restitution" in without:
            values["second_restitution"] = osc.second_restitution
    if {"beta", "inverse_beta"} & set(without):
        del values[given]
    shown = (equal(f"${SYMBOLS[name]}$", value) for name, value in values.items() if name not in without)
    return ", ".join(shown)


def named(label: str) -> str:
    """A label as a figure shows it."""
    return "no impact" if label == "0" else label.replace("inf", "∞")


def walls(ax: "Axes", osc: Oscillator, unit: float, ys: NDArray[np.float64]) -> None:
    """The stops that the motion comes near, and a range that shows them."""
    low, high = float(np.min(ys)), float(np.max(ys))
    size = max(high - low, 1e-12)
    stops = [(osc.gap * unit, 1.0)] + ([] if osc.second_gap is None else [(-osc.second_gap * unit, -1.0)])
    near = [(at, sign) for at, sign in stops if low - size <= at <= high + size]
    low, high = min([low, *(at for at, _ in near)]), max([high, *(at for at, _ in near)])
    air = 0.08 * (high - low) if high > low else 0.5
    for k, (at, sign) in enumerate(near):
        ax.axhline(at, color="0.4", linewidth=1)
        ax.axhspan(at, at + 10 * sign * (high - low + air), facecolor="0.9", edgecolor="0.6", hatch="///", linewidth=0,
                   label="stop" if k == 0 else None, zorder=0)
    ax.set_ylim(low - air, high + air)


def waveform(
    osc: Oscillator,
    wave: tuple[NDArray[np.float64], NDArray[np.float64]],
    impacts: tuple[NDArray[np.float64], NDArray[np.int8]],
    label: str | None,
    ax: "Axes | None",
    si: bool,
) -> "Axes":
    """Position over time, with the stops and the impacts."""
    scale = Scale(osc, si)
    ax = new_axes(ax, (9.5, 3.6))
    t, x = wave[0] * scale.time, wave[1] * scale.length
    ax.plot(t, x, color=SERIES[0], linewidth=1.5, label="position")
    times, sides = impacts
    seen = times * scale.time <= t[-1] * (1 + 1e-12)
    if 0 < np.count_nonzero(seen) <= _MARKED:
        lower = 0.0 if osc.second_gap is None else -osc.second_gap
        places = np.where(sides[seen] > 0, osc.gap, lower) * scale.length
        size = 3 if np.count_nonzero(seen) > 60 else 6
        ax.plot(times[seen] * scale.time, places, "o", color=SERIES[1], markersize=size, markeredgecolor="white",
                markeredgewidth=0.7, label="impact", zorder=3)
    walls(ax, osc, scale.length, x)
    ax.set_xlim(t[0], t[-1])
    ax.set_xlabel(scale.named(r"time $\tau$" if not si else "time", "s"))
    ax.set_ylabel(scale.named(r"$\xi$" if not si else "$x$", "m"))
    ax.set_title(title(osc) + ("" if label is None else f": {named(label)}"))
    legend(ax)
    return ax


def shares(osc: Oscillator, found: list[tuple[str, float]], ax: "Axes | None") -> "Axes":
    """Shares of starts as bars, the largest on top."""
    ax = new_axes(ax, (6.4, 0.9 + 0.42 * len(found)))
    places = np.arange(len(found))
    ax.barh(
        places,
        [100 * share for _, share in found],
        color=[CLASSES[legend_group(label)] for label, _ in found],
        edgecolor="black",
        linewidth=0.7,
    )
    ax.set_yticks(places, [named(label) for label, _ in found])
    ax.invert_yaxis()
    ax.set_xlim(0, 100)
    ax.set_xlabel("share of starts (%)")
    ax.set_title(title(osc))
    return ax


def sections(
    osc: Oscillator, impacts: "Impacts", strobes: "Strobes", axes: "tuple[Axes, Axes] | None"
) -> "tuple[Axes, Axes]":
    """Both sections of an attractor, side by side."""
    if axes is None:
        import matplotlib.pyplot as plt

        figure, pair = plt.subplots(1, 2, figsize=(10, 4.4), layout="constrained")
        figure.suptitle(title(osc))
        axes = (pair[0], pair[1])
    left, right = axes
    for sign, colour, name in ((1, SERIES[0], "stop"), (-1, SERIES[1], "second stop")):
        at = impacts.side == sign
        if np.any(at):
            _dots(left, impacts.phase[at], impacts.velocity_before[at], color=colour, label=name)
    left.set_xlabel(r"phase $\theta$")
    left.set_ylabel(ARRIVAL)
    left.set_title("impacts")
    if osc.second_gap is not None:
        left.legend(loc="best")
    _dots(right, strobes.x, strobes.v, color="black")
    right.set_xlabel(r"$\xi$")
    right.set_ylabel("velocity $u$")
    right.set_title("states at phase 0")
    _room(left)
    _room(right)
    return left, right


def _dots(ax: "Axes", xs: NDArray[np.float64], ys: NDArray[np.float64], **look: Any) -> None:
    """A cloud of small dots, or a few large ones."""
    few = len(np.unique(np.round(np.stack([xs, ys]), 6), axis=1).T) <= 200
    ax.plot(xs, ys, "o", markersize=5 if few else 1, markeredgewidth=0, **look)


def _room(ax: "Axes") -> None:
    """A range of its own for what is one value to rounding."""
    box = ax.dataLim
    for low, high, limit in ((box.x0, box.x1, ax.set_xlim), (box.y0, box.y1, ax.set_ylim)):
        if np.isfinite(low) and high - low < 1e-6 * max(abs(low), abs(high), 1.0):
            limit(low - 0.5, low + 0.5)
