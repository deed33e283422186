"""Many motions in one call, compared with a Python loop over single calls.

    python benches/many.py               # all, in a Python that has a release build of vibroimpact (pip install .)
    python benches/many.py simulate      # one of them: simulate, systems, starts

- simulate: `simulate_many` for 2000 starts of one system with 100 impacts each, and a loop over `simulate`.
- systems: `settle_many` for a Latin hypercube of 1e5 systems with one start each, and a loop over `settle` for 3000 of them.
- starts: `settle_many` for 1e6 scattered starts of one system, and `basin` for a grid of as many.

Each number is the median of rounds in which the two alternate. Both sides have the same results, which is checked.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import vibroimpact as vi

#: The system of the starts.
SYSTEM = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)


def clock(work: Callable[[], Any]) -> tuple[float, Any]:
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def scattered(count: int) -> dict[str, Any]:
    random = np.random.default_rng(1)
    return {"x": random.uniform(-4, SYSTEM.gap, count), "v": random.uniform(-4, 4, count)}


def rows(columns: dict[str, Any], count: int) -> list[dict[str, float]]:
    lists = {name: of[:count].tolist() for name, of in columns.items()}
    return [{name: of[k] for name, of in lists.items()} for k in range(count)]


def simulate(rounds: int, threads: int) -> None:
    starts = scattered(2000)
    alone = rows(starts, 2000)
    loops, many = [], []
    for _ in range(rounds):
        seconds, single = clock(lambda: [vi.simulate(SYSTEM, **start, impacts=100) for start in alone])
        loops.append(seconds)
        for _ in range(5):
            seconds, ds = clock(lambda: vi.simulate_many(SYSTEM, starts=starts, impacts=100, threads=threads))
            many.append(seconds)
        times, counts = ds["time"].values, ds["count"].values
        assert all(np.array_equal(of.time, row[:count]) for of, row, count in zip(single, times, counts))
    loop, one = statistics.median(loops), statistics.median(many)
    print(f"simulate: loop {1e3 * loop:.0f} ms, simulate_many {1e3 * one:.1f} ms: {loop / one:.1f} times as fast")


def systems(rounds: int, threads: int, count: int = 100_000, few: int = 3000) -> None:
    ranges = {"inverse_beta": (0.5, 2.5), "gap": (-0.2, 1.8), "restitution": (0.3, 0.9), "damping": (0.0, 0.1)}
    points = vi.sample("lhs", count, ranges, seed=1)
    columns = {name: np.asarray(points[name]) for name in ranges}
    alone = rows(columns, few)
    loops, many = [], []
    for _ in range(rounds):
        seconds, single = clock(lambda: [vi.settle(vi.Oscillator(**system)) for system in alone])
        loops.append(seconds / few)
        seconds, ds = clock(lambda: vi.settle_many(columns, threads=threads))
        many.append(seconds / count)
        assert [of.label for of in single] == ds.vibro.labels().values[:few].tolist()
    loop, one = statistics.median(loops), statistics.median(many)
    print(f"systems: loop {1e6 * loop:.0f} us, settle_many {1e6 * one:.1f} us for each: {loop / one:.2f} times as fast")


def starts(rounds: int, threads: int, side: int = 1000) -> None:
    grid = {"x": vi.span(-4, SYSTEM.gap, side), "v": vi.span(-4, 4, side)}
    points = scattered(side * side)
    grids, scatters = [], []
    for _ in range(rounds):
        grids.append(clock(lambda: vi.basin(SYSTEM, over=grid, threads=threads))[0])
        scatters.append(clock(lambda: vi.settle_many(SYSTEM, starts=points, threads=threads))[0])
    one, other = statistics.median(grids), statistics.median(scatters)
    print(f"starts: grid {one:.3f} s, scattered {other:.3f} s: {100 * (other / one - 1):+.1f} %")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    known = {"simulate": simulate, "systems": systems, "starts": starts}
    parser.add_argument("what", nargs="*", choices=[[], *known], help="which; default: all")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=2)
    args = parser.parse_args()
    for name in args.what or known:
        known[name](args.rounds, args.threads)


if __name__ == "__main__":
    main()
