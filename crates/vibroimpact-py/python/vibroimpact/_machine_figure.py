"""The figure of a motion of a machine."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import QuestionError
from vibroimpact._figure import legend
from vibroimpact._palette import SERIES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Number of equal steps, and largest numbers of lines, of impacts with a mark each, and of events with both sides.
_STEPS, _LINES, _MARKED, _SIDES = 4000, 6, 2000, 20_000
_HATCHES = ("///", "\\\\\\", "---", "...")


def _intervals(time: NDArray[Any], closed: NDArray[Any]) -> list[tuple[float, float]]:
    """The times in which a stop is closed."""
    both = closed[1:] & closed[:-1]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], both, [False])).astype(int)))
    return [(float(time[a]), float(time[b])) for a, b in zip(edges[::2], edges[1::2])]


def draw(motion: Any, axes: "Sequence[Axes] | None") -> "NDArray[Any]":
    """Draw the coordinates of a `Simulation` of a machine, and the contact forces if there are any."""
    machine, until = motion.system, motion.shown_until
    # with very many events their sides are not seen
    wave = motion.waveform(until / _STEPS or 1.0, events=len(motion) <= _SIDES)
    names, stops, contacts = machine.coordinates, machine.stops, machine.stops + machine.joints
    compliant = [f"stop.{name}.stiffness" in machine.paths for name in stops]
    pushing = [k for k in range(len(contacts)) if k >= len(stops) or compliant[k] or np.any(wave.force[:, k])][:_LINES]
    if axes is None:
        import matplotlib.pyplot as plt

        rows = 2 if pushing else 1
        _, made = plt.subplots(rows, 1, figsize=(9.5, 3.6 + 2.4 * (rows - 1)), layout="constrained", sharex=True,
                               squeeze=False)
        drawn = made[:, 0]
    else:
        drawn = np.atleast_1d(np.asarray(axes, dtype=object))
        if len(drawn) not in (1, 2):
            raise QuestionError(f"{len(drawn)} axes are given; one for the coordinates, or two with the forces, are needed")
    ax = drawn[0]
    touched = [k for k in range(len(stops)) if wave.contact[:, k].any()]
    for place, k in enumerate(touched):
        hatch = _HATCHES[place % len(_HATCHES)] if len(touched) > 1 else None
        for begin, end in _intervals(wave.time, wave.contact[:, k]):
            ax.axvspan(begin, end, facecolor="0.5", edgecolor="0.5", alpha=0.25, linewidth=0, hatch=hatch)
        ax.fill([], [], facecolor="0.5", edgecolor="0.5", alpha=0.25, linewidth=0, hatch=hatch, label=f"contact with {stops[k]}")
    shown = min(len(names), _LINES)
    for k in range(shown):
        ax.plot(wave.time, wave.q[:, k], color=SERIES[k], linewidth=1.5, label=names[k])
    struck = np.flatnonzero((motion.kind == "impact") & (motion.time <= until))
    if 0 < len(struck) <= _MARKED:
        marked = {str(stop): _marked(motion, str(stop), shown) for stop in set(motion.stop[struck])}
        marks = [(motion.time[event], motion.q[event, k]) for event in struck for k in marked[str(motion.stop[event])]]
        if marks:
            ax.plot(*zip(*marks), "o", color="black", markersize=3 if len(marks) > 60 else 5, markeredgecolor="white",
                    markeredgewidth=0.7, label="impact", zorder=3)
    ax.set_ylabel("displacement")
    if len(drawn) > 1:
        for place, k in enumerate(pushing, shown):
            style = "-" if place < len(SERIES) - 1 else "--"
            drawn[1].plot(wave.time, wave.force[:, k], style, color=SERIES[place % (len(SERIES) - 1)], linewidth=1.5,
                          label=f"force of {contacts[k]}")
        drawn[1].set_ylabel("contact force")
    ax.set_title(machine.title or "machine")
    drawn[-1].set_xlabel("time")
    for panel in drawn:
        panel.set_xlim(0, until or 1.0)
        legend(panel)
    return drawn


def _marked(motion: Any, stop: str, shown: int) -> list[int]:
    """The coordinates on which an impact is marked: those that its stop moves, if they are one or two, or else the one
    that it moves most."""
    names = motion.system.coordinates[:shown]
    weights = [abs(motion.system.number(f"stop.{stop}.direction.{name}")) for name in names]
    moved = [k for k, weight in enumerate(weights) if weight > 0]
    return moved if len(moved) <= 2 else [weights.index(max(weights))]
