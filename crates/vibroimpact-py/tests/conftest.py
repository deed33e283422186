"""Common fixtures of the tests: points of the 1971 paper, the command, and closing of figures."""

import os
import subprocess
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
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


def _colours_at(ax: Any, xs: Iterable[float], y: float) -> set[str]:
    """The colours of the cells of a figure at some places of a row."""
    from matplotlib.collections import QuadMesh
    from matplotlib.colors import to_hex

    found = set()
    for x in xs:
        for drawn in reversed(ax.collections):
            if isinstance(drawn, QuadMesh):
                corners, values = np.asarray(drawn.get_coordinates()), np.ma.asarray(drawn.get_array())
                across, up = np.sort(corners[0, :, 0]), np.sort(corners[:, 0, 1])
                column, row = np.searchsorted(across, x) - 1, np.searchsorted(up, y) - 1
                if not (0 <= column < values.shape[1] and 0 <= row < values.shape[0]):
                    continue
                column = column if corners[0, 0, 0] < corners[0, -1, 0] else values.shape[1] - 1 - column
                row = row if corners[0, 0, 1] < corners[-1, 0, 1] else values.shape[0] - 1 - row
                if values[row, column] is not np.ma.masked:
                    found.add(to_hex(drawn.to_rgba(values[row, column])))
                    break
            elif any(path.contains_point((x, y)) for path in drawn.get_paths()):
                found.add(to_hex(drawn.get_facecolor()[0]))
                break
    return found


@pytest.fixture(scope="session")
def colours_at() -> Callable[[Any, Iterable[float], float], set[str]]:
    return _colours_at


@pytest.fixture(autouse=True)
def _closed_figures() -> Iterator[None]:
    yield
    import matplotlib.pyplot as plt

    plt.close("all")
