"""The titles of figures of Datasets are correct, whatever operations were applied to the Dataset before."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes

import vibroimpact as vi
from vibroimpact import _core, _stated
from vibroimpact._paint import mathtext

pytestmark = pytest.mark.filterwarnings("ignore:In a future version of xarray:FutureWarning")

GAPS, EPSILONS = [0.5, 0.75, 1.0], [0.5, 0.7]
X, V = _core.span_values("-4:0.4:5"), _core.span_values("-4:4:4")
NAMES = {mathtext(symbol): name for name, symbol in (_stated.SYMBOLS | _stated.STARTS).items()}
#: Colours of the cells at some places of a row.
Colours = Callable[[Axes, Iterable[float], float], set[str]]


def stated(ax: Axes) -> dict[str, float]:
    """Parameters in the title that have one value."""
    parts = (part.partition(" = ") for part in ax.get_title().split(", "))
    return {NAMES[symbol]: float(value) for symbol, equal, value in parts if equal}


def axis_names(ax: Axes) -> tuple[str, str]:
    across, up = (NAMES.get(label, label) for label in (ax.get_xlabel(), ax.get_ylabel()))
    return across, up


def osc_of(epsilon: float) -> vi.Oscillator:
    return vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=epsilon)


@pytest.fixture(scope="module")
def basins() -> dict[float, xr.Dataset]:
    over = {"gap": GAPS}
    return {eps: vi.basin(osc_of(eps), over, x="-4:0.4:5", v="-4:4:4") for eps in EPSILONS}


@pytest.fixture(scope="module")
def truth() -> dict[tuple[float, float], vi.Settlement]:
    """The motion from each start, computed for one system at a time."""
    x, v = np.meshgrid(X, V)
    return {(eps, gap): vi.settle_many(osc_of(eps).replace(gap=gap), x, v) for eps in EPSILONS for gap in GAPS}


def check(ax: Axes, ds: xr.Dataset, truth: dict[tuple[float, float], vi.Settlement], colours_at: Colours) -> None:
    """Compare every stated value with the cells, at the starts that were computed."""
    said = stated(ax)
    assert said["inverse_beta"] == 1.3
    settled = truth[said["restitution"], said["gap"]].labels
    across, up = axis_names(ax)
    assert {across, up} == {"x", "v"}
    seen = 0
    for j, v in enumerate(V):
        for i, x in enumerate(X):
            at = {"x": x, "v": v}
            if x in ds["x"].values and v in ds["v"].values:
                drawn = colours_at(ax, [at[across]], at[up])
                assert drawn == {_core.class_colour(str(settled[j, i]))}, (at, settled[j, i], drawn, ax.get_title())
                seen += 1
    assert seen == ds["label"].size


def changed(ds: xr.Dataset, rng: np.random.Generator) -> xr.Dataset:
    """An operation that keeps the values with their coordinates."""
    match int(rng.integers(7)):
        case 0:
            return ds.transpose(*rng.permutation(list(ds.dims)).tolist())
        case 1:
            return ds.isel(x=slice(None, None, -1))
        case 2:
            return ds.isel(x=rng.permutation(ds.sizes["x"]))
        case 3:
            return ds.isel(v=rng.permutation(ds.sizes["v"]))
        case 4:
            return ds.isel(x=slice(int(rng.integers(3)), None))
        case 5:
            return ds.assign_coords(run=7).assign_attrs(note="mine")
        case _:
            half = int(rng.integers(1, ds.sizes["v"]))
            return xr.concat([ds.isel(v=slice(half, None)), ds.isel(v=slice(None, half))], "v", data_vars="minimal")


@pytest.mark.parametrize("seed", range(12))
def test_f09_figures_of_basins_state_what_they_show(
    basins: dict[float, xr.Dataset], truth: dict[tuple[float, float], vi.Settlement], seed: int,
    colours_at: Colours,
) -> None:
    rng = np.random.default_rng(seed)
    parts = [basins[eps] for eps in rng.permutation(EPSILONS)]
    if rng.random() < 0.3:
        ds = parts[0]
    else:
        dim = rng.choice(["restitution", "case"])
        ds = xr.concat(parts, dim)
        ds = ds.isel({dim: int(rng.integers(2))})
    for _ in range(int(rng.integers(3))):
        ds = changed(ds, rng)
    how = int(rng.integers(3))
    ds = (
        ds.isel(gap=int(rng.integers(3)))
        if how == 0
        else ds.sel(gap=float(rng.choice(GAPS)))
        if how == 1
        else ds.sel(gap=0.8, method="nearest")
    )
    for _ in range(int(rng.integers(3))):
        ds = changed(ds, rng)
    check(ds.vibro.plot(plt.subplots()[1]), ds, truth, colours_at)


def test_f09_one_value_of_an_axis_is_stated(basins: dict[float, xr.Dataset]) -> None:
    for k, gap in enumerate(GAPS):
        assert stated(basins[0.5].isel(gap=k).vibro.plot(plt.subplots()[1]))["gap"] == gap
    # a dropped coordinate is not stated
    lost = basins[0.5].isel(gap=2, drop=True).vibro.plot()
    assert "gap" not in stated(lost) and "$δ$ not known" in lost.get_title()
    # a parameter that is an axis is not stated
    over = basins[0.5].isel(x=1).vibro.plot(plt.subplots()[1])
    assert over.get_xlabel() == "$u_{0}$" and over.get_ylabel() == "$δ$"
    assert "gap" not in stated(over) and stated(over)["x"] == pytest.approx(-2.9)


def test_f09_joined_along_an_axis_the_title_has_the_range(basins: dict[float, xr.Dataset]) -> None:
    one, two = (basins[eps].isel(gap=0) for eps in EPSILONS)
    both = xr.concat([one, two.assign_coords(v=two["v"] + 10)], "v")
    title = both.vibro.plot().get_title()
    assert "$ε$ from 0.5 to 0.7" in title and "$δ$ = 0.5" in title


def test_f09_cycles_of_joined_datasets_are_not_compared_by_number(s: vi.Oscillator) -> None:
    left, right = vi.basin(s, x="-4:-1:6", v="-4:4:5"), vi.basin(s, x="-0.5:0.5:6", v="-4:4:5")
    whole = xr.concat([left, right], "x")
    legend = whole.vibro.plot().get_legend()
    assert legend is not None
    words = [text.get_text() for text in legend.get_texts()]
    assert words == sorted(set(whole.vibro.labels().values.ravel().tolist()))


def test_f09_values_in_any_order_have_a_true_axis(s: vi.Oscillator, colours_at: Colours) -> None:
    ds = vi.region_map(s, {"gap": [3.0, 0.5, 1.0], "restitution": [0.7, 0.3]}, starts=4)
    ax = ds.vibro.plot()
    labels = ds.vibro.labels()
    for gap, left, right in ((3.0, 2.0, 4.0), (0.5, 0.25, 0.75), (1.0, 0.75, 2.0)):
        for epsilon in (0.7, 0.3):
            here = {name for name in labels.sel(gap=gap, restitution=epsilon).values.tolist() if name}
            assert colours_at(ax, np.linspace(left, right, 26)[1:-1], epsilon) == {_core.class_colour(name) for name in here}
    twice = xr.concat([ds.isel(gap=[0]), ds.isel(gap=[0, 1])], "gap", data_vars="minimal")
    with pytest.raises(vi.QuestionError, match="gap = 3 is there more than once"):
        twice.vibro.plot()


@pytest.fixture(scope="module")
def diagrams() -> dict[float, xr.Dataset]:
    return {eps: vi.orbit_diagram(osc_of(eps), "gap", "0.5:1.5:5") for eps in EPSILONS}


@pytest.mark.parametrize("seed", range(6))
def test_f09_figures_of_diagrams_state_what_they_show(diagrams: dict[float, xr.Dataset], seed: int) -> None:
    rng = np.random.default_rng(seed)
    order = rng.permutation(EPSILONS)
    dim = str(rng.choice(["restitution", "case"]))
    ds = xr.concat([diagrams[eps] for eps in order], dim).isel({dim: int(rng.integers(2))})
    if rng.random() < 0.5:
        ds = ds.transpose(*rng.permutation(list(ds.dims)).tolist())
    if rng.random() < 0.5:
        ds = ds.isel(gap=rng.permutation(5)[: int(rng.integers(1, 6))])
    if rng.random() < 0.4:
        ds = ds.isel(sweep=int(rng.integers(2)))
    if rng.random() < 0.3:
        ds = ds.isel(gap=0)
    ax = ds.vibro.plot(plt.subplots()[1])
    said = stated(ax)
    assert "gap" not in said and said["inverse_beta"] == 1.3 and ax.get_xlabel() == "$δ$"
    true = diagrams[said["restitution"]]
    drawn = 0
    for line in ax.lines:
        for x, y in zip(np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)):
            if np.isfinite(y):
                drawn += 1
                assert np.any(true["velocity"].sel(gap=x).values == y), (x, y, ax.get_title())
    assert drawn > 0
    legend = ax.get_legend()
    assert legend is not None
    ways = {1: "$δ$ rising", -1: "$δ$ falling"}
    assert [text.get_text() for text in legend.get_texts()] == [ways[int(way)] for way in np.atleast_1d(ds["sweep"].values)]


def test_f09_a_line_states_the_values_that_are_shown(s: vi.Oscillator) -> None:
    line = vi.orbit_diagram(s, "inverse_beta", "1.2:1.4:5", also={"gap": (1, 0.5)}, direction="up")
    assert line.vibro.plot().get_xlabel() == "1/$β$, with $δ$ from 1 to 0.5"
    part = line.isel(inverse_beta=[3, 1]).vibro.plot(plt.subplots()[1])
    assert part.get_xlabel() == "1/$β$, with $δ$ from 0.875 to 0.625"
    one = line.isel(inverse_beta=1).vibro.plot(plt.subplots()[1])
    assert one.get_xlabel() == "1/$β$" and stated(one)["gap"] == 0.875
    few = vi.orbit_diagram(s, "gap", "0.5:1:3", direction="scatter", starts=3).isel(start=slice(0, 2)).vibro.plot(plt.subplots()[1])
    legend = few.get_legend()
    assert legend is not None and legend.get_texts()[0].get_text() == "2 starts at each value"


def test_f09_what_no_figure_can_show_is_refused(
    basins: dict[float, xr.Dataset], diagrams: dict[float, xr.Dataset], colours_at: Colours
) -> None:
    ds = basins[0.5].isel(gap=0)
    asks: list[tuple[Any, str]] = [
        (lambda: ds.stack(start=("x", "v")).expand_dims("case").vibro.plot(), "has no numbers along it"),
        (lambda: basins[0.5].vibro.plot(), "a figure has one or two axes, and there are 3"),
        (lambda: ds.drop_vars("x").vibro.plot(), "the dimension x has no numbers along it"),
        (lambda: ds.assign_coords(x=[0, 1, np.nan, 2, 3]).vibro.plot(), "x = nan is no place on an axis"),
        (lambda: basins[0.5].mean("gap", keep_attrs=True).vibro.plot(), "which is no code"),
        (lambda: diagrams[0.5].expand_dims(case=2).vibro.plot(), "the dimensions are case, sweep, gap, point"),
        (lambda: diagrams[0.5].isel(gap=0, drop=True).vibro.plot(), "no parameter to draw it over"),
        (lambda: ds[[]].vibro.plot(), "this Dataset is none that vibroimpact draws"),
    ]
    for ask, sentence in asks:
        with pytest.raises(vi.QuestionError, match=sentence):
            ask()
    # missing cells of joined Datasets are white
    apart = xr.concat([ds.isel(x=[0, 1]), ds.isel(x=[2, 3], v=[0, 1])], "x", data_vars="minimal", join="outer")
    shown = apart.vibro.plot()
    assert [colours_at(shown, [x], V[2]) == set() for x in X[:4]] == [False, False, True, True]


def test_f09_fixed_parameters_are_coordinates(s: vi.Oscillator, tmp_path: Path) -> None:
    osc = s.replace(second_gap=2, damping=0.01)
    ds = vi.basin(osc, x="-1:0.5:3", v="-1:1:2", phase=0.5, store=tmp_path / "basin.zarr")
    for name in ("beta", "inverse_beta", "gap", "restitution", "damping", "second_gap", "second_restitution"):
        assert ds.coords[name].item() == getattr(osc, name) and ds[name].attrs["units"]
    assert ds.coords["phase"].item() == 0.5
    memory = vi.basin(osc, x="-1:0.5:3", v="-1:1:2", phase=0.5)
    assert set(memory.coords) == set(ds.coords)
    title = memory.vibro.plot().get_title()
    assert stated(plt.gca()) == {
        "inverse_beta": 1.3, "gap": 0.75, "restitution": 0.5, "damping": 0.01, "second_gap": 2, "phase": 0.5,
    }, title
    alone = vi.region_map(s, {"inverse_beta": [1.0, 1.1]}, starts=1)
    assert "beta" not in alone.coords and np.isnan(alone["second_gap"].item())
    # read by xarray alone, these parameters are only in the plan, and a figure does not state the plan
    with xr.open_zarr(tmp_path / "basin.zarr") as raw:
        assert raw.vibro.plot(plt.subplots()[1]).get_title() == ""
