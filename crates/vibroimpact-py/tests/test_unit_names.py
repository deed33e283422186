"""Units of variables are names that other programs read, such as pint."""

from pathlib import Path

import pint
import pytest
import vibroimpact as vi
from vibroimpact import _core
from vibroimpact._stated import fraction, unit_of

MACHINE = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.005, damping=1.5, restitution=0.5)

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
    fields = list(vi.settle(MACHINE).quantities)

    def where(name: object) -> dict[str, Path]:
        return {"store": tmp_path / f"{name}.zarr"} if stored else {}

    found = [
        vi.basin(MACHINE, x=[-1, 0], v="-1:1:3", fields=fields, **where(0)),
        vi.region_map(MACHINE, {"gap": "0.5:1.5:3"}, starts=2, fields=fields, **where(1)),
        vi.orbit_diagram(MACHINE, "gap", "0.5:1:3", **where(2)),
    ]
    for name, value in NUMBERS.items():
        found.append(vi.region_map(MACHINE, {name: [0.9 * value, value]}, starts=1, **where(name)))
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
