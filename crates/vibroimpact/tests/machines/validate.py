"""Compares the simulator with closed forms. Prints one line per comparison; the exit status is 1 if one fails."""

import sys

from flint import arb, arb_poly

from flow import guard_coefficients, refine
from model import exactly
from simulation import Simulation

FAILED = []


def compare(what, got, expected, tolerance):
    difference = abs(arb(got) - arb(expected))
    good = difference <= arb(tolerance)
    if not good:
        FAILED.append(what)
    print(f"{'ok  ' if good else 'FAIL'} {what}: {arb(got).mid().str(24, radius=False)}, difference {float(difference):.1e}")


def simulate(machine, q, v, limit, horizon=1e9, trace=None):
    s = Simulation(machine, exactly, {"q": q, "qdot": v, "phase": 0}, trace)
    return s, s.run(limit, arb(horizon))


def extremes(row_of, found):
    """A trace that collects the (time, value) of the turning points of the value row_of(simulation)."""

    def trace(s, regime, terms, end):
        row = row_of(s)
        c = guard_coefficients([row], terms)[0]
        slope = arb_poly(c).derivative()
        parts = 64
        for i in range(parts):
            a, b = end * i / parts, end * (i + 1) / parts
            if slope(a) > 0 and slope(b) < 0 or slope(a) < 0 and slope(b) > 0:
                x = refine(slope if slope(a) > 0 else -slope, a.mid(), b.mid())
                found.append(((s.time + x * regime.flow.h).mid(), arb_poly(c)(x).mid()))

    return trace


def bouncing_ball():
    machine = {
        "coordinates": ["ball"],
        "mass": [2.0],
        "constant": [-3.0],
        "stop": [{"name": "floor", "direction": [-1.0], "gap": 0.0, "restitution": 0.625}],
    }
    s, _ = simulate(machine, [0.5], [0.25], 1000, 100)
    a, v0, h, e = arb(3) / 2, arb(1) / 4, arb(1) / 2, arb(5) / 8
    v1 = (v0 * v0 + 2 * a * h).sqrt()
    first = (v0 + v1) / a
    compare("ball, first impact", s.events[0]["time"], first, 1e-70)
    compare("ball, tenth impact", s.events[9]["time"], first + 2 * v1 / a * e * (1 - e**9) / (1 - e), 1e-70)
    sticks = [x for x in s.events if x["kind"] == "stick"]
    compare("ball, sticks once", len(sticks), 1, 0)
    compare("ball, end of chatter", sticks[0]["time"], first + 2 * v1 / a * e / (1 - e), 1e-29)


def mass_on_stop():
    machine = {
        "coordinates": ["mass"],
        "mass": [100.0],
        "stiffness": [1e4],
        "stop": [{"name": "stop", "direction": [1.0], "gap": 0.0, "stiffness": 1e6}],
    }
    force, motion = [], []
    simulate(machine, [0.0], [1.0], 4, 1, extremes(lambda s: s.machine.contact_force(0), force))
    s, _ = simulate(machine, [0.0], [1.0], 4, 1, extremes(lambda s: s.machine.gaps[0], motion))
    opened = next(x for x in s.events if x["kind"] == "open")
    compare("mass on a stop, largest force", force[0][1], "9950.371902", 1e-6)
    compare("mass on a stop, contact", opened["time"], "0.031260015", 1e-9)
    compare("mass on a stop, contact in closed form", opened["time"], arb.pi() / arb(10100).sqrt(), 1e-70)
    turns = [t for t, g in motion if g < 0]
    second = turns[1] if len(turns) > 1 else arb(0)
    compare("mass on a stop, second largest displacement", second, "0.361049288", 1e-9)


def elastic_balls():
    for k, count in ((0, 3), (1, 31), (2, 314)):
        machine = {
            "coordinates": ["large", "small"],
            "mass": [100.0**k, 1.0],
            "stop": [
                {"name": "balls", "direction": [1.0, -1.0], "gap": 0.0, "restitution": 1.0},
                {"name": "wall", "direction": [0.0, 1.0], "gap": 0.0, "restitution": 1.0},
            ],
        }
        s, _ = simulate(machine, [-2.0, -1.0], [1.0, 0.0], 1000, 200 * 10**k)
        compare(f"elastic balls 1 and {100**k}, collisions", len(s.events), count, 0)


def damped_stop():
    for opening, expected in (("position", "0.526620599330"), ("force", "0.571740027585")):
        machine = {
            "coordinates": ["mass"],
            "mass": [1.0],
            "stop": [{"name": "stop", "direction": [1.0], "gap": 0.0, "stiffness": 1.0, "damping": 0.4, "opening": opening}],
        }
        s, _ = simulate(machine, [0.0], [1.0], 2, 100)
        compare(f"damped stop, speed after it opens by {opening}", -s.events[1]["v"][0], expected, 1e-12)
    machine["stop"][0]["opening"] = "position"
    simulated, _ = simulate(machine, [0.0], [1.0], 2, 100)
    closed_form = (-arb(0.4) / 2 * arb.pi() / (1 - arb(0.4) ** 2 / 4).sqrt()).exp()
    compare("damped stop, closed form", -simulated.events[1]["v"][0], closed_form, 1e-70)


def sliding_block():
    """A block thrown on a belt at rest: it stops after v/a. A spring pulls it until it slips."""
    machine = {
        "coordinates": ["block"],
        "mass": [1.0],
        "friction": [{"name": "ground", "direction": [1.0], "sliding": 0.5}],
    }
    s, _ = simulate(machine, [0.0], [1.0], 1, 100)
    compare("sliding block, holds", s.events[0]["time"], 2, 1e-70)
    compare("sliding block, distance", s.events[0]["q"][0], 1, 1e-70)
    machine = {
        "coordinates": ["block"],
        "mass": [1.0],
        "stiffness": [1.0],
        "friction": [{"name": "belt", "direction": [1.0], "sliding": 0.5, "static": 0.75, "belt": 0.25}],
    }
    s, _ = simulate(machine, [0.0], [0.25], 3, 100)
    kinds = [x["kind"] for x in s.events]
    compare("block on a belt, hold slip hold", kinds == ["hold", "slip", "hold"], True, 0)
    compare("block on a belt, slips", s.events[1]["time"], 3, 1e-70)
    # afterwards q = 0.5 + 0.25 (cos t + sin t): the speed is 0.25 again after 3/4 of a turn
    compare("block on a belt, holds again", s.events[2]["time"] - 3, arb.pi() * 3 / 2, 1e-70)


def preloaded_stop():
    """Pressed into a preloaded stop with half the preload: a force of one half in the gap and inside it."""
    machine = {
        "coordinates": ["mass"],
        "mass": [1.0],
        "constant": [0.5],
        "stop": [{"name": "stop", "direction": [1.0], "gap": 0.0, "stiffness": 1.0, "preload": 1.0}],
    }
    s, _ = simulate(machine, [0.0], [1.0], 3, 100)
    # inside: q = -0.5 + 0.5 cos t + sin t
    root = 2 * arb(2).atan()
    compare("preloaded stop, opens", s.events[1]["time"], root, 1e-70)
    compare("preloaded stop, closes again", s.events[2]["time"], root + 4, 1e-70)
    s, _ = simulate(machine, [0.0], [0.0], 3, 100)
    compare("preloaded stop, rests", [x["kind"] for x in s.events] == ["stick"], True, 0)


if __name__ == "__main__":
    for check in (bouncing_ball, mass_on_stop, elastic_balls, damped_stop, sliding_block, preloaded_stop):
        check()
    sys.exit(1 if FAILED else 0)
