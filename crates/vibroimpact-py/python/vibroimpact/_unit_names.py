"""Units of variables: their attributes, and how figures show them."""

from collections.abc import Mapping
from typing import Any

#: Powers as figures show them.
_POWERS = {"2": "\u00b2", "3": "\u00b3"}


def described(long_name: str, units: str, scale: str) -> dict[str, Any]:
    """The attributes of a variable: the unit, if it is known, and the scale of nondimensional numbers."""
    given = {"long_name": long_name, "units": written(units), "scale": scale}
    return {name: text for name, text in given.items() if text}


def attributes_of(of: Mapping[str, Any]) -> dict[str, Any]:
    """The attributes of a variable that the compiled module describes."""
    attributes = described(of["long_name"], of["units"], of["scale"])
    if of["comment"]:
        attributes["comment"] = of["comment"]
    if of["flags"]:
        attributes["flag_values"] = [value for value, _ in of["flags"]]
        attributes["flag_meanings"] = " ".join(meaning for _, meaning in of["flags"])
    return attributes


def unit_of(attributes: Mapping[Any, Any]) -> str:
    """The unit or the scale of a variable, as labels of figures write it; empty for pure numbers and angles."""
    if scale := str(attributes.get("scale", "")):
        return f"*{scale.replace('omega_n', 'ω_n')}*"
    units = str(attributes.get("units", "1"))
    return "" if units in ("", "1", "rad") else fraction(units)


def written(units: str) -> str:
    """A unit of the compiled module or of a store, `m s-2`, as UDUNITS and pint read it: `m/s^2`."""
    factors = [factor.partition("-") for factor in units.split()]
    above = [symbol for symbol, sign, _ in factors if not sign]
    below = [f"/{symbol}" + (f"^{power}" if power != "1" else "") for symbol, sign, power in factors if sign]
    return " ".join(above or (["1"] if below else [])) + "".join(below)


def fraction(units: str) -> str:
    """A unit as figures show it: `m s-2` and `m/s^2` are m/s\u00b2."""
    text = written(units)
    for power, sign in _POWERS.items():
        text = text.replace(f"^{power}", sign)
    return text
