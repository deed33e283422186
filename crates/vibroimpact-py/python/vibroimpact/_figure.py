"""Common parts of figures: axes, symbols, legends and titles."""

import re
from typing import TYPE_CHECKING, Any

from vibroimpact import _core
from vibroimpact._oscillator import Oscillator

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

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
#: Number of entries above which a narrow legend has three columns.
_MANY = 6
_TOKENS = re.compile(r"\\(.)|(\*\*)|(\*)|([_^])(?:\{([^}]*)\}|(.))|([^\\*_^]+)")


def new_axes(ax: "Axes | None", size: tuple[float, float]) -> "Axes":
    """The given axes, or those of a new figure."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=size, layout="constrained")[1]


def name_axes(ax: "Axes", x: str | None = None, y: str | None = None, title: str | None = None) -> None:
    """Name the axes and set the title, in several lines where one is too long."""
    for name, text in (("xlabel", x), ("ylabel", y), ("title", title)):
        if text is not None:
            ax.set(**{name: text})
    for of in (ax.xaxis.label, ax.yaxis.label, ax.title):
        of.set_wrap(True)


def legend(ax: "Axes", handles: "list[Patch] | None" = None, *, below: str | None = None) -> None:
    """Add a legend where it covers nothing: to the right of the axes, or below them if they are as narrow as a column of text, or if
    there is a colour bar; then it has the title `below`."""
    of = handles if handles is not None else ax.get_legend_handles_labels()[0]
    if not of and not below:
        return
    # of one label once: several figures may be in these axes
    once = {str(handle.get_label()): handle for handle in reversed(of)}
    shown = list(reversed(once.values()))
    narrow = ax.get_position().width * ax.figure.get_figwidth() < _NARROW  # type: ignore[union-attr]
    if below is None and not narrow:
        ax.legend(handles=shown, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, borderaxespad=0.0)
        return
    from matplotlib.transforms import ScaledTranslation

    columns = {"ncols": 3 if len(shown) > _MANY else 2, "columnspacing": 1.0, "handlelength": 1.5, "handletextpad": 0.5}
    place = ax.transAxes + ScaledTranslation(0, -_BELOW, ax.figure.dpi_scale_trans)
    small = "x-small" if narrow else "small"
    ax.legend(handles=shown, title=below or None, loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=place, frameon=False,
              borderaxespad=0.0, fontsize=small, title_fontsize=small, **(columns if narrow else {"ncols": max(len(shown), 1)}))


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


def mathtext(markup: str) -> str:
    """A label with `*italics*`, `_sub` and `^super` scripts as matplotlib writes it."""
    text, italic = "", False
    for escaped, _, star, script, group, one, plain in _TOKENS.findall(markup):
        part = (escaped or plain).replace("$", r"\$")
        if star:
            italic = not italic
        elif script:
            text += f"${script}{{{group or one}}}$"
        else:
            text += f"${part}$" if italic else part
    return text.replace("$$", "")


def heading(system: Any) -> str:
    """The title of a figure: the parameters of an oscillator, or the name of a machine."""
    if isinstance(system, Oscillator):
        return mathtext(_core.title_of(system._file))
    return str(system.title or "machine").split(": ")[0]


def named(label: str) -> str:
    """The text of a label in a figure."""
    return "no impact" if label == "0" else label.replace("inf", "∞")
