"""What the Python peers share: workloads, starts, labels and the command line. `../c/main.c` is the same in C.

`PEER chaos|regular|basin SECONDS` prints `{"rate": ...}`, `PEER impacts FILE` the first impact times of the starts in
the file, one line for each.
"""

from __future__ import annotations

import json
import math
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

TAU = 2.0 * math.pi

DROPPED = 200
"""Impacts before a rate is taken."""
FOLLOWED = 120
"""Impacts before a start gets its label."""
MOST_M = 8
"""Labels m/n up to this m."""
FIRST = 5
"""Impact times that `impacts` prints."""
OUTLOOK = 1000.0
"""Longest flight of a workload."""
OUTLOOK_PERIODS = 20
"""Of `impacts`: time to follow a start for, in forcing periods."""
SIDE, STRIDE = 100, 7919
"""Starts along each side of the grid, and the order in which it is visited."""


@dataclass(frozen=True)
class Start:
    """An undamped oscillator and where its motion begins."""

    inverse_beta: float
    gap: float
    restitution: float
    x: float
    v: float
    phase: float

    @property
    def beta(self) -> float:
        """Forcing frequency over natural frequency."""
        return 1.0 / self.inverse_beta

    @property
    def horizon(self) -> float:
        """The time for which `impacts` follows it."""
        return OUTLOOK_PERIODS * TAU / self.beta


CHAOS = Start(1.11, 3.0, 0.5, 0.0, 0.0, 0.0)
TWO_ONE = Start(1.3, 0.75, 0.5, 0.0, 0.0, 0.0)
ONE_ONE = Start(1.3, 0.75, 0.5, -2.0, 0.0, 0.0)


def basin_start(k: int) -> Start:
    """Start k of the basin: a cell of the grid, in an order that covers it evenly from the beginning."""
    row, column = divmod(k * STRIDE % (SIDE * SIDE), SIDE)
    return Start(1.3, 0.75, 0.5, -4.0 + 4.75 * (column + 0.5) / SIDE, -4.0 + 8.0 * (row + 0.5) / SIDE, 0.0)


def label(beta: float, times: Sequence[float], velocities: Sequence[float]) -> str:
    """The label m/n of the last impacts, by the paper's rule; all velocities on the same side of the impact."""
    for m in range(1, min(MOST_M, len(times) - 1) + 1):
        turns = beta * (times[-1] - times[-1 - m]) / TAU
        if abs(velocities[-1] - velocities[-1 - m]) < 1e-6 * abs(velocities[-1]) and abs(turns - round(turns)) < 1e-6:
            return f"{m}/{round(turns)}"
    return "open"


@dataclass(frozen=True)
class Followed:
    """The rate at which a motion was followed."""

    impacts_per_second: float
    callback_share: float = 0.0
    """The part of the time spent in a Python callback at each impact, where there is one."""


@dataclass(frozen=True)
class Basin:
    """What a peer did in the time given."""

    starts_per_second: float
    labels: Counter[str]


class Peer(Protocol):
    """A way to follow motions."""

    def follow(self, start: Start, seconds: float) -> Followed:
        """The rate after the first `DROPPED` impacts."""
        ...

    def basin(self, seconds: float) -> Basin:
        """Labels of the starts of the grid, for so long."""
        ...

    def impacts(self, starts: Sequence[Start]) -> list[list[float]]:
        """The first impact times of each start."""
        ...


def read_starts(path: str) -> list[Start]:
    """The starts in a file, a line each: inverse_beta gap restitution x v phase."""
    with open(path, encoding="utf-8") as file:
        return [Start(*map(float, line.split())) for line in file if line.strip()]


def main(peer: Peer) -> None:
    """Runs the peer as the program it is called as."""
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} chaos|regular|basin SECONDS, or {sys.argv[0]} impacts FILE")
    workload, argument = sys.argv[1:]
    if workload == "impacts":
        for times in peer.impacts(read_starts(argument)):
            print(*map(repr, times))
        return
    seconds = float(argument)
    result: dict[str, object]
    if workload == "chaos":
        followed = peer.follow(CHAOS, seconds)
        result = {"rate": followed.impacts_per_second, "callback_share": followed.callback_share}
    elif workload == "regular":
        # equally many impacts of either motion
        rates = [peer.follow(start, 0.5 * seconds).impacts_per_second for start in (ONE_ONE, TWO_ONE)]
        result = {"rate": 2.0 / sum(1.0 / rate for rate in rates)}
    elif workload == "basin":
        basin = peer.basin(seconds)
        result = {"rate": basin.starts_per_second, "labels": dict(basin.labels)}
    else:
        sys.exit(f"`{workload}` is not a workload")
    print(json.dumps(result))
