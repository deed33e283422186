"""Oscillators with physical units: the units are never lost, and have names that other programs read, such as pint."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pint
import pytest

import vibroimpact as vi
from vibroimpact import _core
from vibroimpact._stated import fraction, unit_of

MACHINE = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.005, restitution=0.5)
PLAIN = MACHINE.replace(units=None)


def test_f08_a_gap_of_a_machine_is_given_in_metres() -> None:
    assert MACHINE.replace(gap_m=0.004).gap == 0.004 / 0.005
    assert MACHINE.replace(gap_m=0.004).units == MACHINE.units
    both = MACHINE.replace(second_gap_m=0.01)
    assert both.second_gap == 2 and both.replace(second_gap=None).second_gap is None
    assert MACHINE.replace(gap=0.8, units=MACHINE.units).gap == 0.8
    assert MACHINE.replace(gap=0.8, units=None) == PLAIN.replace(gap=0.8)
    assert MACHINE.replace(beta=1.5, restitution=0.6).units == MACHINE.units
    for changes, sentence in (
        ({"gap": 0.004}, "gap = 0.004 of a body may be meant in F/k or in m\nhint: gap_m"),
        ({"second_gap": 0.004}, "second_gap = 0.004 of a body may be meant"),
        ({"damping": 1.5}, "damping = 1.5 of a body may be meant as a ratio or in N s/m"),
        ({"gap": 1, "gap_m": 0.005}, "one parameter, and both are given"),
    ):
        with pytest.raises(vi.QuestionError, match=sentence.replace("(", r"\(")):
            MACHINE.replace(**changes)  # type: ignore[arg-type]


DATASETS: list[tuple[str, Callable[..., "object"]]] = [
    ("basin", lambda osc, **more: vi.basin(osc, x="-1:0.9:4", v="-1:1:3", **more)),
    ("region_map", lambda osc, **more: vi.region_map(osc, {"gap": "0.5:1.5:3", "beta": [1.1, 1.2]}, starts=3, **more)),
    ("orbit_diagram", lambda osc, **more: vi.orbit_diagram(osc, "gap", "0.5:1:5", keep=4, **more)),
    ("strobe", lambda osc, **more: vi.orbit_diagram(osc, "gap", "0.5:1:5", keep=4, show="strobe", **more)),
]


@pytest.mark.parametrize(("name", "ask"), DATASETS, ids=[name for name, _ in DATASETS])
def test_f08b_datasets_keep_the_units_of_a_machine(name: str, ask: Callable[..., "object"], tmp_path: Path) -> None:
    machine, plain = ask(MACHINE), ask(PLAIN)
    # the same nondimensional numbers, and in addition the physical units
    units = [machine.attrs.pop(f"unit_{name}") for name in ("length_m", "time_s", "mass_kg")]  # type: ignore[attr-defined]
    assert units == [0.005, 0.05, 2]
    numbers = [ds.drop_attrs(deep=False) for ds in (machine, plain)]  # type: ignore[attr-defined]
    assert numbers[0].identical(numbers[1]) and "unit_length_m" not in plain.attrs  # type: ignore[attr-defined]
    si = ask(MACHINE).vibro.si()  # type: ignore[attr-defined]
    factors = {"m": 0.005, "m/s": 0.005 / 0.05, "s": 0.05}
    converted = 0
    for variable, of in si.variables.items():
        before = plain.variables[variable]  # type: ignore[attr-defined]
        unit = of.attrs.get("units") or "1"
        assert unit in {"1", "rad", *factors} and "scale" not in of.attrs and of.dims == before.dims
        if unit in factors:
            converted += 1
            np.testing.assert_array_equal(of.values, before.values * factors[unit])
        else:
            np.testing.assert_array_equal(of.values, before.values)
    assert converted > 1 and si.attrs["units"] == "si"
    other = plain.vibro.si(MACHINE.units)  # type: ignore[attr-defined]
    assert other.drop_attrs(deep=False).identical(si.drop_attrs(deep=False))
    with pytest.raises(vi.QuestionError, match="in metres and seconds already"):
        si.vibro.si()
    ax = si.vibro.plot()
    assert ax.get_ylabel().endswith((" (m/s)", " (m)", "$")) and ("(m)" in ax.get_xlabel() or r"$\beta$" in ax.get_xlabel())
    with pytest.raises(vi.QuestionError, match="no units of a body"):
        plain.vibro.si()  # type: ignore[attr-defined]
    # a store keeps the units
    stored = ask(MACHINE, store=tmp_path / "s.zarr").load()  # type: ignore[attr-defined]
    shown = next(variable for variable in ("label", "velocity", "x") if variable in si)
    assert stored.attrs["unit_mass_kg"] == 2 and stored.vibro.si()[shown].equals(si[shown])


def test_f08c_plans_keep_units() -> None:
    for make in (
        lambda osc: vi.Plan.map(osc, {"gap": "0:1:3"}),
        lambda osc: vi.Plan.basin(osc, {"x": "-1:0:3"}),
        lambda osc: vi.Plan.diagram(osc, "gap", "0:1:3"),
        lambda osc: vi.Plan.lyapunov(osc, {"gap": "0:1:3"}),
        lambda osc: vi.Plan.attractors(osc, 10),
    ):
        assert make(MACHINE).to_dict()["units"] == {"length_m": 0.005, "time_s": 0.05, "mass_kg": 2}
        assert make(PLAIN).points > 0 and "units" not in make(PLAIN).to_dict()


DAMPED = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.005, damping=1.5, restitution=0.5)

#: Numbers of the body by name.
NUMBERS = {
    "force_n": 4,
    "mass_kg": 2,
    "stiffness_n_per_m": 800,
    "frequency_hz": 25 / 6.283185307179586,
    "gap_m": 0.005,
    "damping_ns_per_m": 1.5,
}
REGISTRY = pint.UnitRegistry()


def parsed(units: str) -> pint.Unit:
    return REGISTRY(units).units if units != "1" else REGISTRY.dimensionless


def test_the_parser_refuses_other_notations() -> None:
    with pytest.raises(pint.UndefinedUnitError):
        parsed("omega_n F/k")
    # the scale of lengths would be read as a farad over the Boltzmann constant
    assert parsed("F/k") == REGISTRY.farad / REGISTRY.boltzmann_constant
    assert parsed("m/s^2") == REGISTRY.meter / REGISTRY.second**2


@pytest.mark.parametrize("stored", [False, True])
def test_every_unit_is_parsed(stored: bool, tmp_path: Path) -> None:
    fields = list(vi.settle(DAMPED).quantities)

    def where(name: object) -> dict[str, Path]:
        return {"store": tmp_path / f"{name}.zarr"} if stored else {}

    found = [
        vi.basin(DAMPED, x=[-1, 0], v="-1:1:3", fields=fields, **where(0)),
        vi.region_map(DAMPED, {"gap": "0.5:1.5:3"}, starts=2, fields=fields, **where(1)),
        vi.orbit_diagram(DAMPED, "gap", "0.5:1:3", **where(2)),
    ]
    for name, value in NUMBERS.items():
        found.append(vi.region_map(DAMPED, {name: [0.9 * value, value]}, starts=1, **where(name)))
    seen = set()
    for ds in (of.load() if stored else of for of in found):
        for name, of in ds.variables.items():
            units, scale = of.attrs["units"], of.attrs.get("scale")
            assert parsed(units).dimensionless or (scale is None and name in _core.body_parameters()), name
            seen.add(units)
        for name, of in ds.vibro.si().variables.items():
            assert "scale" not in of.attrs
            # the unit is that of the SI, without a factor
            units = of.attrs["units"]
            # pint takes a hertz for one turn, 2 pi, in a second
            if units != "Hz":
                assert REGISTRY.Quantity(1, parsed(units)).to_base_units().magnitude == 1, name
            seen.add(units)
    assert seen >= {"1", "rad", "m", "m/s", "m/s^2", "1/s", "N s", "J", "W", "N", "kg", "Hz", "N/m", "N s/m"}


@pytest.mark.parametrize(
    ("units", "shown"),
    [("m s-1", "m/s"), ("m s-2", "m/s\u00b2"), ("N s m-1", "N s/m"), ("s-1", "1/s"), ("m/s^2", "m/s\u00b2"), ("kg m", "kg m"), ("J", "J")],
)
def test_figures_show_fractions(units: str, shown: str) -> None:
    assert fraction(units) == unit_of({"units": units}) == shown
    assert unit_of({"units": "1"}) == unit_of({"units": "rad"}) == unit_of({}) == ""
    assert unit_of({"units": "1", "scale": "omega_n F/k"}) == "*ω_n F/k*"
