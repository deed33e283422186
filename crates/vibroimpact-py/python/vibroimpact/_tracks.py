"""The bifurcation diagram of a branch: a curve for each impact, followed from point to point."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import Oscillator, QuestionError
from vibroimpact._figure import ARRIVAL, Scale, along, heading, legend, named, new_axes
from vibroimpact._palette import class_colour, variant
from vibroimpact._tables import BRANCH_MARKS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Number of values of the orbit diagram behind a branch.
VALUES = 401
#: Maximum number of labels in a legend.
_NAMED = 12
LOOKS = {"stable": "-", "neutral": "-.", "unstable": "--", "inadmissible": ":"}


def plot(
    branch: Any, ax: "Axes | None",
    behind: "tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]] | None", inadmissible: bool, si: bool,
) -> "Axes":
    """Draw the speeds of closings, or the quantity of a machine without stops, over the number that varies: solid if stable, dashed
    and dotted if neutral, dashed if unstable. `behind` are the points of the orbit diagram."""
    if isinstance(branch.system, Oscillator):
        scale = Scale(branch.system, si)
        unit, speed = scale.of(branch.vary), scale.velocity
        abscissa, ordinate = scale.line(branch.vary, branch.ends, branch.also), scale.named(ARRIVAL, "m/s")
    elif si:
        raise QuestionError("si=True is for an oscillator in physical units; a machine has its own units")
    else:
        unit = speed = 1.0
        abscissa, ordinate = along(branch.vary, branch.ends, branch.also), branch.quantity or "speed of closing"
    ax = new_axes(ax, (7.6, 4.8))
    if behind is not None:
        _behind(ax, behind[0] * unit, behind[1] * speed, behind[2])
    draw([_Drawn(of) for of in (branch, *branch.followed)], ax, inadmissible, unit, speed)
    low, high = sorted(branch.ends)
    ax.set_xlim(low * unit, high * unit)
    ax.set_xlabel(abscissa)
    ax.set_ylabel(ordinate)
    ax.set_title(heading(branch.system, (branch.vary, *(branch.also or ())[:1])))
    legend(ax)
    return ax


class _Drawn:
    """A branch with what is drawn at each point: phases and speeds of the closings of the cycle, or one value of a quantity."""

    def __init__(self, of: Any) -> None:
        self.of, self.events = of, of.events
        if of.value is None:
            self.phases = [cycle.phase[cycle.closes] for cycle in of.cycles]
            self.speeds = [cycle.speed[cycle.closes] for cycle in of.cycles]
        else:
            self.phases, self.speeds = [np.zeros(1)] * len(of), list(of.value.reshape(-1, 1))

    def __len__(self) -> int:
        return len(self.of)


def draw(branches: Sequence[_Drawn], ax: "Axes", inadmissible: bool = False, unit: float = 1.0, speed: float = 1.0) -> None:
    """Draw the speeds of all impacts of branches, and their events."""
    labels: list[str] = []
    looks: list[str] = []
    for one in branches:
        for label, look, xs, ys in pieces(one):
            if look == "inadmissible" and not inadmissible:
                continue
            if look not in looks:
                looks.append(look)
            if label not in labels:
                labels.append(label)
            curve(ax, xs * unit, ys * speed, LOOKS[look], label, linewidth=1.0 if look == "inadmissible" else 1.8)
    for label in labels[:_NAMED]:
        curve(ax, [], [], "-", label, label=named(label))
    for look in (look for look in LOOKS if look in looks):
        ax.plot([], [], LOOKS[look], color="black", label=look)
    _events(branches, ax, inadmissible, unit, speed)


def curve(ax: "Axes", xs: Any, ys: Any, dash: str, motion: str, linewidth: float = 1.8, **look: Any) -> None:
    """A line in the colour of the label of a motion, with a dark rim where it is solid, because some of these colours are light."""
    from matplotlib.patheffects import Normal, Stroke

    colour = class_colour(motion) if dash == "-" else variant(class_colour(motion), 1)
    rim = [Stroke(linewidth=linewidth + 1.0, foreground="0.25"), Normal()] if dash == "-" else None
    ax.plot(xs, ys, dash, color=colour, linewidth=linewidth, path_effects=rim, **look)


def _behind(
    ax: "Axes", xs: NDArray[np.float64], ys: NDArray[np.float64], repeats: NDArray[np.bool_]
) -> None:
    """Draw the speeds of an orbit diagram from simulation in grey; `repeats` are those of motions that repeat."""
    # the dots of motions that repeat are wider than a curve
    for at, size in ((repeats, 4.5), (~repeats, 1.6)):
        ax.plot(xs[at], ys[at], "o", color="0.72", markersize=size, markeredgewidth=0, zorder=0)
    ax.plot([], [], "o", color="0.72", markersize=4, label="simulation")


def _events(branches: Sequence[_Drawn], ax: "Axes", inadmissible: bool, unit: float, speed: float) -> None:
    places: dict[str, list[tuple[float, float]]] = {}
    for one in branches:
        for event in one.events:
            if event.kind not in BRANCH_MARKS or not (inadmissible or one.of.admissible[event.point]):
                continue
            _, at_zero = BRANCH_MARKS[event.kind]
            speeds = [0.0] if at_zero else one.speeds[event.point].tolist()
            places.setdefault(event.kind, []).extend((event.parameter, u) for u in speeds)
    for kind in sorted(places):
        xs, ys = np.array(places[kind]).reshape(-1, 2).T
        ax.plot(xs * unit, ys * speed, BRANCH_MARKS[kind][0], color="white", markeredgecolor="black", markersize=6, label=kind,
                zorder=4, clip_on=False)


def pieces(branch: _Drawn) -> Iterator[tuple[str, str, NDArray[np.float64], NDArray[np.float64]]]:
    """Curves of one impact with one label and one line style. Consecutive curves share a point."""
    begin = 0
    # cycles with one label may have different numbers of impacts, if they stick
    labels = branch.of.label.tolist()
    key = [(label, len(speeds)) for label, speeds in zip(labels, branch.speeds)]
    while begin < len(branch):
        label = labels[begin]
        end = next((k for k in range(begin, len(branch)) if key[k] != key[begin]), len(branch))
        for track in _tracks(branch.phases[begin:end], branch.speeds[begin:end]):
            for look, at in _runs(branch, begin, end):
                yield label, look, branch.of.parameter[at], track[at.start - begin : at.stop - begin]
        begin = end


def _runs(branch: _Drawn, begin: int, end: int) -> Iterator[tuple[str, slice]]:
    """Ranges of points with one line style. A step takes its style from the end that is no event."""
    events = {event.point for event in branch.events}
    before, first = None, begin
    for k in range(begin, end - 1):
        at = k if k + 1 in events and k not in events else k + 1
        look = str(branch.of.stability[at]) if branch.of.admissible[at] else "inadmissible"
        if before is not None and look != before:
            yield before, slice(first, k + 1)
            first = k
        before = look
    if before is not None:
        yield before, slice(first, end)


def _tracks(each: list[NDArray[np.float64]], values: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    """The speed of each impact at consecutive points with one label, one row for each impact."""
    count = len(each[0])
    rows = np.zeros((len(each), max(count, 1)))
    before: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None
    for k, (phases, speeds) in enumerate(zip(each, values)):
        if count == 0:
            continue
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
