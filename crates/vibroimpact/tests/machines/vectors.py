"""Makes the test vectors: simulates random machines, estimates how each event depends on the numbers, writes JSON.

python vectors.py --count 10 --kind rigid_ground --seed 1 --out vectors
"""

import argparse
import json
import multiprocessing
import os
import random
from collections import Counter
from itertools import pairwise

from flint import arb, arb_mat

import special  # noqa: F401  (adds kinds)
from kinds import KINDS, draw
from model import exactly
from simulation import Simulation

RAW, AFTER = 400, 8
HORIZON = 100
SMALL = arb("1e-25")  # relative change that gives the condition
LARGE = 1e-14  # relative change under which a robust event stays


def chattering(events):
    """Whether the last impacts look like a chatter: on one stop, slower and at shorter intervals."""
    last = events[-1]
    if last["kind"] != "impact":
        return False
    same = [x for x in events[-12:] if x["kind"] == "impact" and x["stop"] == last["stop"]][-4:]
    if len(same) < 4:
        return False
    speeds = [x["speed"] for x in same]
    gaps = [b["time"] - a["time"] for a, b in pairwise(same)]
    return all(a > b for a, b in pairwise(speeds)) and all(a > b for a, b in pairwise(gaps))


def stick_place(events):
    """Index of the first stick that ends a chatter, or None."""
    return next((i for i, x in enumerate(events) if x.get("chatter")), None)


def enough(events, limit):
    """Whether a simulation can end: `limit` events, and no chatter that is still under way."""
    if len(events) < limit:
        return False
    at = stick_place(events)
    if at is None:
        return not chattering(events)
    return len(events) > at + AFTER


def whole(data, start, number, limit, ties=None):
    """A simulation, and why it ended."""
    s = Simulation(data, number, start)
    if ties:
        restore(s, ties)
    end = s.run(RAW + AFTER, arb(HORIZON), lambda s: enough(s.events, limit))
    return s, end


def ties_of(s):
    """What holds exactly at the start: gaps and rates that are zero."""
    m = s.machine
    gaps = [e for e in range(len(m.stops)) if s.sign(m.gaps[e]) == 0]
    rates = [e for e in gaps if s.sign(m.gap_rates[e]) == 0]
    slips = [j for j in range(len(m.joints)) if s.sign(m.slips[j]) == 0]
    return gaps, rates, slips


def restore(s, ties):
    """Makes hold again, in a disturbed simulation, what holds exactly at the start: moves gaps, then velocities."""
    m, (gaps, rates, slips) = s.machine, ties
    n, z = m.n, s.z.entries()
    for e in gaps:
        m.gaps[e][m.one] -= sum((a * b for a, b in zip(m.gaps[e], z)), arb(0))
        m.gaps[e][m.one] = m.gaps[e][m.one].mid()
    rows = [m.gap_rates[e] for e in rates] + [m.slips[j] for j in slips]
    if not rows:
        return
    w = arb_mat(len(rows), n, [row[n + i] for row in rows for i in range(n)])
    miss = arb_mat(len(rows), 1, [-sum((a * b for a, b in zip(row, z)), arb(0)) for row in rows])
    try:
        change = w.transpose() * (w * w.transpose()).solve(miss)
    except ZeroDivisionError:
        return
    for i in range(n):
        z[n + i] = (z[n + i] + change[i, 0]).mid()
    s.z = arb_mat(m.size, 1, z)


def disturbance(seed, size):
    """A `number` that changes each number relatively by +size or -size."""
    signs = {}
    r = random.Random(seed)

    def number(path, x):
        if path not in signs:
            signs[path] = r.choice([1, -1])
        return (arb(x) * (1 + signs[path] * size)).mid()

    return number


def changed(paths, size):
    """A `number` that changes only the numbers at these paths relatively by `size`."""
    return lambda path, x: (arb(x) * (1 + size)).mid() if path in paths else arb(x)


def paths_of(data, start):
    """The paths of all numbers of a machine and its start that are not zero."""
    paths = {}

    def number(path, x):
        if x != 0:
            paths[path] = None
        return arb(x)

    Simulation(data, number, start)
    return list(paths)


def agree(a, b):
    return a["kind"] == b["kind"] and a["stop"] == b["stop"]


def change(a, b):
    """Changes of time, q and v between two versions of an event."""
    return [
        abs(a["time"] - b["time"]),
        max(abs(x - y) for x, y in zip(a["q"], b["q"])),
        max(abs(x - y) for x, y in zip(a["v"], b["v"])),
    ]


def conditions(base, others, combine):
    """For each event that all versions share: its changes, combined by `max` or `sum`, per relative change of the numbers."""
    out = []
    for i, event in enumerate(base):
        if not all(i < len(o) and agree(event, o[i]) for o in others):
            break
        changes = [change(event, o[i]) for o in others]
        out.append([combine(c[k] for c in changes) / SMALL for k in range(3)])
    return out


def robust(base, condition, others):
    """Number of leading events that stay when all numbers change by LARGE, with times as the condition says."""
    for i, (event, c) in enumerate(zip(base, condition)):
        for other in others:
            if i >= len(other) or not agree(event, other[i]):
                return i
            if abs(event["time"] - other[i]["time"]) > 20 * c[0] * LARGE + 1e-12:
                return i
    return len(condition)


def clean(xs):
    """Doubles; zero for the rounding of high precision."""
    return [float(x) if abs(x) > 1e-50 else 0.0 for x in xs]


def short(x):
    """Two digits; zero for the rounding of high precision."""
    return 0.0 if abs(x) < 1e-24 else float(f"{float(x):.1e}")


def pack(events, condition):
    """Rows [kind, stop, time, speed, condition of the time] and [row, q, qdot, conditions of q and qdot]."""
    rows, states = [], []
    count = len(condition)
    for i, (x, c) in enumerate(zip(events, condition)):
        rows.append([x["kind"], x["stop"], float(x["time"]), *clean([x["speed"]]), short(c[0])])
        if i in (0, count // 2, count - 1):
            states.append([i, clean(x["q"]), clean(x["v"]), short(c[1]), short(c[2])])
    return rows, states


def case(task):
    kind, seed, index, whole_sums = task
    name = f"{kind}-{index}"
    events = 20 if index % 4 == 0 else 7
    data, start = draw(kind, seed, index)
    try:
        ties = ties_of(Simulation(data, exactly, start))
        base, end = whole(data, start, exactly, events)
    except ValueError as reason:
        return name, None, str(reason)
    if len(base.events) < 2 and end != "horizon":
        return name, None, end
    if len(base.events) < 2 and index % 4 and kind != "grazing":
        return name, None, "few events"
    if name in whole_sums:
        combine, numbers = sum, [changed({path}, SMALL) for path in paths_of(data, start)]
    else:
        combine, numbers = max, [disturbance(f"{name}/{i}", SMALL) for i in range(3)]
    versions = [whole(data, start, number, events, ties)[0].events for number in numbers]
    large = [whole(data, start, disturbance(f"{name}/0", size), events, ties)[0].events for size in (LARGE, -LARGE)]
    at = stick_place(base.events)
    condition = conditions(base.events[:events], versions, combine)
    listed = len(condition)
    if listed < min(events, len(base.events)):
        end = "a change in the order of events"
        if listed < 2:
            return name, None, end
    rows, states = pack(base.events, condition)
    out = {"name": name, "machine": data, "start": start, "events": rows, "states": states}
    out["robust"] = robust(base.events, condition, large)
    if listed == events:
        end = "limit"
    out["end"] = [end, float(base.time) if end == "horizon" else rows[-1][2] if rows else 0.0]
    if at is not None and at < RAW:
        tails = [v[stick_place(v) :] if stick_place(v) is not None else [] for v in versions]
        tail = base.events[at : at + 1 + AFTER]
        condition = conditions(tail, tails, combine)
        if condition:
            rows, states = pack(tail, condition)
            tails = [v[stick_place(v) :] if stick_place(v) is not None else [] for v in large]
            out["after_chatter"] = {"raw": at, "events": rows, "states": states, "robust": robust(tail, condition, tails)}
    return name, out, end


def summary(folder):
    """A table of the files in Markdown: cases, cases with a chatter that ends, events of each kind."""
    kinds = ["impact", "close", "open", "stick", "release", "hold", "slip"]
    rows, total = [], Counter()
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name)) as file:
            cases = [json.loads(line) for line in file]
        count = Counter(row[0] for c in cases for row in c["events"] + c.get("after_chatter", {"events": []})["events"])
        count.update(cases=len(cases), chatters=sum("after_chatter" in c for c in cases))
        total += count
        rows.append((name.removesuffix(".json"), count))
    print("| kind | cases | chatters |", " | ".join(kinds), "|")
    print("|---|" + "---:|" * (len(kinds) + 2))
    for name, count in [*rows, ("all", total)]:
        print(f"| {name} |", " | ".join(str(count[k]) for k in ["cases", "chatters", *kinds]), "|")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10, help="machines of each kind")
    parser.add_argument("--first", type=int, default=0, help="index of the first machine")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--kind", action="append", choices=list(KINDS), help="all kinds if absent")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--out", default="vectors")
    parser.add_argument("--summary", action="store_true", help="only print how many cases and events the files have")
    args = parser.parse_args()
    if args.summary:
        return summary(args.out)
    os.makedirs(args.out, exist_ok=True)
    # the cases whose conditions are sums over all numbers
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "whole_conditions.txt")) as file:
        whole_sums = set(file.read().split())
    with multiprocessing.Pool(args.processes) as pool:
        for kind in args.kind or KINDS:
            tasks = [(kind, args.seed, i, whole_sums) for i in range(args.first, args.first + args.count)]
            ends, kinds, kept, chatters = Counter(), Counter(), 0, 0
            with open(os.path.join(args.out, f"{kind}.json"), "w") as file:
                for _, out, end in pool.imap(case, tasks):
                    ends[end if not end.startswith("a value") else "a value near zero"] += 1
                    if out is None:
                        continue
                    kept += 1
                    chatters += "after_chatter" in out
                    kinds.update(row[0] for row in out["events"])
                    file.write(json.dumps(out, separators=(",", ":")).replace(".0,", ",").replace(".0]", "]") + "\n")
            print(kind, "kept", kept, "of", len(tasks), "chatters", chatters, dict(kinds), dict(ends), flush=True)


if __name__ == "__main__":
    main()
