"""Grids over machines as Datasets: in memory, in stores, and as `Machine` has them."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from vibroimpact import Machine, Plan, basin, open, orbit_diagram, region_map, run, sample, settle_many
from vibroimpact._export import export

HAMMER = Machine.named("two-mass-hammer")
AXES = {"frequency": "0.8:1.2:5", "stop.anvil.gap": [0.3, 0.5, 0.75]}


def test_a_map_is_that_of_the_machine_and_of_its_store(tmp_path: Path) -> None:
    ds = region_map(HAMMER, AXES, starts=2, fields=["power", "stop.anvil.impact_speed_max"])
    assert ds["label"].dims == ("stop.anvil.gap", "frequency", "motion")
    stored = region_map(
        HAMMER, AXES, starts=2, fields=["power", "stop.anvil.impact_speed_max"], store=tmp_path / "m.zarr", tile=2
    )
    for name in ("label", "share", "speed", "multiplier", "power", "stop.anvil.impact_speed_max"):
        np.testing.assert_array_equal(stored[name].values, ds[name].values, err_msg=name)
    for gap in (0.3, 0.75):
        own = HAMMER.set({"stop.anvil.gap": gap}).map({"frequency": "0.8:1.2:5"}, starts=2)
        labels = ds.vibro.labels().sel({"stop.anvil.gap": gap}).isel(motion=0).values
        assert labels.tolist() == own.vibro.labels().values[:, 0].tolist()
    settled = HAMMER.set({"stop.anvil.gap": 0.3, "frequency": 1.2}).settle().motion
    power = ds["power"].sel({"stop.anvil.gap": 0.3, "frequency": 1.2}).isel(motion=0).item()
    assert power == pytest.approx(settled.quantities["power"], rel=1e-7)
    assert ds.vibro.plot().get_xlabel() == "frequency"


def test_basins_have_starts_of_machines() -> None:
    ds = basin(HAMMER, {"q.head": "-1:1:5", "phase": "0:6:3"}, qdot=[0, 0.5])
    # the head begins beyond the anvil
    assert ((ds["label"] == -5) == (ds["q.head"] > 0.5)).all()
    assert ds["cycle_share"].sum() == 1


def test_plans_of_machines_are_plans(tmp_path: Path) -> None:
    plan = Plan.map(HAMMER, AXES, starts=1, tile=2)
    assert Plan(plan.json) == plan and plan.points == 15
    assert run(plan, tmp_path / "m.zarr").computed == 6
    assert open(tmp_path / "m.zarr").attrs["plan_hash"] == plan.hash


def test_exponents_of_machines(tmp_path: Path) -> None:
    plan = Plan.lyapunov(HAMMER, {"frequency": "0.8:1.2:3", "qdot.head": [0, 1]}, q=[0.1, 0], impacts=500, tile=2)
    run(plan, tmp_path / "l.zarr")
    ds = open(tmp_path / "l.zarr").load()
    assert ds["exponent"].dims == ("qdot.head", "frequency", "direction") and ds.sizes["direction"] == 4
    alone = HAMMER.set({"frequency": 1.2}).lyapunov(q=[0.1, 0], qdot=[0, 1], impacts=500)
    here = ds.isel({"frequency": 2, "qdot.head": 1})
    assert here["exponent"].values.tolist() == [of.value for of in alone.exponents]
    assert here["impacts_per_period"].item() == 1 and here.vibro.labels("grounds").item() == "exact"


def test_diagrams_of_machines(tmp_path: Path) -> None:
    ds = orbit_diagram(HAMMER, "frequency", "1:1.2:5", transient=100)
    assert ds["speed"].sel(sweep=1, frequency=1.0).dropna("point").size == 2
    assert set(ds["stop"].values.ravel().tolist()) == {-1, 0}
    run(Plan.diagram(HAMMER, "frequency", "1:1.2:5", transient=100), tmp_path / "rows.zarr")
    export(tmp_path / "rows.zarr", tmp_path / "rows.csv", "csv")
    rows = pd.read_csv(tmp_path / "rows.csv")
    assert list(rows.columns) == ["frequency", "sweep", "kind", "stop", "phase", "speed"]
    assert set(rows["stop"]) == {"anvil"}
    assert ds.vibro.plot().get_ylabel() == "speed of closing"
    strobe = orbit_diagram(HAMMER, "frequency", "1:1.2:5", show="q.head", store=tmp_path / "d.zarr")
    assert strobe.vibro.plot().get_ylabel() == "q.head at phase 0"
    power = orbit_diagram(HAMMER, "frequency", "1:1.2:5", show="stop.anvil.impact_loss_per_period", direction="up")
    assert power["stop.anvil.impact_loss_per_period"].attrs["long_name"].endswith("of the motion")
    assert power.vibro.plot().get_ylabel() == "stop.anvil.impact_loss_per_period"


def test_points_are_settled_as_one_by_one(tmp_path: Path) -> None:
    frequencies, heads = np.array([0.95, 1.2]), np.array([-0.5, 0.2, 9.0])
    ds = HAMMER.settle_many(over={"frequency": frequencies[:, None]}, starts={"q.head": heads}, fields=["power"])
    labels = ds.vibro.labels()
    assert labels.shape == (2, 3) and ds["frequency"].dims == ("sample_0",) and ds["q.head"].dims == ("sample_1",)
    # the last start lies beyond the anvil
    assert (labels[:, 2] == "").all() and (ds["label"][:, 2] == -5).all() and np.isnan(ds["power"][:, 2]).all()
    for i, frequency in enumerate(frequencies):
        for j, head in enumerate(heads[:2]):
            alone = HAMMER.set({"frequency": frequency}).settle(q=[0, head]).motion
            assert labels[i, j] == alone.label and ds["power"][i, j] == pytest.approx(alone.quantities["power"], rel=1e-7)


def test_a_sample_of_a_machine_is_kept_in_a_store(tmp_path: Path) -> None:
    points = sample("lhs", 9, {"frequency": (0.9, 1.3), "q.head": (-1, 0.4)}, seed=2)
    memory = settle_many(HAMMER, over=points, fields=["power"])
    stored = settle_many(HAMMER, over=points, fields=["power"], store=tmp_path / "s.zarr", tile=4)
    assert memory.sizes["sample"] == stored.sizes["sample"] == 9
    for name in ("label", "speed", "multiplier", "power", "impacts", "frequency", "q.head"):
        np.testing.assert_array_equal(stored[name].values, memory[name].values, err_msg=name)
    assert '"drawn"' in stored.attrs["plan"] and memory.vibro.plot().get_xlabel() == "frequency"


def test_events_of_many_motions_are_those_of_each() -> None:
    gaps = [0.3, 0.5]
    ds = HAMMER.simulate_many(over={"stop.anvil.gap": gaps}, starts={"q.head": 0.1}, impacts=6)
    assert dict(ds.sizes) == {"sample": 2, "event": 6} and set(ds.vibro.labels("end").values) == {"event_limit"}
    for k, gap in enumerate(gaps):
        alone = HAMMER.set({"stop.anvil.gap": gap}).simulate(q=[0, 0.1], impacts=6)
        assert ds.vibro.labels("kind")[k].values.tolist() == alone.kind.tolist()
        assert ds.vibro.labels("stop")[k].values.tolist() == alone.stop.tolist()
        for name, column in {"time": alone.time, "speed": alone.speed, "q.head": alone.q[:, 1], "qdot.frame": alone.qdot[:, 0]}.items():
            np.testing.assert_array_equal(ds[name][k], column, err_msg=name)
