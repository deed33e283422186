"""`ds.vibro`: figures and labels of Datasets made here. Importing this registers it with xarray."""

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from vibroimpact._core import QuestionError

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def flags(long_name: str, meanings: dict[int, str]) -> dict[str, Any]:
    """Attributes of a variable of codes, after the CF conventions."""
    return {
        "long_name": long_name,
        "flag_values": np.array(list(meanings), dtype=np.int8),
        "flag_meanings": " ".join(meanings.values()),
    }


@xr.register_dataset_accessor("vibro")  # type: ignore[no-untyped-call]
class VibroAccessor:
    """What a Dataset of vibroimpact can do besides."""

    def __init__(self, ds: xr.Dataset) -> None:
        self._ds = ds

    def labels(self, name: str = "kind") -> xr.DataArray:
        """The words behind the codes of a variable, in its shape.

        Parameters
        ----------
        name : str
            A variable with the attributes `flag_values` and `flag_meanings`.
        """
        array = self._ds[name]
        if "flag_meanings" not in array.attrs:
            raise QuestionError(f"`{name}` has no codes: it lacks the attribute flag_meanings")
        words = np.array(str(array.attrs["flag_meanings"]).split())
        codes = np.asarray(array.attrs["flag_values"])
        order = np.argsort(codes)
        return array.copy(data=words[order][np.searchsorted(codes[order], array.values)])

    def plot(self, ax: "Axes | None" = None, *, which: str | None = None) -> "Axes":
        """The figure of what the Dataset holds: of an orbit diagram its points over the parameter.

        Parameters
        ----------
        ax : matplotlib Axes
            Where to draw; a new figure unless given.
        which : str
            The variable on the ordinate: "velocity" or "x" unless given.
        """
        from vibroimpact import _clouds

        if {"sweep", "point"} <= set(self._ds.dims):
            return _clouds.plot(self._ds, ax, which)
        raise QuestionError("this Dataset is none that vibroimpact draws\nhint: those of orbit_diagram have a figure")
