"""Answers in Python are those of the command, to the last bit: each call beside its command line. Both write them with one function.

And the command `vibro` that the package installs.
"""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import _core
from vibroimpact.__main__ import vibro as main

SYSTEMS = {
    "--inverse-beta 1.3 --gap 0.75 --restitution 0.5": vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5),
    "--inverse-beta 1.11 --gap 3 --restitution 0.5": vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5),
    "--beta 0.9 --gap -1.5 --restitution 0.5": vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5),
    "--inverse-beta 1.11 --gap -0.5 --restitution 0.5": vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5),
    "--beta 0.5 --gap 40 --restitution 0.5": vi.Oscillator(beta=0.5, gap=40, restitution=0.5),
    "--beta 1.1 --gap 1 --restitution 0.7 --damping 0.01 --second-gap 0.5 --second-restitution 0.4": vi.Oscillator(
        beta=1.1, gap=1, restitution=0.7, damping=0.01, second_gap=0.5, second_restitution=0.4
    ),
    "--mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 2.5 --gap-m 0.003 --restitution 0.6 --damping-ns-per-m 3":
        vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6, damping=3),
    "--machine two-mass-hammer --set frequency=1.06": vi.Machine.named("two-mass-hammer").set(frequency=1.06),
}
S, U, STUCK, RESTING, _, TWO, BODY, HAMMER = SYSTEMS
SLOW = "--inverse-beta 0.7 --gap 2 --restitution 0.5"
FLIPS = "--inverse-beta 1.11 --gap 1.5 --restitution 0.5"
SYSTEMS[SLOW] = vi.Oscillator(inverse_beta=0.7, gap=2, restitution=0.5)
SYSTEMS[FLIPS] = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)

#: System, the command without it, and the call.
CALLS: list[tuple[str, str, Callable[[Any], Any]]] = [
    *((system, "settle", vi.settle) for system in SYSTEMS),
    *((system, "simulate --impacts 60", lambda of: vi.simulate(of, impacts=60)) for system in (STUCK, RESTING, TWO, BODY, HAMMER)),
    *((system, "attractors --starts 20", lambda of: vi.attractors(of, starts=20)) for system in (S, TWO, BODY, HAMMER)),
    *((system, "lyapunov --impacts 5000", lambda of: vi.lyapunov(of, impacts=5000)) for system in (U, STUCK, HAMMER)),
    *((system, "margins --lines 4", lambda of: vi.margins(of, lines=4)) for system in (FLIPS, U)),
    *((SLOW, f"orbit --label {label}", lambda of, label=label: vi.orbits(of, label)) for label in ("1/1", "inf/1")),
    *((system, "simulate --time 25", lambda of: vi.simulate(of, time=25)) for system in (S, HAMMER)),
    (S, "settle --v 0.5 --phase 1", lambda of: vi.settle(of, v=0.5, phase=1)),
    (HAMMER, "settle --q 0.1,0 --phase 1", lambda of: vi.settle(of, q=[0.1, 0], phase=1)),
    (HAMMER, "orbit --label 1/1", lambda of: vi.orbits(of, "1/1")),
    (FLIPS, "branch --label 1/1 --vary gap --to 2.5 --follow 2", lambda of: vi.branch(of, "gap", 2.5, label="1/1", follow=2)),
    (RESTING, "branch --label inf/1 --vary gap --to -0.2", lambda of: vi.branch(of, "gap", -0.2, label="inf/1")),
    (HAMMER, "branch --vary b --to 0.6", lambda of: vi.branch(of, "b", 0.6)),
    (FLIPS, "curve --label 1/1 --kind flip --vary gap=0:3 --and inverse-beta=1.05:1.2",
     lambda of: vi.curve(of, "flip", {"gap": (0, 3), "inverse_beta": (1.05, 1.2)}, label="1/1")),
    (HAMMER, "curve --label 2/1 --kind fold --vary frequency=0.9:1.2 --and b=0.3:0.7 --points 5",
     lambda of: vi.curve(of, "fold", {"frequency": (0.9, 1.2), "b": (0.3, 0.7)}, label="2/1", points=5)),
    ("--restitution 0.5", "region --label 1/1 --inverse-beta 0.6:0.9 --gap 1:3 --grid 8",
     lambda _: vi.region(SYSTEMS[S], "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=8)),
]


@pytest.mark.parametrize(("system", "command", "call"), CALLS, ids=lambda of: of if isinstance(of, str) else "")
def test_answers(vibro: Callable[..., Any], system: str, command: str, call: Callable[[Any], Any]) -> None:
    done = vibro(*command.split(), *system.split(), "--json")
    assert done.returncode == 0, done.stderr
    found, told = call(SYSTEMS.get(system)).to_dict(), json.loads(done.stdout)
    if system in (BODY, HAMMER):
        # Python knows the numbers of these systems, not how they were given
        for answer in (found, told):
            answer["plan"] = answer["plan"]["task"]
            del answer["system"]
    assert found == told


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


def test_a_contact_is_that_of_the_command(vibro: Callable[..., Any]) -> None:
    told = json.loads(vibro("contact", "--restitution", 0.6, "--mass-kg", 0.8, "--stiffness-n-per-m", 2e5, "--json").stdout)
    found = vi.contact(restitution=0.6, mass=0.8, stiffness=2e5)
    assert found.to_dict() == told and found == vi.contact(restitution=0.6, mass=0.8, stiffness=2e5)
    assert len(found.to_dataframe()) == 2 and found.to_xarray()["contact_time"].values.tolist() == found.contact_time.tolist()
    assert found.plot().get_ylabel() == "contact force (N)" and np.isnan(vi.contact(damping_ratio=1.2, mass=1, stiffness=10).contact_time[1])
    for given, sentence in (({"mass": 1, "stiffness": 5}, "hint: restitution, damping or damping_ratio"), ({"opening": "late"}, "unknown variant")):
        with pytest.raises(vi.QuestionError, match=sentence):
            vi.contact(**given)


#: What the script of the package does, as pip writes it.
SCRIPT = "#!{python}\nimport sys\nfrom vibroimpact.__main__ import vibro\nsys.exit(vibro())\n"


@pytest.fixture
def script(tmp_path: Path) -> Path:
    file = tmp_path / "vibro"
    file.write_text(SCRIPT.format(python=sys.executable))
    file.chmod(0o755)
    return file


def run(*words: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=120)


SETTLE = ("settle", "--inverse-beta", 1.8, "--gap", 0.25, "--restitution", 0.5)


def test_it_is_declared(root: Path) -> None:
    assert 'vibro = "vibroimpact.__main__:vibro"' in (root / "pyproject.toml").read_text()


def test_it_answers_as_the_program(
    script: Path, vibro: Callable[..., "subprocess.CompletedProcess[str]"], monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    for words in ((*SETTLE, "--json"), SETTLE, ("--version",), ("settle", "--gap", 1), ("orbit", "--help"), ("nothing",)):
        other = vibro(*words)
        monkeypatch.setattr(sys, "argv", [str(script), *map(str, words)])
        code = main()
        said = capfd.readouterr()
        assert (code, said.out, said.err) == (other.returncode, other.stdout, other.stderr)
    assert run(script, "--version").stdout.strip() == f"vibro {vi.__version__}"


def test_job_scripts_name_it_and_exports_use_its_python(
    script: Path, s: vi.Oscillator, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = vi.Plan.basin(s, {"x": [-1.0, 0.0], "v": [0.0, 1.0]})
    file, store = tmp_path / "plan.json", tmp_path / "basin.zarr"
    file.write_text(plan.json)
    made = run(script, "slurm", file, "--jobs", 1, "--time", "01:00:00", "--store", store)
    assert made.returncode == 0 and f"exec {script} run " in made.stdout.replace("'", "")
    # the command is told the Python that writes; that it asks this Python is tested in `test_export.py`
    said: list[object] = []
    monkeypatch.setattr(_core, "vibro", lambda *given: said.append(given) or 0)
    words = ["export", str(store), "--parquet", "basin.parquet"]
    monkeypatch.setattr(sys, "argv", [str(script), *words])
    assert main() == 0 and said == [(["vibro", *words, "--python", sys.executable], str(script))]
