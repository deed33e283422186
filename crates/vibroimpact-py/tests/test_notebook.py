"""The example notebook runs without changes, and contains no outputs."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import pytest


@pytest.mark.filterwarnings("ignore")
def test_the_notebook_runs(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its cells run in this process, without the kernel of a notebook, which takes longer to start than they take."""
    book = json.loads((root / "examples/rattling-part.ipynb").read_text())
    cells = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in cells)
    names: dict[str, object] = {}
    for cell in cells:
        exec("".join(line for line in cell["source"] if not line.startswith("%matplotlib")), names)
    told = capsys.readouterr().out
    # the statements in the text of the notebook
    assert "one length is 5 mm" in told and "<Settled 2/1, stable>" in told and "flip at a gap of" in told
    assert "falling: at most 0.82 m/s at 15.15 Hz, 1/1" in told and "rising: at most 2.63 W at 15.90 Hz" in told
    assert len(plt.get_fignums()) == 6
    for number in plt.get_fignums():
        plt.figure(number).canvas.draw()
