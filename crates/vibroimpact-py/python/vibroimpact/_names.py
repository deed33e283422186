"""The variables of Datasets by their long names, so that a Dataset is known after `rename`."""

from functools import lru_cache
from typing import TYPE_CHECKING

from vibroimpact import _core

if TYPE_CHECKING:
    import xarray as xr

#: The long names of the variables that figures and labels need.
_FIELDS = {
    "motion m/n, the most frequent first": "label",
    "motion m/n that the start leads to": "label",
    "share of the starts that lead to the motion": "share",
    "number of the cycle that the start leads to, in the tables cycle_*": "cycle",
    "whether the point was computed itself": "computed",
}
_COORDINATES = (
    "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap", "second_restitution", "x", "v", "phase",
)


@lru_cache(maxsize=1)
def _known() -> dict[str, str]:
    """The names by the long names."""
    coordinates = (*_COORDINATES, *_core.body_parameters())
    return {**_FIELDS, **{_core.coordinate_words(name)[0]: name for name in coordinates}}


def _given(ds: "xr.Dataset") -> dict[str, str]:
    """The names that renamed variables were given when the Dataset was computed, by their names now."""
    known = _known()
    found = {str(now): known.get(str(of.attrs.get("long_name", "")), str(now)) for now, of in ds.variables.items()}
    return {now: name for now, name in found.items() if now != name and name not in ds.variables}


def here(ds: "xr.Dataset", name: str) -> str:
    """The name that a variable has now, if the Dataset has it."""
    return next((now for now, given in _given(ds).items() if given == name), name)


def restored(ds: "xr.Dataset") -> "xr.Dataset":
    """The Dataset with the names that its variables were given."""
    free = {now: name for now, name in _given(ds).items() if name not in ds.dims}
    whole: xr.Dataset = ds.rename(free) if free else ds
    return whole
