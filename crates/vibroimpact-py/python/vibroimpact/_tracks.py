"""The bifurcation diagram of a branch: a curve for each impact, followed from point to point."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import Oscillator
from vibroimpact._figure import ARRIVAL, Scale, legend, named, new_axes, title
from vibroimpact._palette import SERIES
from vibroimpact._tables import BRANCH_MARKS

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


class Event(Protocol):
    """What a figure needs of an event of a branch."""

    @property
    def kind(self) -> str: ...
    @property
    def parameter(self) -> float: ...
    @property
    def point(self) -> int: ...


class Impacts(Protocol):
    """What a figure needs of the impacts of a cycle."""

    def __len__(self) -> int: ...
    @property
    def phase(self) -> NDArray[np.float64]: ...
    @property
    def velocity_before(self) -> NDArray[np.float64]: ...


class Cycles(Protocol):
    """The impacts at each point of a branch."""

    def __iter__(self) -> Iterator[Impacts]: ...
    def __getitem__(self, k: int, /) -> Impacts: ...


class Curves(Protocol):
    """What the curves of a branch need, of an oscillator or of a machine."""

    def __len__(self) -> int: ...
    @property
    def parameter(self) -> NDArray[np.float64]: ...
    @property
    def label(self) -> Sequence[str]: ...
    @property
    def physical(self) -> NDArray[np.bool_]: ...
    @property
    def stability(self) -> NDArray[np.str_]: ...
    @property
    def cycles(self) -> "Cycles": ...
    @property
    def events(self) -> Sequence[Event]: ...


class Followed(Curves, Protocol):
    """What a figure needs of a branch of an oscillator."""

    @property
    def osc(self) -> Oscillator: ...
    @property
    def vary(self) -> str: ...
    @property
    def ends(self) -> tuple[float, float]: ...
    @property
    def also(self) -> tuple[str, float, float] | None: ...
    @property
    def followed(self) -> "Sequence[Followed]": ...


#: Number of values of the orbit diagram behind a branch.
VALUES = 401
#: Maximum number of labels with a colour of their own.
_NAMED = 12
LOOKS = {"stable": "-", "neutral": "-.", "unstable": "--", "inadmissible": ":"}


def plot(branch: Followed, ax: "Axes | None", diagram: "xr.Dataset | None", virtual: bool, si: bool) -> "Axes":
    """Draw the speeds before impacts over the parameter: solid if stable, dashed and dotted if neutral, dashed if unstable. `diagram` is the orbit diagram
    behind."""
    scale = Scale(branch.osc, si)
    unit, speed = scale.of(branch.vary), scale.velocity
    ax = new_axes(ax, (7.6, 4.8))
    if diagram is not None:
        _behind(diagram, branch.vary, ax, unit, speed)
    draw([branch, *branch.followed], ax, virtual, unit, speed)
    low, high = sorted(branch.ends)
    ax.set_xlim(low * unit, high * unit)
    ax.set_xlabel(scale.line(branch.vary, branch.ends, branch.also))
    ax.set_ylabel(scale.named(ARRIVAL, "m/s"))
    ax.set_title(title(branch.osc, (branch.vary, *(branch.also or ())[:1])))
    legend(ax)
    return ax


def draw(branches: "Sequence[Curves]", ax: "Axes", virtual: bool = False, unit: float = 1.0, speed: float = 1.0) -> None:
    """Draw the speeds of all impacts of branches, and their events."""
    colours: dict[str, tuple[str, float]] = {}
    looks: list[str] = []
    for one in branches:
        for label, look, xs, ys in pieces(one):
            if look == "inadmissible" and not virtual:
                continue
            colour, alpha = colours.setdefault(label, _colour(len(colours)))
            if look not in looks:
                looks.append(look)
            width = 1.0 if look == "inadmissible" else 1.8
            ax.plot(xs * unit, ys * speed, LOOKS[look], color=colour, alpha=alpha, linewidth=width)
    for label, (colour, alpha) in list(colours.items())[:_NAMED]:
        ax.plot([], [], color=colour, alpha=alpha, linewidth=1.8, label=named(label))
    for look in (look for look in LOOKS if look in looks):
        ax.plot([], [], LOOKS[look], color="black", label=look)
    _events(branches, ax, virtual, unit, speed)


def _colour(k: int) -> tuple[str, float]:
    # without black, which is used for marks, and yellow, which is too light for a thin line
    return (SERIES[k % 6], 1.0 if k < 6 else 0.55) if k < _NAMED else ("0.3", 1.0)


def behind(
    ax: "Axes", xs: NDArray[np.float64], ys: NDArray[np.float64], repeats: NDArray[np.bool_]
) -> None:
    """Draw the speeds of an orbit diagram from simulation in grey; `repeats` are those of motions that repeat."""
    # the dots of motions that repeat are wider than a curve
    for at, size in ((repeats, 4.5), (~repeats, 1.6)):
        ax.plot(xs[at], ys[at], "o", color="0.72", markersize=size, markeredgewidth=0, zorder=0)
    ax.plot([], [], "o", color="0.72", markersize=4, label="simulation")


def _behind(ds: "xr.Dataset", vary: str, ax: "Axes", unit: float, speed: float) -> None:
    ys = ds["velocity"].transpose("sweep", vary, "point").values
    xs = np.broadcast_to(ds[vary].values[:, None], ys.shape)
    repeats = np.isfinite(ys).sum(axis=-1, keepdims=True) < ys.shape[-1]
    there = np.isfinite(ys)
    behind(ax, xs[there] * unit, ys[there] * speed, np.broadcast_to(repeats, ys.shape)[there])


def _events(branches: "Sequence[Curves]", ax: "Axes", virtual: bool, unit: float, speed: float) -> None:
    places: dict[str, list[tuple[float, float]]] = {}
    for one in branches:
        for event in one.events:
            if event.kind not in BRANCH_MARKS or not (virtual or one.physical[event.point]):
                continue
            _, at_zero = BRANCH_MARKS[event.kind]
            speeds = [0.0] if at_zero else one.cycles[event.point].velocity_before.tolist()
            places.setdefault(event.kind, []).extend((event.parameter, u) for u in speeds)
    for kind in sorted(places):
        xs, ys = np.array(places[kind]).reshape(-1, 2).T
        ax.plot(xs * unit, ys * speed, BRANCH_MARKS[kind][0], color="white", markeredgecolor="black", markersize=6, label=kind,
                zorder=4, clip_on=False)


def pieces(branch: Curves) -> Iterator[tuple[str, str, NDArray[np.float64], NDArray[np.float64]]]:
    """Curves of one impact with one label and one line style. Consecutive curves share a point."""
    begin = 0
    # cycles with one label may have different numbers of impacts, if they stick
    key = [(label, len(cycle)) for label, cycle in zip(branch.label, branch.cycles)]
    while begin < len(branch):
        label = branch.label[begin]
        end = next((k for k in range(begin, len(branch)) if key[k] != key[begin]), len(branch))
        for track in _tracks([branch.cycles[k] for k in range(begin, end)]):
            for look, at in _runs(branch, begin, end):
                yield label, look, branch.parameter[at], track[at.start - begin : at.stop - begin]
        begin = end


def _runs(branch: Curves, begin: int, end: int) -> Iterator[tuple[str, slice]]:
    """Ranges of points with one line style. A step takes its style from the end that is no event."""
    events = {event.point for event in branch.events}
    before, first = None, begin
    for k in range(begin, end - 1):
        at = k if k + 1 in events and k not in events else k + 1
        look = str(branch.stability[at]) if branch.physical[at] else "inadmissible"
        if before is not None and look != before:
            yield before, slice(first, k + 1)
            first = k
        before = look
    if before is not None:
        yield before, slice(first, end)


def _tracks(run: list[Impacts]) -> NDArray[np.float64]:
    """The speed of each impact at consecutive points with one label, one row for each impact."""
    count = len(run[0])
    rows = np.zeros((len(run), max(count, 1)))
    before: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None
    for k, cycle in enumerate(run):
        if count == 0:
            continue
        phases, speeds = cycle.phase, cycle.velocity_before
        if before is not None:
            # a list begins with the fastest impact, which may change along the branch: choose the shift closest to the point before
            off = [
                np.sum(_apart(np.roll(phases, -s), before[0]) ** 2 + (np.roll(speeds, -s) - before[1]) ** 2)
                for s in range(count)
            ]
            shift = -int(np.argmin(off))
            phases, speeds = np.roll(phases, shift), np.roll(speeds, shift)
        rows[k] = speeds
        before = phases, speeds
    matrix: NDArray[np.float64] = rows.T
    return matrix


def _apart(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Differences of angles a - b, in [-pi, pi)."""
    return (a - b + np.pi) % (2 * np.pi) - np.pi
