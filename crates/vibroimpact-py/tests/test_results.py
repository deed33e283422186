"""What all results have: equality of values, dicts, tables, pictures in notebooks; and the accessor of Datasets."""

import base64
import copy
import json
import pickle
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

OSC = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
HAMMER = vi.Machine.named("two-mass-hammer")
RESULTS: dict[str, Callable[[], Any]] = {
    "simulation": lambda: vi.simulate(OSC, impacts=12),
    "motion": lambda: vi.settle(OSC),
    "cycle": lambda: vi.settle(OSC).cycle,
    "attractors": lambda: vi.attractors(OSC, starts=12),
    "settlement": lambda: vi.settle_many(OSC, [0.0, 1.0]),
    "orbit": lambda: vi.orbits(OSC, "1/1")[0],
    "branch": lambda: vi.branch(OSC, "gap", 2.0, label="1/1"),
    "curve": lambda: vi.curve(OSC, "flip", {"gap": (1, 3), "inverse_beta": (1.05, 1.2)}, label="1/1"),
    "region": lambda: vi.region(OSC, "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=4),
    "response": lambda: vi.response(OSC, "gap", "1:2:3"),
    "lyapunov": lambda: vi.lyapunov(OSC, impacts=1000, points=20),
    "margins": lambda: vi.margins(OSC, vary=["gap"], lines=4),
    "machine simulation": lambda: HAMMER.simulate(impacts=6),
    "machine settled": lambda: HAMMER.settle(),
    "machine motion": lambda: HAMMER.settle().motion,
    "machine attractors": lambda: HAMMER.attractors(4),
    "machine lyapunov": lambda: HAMMER.lyapunov(impacts=200),
    "machine orbits": lambda: HAMMER.orbits("1/1"),
    "machine branch": lambda: HAMMER.branch("frequency", 1.05),
    "machine curve": lambda: HAMMER.curve("grazing", {"frequency": (0.9, 1.3), "b": (0.4, 0.6)}, points=5),
    "machine response": lambda: HAMMER.response("frequency", "1.1:1.2:3"),
    "machine margins": lambda: HAMMER.margins(vary=["frequency"]),
}
#: Results without a figure.
NO_PICTURE = {"cycle"}


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_values(name: str) -> None:
    pd = pytest.importorskip("pandas")
    one, same = RESULTS[name](), RESULTS[name]()
    assert one is not same and one == same and not one != same
    again = pickle.loads(pickle.dumps(one))
    assert again == one and repr(again) == repr(one) and copy.deepcopy(one) == one
    assert one != "another thing" and one != vi.simulate(OSC, impacts=3)
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)
    table = one.to_dataframe()
    assert isinstance(table, pd.DataFrame) and len(table) > 0 and len(set(table.columns)) == len(table.columns)
    if name != "cycle":
        assert json.loads(json.dumps(one.to_dict())) and again.to_dict() == one.to_dict()
        assert name == "settlement" or getattr(again, "plan", None) == getattr(one, "plan", None)
    html = one._repr_html_()
    assert html.startswith("<pre>&lt;" if "cycle" != name else "<pre>") and ("<img" in html) is (name not in NO_PICTURE)
    if "<img" in html:
        picture = base64.b64decode(html.split("base64,")[1].split('"')[0])
        assert picture.startswith(b"\x89PNG") and len(picture) < 100_000
    import matplotlib.pyplot as plt

    assert not plt.get_fignums()


@pytest.mark.parametrize("name", ["branch", "settlement", "machine simulation"])
def test_results_from_pickles_are_drawn(name: str) -> None:
    one = RESULTS[name]()
    lines = [np.atleast_1d(of.plot())[0].get_lines() for of in (one, pickle.loads(pickle.dumps(one)))]
    assert len(lines[0]) == len(lines[1])
    for a, b in zip(*lines):
        np.testing.assert_array_equal(a.get_ydata(), b.get_ydata())


def test_other_values_are_other_results() -> None:
    assert vi.simulate(OSC, impacts=5) != vi.simulate(OSC, impacts=6)
    assert vi.branch(OSC, "gap", 2.0, label="1/1") != vi.branch(OSC, "gap", 2.1, label="1/1")
    assert HAMMER.settle() != HAMMER.set({"frequency": 1.05}).settle()
    # not-a-number equals itself: only a stick has an error
    pressed = vi.simulate(vi.Oscillator(beta=0.9, gap=-0.5, restitution=0.5), impacts=20)
    assert np.isnan(pressed.error).any() and pressed == vi.simulate(pressed.system, impacts=20)


def test_results_that_have_no_figure_show_their_text() -> None:
    silent = vi.settle(vi.Oscillator(beta=0.5, gap=9, restitution=0.5))
    assert silent._repr_html_() == "<pre>&lt;Settled 0, neutral&gt;</pre>"


def test_importing_drags_nothing_in_and_the_accessor_is_there_whoever_is_imported_first() -> None:
    code = """
import sys
import vibroimpact
print({"xarray", "matplotlib", "pandas", "zarr", "tqdm", "dask"}.isdisjoint(sys.modules))
import xarray
print(isinstance(xarray.Dataset().vibro, vibroimpact.VibroAccessor))
for name in [name for name in sys.modules if name.startswith("vibroimpact") and name != "vibroimpact._core"]:
    del sys.modules[name]
del xarray.Dataset.vibro
import vibroimpact
print(isinstance(xarray.Dataset().vibro, vibroimpact.VibroAccessor))
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.stdout.split() == ["True"] * 3, run.stderr
    with pytest.raises(AttributeError, match="no attribute `nothing`"):
        vi.nothing  # noqa: B018


def test_the_accessor_after_what_xarray_does(s: vi.Oscillator) -> None:
    xr = pytest.importorskip("xarray")
    ds = vi.region_map(s, {"inverse_beta": "1:1.5:5", "gap": [0.5, 0.75, 1.0]}, starts=4)
    words = ds.vibro.labels()
    some = ds.where(ds["gap"] > 0.6)
    assert (some.vibro.labels().sel(gap=0.5) == "").all() and (some.vibro.labels().sel(gap=1.0) == words.sel(gap=1.0)).all()
    ax = some.vibro.plot()
    assert ax.get_xlabel() == "1/$β$" and "$ε$ = 0.5" in ax.get_title()
    renamed = ds.rename(gap="clearance", label="motion_label")
    assert (renamed.vibro.labels().values == words.values).all()
    ax = renamed.vibro.plot()
    assert ax.get_ylabel() == "$δ$" and "not known" not in ax.get_title()
    slices = [renamed.isel(clearance=k) for k in (1, 2)]
    assert ["$δ$ = 0.75" in one.vibro.plot().get_title() for one in slices] == [True, False]
    joined = xr.concat([ds.isel(gap=[0]), ds.isel(gap=[1, 2])], "gap")
    assert (joined.vibro.labels() == words).all() and joined.vibro.plot().get_title() == ds.vibro.plot().get_title()


def test_a_slice_shows_its_own_parameters(s: vi.Oscillator) -> None:
    ds = vi.region_map(s, {"inverse_beta": "1:1.5:5", "gap": [0.5, 0.75, 1.0]}, starts=4)
    for k, gap in enumerate((0.5, 0.75, 1.0)):
        assert f"$δ$ = {gap:g}" in ds.isel(gap=k).vibro.plot().get_title()
    basins = vi.basin(HAMMER, {"q.head": [-1.0, 0.0], "qdot.head": [-1.0, 0.0, 1.0], "phase": [0.0, 1.5]})
    for k, phase in enumerate((0.0, 1.5)):
        title = basins.isel(phase=k).vibro.plot().get_title()
        assert title.endswith(f", phase = {phase:g}") and title.startswith(HAMMER.title.split(": ")[0])
    assert basins.isel(phase=1, drop=True).vibro.plot().get_title().endswith("phase not known")


def test_legends_name_what_they_hide() -> None:
    ds = vi.region_map(vi.Oscillator(beta=1, gap=0, restitution=0.5), {"inverse_beta": "0.9:1.2:13", "gap": "0:3:13"}, starts=4)
    there = set(ds.vibro.labels().values.ravel().tolist()) - {""}
    legend = ds.vibro.plot().get_legend()
    texts = [text.get_text() for text in legend.get_texts()]
    assert len(set(texts)) == len(texts) and not any("other" in text for text in texts)
    named = {word for text in texts for word in text.replace("∞", "inf").split(", ")}
    several = {label for label in there if "/" in label}
    assert several <= named or any("more" in text for text in texts)


LONG: list[Callable[..., Any]] = [
    lambda **of: vi.simulate(OSC, impacts=20_000, **of),
    lambda **of: vi.lyapunov(OSC, impacts=20_000, **of),
    lambda **of: vi.response(OSC, "gap", "1:2:5", **of),
    lambda **of: vi.region(OSC, "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=4, **of),
    lambda **of: vi.branch(OSC, "gap", 2.0, label="1/1", **of),
    lambda **of: vi.curve(OSC, "flip", {"gap": (1, 3), "inverse_beta": (1.05, 1.2)}, label="1/1", **of),
    lambda **of: vi.orbits(OSC, "2/2", **of),
    lambda **of: vi.margins(OSC, vary=["gap"], lines=4, **of),
    lambda **of: vi.region_map(OSC, {"gap": "1:2:9", "inverse_beta": "1:1.2:9"}, starts=2, refine=4, **of),
    lambda **of: vi.simulate_many(OSC, starts={"v": [0.0, 0.5]}, **of),
    lambda **of: HAMMER.simulate(impacts=3000, **of),
    lambda **of: HAMMER.simulate(periods=50, **of),
    lambda **of: HAMMER.settle(**of),
    lambda **of: HAMMER.lyapunov(impacts=200, **of),
    lambda **of: HAMMER.orbits("1/1", **of),
    lambda **of: HAMMER.branch("frequency", 1.05, **of),
    lambda **of: HAMMER.curve("grazing", {"frequency": (0.9, 1.3), "b": (0.4, 0.6)}, points=5, **of),
    lambda **of: HAMMER.attractors(4, **of),
    lambda **of: HAMMER.basin({"q.head": "-1:1:5", "qdot.head": "-1:1:3"}, **of),
    lambda **of: HAMMER.map({"frequency": "0.8:1.2:3"}, starts=2, **of),
]


@pytest.mark.parametrize("ask", LONG, ids=range(len(LONG)))
def test_long_work_reports_progress(ask: Callable[..., Any]) -> None:
    seen: list[tuple[int, int]] = []
    ask(progress=lambda done, total: seen.append((done, total)))
    assert seen and seen[-1][0] == seen[-1][1] >= 1
    assert all(0 <= done <= total for done, total in seen)
