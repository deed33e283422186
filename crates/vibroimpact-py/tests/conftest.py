"""Common fixtures of the tests: points of the 1971 paper, the command, and closing of figures."""

import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib
import pytest

matplotlib.use("Agg")

import vibroimpact as vi  # noqa: E402

ROOT = Path(__file__).resolve().parents[3]


#: Tests that wait for other programs come first, so that the others run beside them.
WAITING = ("test_slurm.py", "test_dask.py")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=lambda item: item.path.name not in WAITING)


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture
def n() -> vi.Oscillator:
    """Point N of the 1971 paper: 4/1."""
    return vi.Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)


@pytest.fixture
def s() -> vi.Oscillator:
    """Point S: 2/1 and 1/1."""
    return vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)


@pytest.fixture
def u() -> vi.Oscillator:
    """Point U: chaos."""
    return vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5)


@pytest.fixture(scope="session")
def vibro() -> Callable[..., subprocess.CompletedProcess[str]]:
    """The command from the latest build of cargo."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    built = [path for path in (target / "debug/vibro", target / "release/vibro") if path.is_file()]
    if "VIBRO" in os.environ:
        built = [Path(os.environ["VIBRO"])]
    if not built:
        pytest.skip("the command is not built: cargo build -p vibroimpact-cli")
    program = max(built, key=lambda path: path.stat().st_mtime)

    def run(*words: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=120)

    return run


@pytest.fixture(autouse=True)
def _closed_figures() -> Iterator[None]:
    yield
    import matplotlib.pyplot as plt

    plt.close("all")
