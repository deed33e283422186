"""The package as a whole: time of import, types, and examples in the documentation."""

import doctest
import importlib
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import vibroimpact as vi


def test_importing_drags_nothing_in() -> None:
    program = """
import sys
import vibroimpact
print(*sorted({"xarray", "matplotlib", "pandas", "zarr", "tqdm", "dask"} & set(sys.modules)))
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""


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


def test_the_types_of_questions_are_those_of_plans(root: Path) -> None:
    done = subprocess.run([sys.executable, "crates/vibroimpact-py/generate.py", "--check"], cwd=root, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


#: The stubs are compared with what is compiled, for which types of other packages play no part.
STUBBED = ["vibroimpact._core", "vibroimpact._questions", "vibroimpact._continuation", "vibroimpact._grids"]
STUBS = ["mypy.stubtest", "--mypy-config-file", "crates/vibroimpact-py/stubtest.ini", *STUBBED]
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
