"""Ranges have the same values in Python, in plans and in the command; phases the same limits."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import _core

OSC = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
RANGES = [(0.4, 2, 13), (-0.4, 0.7, 13), (-0.1, 0.3, 5), (2, 0.3, 18), (0.1, 0.7, 7), (1 / 3, 2 / 3, 11)]


@pytest.mark.parametrize("over", RANGES, ids=str)
def test_f07_one_formula(over: tuple[float, float, int], vibro: Callable[..., Any]) -> None:
    first, last, count = over
    text = f"{first!r}:{last!r}:{count}"
    values = _core.span_values(text)
    assert (values[0], values[-1], len(values)) == (first, last, count)
    assert np.all(np.diff(values) > 0) or np.all(np.diff(values) < 0)
    assert np.allclose(values, np.linspace(first, last, count), rtol=0, atol=1e-15)
    # as text and as an array of these values; a tuple of three numbers is refused
    for given in (text, values):
        ds = vi.orbit_diagram(OSC, "gap", given, direction="up", keep=1, transient=10)
        assert ds["gap"].values.tolist() == values.tolist()
        plan = vi.Plan.map(OSC, {"gap": given}, starts=1)
        assert plan.to_dict()["task"]["map"]["axes"][0]["over"] == text.replace(".0:", ":").replace(" ", "")
    # an array of other values is used unchanged, to the last bit
    other = np.linspace(first, last, count) * (1 + 3e-16)
    assert vi.region_map(OSC, {"gap": other}, starts=1, impacts=10)["gap"].values.tolist() == other.tolist()
    words = ("--inverse-beta", 1.3, "--restitution", 0.5, "--vary", "gap", f"--over={text}", "--direction", "up", "--keep", 1)
    done = vibro("diagram", *words, "--transient", 10, "--csv", "-")
    assert done.returncode == 0, done.stderr
    # a sweep up has rising values, in whichever order the range is written
    assert [float(row.split(",")[0]) for row in done.stdout.splitlines()[1:]] == sorted(values.tolist())


def test_ranges_are_texts_and_tuples_are_refused() -> None:
    over = vi.span(0.5, 1.5, 5)
    assert over == "0.5:1.5:5" and isinstance(over, str) and over.values().tolist() == [0.5, 0.75, 1.0, 1.25, 1.5]
    for given, values in ((over, over.values().tolist()), ([0.5, 1.0, 2], [0.5, 1, 2])):
        assert vi.region_map(OSC, {"gap": given}, starts=1, impacts=10)["gap"].values.tolist() == values
    three = "(0.5, 1.0, 2) may be three values or 2 values from 0.5 to 1.0\n"
    three += 'hint: [0.5, 1.0, 2] is a list; "0.5:1.0:2" or vibroimpact.span(0.5, 1.0, 2) is a range'
    log = '(0.1, 1, 3, log) is a tuple, which may be a list or a range\nhint: "0.1:1:3:log" or vibroimpact.span(0.1, 1, 3, log=True) is a range'
    two = "(0.5, 1.0) is a tuple, which may be a list or a range\nhint: [0.5, 1.0] is a list"
    asks: list[Callable[[Any], Any]] = [
        lambda over: vi.region_map(OSC, {"gap": over}, starts=1),
        lambda over: vi.orbit_diagram(OSC, "gap", over),
        lambda over: vi.basin(OSC, {"restitution": over}, x="-1:0:2"),
        lambda over: vi.basin(OSC, x=over),
        lambda over: vi.Plan.lyapunov(OSC, {"gap": over}),
    ]
    for given, sentence in (((0.5, 1.0, 2), three), ((0.1, 1, 3, "log"), log), ((0.5, 1.0), two)):
        for ask in asks:
            with pytest.raises(vi.QuestionError) as refusal:
                ask(given)
            assert str(refusal.value) == sentence
    with pytest.raises(TypeError, match="count = 2.5 is not a whole number"):
        vi.span(0, 1, 2.5)  # type: ignore[arg-type]


def test_f07b_equal_ratios() -> None:
    ds = vi.region_map(OSC, {"beta": vi.span(0.01, 100, 5, log=True)}, starts=1, impacts=10)
    assert ds["beta"].values.tolist() == [0.01, 0.1, 1.0, 10.0, 100.0]


@pytest.mark.parametrize("phase", [1e18, -1e18, 1e300])
def test_f10_phases_that_are_no_angles(phase: float) -> None:
    for ask in (
        lambda: vi.settle(OSC, phase=phase),
        lambda: vi.simulate(OSC, phase=phase),
        lambda: vi.lyapunov(OSC, phase=phase),
        lambda: vi.settle_many(OSC, [0.0, 0.1], 0.0, phase),
        lambda: vi.basin(OSC, x="-1:0.5:3", phase=phase),
        lambda: vi.basin(OSC, phase=f"0:{phase!r}:3"),
    ):
        with pytest.raises(vi.QuestionError, match="lies outside -1e15 <= phase <= 1e15"):
            ask()


def test_f10b_progress_with_refinement_counts_all_points() -> None:
    told: list[tuple[int, int]] = []
    ds = vi.basin(OSC, x="-4:0.75:200", v="-4:4:200", refine=8, threads=1, progress=lambda *of: told.append(of))
    assert bool((ds["computed"] == 2).any()) and told[-1] == (40_000, 40_000)
    assert all(total == 40_000 and done <= total for done, total in told)


def test_f10c_missing_tiles_are_counted(tmp_path: Any) -> None:
    plan = vi.Plan.attractors(OSC, 1500, tile=1)
    told: list[tuple[int, int]] = []
    vi.run(plan, tmp_path / "s.zarr", part=(1, 100), progress=lambda *of: told.append(of))
    far = vi.status(tmp_path / "s.zarr")
    assert (len(far.missing), far.missing_left_out, far.done) == (1000, 485, 15)
    # only the points of the part are counted
    assert told[-1] == (15, 15)
