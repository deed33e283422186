"""The results have the same numbers as the output of the command, to the last bit."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

S = ("--inverse-beta", 1.3, "--gap", 0.75, "--restitution", 0.5)
SYSTEMS = [
    (vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), S),
    (vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5), ("--inverse-beta", 1.11, "--gap", 3, "--restitution", 0.5)),
    (vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5), ("--beta", 0.9, "--gap", -1.5, "--restitution", 0.5)),
    (vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5), ("--inverse-beta", 1.11, "--gap", -0.5, "--restitution", 0.5)),
    (vi.Oscillator(beta=0.5, gap=40, restitution=0.5), ("--beta", 0.5, "--gap", 40, "--restitution", 0.5)),
    (
        vi.Oscillator(beta=1.1, gap=1, restitution=0.7, damping=0.01, second_gap=0.5, second_restitution=0.4),
        ("--beta", 1.1, "--gap", 1, "--restitution", 0.7, "--damping", 0.01, "--second-gap", 0.5, "--second-restitution", 0.4),
    ),
]


@pytest.fixture
def ask(vibro: Callable[..., Any]) -> Callable[..., dict[str, Any]]:
    def ask(*words: object) -> dict[str, Any]:
        done = vibro(*words, "--json")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return ask


@pytest.mark.parametrize(("osc", "flags"), SYSTEMS, ids=lambda of: repr(of) if isinstance(of, vi.Oscillator) else "")
def test_settle_simulate_attractors(ask: Callable[..., Any], osc: vi.Oscillator, flags: tuple[object, ...]) -> None:
    assert vi.settle(osc, v=0.5, phase=1).to_dict() == ask("settle", *flags, "--v", 0.5, "--phase", 1)
    told = ask("simulate", *flags, "--impacts", 60)
    found = vi.simulate(osc, impacts=60)
    assert found.to_dict() == told and json.loads(found.plan) == told["plan"]
    told = ask("attractors", *flags, "--starts", 60)
    found = vi.attractors(osc, starts=60)
    assert [motion.to_dict() for motion in found] == told["motions"]
    assert found.box == told["box"] and json.loads(found.plan) == told["plan"]


def test_machines(ask: Callable[..., Any]) -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6, damping=3)
    flags = ("--mass-kg", 2, "--stiffness-n-per-m", 800, "--force-n", 4, "--frequency-hz", 2.5, "--gap-m", 0.003,
             "--restitution", 0.6, "--damping-ns-per-m", 3)
    told = ask("settle", *flags)
    assert vi.settle(osc).to_dict()["motion"] == told["motion"] and osc.units is not None
    assert (osc.units.length_m, osc.units.time_s) == (told["system"]["scales"]["length_m"], told["system"]["scales"]["time_s"])


@pytest.mark.parametrize("label", ["1/1", "2/1", "1/2", "inf/1"])
def test_orbits(ask: Callable[..., Any], label: str) -> None:
    osc = vi.Oscillator(inverse_beta=0.7, gap=2, restitution=0.5)
    told = ask("orbit", "--inverse-beta", 0.7, "--gap", 2, "--restitution", 0.5, "--label", label)
    assert [orbit.to_dict() for orbit in vi.orbits(osc, label)] == told["orbits"]


def test_branch(ask: Callable[..., Any]) -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    told = ask("branch", "--inverse-beta", 1.11, "--gap", 1.5, "--restitution", 0.5, "--label", "1/1", "--vary", "gap",
               "--to", 2.5, "--follow", 2)
    found = vi.branch(osc, "gap", 2.5, label="1/1", follow=2).to_dict()
    assert len(found["branches"]) == len(told["branches"]) > 1
    assert found == {name: told[name] for name in found}


def test_branch_of_an_orbit_that_rests(ask: Callable[..., Any]) -> None:
    told = ask("branch", "--inverse-beta", 1.11, "--gap", -0.5, "--restitution", 0.5, "--label", "inf/1", "--vary", "gap",
               "--to", -0.2)
    found = vi.branch(vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5), "gap", -0.2, label="inf/1")
    assert found.events[-1].kind == "end of rest" and found.cycles[0].kind.tolist().count("release") == 1
    assert found.to_dict() == {name: told[name] for name in found.to_dict()}


def test_curve(ask: Callable[..., Any]) -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    told = ask("curve", "--inverse-beta", 1.11, "--gap", 1.5, "--restitution", 0.5, "--label", "1/1", "--kind", "flip",
               "--vary", "gap=0:3", "--and", "inverse-beta=1.05:1.2")
    found = vi.curve(osc, "flip", {"gap": (0, 3), "inverse_beta": (1.05, 1.2)}, label="1/1")
    assert found.to_dict() == {name: told[name] for name in found.to_dict()} and json.loads(found.plan) == told["plan"]


def test_region(ask: Callable[..., Any]) -> None:
    osc = vi.Oscillator(beta=1, gap=0, restitution=0.5)
    told = ask("region", "--label", "1/1", "--inverse-beta", "0.6:0.9", "--gap", "1:3", "--restitution", 0.5, "--grid", 8)
    found = vi.region(osc, "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=8).to_dict()
    assert found == {name: told[name] for name in found}


def test_margins(ask: Callable[..., Any]) -> None:
    for gap, damping in ((1.5, 0.01), (3.0, 0.0), (-0.5, 0.0)):
        told = ask("margins", "--inverse-beta", 1.11, "--gap", gap, "--restitution", 0.5, "--damping", damping, "--lines", 20)
        found = vi.margins(vi.Oscillator(inverse_beta=1.11, gap=gap, restitution=0.5, damping=damping), lines=20)
        assert found.to_dict() == {name: told[name] for name in found.to_dict()} and json.loads(found.plan) == told["plan"]


@pytest.mark.parametrize(("osc", "flags"), SYSTEMS[:5], ids=lambda of: repr(of) if isinstance(of, vi.Oscillator) else "")
def test_lyapunov(ask: Callable[..., Any], osc: vi.Oscillator, flags: tuple[object, ...]) -> None:
    told = ask("lyapunov", *flags, "--impacts", 5000)
    found = vi.lyapunov(osc, impacts=5000)
    assert found.to_dict() == {name: told[name] for name in found.to_dict()} and json.loads(found.plan) == told["plan"]


@pytest.mark.parametrize("show", ["velocity", "strobe"])
def test_diagram(vibro: Callable[..., Any], show: str) -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0, restitution=0.5)
    ds = vi.orbit_diagram(osc, "gap", "0:3:31", show=show)
    told = vibro("diagram", "--inverse-beta", 1.3, "--restitution", 0.5, "--vary", "gap", "--over", "0:3:31", "--show", show,
                 "--csv", "-")
    head, *rows = [line.split(",") for line in told.stdout.splitlines()]
    columns = ("phase", "speed") if show == "velocity" else ("x", "v")
    places = [head.index(name) for name in columns]
    told_points = [(r[1], float(r[0]), *(float(r[k]) for k in places)) for r in rows if r[places[0]] != ""]
    found = []
    # a sweep down begins at the largest value
    names = ("impact_phase", "velocity") if show == "velocity" else columns
    for sweep, order in (("up", 1), ("down", -1)):
        one = ds.sel(sweep=order).isel(gap=slice(None, None, order))
        for gap, a, b in zip(one["gap"].values, *(one[name].values for name in names)):
            found += [(sweep, float(gap), float(x), float(y)) for x, y in zip(a, b) if np.isfinite(x)]
    assert found == told_points and len(found) > 100
