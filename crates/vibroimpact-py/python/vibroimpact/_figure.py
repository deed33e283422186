"""Common parts of figures (axes, symbols, units), and the figures of one system: waveform, shares."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import Oscillator, QuestionError
from vibroimpact._palette import SERIES, class_colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

    from vibroimpact._waveform import Waveform

SYMBOLS = {
    "beta": r"\beta",
    "inverse_beta": r"1/\beta",
    "gap": r"\delta",
    "restitution": r"\varepsilon",
    "damping": r"\zeta",
    "second_gap": r"\delta_2",
    "second_restitution": r"\varepsilon_2",
}

#: Name of the speed before an impact.
ARRIVAL = r"arrival velocity $u_-$"
#: Width of axes in inches below which there is no room for a legend beside them, and how far below the axes it then begins.
_NARROW, _BELOW = 3.6, 0.42
#: Maximum number of impacts with a mark each; more marks would merge into a band.
_MARKED = 5000


class Scale:
    """The units of a figure, and the names of its axes in these units."""

    def __init__(self, osc: Oscillator, si: bool) -> None:
        self.si = si
        self.length = self.time = self.velocity = 1.0
        if si:
            if osc.units is None:
                raise QuestionError("si=True needs the system in physical units\nhint: Oscillator.from_units")
            self.length, self.time = osc.units.length_m, osc.units.time_s
            self.velocity = osc.units.velocity_m_per_s

    def named(self, name: str, unit: str) -> str:
        """A name with its unit, if the figure has units."""
        return f"{name} ({unit})" if self.si else name

    def of(self, parameter: str) -> float:
        """The unit of a parameter in the figure."""
        return self.length if parameter in ("gap", "second_gap") else 1.0

    def axis(self, parameter: str) -> str:
        """The symbol of a parameter with its unit."""
        of_machine = _core.machine_parameters()
        if parameter in of_machine:
            return of_machine[parameter]
        name = f"${SYMBOLS[parameter]}$"
        return self.named(name, "m") if parameter in ("gap", "second_gap") else name

    def line(self, parameter: str, ends: tuple[float, float], also: tuple[str, float, float] | None) -> str:
        """The name of an axis along a line: the first parameter, and the range of the second one."""
        second = also and (self.axis(also[0]), also[1] * self.of(also[0]), also[2] * self.of(also[0]))
        return along(self.axis(parameter), ends, second)


def along(name: str, ends: tuple[float, float], second: tuple[str, float, float] | None) -> str:
    """The name of an axis along a line: the first number, and the range of the second one."""
    if second is None:
        return name
    other, *values = second
    # the axis rises, in whichever direction the line was followed
    first, last = values if ends[0] <= ends[1] else reversed(values)
    return f"{name}, with {other} from {first:.6g} to {last:.6g}"


def new_axes(ax: "Axes | None", size: tuple[float, float]) -> "Axes":
    """The given axes, or those of a new figure."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=size, layout="constrained")[1]


def legend(ax: "Axes", handles: "list[Patch] | None" = None) -> None:
    """Add a legend where it covers nothing: to the right of the axes, or below them if they are as narrow as a column of text."""
    of = handles or ax.get_legend_handles_labels()[0]
    if not of:
        return
    # of one label once: several figures may be in these axes
    once: dict[str, Any] = {}
    for handle in of:
        once.setdefault(str(handle.get_label()), handle)
    if ax.get_position().width * ax.figure.get_figwidth() >= _NARROW:  # type: ignore[union-attr]
        ax.legend(handles=list(once.values()), loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, borderaxespad=0.0)
        return
    from matplotlib.transforms import ScaledTranslation

    below = ax.transAxes + ScaledTranslation(0, -_BELOW, ax.figure.dpi_scale_trans)
    ax.legend(handles=list(once.values()), loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=below, frameon=False,
              borderaxespad=0.0, ncols=2, fontsize="x-small", columnspacing=1.0, handlelength=1.5, handletextpad=0.5)


def equal(symbol: str, value: float) -> str:
    """Text for a parameter with one value."""
    return rf"{symbol} $= {_number(value)}$" if not symbol.endswith("$") else f"{symbol[:-1]} = {_number(value)}$"


def span(symbol: str, low: float, high: float) -> str:
    """Text for a parameter with a range of values."""
    return f"{symbol} from {low:.6g} to {high:.6g}"


def _number(value: float) -> str:
    text = f"{value:.6g}"
    mantissa, e, exponent = text.partition("e")
    return text if not e else rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def title(osc: Oscillator, without: tuple[str, ...] = ()) -> str:
    """The title: all parameters except those in `without`, which vary in the figure."""
    given = "inverse_beta" if "inverse_beta" in repr(osc) else "beta"
    values: dict[str, float] = {given: getattr(osc, given), "gap": osc.gap, "restitution": osc.restitution}
    if osc.damping > 0:
        values["damping"] = osc.damping
    if osc.second_gap is not None and osc.second_restitution is not None:
        values["second_gap"] = osc.second_gap
        if osc.second_restitution != osc.restitution or "restitution" in without:
            values["second_restitution"] = osc.second_restitution
    if {"beta", "inverse_beta"} & set(without):
        without = (*without, "beta", "inverse_beta")
    if any(name in _core.machine_parameters() for name in without):
        # a number of the machine may change each of these
        without = (*without, "beta", "inverse_beta", "gap", "damping", "second_gap")
    shown = (equal(f"${SYMBOLS[name]}$", value) for name, value in values.items() if name not in without)
    return ", ".join(shown)


def heading(system: Any, without: tuple[str, ...] = ()) -> str:
    """The title of a figure: the parameters of an oscillator except those in `without`, or the name of a machine."""
    if isinstance(system, Oscillator):
        return title(system, without)
    return str(system.title or "machine").split(": ")[0]


def axis_of(system: Any, name: str) -> str:
    """The name of the axis of a number: the symbol of a parameter of an oscillator, or the path of a number of a machine."""
    return Scale(system, False).axis(name) if isinstance(system, Oscillator) else name


def named(label: str) -> str:
    """The text of a label in a figure."""
    return "no impact" if label == "0" else label.replace("inf", "∞")


def walls(ax: "Axes", osc: Oscillator, unit: float, ys: NDArray[np.float64]) -> None:
    """Draw the stops near the motion, and set a range of the ordinate that shows them."""
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
    wave: "Waveform",
    impacts: tuple[NDArray[np.float64], NDArray[np.float64]],
    label: str | None,
    ax: "Axes | None",
    si: bool,
) -> "Axes":
    """Draw the position of an oscillator over time, with the stops and the impacts, whose times and positions are given."""
    scale = Scale(osc, si)
    ax = new_axes(ax, (9.5, 3.6))
    t, x = wave.time * scale.time, wave.q[:, 0] * scale.length
    ax.plot(t, x, color=SERIES[0], linewidth=1.5, label="position")
    times, at = impacts
    seen = times * scale.time <= t[-1] * (1 + 1e-12)
    if 0 < np.count_nonzero(seen) <= _MARKED:
        places = at[seen] * scale.length
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


def shares(heading: str, found: list[tuple[str, float]], ax: "Axes | None") -> "Axes":
    """Draw the shares of starts as bars, with the first on top, under a title."""
    ax = new_axes(ax, (6.4, 0.9 + 0.42 * len(found)))
    places = np.arange(len(found))
    ax.barh(
        places,
        [100 * share for _, share in found],
        color=[class_colour(label) for label, _ in found],
        edgecolor="black",
        linewidth=0.7,
    )
    ax.set_yticks(places, [named(label) for label, _ in found])
    ax.invert_yaxis()
    ax.set_xlim(0, 100)
    ax.set_xlabel("share of starts (%)")
    ax.set_title(heading)
    return ax
