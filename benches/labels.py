#!/usr/bin/env python3
"""Compare the labels and the processor time of a map in two versions of the command.

    python3 benches/labels.py OLD/vibro target/release/vibro               # figure 4's plane, 100 x 100 points, 4 starts each
    python3 benches/labels.py OLD NEW --variants 0 --rounds 7              # only labels and time

Without damping a chaotic transient can end after a flight of hundreds of periods, and then the last digit of one contact decides
which motion follows. A point whose label in the new version differs is one of these if the old version gives it another label
too when the restitution is changed by some roundings. The script counts them: first maps with `--variants` different
restitutions, then, for the points that are left, up to 200 restitutions for each point alone.

The time is the processor time of the command, the median of rounds in which the two alternate.
"""

import argparse
import csv
import io
import math
import os
import statistics
import subprocess
from collections import defaultdict

MAP = ["map", "--inverse-beta", "0.4:2:100", "--gap", "0:5:100", "--starts", "4", "--csv", "-"]

Labels = dict[tuple[str, str], tuple[tuple[str, str], ...]]


def run(vibro: str, words: list[str], restitution: float) -> tuple[Labels, float]:
    """The shares of all labels at each point, and the processor time."""
    before = os.times()
    done = subprocess.run([vibro, *words, "--restitution", repr(restitution)], capture_output=True, text=True, check=True)
    after = os.times()
    points = defaultdict(list)
    for row in csv.DictReader(io.StringIO(done.stdout)):
        points[row["inverse_beta"], row["gap"]].append((row["label"], row["share"]))
    return {point: tuple(sorted(shares)) for point, shares in points.items()}, after.children_user - before.children_user


def restitutions(count: int) -> list[float]:
    """The doubles nearest to 0.5, on both sides in turn."""
    up = down = 0.5
    found = []
    for _ in range((count + 1) // 2):
        up, down = math.nextafter(up, 1), math.nextafter(down, 0)
        found += [up, down]
    return found[:count]


def alone(vibro: str, point: tuple[str, str], restitution: float) -> tuple[tuple[str, str], ...]:
    """The shares at one point: the corner of a small map."""
    inverse_beta, gap = (f"{value},{float(value) + 1e-3}" for value in point)
    words = ["map", "--inverse-beta", inverse_beta, "--gap", gap, "--starts", "4", "--csv", "-"]
    return run(vibro, words, restitution)[0][point]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--variants", type=int, default=24, help="maps with other restitutions (24)")
    parser.add_argument("--rounds", type=int, default=3, help="rounds in which the two alternate (3)")
    arguments = parser.parse_args()
    times: dict[str, list[float]] = {"old": [], "new": []}
    for _ in range(arguments.rounds):
        old, seconds = run(arguments.old, MAP, 0.5)
        times["old"].append(seconds)
        new, seconds = run(arguments.new, MAP, 0.5)
        times["new"].append(seconds)
    before, after = (statistics.median(times[name]) for name in ("old", "new"))
    print(f"processor time: old {before:.2f} s, new {after:.2f} s: {after / before:.3f}")
    left = [point for point in old if old[point] != new.get(point)]
    print(f"labels differ at {len(left)} of {len(old)} points")
    changed = []
    for restitution in restitutions(arguments.variants):
        other = run(arguments.old, MAP, restitution)[0]
        changed.append(sum(other[point] != old[point] for point in old))
        left = [point for point in left if other[point] == old[point]]
    if changed:
        print(f"old, {len(changed)} restitutions within {(len(changed) + 1) // 2} roundings: {min(changed)} to {max(changed)} points change")
        print(f"of the points above {len(left)} keep their label in all of them")
        for point in left:
            kept = all(alone(arguments.old, point, restitution) == old[point] for restitution in restitutions(200))
            print(f"  1/beta {point[0]}, gap {point[1]}: {'keeps' if kept else 'changes'} its label within 100 roundings")


if __name__ == "__main__":
    main()
