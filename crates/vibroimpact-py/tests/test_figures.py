"""Figures: drawn without warnings, with the required contents."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes

import vibroimpact as vi
from vibroimpact import _palette


def words(ax: Axes) -> list[str]:
    legend = ax.get_legend()
    return [] if legend is None else [text.get_text() for text in legend.get_texts()]


def drawn(ax: Axes) -> None:
    ax.figure.canvas.draw()


def test_waveforms_stay_below_the_stop(n: vi.Oscillator) -> None:
    ax = vi.simulate(n, impacts=20).plot()
    drawn(ax)
    assert words(ax) == ["position", "impact", "stop"]
    position, impacts = ax.lines[0], ax.lines[1]
    assert np.max(position.get_ydata()) <= n.gap + 1e-12 and len(impacts.get_xdata()) == 20
    motion = vi.settle(n).plot(plt.subplots()[1])
    drawn(motion)
    assert motion.get_title().endswith(": 4/1") and r"\delta = 0.25" in motion.get_title()
    # six periods of four impacts, from the first impact to the first impact
    assert len(motion.lines[1].get_xdata()) == 25


def test_metres_and_seconds() -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6)
    sim = vi.simulate(osc, impacts=20)
    plain, si = sim.plot(), sim.plot(si=True)
    assert osc.units is not None and si.get_xlabel() == "time (s)" and si.get_ylabel() == "$x$ (m)"
    np.testing.assert_allclose(si.lines[0].get_xdata(), osc.units.time_s * np.asarray(plain.lines[0].get_xdata()))
    np.testing.assert_allclose(si.lines[0].get_ydata(), osc.units.length_m * np.asarray(plain.lines[0].get_ydata()))


def test_a_branch_is_solid_where_it_is_stable_and_dashed_where_not() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    found = vi.branch(osc, "1/1", "gap", 2.5, follow=1)
    ax = found.plot(diagram=False)
    drawn(ax)
    assert words(ax) == ["1/1", "2/2", "1/2", "stable", "unstable", "flip", "fold", "grazing"]
    flip = found.events[0].parameter
    for line in (line for line in ax.lines if len(line.get_xdata()) > 5 and line.get_color() == _palette.SERIES[0]):
        xs = np.asarray(line.get_xdata())
        assert (xs.max() <= flip + 1e-9) if line.get_linestyle() == "-" else (xs.min() >= flip - 1e-9)
    assert "simulation" in words(found.plot(plt.subplots()[1]))


@pytest.mark.parametrize(
    "draw",
    [
        lambda s: vi.attractors(s).plot(),
        lambda s: vi.curve(s.replace(inverse_beta=0.7, gap=2), "1/1", "fold", {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}).plot(),
        lambda s: vi.region(s, "1/1", {"inverse_beta": (0.4, 2), "gap": (-1, 5)}).plot(),
        lambda s: vi.lyapunov(s, impacts=2000, points=100).plot()[0],
        lambda s: vi.lyapunov(s.replace(second_gap=1), impacts=2000, points=100).plot()[1],
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


def test_cells_have_the_colours_of_their_motions(s: vi.Oscillator) -> None:
    ds = vi.basin(s, x="-4:0.75:30", v="-4:4:20")
    ax = ds.vibro.plot()
    drawn(ax)
    assert words(ax) == ["1/1", "2/1"] and ax.get_xlabel() == r"$\xi_0$" and ax.get_ylabel() == "$u_0$"
    mesh = ax.collections[0]
    shown = np.asarray(mesh.get_array()).reshape(20, 30)
    expected = np.searchsorted(["1/1", "2/1"], ds.vibro.labels().values)
    np.testing.assert_array_equal(shown, expected)
    colours = [matplotlib.colors.to_hex(patch.get_facecolor()) for patch in ax.get_legend().get_patches()]
    assert colours == [_palette.CLASSES["1/1"], _palette.CLASSES["2/1"]]
    with pytest.raises(vi.QuestionError, match="a figure has two axes, and there are 1"):
        ds.isel(x=0).vibro.plot()


def test_a_cell_is_divided_between_its_motions(s: vi.Oscillator) -> None:
    ds = vi.region_map(s, {"inverse_beta": "1.2:1.3:2", "gap": "0.7:0.8:2"}, starts=20)
    counts = (ds.vibro.labels() != "").sum("motion")
    assert counts.max() >= 2
    shown = np.asarray(ds.vibro.plot().collections[0].get_array()).reshape(2, 24)
    for j in range(2):
        for i in range(2):
            assert len(set(shown[j, 12 * i : 12 * i + 12].tolist())) == counts.values[j, i]


def test_a_region_is_filled_and_bounded(s: vi.Oscillator) -> None:
    ax = vi.region(s, "1/1", {"inverse_beta": (0.4, 2), "gap": (-1, 5)}).plot()
    assert words(ax)[:4] == ["1/1 exists, unstable", "1/1 stable", "fold", "flip"]
    assert ax.get_xlim() == (0.4, 2) and ax.get_ylim() == (-1, 5) and ax.get_title() == r"$\varepsilon = 0.5$"


def test_colours_are_those_of_the_command(root: Path) -> None:
    source = (root / "crates/vibroimpact-plot/src/palette.rs").read_text()
    series = re.search(r"SERIES: \[Colour; 8\] = \[(.*?)\];", source, re.S)
    assert series is not None
    colours = [f"#{code.replace('_', '')}" for code in re.findall(r"0x([0-9a-f_]+)", series[1])]
    assert list(_palette.SERIES) == colours
    styles = source[source.index("pub fn class_style") :]
    found = dict(re.findall(r'"([^"]+)" => (?:plain|ClassStyle::hatched)\(0x([0-9a-f_]+)', styles))
    assert {name: f"#{code.replace('_', '')}" for name, code in found.items()} == {
        name: colour for name, colour in _palette.CLASSES.items() if name != "other"
    }
    tests = re.search(r"fn labels_find_their_group.*?\] \{", source, re.S)
    assert tests is not None
    pairs = [(label, group) for label, group in re.findall(r'\("([^"]*)", "([^"]*)"\)', tests[0])]
    ours = [(label, group) for label, group in pairs if label not in ("", " 4/1 ", "2/1'", "∞/2", "Chaotic")]
    assert len(ours) > 12 and all(_palette.legend_group(label) == group for label, group in ours)
