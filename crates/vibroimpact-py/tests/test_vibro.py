"""The command `vibro` that the package installs."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import vibroimpact as vi
from vibroimpact.__main__ import vibro as main

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


def test_job_scripts_name_it_and_exports_use_its_python(script: Path, s: vi.Oscillator, tmp_path: Path) -> None:
    pytest.importorskip("zarr", minversion="3")
    pytest.importorskip("pyarrow")
    plan = vi.Plan.basin(s, {"x": [-1.0, 0.0], "v": [0.0, 1.0]})
    file, store, table = tmp_path / "plan.json", tmp_path / "basin.zarr", tmp_path / "basin.parquet"
    file.write_text(plan.json)
    made = run(script, "slurm", file, "--jobs", 1, "--time", "01:00:00", "--store", store)
    assert made.returncode == 0 and f"exec {script} run " in made.stdout.replace("'", "")
    assert vi.run(plan, store).left == 0
    done = run(script, "export", store, "--parquet", table)
    assert done.returncode == 0 and table.is_file(), done.stderr
