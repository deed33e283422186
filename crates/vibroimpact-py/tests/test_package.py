"""The package as a whole: time of import, types, and examples in the documentation."""

import doctest
import importlib
import inspect
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import vibroimpact as vi
from vibroimpact._documented import fields_of


def test_every_name_is_documented() -> None:
    for name in vi.__all__:
        of = getattr(vi, name)
        assert name == "__version__" or (of.__doc__ and len(of.__doc__) > 15), name
    calls = [name for name in vi.__all__ if name.islower() and name != "__version__"]
    assert len(calls) >= 10 and all(">>> " in getattr(vi, name).__doc__ for name in calls)


def test_examples_in_the_documentation_are_true() -> None:
    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    modules = [vi, *(importlib.import_module(f"vibroimpact.{of.name}") for of in pkgutil.iter_modules(vi.__path__))]
    tested = set()
    for module in modules:
        for test in finder.find(module):
            runner.run(test)
            tested.add(test.name)
    assert runner.summarize(verbose=False).failed == 0
    assert {"vibroimpact._oscillator.Oscillator", "vibroimpact._oscillator.Oscillator.from_units", "vibroimpact"} <= tested


def listings(path: Path) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```$", path.read_text(), re.S | re.M)


@pytest.mark.filterwarnings("ignore")
def test_listings_run_as_typed(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.chdir(tmp_path)
    pages = [root / "README.md", root / "docs/python.md", root / "docs/machines.md"]
    found = {page.name: listings(page) for page in pages}
    assert all(found.values()), found.keys()
    for page, texts in found.items():
        # the listings of a page run in one session
        names: dict[str, object] = {}
        for text in texts:
            if ">>> " in text:
                examples = doctest.DocTestParser().get_doctest(text, names, page, page, 0)
                runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
                runner.run(examples, clear_globs=False)
                names = examples.globs
                assert runner.summarize(verbose=False).failed == 0
            else:
                exec(compile(text, page, "exec"), names)


#: The functions that ask for each task.
QUESTIONS: dict[str, list[Callable[..., Any]]] = {
    "simulate": [vi.simulate], "settle": [vi.settle], "orbit": [vi.orbits], "edge": [vi.edge], "branch": [vi.branch], "curve": [vi.curve],
    "region": [vi.region], "response": [vi.response], "margins": [vi.margins], "attractors": [vi.attractors, vi.Plan.attractors],
    "lyapunov": [vi.lyapunov, vi.Plan.lyapunov], "basin": [vi.basin, vi.Plan.basin], "map": [vi.region_map, vi.Plan.map],
    "diagram": [vi.orbit_diagram, vi.Plan.diagram],
}
#: Arguments that are no fields of a task, and those that stand for other fields of it.
COMMON = {"system", "x", "v", "q", "qdot", "phase", "threads", "progress", "store", "client", "tile"}
SPELLED = {
    ("branch", "to"): ["to", "back"], ("curve", "over"): ["vary", "and"], ("region", "over"): ["across", "up"], ("margins", "scale"): ["vary"],
    ("edge", "other"): ["other"],
    ("diagram", "starts"): ["direction"], ("diagram", "seed"): ["direction"], **{(task, "over"): ["axes"] for task in ("basin", "map", "lyapunov")},
}
#: Fields for which other functions have arguments, and a default that is not that of plans.
ELSEWHERE, OWN = {"basin": {"points", "transient"}, "lyapunov": {"axes", "points"}}, ("map", "seed")
KINDS = {"integer": "SupportsIndex", "number": "float", "string": "str", "array": "Sequence"}


@pytest.mark.parametrize("task", QUESTIONS)
def test_arguments_are_the_fields_of_plans(task: str) -> None:
    fields = fields_of(task)
    for function in QUESTIONS[task]:
        seen = {"start", *ELSEWHERE.get(task, ())}
        for name, of in inspect.signature(function).parameters.items():
            seen |= (names := {*SPELLED.get((task, name), [name])})
            assert names <= fields.keys() or name in COMMON, name
            field = fields.get(name, {})
            assert of.default in (of.empty, None, (), field.get("default", of.default)) or (task, name) == OWN, name
            kind = field.get("type")
            kind = KINDS.get(kind if isinstance(kind, str) or kind is None else kind[0], "")
            assert of.annotation.startswith(kind) or (task, name) in SPELLED, (name, of.annotation)
        assert fields.keys() <= seen


#: The stub is compared with what is compiled, for which types of other packages play no part.
STUBS = ["mypy.stubtest", "--mypy-config-file", "crates/vibroimpact-py/stubtest.ini", "vibroimpact._core"]
STUBS += ["--allowlist", "crates/vibroimpact-py/stubtest.allow"]
TOOLS = [STUBS, ["mypy"], ["mypy", "--python-version", "3.10"]]
#: Those of the long run only: what holds for the oldest Python hardly ever fails for a newer one.
LONG = ["mypy"]


@pytest.mark.parametrize("tool", TOOLS, ids=["stubs", "types", "oldest"])
def test_types_are_true(root: Path, tool: list[str]) -> None:
    pytest.importorskip("mypy")
    if tool == LONG and os.environ.get("VIBROIMPACT_LONG") != "1":
        pytest.skip("as with the oldest Python; VIBROIMPACT_LONG=1 runs it")
    done = subprocess.run([sys.executable, "-m", *tool], cwd=root, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_types_are_true_for_pyright(root: Path) -> None:
    """Pyright is a program of npm: `npm install --global pyright`. The long run fetches it."""
    words = ["pyright"] if shutil.which("pyright") else ["npx", "--yes", "pyright@1.1.414"]
    if words[0] == "npx" and not (shutil.which("npx") and os.environ.get("VIBROIMPACT_LONG") == "1"):
        pytest.skip("there is no pyright: npm install --global pyright; VIBROIMPACT_LONG=1 fetches it")
    done = subprocess.run(words, cwd=root, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
