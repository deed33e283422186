"""Figures of the answers about machines: the data are in the artists, and what has no figure says so."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import vibroimpact as vi

HAMMER = vi.Machine.named("two-mass-hammer")
TITLE = HAMMER.title.split(": ")[0] if HAMMER.title else "machine"


def words(ax: plt.Axes) -> list[str]:
    legend = ax.get_legend()
    return [] if legend is None else [text.get_text() for text in legend.get_texts()]


def test_a_settled_motion_is_drawn_over_whole_periods() -> None:
    found = HAMMER.settle()
    for of in (found, found.motion):
        axes = of.plot()
        assert axes[0].get_title() == f"{TITLE}: {found.motion.label}"
        low, high = axes[0].get_xlim()
        assert HAMMER.period is not None and low == 0 and round((high / HAMMER.period), 6) == 6
    (ax,) = plt.subplots(1, 1, squeeze=False)[1].ravel()
    assert found.plot(ax)[0] is ax
    far = HAMMER.set({"b": 50.0}).settle()
    if far.motion.state is None:
        with pytest.raises(vi.QuestionError, match="has no cycle to draw"):
            far.plot()


def test_shares_and_exponents() -> None:
    found = HAMMER.attractors(6)
    ax = found.plot()
    ends = [path.vertices[:, 0].max() for bars in ax.collections for path in bars.get_paths()]
    assert ends == (100 * found.share).tolist() and ax.get_title() == TITLE
    measured = HAMMER.lyapunov(impacts=300)
    ax = plt.subplots()[1]
    assert measured.plot(ax) is ax and measured.exponents is not None
    line = ax.get_lines()[1]
    np.testing.assert_array_equal(line.get_ydata(), [one.value for one in measured.exponents])


def test_a_branch_without_stops_shows_a_displacement() -> None:
    branch = vi.Machine.named("stick-slip").branch("V", 0.5)
    assert branch.quantity == "q.mass.displacement_max" and branch.value is not None
    # it swings about x = f = 0.2 from x = fs = 0.4 with the velocity of the belt
    assert np.allclose(branch.value, 0.2 + np.hypot(0.2, branch.parameter), rtol=0, atol=1e-12)
    ax = branch.plot(diagram=False)
    assert ax.get_ylabel() == branch.quantity
    drawn = np.concatenate([np.asarray(line.get_ydata()) for line in ax.lines if len(np.asarray(line.get_xdata())) > 1])
    assert np.isfinite(drawn).any() and np.nanmax(drawn) > 0.7
    assert vi.Machine.named("two-mass-hammer").branch("frequency", 1.01).quantity is None


def test_orbits_branches_and_curves() -> None:
    found = HAMMER.orbits("1/1")
    ax = found.plot()
    assert len(words(ax)) == len(found) and words(ax)[0].startswith("orbit 1: 1/1, ")
    np.testing.assert_array_equal(ax.get_lines()[len(found) - 1].get_ydata(), found[-1].cycle.speed[np.isin(found[-1].cycle.kind, ("impact", "close"))])
    branch = HAMMER.branch("frequency", 1.05)
    ax = branch.plot(diagram=False)
    assert ax.get_xlabel() == "frequency" and {"grazing", "fold", "1/1", "stable"} <= set(words(ax))
    drawn = np.concatenate([line.get_xdata() for line in ax.get_lines() if len(line.get_xdata()) > 1 and line.get_marker() == "None"])
    assert set(branch.parameter.tolist()) == set(drawn[np.isfinite(drawn)].tolist())
    # a curve for each closing, not only for the fastest
    heights = np.concatenate([line.get_ydata() for line in ax.get_lines() if len(line.get_xdata()) > 1 and line.get_marker() == "None"])
    closings = np.concatenate([cycle.speed[np.isin(cycle.kind, ("impact", "close"))] for cycle in branch.cycles])
    assert set(closings.tolist()) == set(heights[np.isfinite(heights)].tolist())
    line = HAMMER.branch("frequency", 1.1, also={"b": 0.6})
    ax = line.plot()
    assert ax.get_xlabel() == "frequency, with b from 0.6 to 0.5" and {"stable", "simulation"} <= set(words(ax))
    curve = HAMMER.curve("grazing", {"frequency": (0.9, 1.3), "b": (0.4, 0.6)}, points=5)
    ax = curve.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("frequency", "b") and words(ax)[0] == f"grazing of {curve.label}"
    np.testing.assert_array_equal(ax.get_lines()[0].get_xdata()[1:], curve.values[:, 0])


def test_sections() -> None:
    found = vi.Machine.named("impact-pair").lyapunov(impacts=300, points=200)
    drawn = found.plot_sections()
    assert [ax.get_xlabel() for ax in drawn] == ["phase $θ$", "q.ball"] and drawn[1].get_ylabel() == "qdot.ball"
    assert words(drawn[0]) == ["right", "left"]
    np.testing.assert_array_equal(drawn[1].get_lines()[0].get_xdata(), found.strobes.q[:, 0])
    with pytest.raises(vi.QuestionError, match="3 axes are given for a figure of 2 panels"):
        found.plot_sections([plt.subplots()[1]] * 3)


def test_basins_and_maps() -> None:
    ax = HAMMER.basin({"q.head": "-1:1:5", "qdot.head": "-1:1:3"}).vibro.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("q.head", "qdot.head") and words(ax)[0].startswith("1/1")
    mesh = ax.collections[0].get_array()
    # the last column lies beyond the anvil
    assert mesh.shape == (3, 5) and np.ma.getmaskarray(mesh).tolist() == [[False] * 4 + [True]] * 3
    over = HAMMER.map({"frequency": "0.8:1.2:3"}, starts=2)
    assert set(words(over.vibro.plot())) == {label for label in over.vibro.labels().values.ravel().tolist() if label}
    ax = HAMMER.map({"frequency": "0.8:1.2:3", "b": "0.4:0.6:2"}, starts=1).vibro.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("frequency", "b")
