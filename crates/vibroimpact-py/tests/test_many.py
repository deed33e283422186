"""Many systems and starts at once: the same verdicts as one by one, whatever the form in which they are given."""

from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

RNG = np.random.default_rng(5)
N = 60
SAMPLES = {
    "inverse_beta": RNG.uniform(0.6, 2.0, N),
    "gap": RNG.uniform(-0.5, 3.0, N),
    "restitution": RNG.uniform(0.1, 0.9, N),
    "damping": np.where(np.arange(N) % 3 == 0, 0.0, RNG.uniform(0.0, 0.2, N)),
}


def one_by_one(k: int, **start: float) -> vi.Motion:
    return vi.settle(vi.Oscillator(**{name: float(of[k]) for name, of in SAMPLES.items()}), **start)


def test_a_hypercube_is_as_one_by_one() -> None:
    speeds = RNG.uniform(-1, 1, N)
    ds = vi.settle_many(SAMPLES, starts={"v": speeds, "phase": 0.5}, fields=["impact_speed_max"], transient=True)
    assert dict(ds.sizes) == {"sample": N}
    labels, reasons = ds.vibro.labels().values, ds.vibro.labels("reason").values
    for k in range(N):
        motion = one_by_one(k, v=float(speeds[k]), phase=0.5)
        assert labels[k] == motion.label
        here = ds.isel(sample=k)
        if motion.kind == "periodic" and motion.multipliers is not None:
            whole = np.inf if motion.impacts is None else motion.impacts
            assert (here["impacts"].item(), here["periods"].item()) == (whole, motion.periods)
            pair = [here[f"multiplier_{k}_re"].item() + 1j * here[f"multiplier_{k}_im"].item() for k in (1, 2)]
            np.testing.assert_allclose(pair, motion.multipliers, rtol=1e-12, atol=1e-13)
            assert motion.quantities is not None and reasons[k] == "cycle"
            np.testing.assert_allclose(here["impact_speed_max"].item(), motion.quantities["impact_speed_max"], rtol=1e-13)
        elif motion.horizon is not None:
            assert reasons[k] == motion.horizon["why"] and np.isnan(here["impacts"].item())
        if motion.seen_events is not None:
            assert (here["transient"].item(), reasons[k]) == (motion.seen_events, "exponent")
        assert here["transient"].item() >= 0
    assert len(set(labels.tolist())) > 3
    # scalar coordinates state what does not vary, and the others where they do
    assert ds["phase"].item() == 0.5 and np.isnan(ds["second_gap"].item()) and ds["gap"].dims == ("sample",)
    assert "beta" not in ds.coords and np.array_equal(ds["v"].values, speeds)


def test_systems_times_starts_broadcast(s: vi.Oscillator) -> None:
    gaps, speeds = np.array([0.5, 0.75, 1.5]), np.linspace(-3, 3, 50)
    ds = vi.settle_many(s, over={"gap": gaps[:, None]}, starts={"v": speeds[None, :]})
    assert ds["gap"].dims == ("sample_0",) and ds["v"].dims == ("sample_1",) and ds["label"].shape == (3, 50)
    for k, gap in enumerate(gaps):
        alone = vi.settle_many(s.replace(gap=float(gap)), starts={"v": speeds})
        assert np.array_equal(ds["label"].values[k], alone["label"].values)


def test_tables_and_datasets(s: vi.Oscillator) -> None:
    pd, xr = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    want = vi.settle_many(SAMPLES)
    table = pd.DataFrame(SAMPLES)
    assert vi.settle_many(table)["label"].equals(want["label"])
    assert vi.settle_many(table.drop(columns="damping").assign(damping=SAMPLES["damping"]))["label"].equals(want["label"])
    labelled = xr.Dataset({name: ("sample", of) for name, of in SAMPLES.items()}, {"sample": np.arange(N) * 10})
    ds = vi.settle_many(labelled, starts=xr.Dataset({"v": ("start", [0.0, 0.5])}, {"start": ["rest", "kick"]}))
    assert ds["label"].dims == ("sample", "start") and ds["sample"].values[3] == 30
    assert np.array_equal(ds["label"].sel(start="rest").values, want["label"].values)
    rows = ds.sel(start="kick").to_dataframe()
    assert len(rows) == N
    # a grid of xarray is a basin
    grid = xr.Dataset(coords={"x": [-1.0, 0.0], "v": [0.0, 0.5, 1.0]})
    basin = vi.basin(s, x=[-1.0, 0.0], v=[0.0, 0.5, 1.0])
    found = vi.settle_many(s, starts=grid)["label"]
    assert np.array_equal(found.transpose("v", "x").values, basin["label"].values)


def test_machines_in_si() -> None:
    machine = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6)
    forces = np.array([4.0, 6.0, 8.0])
    ds = vi.settle_many(machine, over={"force_n": forces}, fields=["impact_speed_max"])
    si = ds.vibro.si()
    for k, force in enumerate(forces):
        there = machine.replace(force_n=float(force))
        motion = vi.settle(there)
        assert motion.quantities is not None and there.units is not None
        speed = motion.quantities["impact_speed_max"]
        np.testing.assert_allclose(ds["impact_speed_max"].values[k], speed, rtol=1e-13)
        np.testing.assert_allclose(si["impact_speed_max"].values[k], speed * there.units.velocity_m_per_s, rtol=1e-12)
    assert si["force_n"].attrs["units"] == "N" and si["impact_speed_max"].attrs["units"] == "m/s"


REFUSED: list[tuple[Any, str]] = [
    (lambda s: vi.settle_many({"gap": [1.0], "inverse_beta": 1.0}), "the systems have no restitution\nhint: an Oscillator"),
    (lambda s: vi.settle_many({**SAMPLES, "mass": 1.0}), "`mass` is no parameter and no coordinate of a start; there are beta"),
    (lambda s: vi.settle_many(s, starts={"gap": [1.0]}), "starts has no coordinate `gap`; there are x, v, phase\nhint: parameters"),
    (lambda s: vi.settle_many(s, over={"gap": [1.0, 2.0]}, starts={"v": [1.0, 2.0, 3.0]}), r"do not broadcast to one shape: gap \(2,\), v \(3,\)"),
    (lambda s: vi.settle_many(s, over={"restitution": [0.5, 0.5, 1.5]}), r"restitution eps = 1.5 lies outside 0 <= eps <= 1 \(point 2\)\nhint"),
    (lambda s: vi.settle_many(s, starts={"v": np.empty(0)}), "there are no points"),
    (lambda s: vi.settle_many(s, over={"beta": [1.0]}, starts={"x": 0.0}, fields=["speed"]), "`speed` is no quantity"),
    (lambda s: vi.settle_many({"gap": 1.0, "v": 1.0, "restitution": 0.5, "beta": 1}, starts={"v": [1.0]}), "v is given twice, the second time in starts"),
]


@pytest.mark.parametrize(("ask", "sentence"), REFUSED, ids=range(len(REFUSED)))
def test_points_that_make_no_sense(s: vi.Oscillator, ask: Any, sentence: str) -> None:
    with pytest.raises(vi.QuestionError, match=sentence):
        ask(s)


def test_wrong_types(s: vi.Oscillator) -> None:
    for ask in (
        lambda: vi.settle_many([1, 2]),  # type: ignore[call-overload]
        lambda: vi.settle_many(s, starts={"v": ["a"]}),
        lambda: vi.settle_many(s, [0.0], starts={"v": [0.0]}),  # type: ignore[call-overload]
        lambda: vi.settle_many(SAMPLES, [0.0]),  # type: ignore[call-overload]
        lambda: vi.settle_many(s, v=[1.0, 2.0]),  # type: ignore[call-overload]
    ):
        with pytest.raises(TypeError):
            ask()


def test_points_are_drawn_over_the_first_two_that_vary() -> None:
    ds = vi.settle_many(SAMPLES)
    ax = ds.vibro.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("1/$β$", "$δ$") and "$ε$ from" in ax.get_title()
    drawn = np.concatenate([line.get_xdata() for line in ax.get_lines()])
    assert sorted(drawn.tolist()) == sorted(SAMPLES["inverse_beta"].tolist())
    legend = ax.get_legend()
    assert legend is not None and len(legend.get_texts()) == sum(len(line.get_xdata()) > 0 for line in ax.get_lines())
