"""Units of variables: their attributes, and how figures show them."""

from collections.abc import Mapping
from typing import Any

#: Powers as figures show them.
_POWERS = {"2": "\u00b2", "3": "\u00b3"}


def described(long_name: str, units: str, scale: str) -> dict[str, Any]:
    """The attributes of a variable: the unit in the notation of UDUNITS if it is known, and the scale of nondimensional numbers."""
    given = {"long_name": long_name, "units": units, "scale": scale}
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
    """The unit or the scale of a variable, as figures show it; empty for pure numbers and angles."""
    if scale := str(attributes.get("scale", "")):
        return "$" + scale.replace("omega_n", r"\omega_n") + "$"
    units = str(attributes.get("units", "1"))
    return "" if units in ("", "1", "rad") else fraction(units)


def fraction(units: str) -> str:
    """A unit in the notation of UDUNITS as a fraction: `m s-2` is m/s\u00b2."""
    above: list[str] = []
    below: list[str] = []
    for factor in units.split():
        symbol, sign, power = factor.partition("-")
        (below if sign else above).append(symbol + _POWERS.get(power, ""))
    return " ".join(above or ["1"]) + "".join(f"/{symbol}" for symbol in below)
