"""The example notebook runs without changes, and contains no outputs."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("ipykernel", reason="the notebook needs ipykernel")
nbclient = pytest.importorskip("nbclient", reason="the notebook needs nbclient")
nbformat = pytest.importorskip("nbformat", reason="the notebook needs nbformat")


@pytest.mark.filterwarnings("ignore")
def test_the_notebook_runs(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # a kernel of this Python, whichever kernels are registered
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    monkeypatch.delenv("MPLBACKEND", raising=False)
    kernel = tmp_path / "kernels/here"
    kernel.mkdir(parents=True)
    command = f'["{sys.executable}", "-m", "ipykernel_launcher", "-f", "{{connection_file}}"]'
    (kernel / "kernel.json").write_text(f'{{"argv": {command}, "display_name": "here", "language": "python"}}')
    book = nbformat.read(root / "examples/rattling-part.ipynb", as_version=4)
    nbformat.validate(book)
    cells = [cell for cell in book.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells)
    where = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(book, timeout=60, kernel_name="here", resources=where).execute()
    told = "".join(out.text for cell in cells for out in cell.outputs if out.output_type == "stream" and out.name == "stdout")
    figures = [out for cell in cells for out in cell.outputs if "image/png" in out.get("data", {})]
    # the statements in the text of the notebook
    assert "one length is 5 mm" in told and "<Settled 2/1, stable>" in told and "flip at a gap of" in told
    assert "falling: at most 0.82 m/s at 15.15 Hz, 1/1" in told and "rising: at most 2.63 W at 15.90 Hz" in told
    assert len(figures) == 6 and all(len(out.data["image/png"]) > 10_000 for out in figures)
