"""Figures: drawn without warnings, with the required contents."""

from collections.abc import Callable
from typing import Any

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex

import vibroimpact as vi
from vibroimpact import _core


def words(ax: Axes) -> list[str]:
    legend = ax.get_legend()
    return [] if legend is None else [text.get_text() for text in legend.get_texts()]


def drawn(ax: Axes) -> None:
    ax.figure.canvas.draw()


def test_waveforms_stay_below_the_stop(n: vi.Oscillator) -> None:
    ax = vi.simulate(n, impacts=20).plot()
    drawn(ax)
    assert words(ax) == ["position", "impact", "stop"]
    position, impacts = (line for line in ax.lines if len(line.get_xdata()) > 2)
    assert np.max(position.get_ydata()) <= n.gap + 1e-12 and len(impacts.get_xdata()) == 20
    motion = vi.settle(n).plot(plt.subplots()[1])
    drawn(motion)
    assert motion.get_title().endswith(": 4/1") and "$δ$ = 0.25" in motion.get_title()
    # six periods of four impacts, after the first impact
    assert len(next(line for line in motion.lines if line.get_marker() == "o").get_xdata()) in (23, 24)


def test_metres_and_seconds() -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6)
    sim = vi.simulate(osc, impacts=20)
    plain, si = sim.plot(), sim.plot(si=True)
    assert osc.units is not None and si.get_xlabel() == "time $τ$ (s)" and si.get_ylabel() == "$ξ$ (m)"
    one, other = (next(line for line in ax.lines if len(line.get_xdata()) > 100) for ax in (si, plain))
    np.testing.assert_allclose(one.get_xdata(), osc.units.time_s * np.asarray(other.get_xdata()))
    np.testing.assert_allclose(one.get_ydata(), osc.units.length_m * np.asarray(other.get_ydata()))


def test_a_branch_is_solid_where_it_is_stable_and_dashed_where_not() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    found = vi.branch(osc, "gap", 2.5, label="1/1", follow=1)
    ax = found.plot(diagram=False)
    drawn(ax)
    assert words(ax) == ["1/1", "2/2", "1/2", "stable", "unstable", "flip", "fold", "grazing"]
    flip = found.events[0].parameter
    stable = [line for line in ax.lines if len(line.get_xdata()) > 5 and line.get_color().startswith(_core.class_colour("1/1"))]
    assert stable and all(line.get_linestyle() == "-" and np.nanmax(line.get_xdata()) <= flip + 1e-9 for line in stable)
    dashed = [line for line in ax.lines if len(line.get_xdata()) > 5 and line.get_linestyle() == "--"]
    assert dashed and all(np.nanmin(line.get_xdata()) >= flip - 1e-9 for line in dashed)
    assert "simulation" in words(found.plot(plt.subplots()[1]))


@pytest.mark.parametrize(
    "draw",
    [
        lambda s: vi.attractors(s).plot(),
        lambda s: vi.curve(s.replace(inverse_beta=0.7, gap=2), "fold", {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}, label="1/1").plot(),
        lambda s: vi.lyapunov(s, impacts=2000, points=100).plot_sections()[0],
        lambda s: vi.lyapunov(s.replace(second_gap=1), impacts=2000, points=100).plot_sections()[1],
        lambda s: vi.orbit_diagram(s, "gap", "0:3:61").vibro.plot(),
        lambda s: vi.orbit_diagram(s, "gap", "0:3:61").vibro.plot(which="impact_phase"),
        lambda s: vi.orbit_diagram(s, "inverse_beta", "1:1.3:21", show="strobe", direction="scatter").vibro.plot(),
        lambda s: vi.basin(s, x="-4:0.75:30", v="-4:4:20").vibro.plot(),
        lambda s: vi.region_map(s, {"inverse_beta": "0.5:1.5:9", "gap": "0:3:7"}, starts=6).vibro.plot(),
        lambda s: vi.region_map(s, {"gap": [0.0, 0.5, 3.0], "restitution": "0.1:0.9:5"}, starts=6).vibro.plot(),
        lambda s: vi.settle(vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5)).plot(),
        lambda s: vi.simulate(vi.Oscillator(beta=0.5, gap=40, restitution=0.5)).plot(),
        lambda s: vi.simulate(vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5)).plot(),
    ],
)
def test_they_are_drawn(s: vi.Oscillator, draw: Callable[[vi.Oscillator], Any]) -> None:
    ax = draw(s)
    drawn(ax)
    assert ax.get_xlabel() and (ax.lines or ax.patches or ax.collections)


def test_cells_have_the_colours_of_their_motions(s: vi.Oscillator, colours_at: Callable[..., set[str]]) -> None:
    ds = vi.basin(s, x="-4:0.75:30", v="-4:4:20")
    ax = ds.vibro.plot()
    drawn(ax)
    assert [word.split(",")[0] for word in words(ax)] == ["2/1", "1/1"] and (ax.get_xlabel(), ax.get_ylabel()) == ("$ξ_{0}$", "$u_{0}$")
    for j, i in ((0, 0), (5, 11), (12, 20), (19, 29), (9, 1)):
        x, v = ds["x"].values[i], ds["v"].values[j]
        assert colours_at(ax, [x], v) == {_core.class_colour(ds.vibro.labels().values[j, i])}
    colours = [matplotlib.colors.to_hex(patch.get_facecolor()) for patch in ax.get_legend().get_patches()]
    assert colours == [_core.class_colour("2/1"), _core.class_colour("1/1")]
    # over one axis each start has a bar
    line = ds.isel(v=0).vibro.plot(plt.subplots()[1])
    assert [colours_at(line, [x], 0.5) for x in ds["x"].values] == [{_core.class_colour(of)} for of in ds.vibro.labels().values[0]]


def test_a_cell_is_divided_between_its_motions(s: vi.Oscillator, colours_at: Callable[..., set[str]]) -> None:
    ds = vi.region_map(s, {"inverse_beta": "1.2:1.3:2", "gap": "0.7:0.8:2"}, starts=20)
    labels, ax = ds.vibro.labels(), ds.vibro.plot()
    assert (labels != "").sum("motion").max() >= 2
    for j, gap in enumerate((0.7, 0.8)):
        for i, x in enumerate((1.2, 1.3)):
            there = {_core.class_colour(of) for of in labels.values[j, i] if of}
            assert colours_at(ax, np.linspace(x - 0.04, x + 0.04, 24), gap) == there


def test_a_region_is_filled_and_bounded(s: vi.Oscillator) -> None:
    ax = vi.region(s, "1/1", {"inverse_beta": (0.4, 2), "gap": (-1, 5)}, grid=12).plot()
    drawn(ax)
    assert words(ax)[:4] == ["1/1 exists, unstable", "1/1 stable", "fold", "flip"]
    assert ax.get_xlim() == (0.4, 2) and ax.get_ylim() == (-1, 5) and ax.get_title() == "$ε$ = 0.5"


def steps(values: Any) -> Any:
    """The numbers of the colours of values."""
    known = values[np.isfinite(values)]
    return np.minimum((values - known.min()) / (known.max() - known.min()) * 256, 255).astype(int)


def coloured(ds: Any, **options: Any) -> tuple[Axes, Any]:
    """The axes and the array of colours of a figure."""
    ax = ds.vibro.plot(plt.subplots(layout="constrained")[1], **options)
    drawn(ax)
    return ax, ax.collections[0]


def test_cells_have_the_colours_of_a_quantity(s: vi.Oscillator) -> None:
    ds = vi.basin(s, x="-4:0.75:30", v="-4:4:20", fields=["impact_speed_max"])
    ax, mesh = coloured(ds, colour="impact-speed-max")
    np.testing.assert_array_equal(np.asarray(mesh.get_array()), steps(ds["impact_speed_max"].values))
    assert to_hex(mesh.to_rgba(255)) == "#fde725" and ax.get_legend() is None
    assert ax.figure.axes[1].get_ylabel() == "largest impact speed ($ω_{n} F/k$)"


def test_a_colour_is_that_of_the_worst_motion_unless_another_is_asked_for(s: vi.Oscillator) -> None:
    over = {"inverse_beta": "1.2:1.3:4", "gap": "0.6:0.8:5"}
    ds = vi.region_map(s, over, starts=20, fields=["impact_speed_max"])
    speeds = ds["impact_speed_max"]
    for of, expected in [
        ("largest", speeds.max("motion")),
        ("worst", speeds.max("motion")),
        ("least", speeds.min("motion")),
        ("likeliest", speeds.isel(motion=0)),
    ]:
        ax, mesh = coloured(ds, colour="impact_speed_max", of=of)
        np.testing.assert_array_equal(np.asarray(mesh.get_array()), steps(expected.transpose("gap", ...).values))
    assert ax.get_legend().get_title().get_text() == "where motions coexist: the most frequent motion"
    assert bool((speeds.max("motion") > speeds.min("motion")).any())
    with pytest.raises(vi.QuestionError, match="`median` is no way to choose"):
        ds.vibro.plot(colour="impact_speed_max", of="median")


def test_cells_without_a_value_look_different_and_are_explained() -> None:
    osc = vi.Oscillator(inverse_beta=1, gap=0, restitution=0.5)
    over = {"inverse_beta": "0.4:1:12", "gap": "-0.5:0.3:9"}
    ds = vi.region_map(osc, over, starts=4, impacts=60, fields=["impacts_per_period", "impact_speed_mean"])
    ax, mesh = coloured(ds, colour="impacts_per_period")
    assert words(ax) == ["infinite", "undecided"] and len(ax.collections) == 3
    values = ds["impacts_per_period"].values
    masked = np.ma.getmaskarray(mesh.get_array()).reshape(9, 12)
    expected = np.isinf(values).any(axis=-1) | ~np.isfinite(values).any(axis=-1)
    np.testing.assert_array_equal(masked, expected)
    looks = {(patch.get_facecolor(), patch.get_hatch()) for patch in ax.get_legend().get_patches()}
    assert len(looks) == 2
    # the mean speed of a chatter and of a motion without impacts is not defined
    assert "not defined" in words(coloured(ds, colour="impact_speed_mean")[0])
    nothing = ds.copy()
    nothing["label"] = ds["label"].where(ds["gap"] > 0, -9).astype(np.int32)
    assert "not computed" in words(coloured(nothing, colour="impacts_per_period")[0])
    refined = ds.assign(computed=(("gap", "inverse_beta"), np.full((9, 12), 2, dtype=np.int8)))
    assert "not computed" in words(coloured(refined, colour="impact_speed_mean")[0])


def test_metres_and_seconds_in_colours() -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6)
    ds = vi.basin(osc, x="-4:0.6:12", v="-4:4:10", fields=["impact_loss_per_period"]).vibro.si()
    ax, mesh = coloured(ds, colour="impact_loss_per_period")
    np.testing.assert_array_equal(np.asarray(mesh.get_array()), steps(ds["impact_loss_per_period"].values))
    assert ax.figure.axes[1].get_ylabel() == "energy lost in impacts per forcing period (J)"
    assert ax.get_xlabel() == "$x_{0}$ (m)" and ax.get_ylabel() == "$v_{0}$ (m/s)" and "$d$ = 0.003 m" in ax.get_title()
    ax = vi.orbit_diagram(osc, "gap", "0.5:1:3").vibro.si().vibro.plot()
    assert ax.get_xlabel() == "$d$ (m)" and ax.get_ylabel() == "arrival velocity (m/s)"
    xs = np.concatenate([of.get_xdata() for of in ax.get_lines()])
    np.testing.assert_allclose([xs.min(), xs.max()], [0.5 * osc.units.length_m, osc.units.length_m], rtol=1e-12)


def test_every_figure_takes_axes_a_title_and_properties_of_lines(s: vi.Oscillator) -> None:
    motion, other = s.settle(), s.replace(gap=2.0).settle()
    ax = motion.plot()
    low, high = ax.get_ylim()
    assert other.plot(ax, color="black", linewidth=3, title="both") is ax
    assert ax.get_ylim() == (low, max(high, other.plot().get_ylim()[1])) and ax.get_title() == "both"
    assert {of.get_color() for of in ax.get_lines() if of.get_linewidth() == 3} == {"black"}
    # a label that both figures have is there once
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["position", "impact", "stop"]
    assert motion.plot(legend=False).get_legend() is None
    # in a column of text the axes keep most of its width
    for draw in (motion.plot, s.attractors(8).plot, vi.region_map(s, {"gap": "0:2:9", "inverse_beta": "0.5:2:9"}, starts=2).vibro.plot):
        figure, ax = plt.subplots(figsize=(3.4, 2.6), layout="constrained")
        draw(ax)
        figure.draw_without_rendering()
        assert ax.get_position().width > 0.7 and ax.get_position().height > 0.3


def test_a_label_has_one_colour(s: vi.Oscillator) -> None:
    from vibroimpact._core import class_colour

    def lines(ax: Axes, label: str) -> set[str]:
        return {to_hex(of.get_color()) for of in ax.get_lines() if of.get_label() == label}

    assert lines(s.branch("gap", 1.0, label="2/1").plot(diagram=False), "2/1") == {class_colour("2/1")}
    assert lines(s.response("gap", "0.7:0.8:3").plot(), "2/1") == {class_colour("2/1")}
    points = vi.settle_many(s, starts={"x": [-2.0, 0.0], "v": [0.0, 0.5]})
    assert lines(points.vibro.plot(), "2/1") == {class_colour("2/1")}


def test_a_map_over_one_axis(s: vi.Oscillator) -> None:
    ds = vi.region_map(s, {"gap": "0.5:3:11"}, starts=12, impacts=60, fields=["impact_speed_mean"])
    ax = ds.vibro.plot()
    drawn(ax)
    assert ax.get_ylabel() == "share of starts" and ax.get_ylim() == (0, 1)
    labels, bars = ds.vibro.labels(), {to_hex(of.get_facecolor()[0]): [path.get_extents() for path in of.get_paths()] for of in ax.collections}
    np.testing.assert_allclose(sum(bar.height for of in bars.values() for bar in of), len(ds["gap"]))
    free = ds["share"].where(labels == "0", 0).sum("motion").values
    assert words(ax)[0] == "no impact"
    np.testing.assert_allclose([bar.height for bar in bars[_core.class_colour("0")]], free[free > 0])
    dots = ds.vibro.plot(colour="impact_speed_mean")
    drawn(dots)
    speeds = ds["impact_speed_mean"].values
    shown = [line for line in dots.lines if line.get_marker() == "o"]
    assert sum(len(line.get_xdata()) for line in shown) == np.isfinite(speeds).sum()
    assert {"undecided", "not defined"} <= set(words(dots))
    marks = {line.get_marker(): len(line.get_xdata()) for line in dots.lines if len(line.get_xdata())}
    assert marks["x"] == (labels == "undecided").sum() and marks["+"] == (labels == "0").sum()


def test_colours_that_are_refused(s: vi.Oscillator) -> None:
    ds = vi.basin(s, x="-4:0.75:5", v="-4:4:4", fields=["power"])
    with pytest.raises(vi.QuestionError, match="`speed` is no quantity of the motions in this Dataset; there are power"):
        ds.vibro.plot(colour="speed")
