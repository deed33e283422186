"""Figures of the answers about machines, with the looks of those of the oscillator."""

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _exponents, _tracks
from vibroimpact._core import QuestionError
from vibroimpact._figure import along, legend, named, new_axes
from vibroimpact._palette import SERIES
from vibroimpact._sections import dot_legend, dots, room
from vibroimpact._tables import CURVE_MARKS, EVENT_COLOURS

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Minimum number of forcing periods, and number of cycles without forcing, in a figure of a motion.
_PERIODS, _CYCLES = 6, 3
#: Number of colours of lines; the others of the series are too light, or black.
_USABLE = 6


def title(plan: str) -> str:
    """The title of the machine of a plan, up to its first colon."""
    return str(json.loads(plan).get("title") or "machine").split(": ")[0]


def motion(of: Any, axes: Any) -> "NDArray[Any]":
    """Draw a motion over several periods, from a state on it."""
    from vibroimpact import _machine_figure

    if of.state is None:
        raise QuestionError(f"the motion {of.label} has no cycle to draw\nhint: machine.simulate(...).plot() draws it from its start")
    machine, (q, qdot, phase) = of._machine, of.state
    if machine.period is None:
        limits: dict[str, Any] = {"impacts": max(_CYCLES * len(of.cycle), 1)}
    else:
        turns = of.periods or 1
        limits = {"periods": turns * max(2, -(-_PERIODS // turns))}
    drawn = _machine_figure.draw(machine.simulate(q=q, qdot=qdot, phase=phase, **limits), axes)
    heading = (machine.title or "machine").split(": ")[0]
    drawn[0].set_title(f"{heading}: {named(of.label)}")
    return drawn


def exponents(of: Any, ax: "Axes | None") -> "Axes":
    """Draw the exponents with their error bars."""
    if not of.exponents:
        raise QuestionError("there are no exponents: the motion ended before they could be measured")
    return _exponents.plot(of.exponents, of.exact, f"{title(of.plan)}: {named(of.motion.label)}", ax)


def _of_closings(of: Any) -> NDArray[np.bool_]:
    closing: NDArray[np.bool_] = np.isin(of.cycle.kind, ("impact", "close"))
    return closing


def orbits(of: Any, ax: "Axes | None") -> "Axes":
    """Draw the closings of each orbit: their speeds over the phase of the forcing."""
    if not len(of):
        raise QuestionError("there are no orbits to draw")
    ax = new_axes(ax, (6.4, 4.2))
    for k, one in enumerate(of):
        at = _of_closings(one)
        colour = SERIES[k % _USABLE]
        ax.plot(one.cycle.phase[at], one.cycle.speed[at], "o" if one.stable else "s", color=colour, markersize=7,
                markerfacecolor=colour if one.stable else "white", label=f"{named(one.label)}, no. {k + 1}, {one.stability}")
    ax.set_xlim(0, 2 * np.pi)
    ax.set_xlabel("phase of the forcing")
    ax.set_ylabel("speed of closing")
    ax.set_title(title(of.plan))
    legend(ax)
    return ax


def sections(of: Any, axes: Any) -> "NDArray[Any]":
    """Draw the phase and speed of closings of each stop, and the plane of each coordinate and its velocity at phase 0."""
    import matplotlib.pyplot as plt

    names = of.motion._machine.coordinates
    if axes is None:
        rows = -(-(len(names) + 1) // 2)
        figure, grid = plt.subplots(rows, 2, figsize=(10, 4.0 * rows), layout="constrained", squeeze=False)
        figure.suptitle(f"{title(of.plan)}: {named(of.motion.label)}")
        axes = grid.ravel()
        for ax in axes[len(names) + 1 :]:
            ax.remove()
    drawn = np.asarray(axes, dtype=object).ravel()[: len(names) + 1]
    if len(drawn) != len(names) + 1:
        raise QuestionError(f"{len(names) + 1} axes are needed, for the closings and for each coordinate, not {len(drawn)}")
    first = drawn[0]
    stops = of.motion._machine.stops
    for k, stop in enumerate(stops):
        at = of.closings.stop == stop
        if np.any(at):
            dots(first, of.closings.phase[at], of.closings.speed[at], color=SERIES[k % _USABLE], label=stop)
    first.set(xlabel=r"phase $\theta$", ylabel="speed of closing", title="closings of stops")
    if len(stops) > 1:
        dot_legend(first)
    for i, (ax, name) in enumerate(zip(drawn[1:], names)):
        dots(ax, of.strobes.q[:, i], of.strobes.qdot[:, i], color="black")
        ax.set(xlabel=f"q.{name}", ylabel=f"qdot.{name}", title="states at phase 0")
    for ax in drawn:
        room(ax)
    return drawn


class _Closings(NamedTuple):
    """The closings of stops of a cycle, as the figure of a branch needs them."""

    phase: NDArray[np.float64]
    velocity_before: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.phase)


class _Event(NamedTuple):
    kind: str
    parameter: float
    point: int


class _Branch:
    """A branch of a machine, as the figure of a branch of an oscillator needs it."""

    def __init__(self, of: Any) -> None:
        if of.value is None:
            closing = [np.isin(cycle.kind, ("impact", "close")) for cycle in of.cycles]
            self.cycles = [_Closings(cycle.phase[at], cycle.speed[at]) for cycle, at in zip(of.cycles, closing)]
        else:
            # one value of each cycle, as if it were a closing
            self.cycles = [_Closings(np.zeros(1), value) for value in of.value.reshape(-1, 1)]
        self.parameter, self.stability = of.parameter, of.stability
        self.label = of.label.tolist()
        # a branch of a machine ends where its orbit ceases to be admissible
        self.physical = np.ones(len(of), dtype=np.bool_)
        columns = (of.event_kind.tolist(), of.event_parameter.tolist(), of.event_point.tolist())
        self.events = [_Event(*row) for row in zip(*columns)]

    def __len__(self) -> int:
        return len(self.parameter)


def branch(
    of: Any, ax: "Axes | None", ends: tuple[float, float], diagram: Mapping[str, NDArray[Any]] | None
) -> "Axes":
    """Draw the speeds of all closings, or the quantity of a machine without stops: solid if stable, dashed and dotted if
    neutral, dashed if unstable, with the events. `diagram` has the columns of the orbit diagram behind."""
    ax = new_axes(ax, (7.6, 4.8))
    if diagram is not None:
        _tracks.behind(ax, diagram["parameter"], diagram["speed"], diagram["repeats"])
    _tracks.draw([_Branch(one) for one in (of, *of.followed)], ax)
    ax.set_xlim(*sorted(ends))
    ax.set_xlabel(along(of.vary, ends, of.also))
    ax.set_ylabel(of.quantity or "speed of closing")
    ax.set_title(title(of.plan))
    legend(ax)
    return ax


def curve(of: Any, ax: "Axes | None") -> "Axes":
    """Draw the curve in its plane, with its points of codimension two."""
    ax = new_axes(ax, (7.2, 4.8))
    # a motion with friction only has no impact that could name it
    name = of.kind if of.label == "0" else f"{of.kind} of {named(of.label)}"
    ax.plot(of.values[:, 0], of.values[:, 1], color=EVENT_COLOURS.get(of.kind, SERIES[3]), linewidth=1.8, label=name)
    for k, kind in enumerate(kind for kind in dict.fromkeys(of.event_kind.tolist()) if not kind.startswith("end")):
        points = of.event_point[of.event_kind == kind]
        ax.plot(of.values[points, 0], of.values[points, 1], CURVE_MARKS.get(kind, "osD^v"[k % 5]), color="white",
                markeredgecolor="black", markersize=8, label=kind, zorder=4, clip_on=False)
    ax.set_xlabel(of.parameters[0])
    ax.set_ylabel(of.parameters[1])
    ax.set_title(title(of.plan))
    legend(ax)
    return ax


def cells(
    axes: Mapping[str, NDArray[np.float64]],
    labels: NDArray[np.str_],
    plan: str,
    ax: "Axes | None",
    *,
    motion_of: NDArray[np.int64] | None = None,
    share: NDArray[np.float64] | None = None,
) -> "Axes":
    """Draw a basin or a map of labels with the figure of its Dataset."""
    from vibroimpact import _cells

    return _cells.plot(dataset(axes, labels, plan, motion_of, share), ax)


def _code(label: str) -> int:
    """The code of a label in a Dataset; that of no motion for other texts."""
    m, slash, n = label.partition("/")
    if slash and n == "T":
        return 1_600_000_000 if m == "inf" else 1_500_000_000 + int(m)
    if slash:
        return 1_000_000_000 + int(n) if m == "inf" else 10_000 * int(m) + int(n)
    return {"0": 0, "chaotic": -2, "stuck": -3, "undecided": -4}.get(label, -1)


def dataset(
    axes: Mapping[str, NDArray[np.float64]],
    labels: NDArray[np.str_],
    plan: str,
    motion_of: NDArray[np.int64] | None,
    share: NDArray[np.float64] | None,
) -> "xr.Dataset":
    """Labels, and the motions or shares of a grid, as the Dataset of which figures are drawn; the last axis comes first."""
    import xarray as xr

    dims = [*axes]
    distinct, places = np.unique(labels, return_inverse=True)
    codes = np.array([_code(label) for label in distinct.tolist()], dtype=np.int32)[places].reshape(labels.shape)
    further = ["motion"] if share is not None else []
    variables: dict[str, Any] = {"label": ([*dims, *further], codes)}
    if share is not None:
        variables["share"] = ([*dims, "motion"], share)
    if motion_of is not None:
        variables["cycle"] = (dims, motion_of)
        variables["cycle_label"] = ("cycles", np.arange(motion_of.max(initial=-1) + 1))
    ds: xr.Dataset = xr.Dataset(variables, coords=dict(axes), attrs={"plan": plan}).transpose(*reversed(dims), ...)
    return ds
