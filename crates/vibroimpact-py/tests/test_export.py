"""Stores in other formats: the values read back are those of the store."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact import _export, _store
from vibroimpact.__main__ import main

pd = pytest.importorskip("pandas")

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")

KINDS = ["map", "basin", "attractors", "lyapunov", "diagram"]
#: Columns of words of an orbit diagram, where the Dataset has codes.
WORDS = ("sweep", "kind", "stop")


@pytest.fixture(params=KINDS)
def store(request: pytest.FixtureRequest, s: vi.Oscillator, u: vi.Oscillator, tmp_path: Path) -> Path:
    plans = {
        "map": lambda: vi.Plan.map(s, {"inverse_beta": "1:1.5:6", "gap": [0.25, 0.5, 1.0]}, starts=6, tile=3),
        "basin": lambda: vi.Plan.basin(s, {"x": "-4:0.75:9", "v": "-4:4.5:7"}, refine=4),
        "attractors": lambda: vi.Plan.attractors(s, 20),
        "lyapunov": lambda: vi.Plan.lyapunov(u, {"gap": "2.8:3:3"}, impacts=2000),
        "diagram": lambda: vi.Plan.diagram(s, "gap", "0.5:1:5"),
    }
    place = tmp_path / f"{request.param}.zarr"
    vi.run(plans[request.param](), place)
    return place


@pytest.mark.parametrize("engine", ["netcdf4", "h5netcdf", "scipy"])
def test_netcdf_holds_all_arrays(store: Path, engine: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    modules = _export._ENGINES[engine]
    for module in modules:
        pytest.importorskip(module)
    monkeypatch.setattr(_export, "_ENGINES", {engine: modules})
    assert main(["export", str(store), "--format", "netcdf", str(tmp_path / "out.nc")]) == 0
    with xr.open_dataset(tmp_path / "out.nc", engine=engine) as file:
        read = file.load()
    kept = _store.with_status(store).load()
    assert set(read.variables) == set(kept.variables)
    for name, of in kept.variables.items():
        assert read[name].dims == of.dims, name
        np.testing.assert_array_equal(read[name].values.astype(of.dtype), of.values, err_msg=str(name))
        assert read[name].dtype == of.dtype or of.dtype.kind == "T", name
        assert {**read[name].attrs, "flag_values": 0} == {**of.attrs, "flag_values": 0}, name
        np.testing.assert_array_equal(read[name].attrs.get("flag_values", 0), of.attrs.get("flag_values", 0))
        assert np.asarray(read[name].attrs.get("flag_values", of.dtype.type() if of.dtype.kind == "i" else 0)).dtype.kind == "i"
    assert read.attrs == kept.attrs and vi.Plan(read.attrs["plan"]).hash == read.attrs["plan_hash"]
    if "label" in kept or "kind" in kept:
        xr.testing.assert_equal(read.vibro.labels(), kept.vibro.labels())
    if "cycle_label" in kept:
        assert read["cycle_label"].values.tolist() == kept["cycle_label"].values.tolist() != []


def test_the_conventions_are_kept(store: Path, tmp_path: Path) -> None:
    """The checker of IOOS finds nothing; in the long run it is fetched."""
    if shutil.which("compliance-checker"):
        words = ["compliance-checker"]
    elif os.environ.get("VIBROIMPACT_LONG") == "1":
        words = [sys.executable, "-m", "uv", "tool", "run", "--from", "compliance-checker==6.1.0", "compliance-checker"]
    else:
        pytest.skip("there is no compliance-checker: pip install compliance-checker; VIBROIMPACT_LONG=1 fetches it")
    assert main(["export", str(store), "--format", "netcdf", str(tmp_path / "out.nc")]) == 0
    done = subprocess.run([*words, "--test=cf:1.11", "--criteria=strict", tmp_path / "out.nc"], capture_output=True, text=True)
    assert done.returncode == 0 and "All tests passed!" in done.stdout, done.stdout + done.stderr


def test_parquet_holds_the_table(store: Path, tmp_path: Path) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    assert main(["export", str(store), "--format", "parquet", str(tmp_path / "out.parquet")]) == 0
    kept = _store.with_status(store).load()
    told = {name.decode(): text.decode() for name, text in pq.read_schema(tmp_path / "out.parquet").metadata.items()}
    assert vi.Plan(told["plan"]).hash == told["plan_hash"] == kept.attrs["plan_hash"] and told["title"] == kept.attrs["title"]
    units = {f.name: (f.metadata or {}).get(b"units", b"").decode() for f in pq.read_schema(tmp_path / "out.parquet")}
    said = {name: of for name, of in units.items() if name in kept.variables and not (store.stem == "diagram" and name in WORDS)}
    assert said == {name: kept[name].attrs["units"] for name in said} and len(said) > (store.stem != "diagram")
    if store.stem == "diagram":
        assert units["phase"] == "rad" and not any(units[name] for name in WORDS)
    read = pd.read_parquet(tmp_path / "out.parquet")
    # CSV is that of the command, whose numbers are those of the Dataset
    assert main(["export", str(store), "--format", "csv", str(tmp_path / "out.csv")]) == 0
    pd.testing.assert_frame_equal(read, pd.read_csv(tmp_path / "out.csv"), check_exact=True, check_dtype=False)
    if store.stem == "diagram":
        speeds = kept["velocity"].values
        assert sorted(read["speed"].dropna()) == sorted(speeds[np.isfinite(speeds)].tolist())
    if "motion" in kept.dims:
        for row in read.itertuples():
            here = kept.sel(gap=row.gap, inverse_beta=row.inverse_beta)
            places = np.flatnonzero(here["share"].values == row.share)
            assert row.label in here.vibro.labels().values[places]
        assert len(read) == int((kept["share"] > 0).sum()) > kept.sizes["gap"] * kept.sizes["inverse_beta"]


def test_a_study_of_a_body_is_in_its_units(tmp_path: Path) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6)
    vi.run(vi.Plan.basin(osc, {"x": [-1.0, 0.0]}, fields=["power"]), tmp_path / "body.zarr")
    assert main(["export", str(tmp_path / "body.zarr"), "--format", "parquet", str(tmp_path / "out.parquet")]) == 0
    read = pq.read_table(tmp_path / "out.parquet")
    assert read["x_m"].to_pylist() == [-0.005, 0.0] and read.schema.field("power_w").metadata[b"units"] == b"W"


def test_the_command_asks_for_it(s: vi.Oscillator, vibro: Callable[..., Any], tmp_path: Path) -> None:
    """By `python -m vibroimpact export`, here with a program that says how it was called."""
    store, file, python = tmp_path / "one.zarr", tmp_path / "one.nc", tmp_path / "python"
    vi.run(vi.Plan.basin(s, {"x": "-4:0.75:9"}), store)
    file.touch()
    python.write_text('#!/bin/sh\necho "$@" > "$7"\n')
    python.chmod(0o755)
    words = ("export", store, "--netcdf", file, "--python", python)
    assert vibro(*words).returncode == 2
    done = vibro(*words, "--force")
    assert done.returncode == 0 and file.read_text() == f"-m vibroimpact export {store} --format netcdf {file}\n", done.stderr


def test_refusals(s: vi.Oscillator, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def said(*words: object) -> str:
        assert main(["export", *map(str, words)]) == 1
        return capsys.readouterr().err

    assert "there is no store at" in said(tmp_path / "none.zarr", "--format", "csv", tmp_path / "x")
    place = tmp_path / "one.zarr"
    vi.run(vi.Plan.basin(s, {"x": "-4:0.75:9"}), place)
    assert "error: there is no folder" in said(place, "--format", "csv", tmp_path / "no/x.csv")
    monkeypatch.setattr(_export, "find_spec", lambda name: None)
    assert "error: writing Parquet needs pyarrow" in said(place, "--format", "parquet", tmp_path / "x.parquet")
    assert "needs netCDF4, h5netcdf or scipy, and none of them is installed" in said(place, "--format", "netcdf", tmp_path / "x.nc")
    assert sorted(of.name for of in tmp_path.iterdir()) == ["one.zarr", "one.zarr.costs"]
    with pytest.raises(vi.QuestionError, match="format = `xls` is none of netcdf, parquet, csv"):
        _export.export(place, tmp_path / "x", "xls")


def test_without_zarr_a_store_says_what_is_missing(
    s: vi.Oscillator, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import importlib.metadata

    vi.run(vi.Plan.basin(s, {"x": "-4:0.75:9"}), tmp_path / "one.zarr")
    monkeypatch.setattr(importlib.metadata, "version", lambda name: "2.18.3")
    with pytest.raises(ImportError, match=r"needs zarr 3 or later, and zarr 2.18.3 is installed\nhint: pip install 'zarr>=3'"):
        vi.open(tmp_path / "one.zarr")
