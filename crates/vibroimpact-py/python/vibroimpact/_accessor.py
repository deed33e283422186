"""`ds.vibro`: figures and labels of Datasets made here. Importing this registers it with xarray."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from vibroimpact import _core
from vibroimpact._core import QuestionError

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@xr.register_dataset_accessor("vibro")  # type: ignore[no-untyped-call]
class VibroAccessor:
    """What a Dataset of vibroimpact can do besides."""

    def __init__(self, ds: xr.Dataset) -> None:
        self._ds = ds

    def labels(self, name: str | None = None) -> xr.DataArray:
        """The words behind the codes of a variable, in its shape.

        Parameters
        ----------
        name : str
            "label" unless given, in an orbit diagram "kind": motions by their labels m/n, other codes by their
            meaning. Where there is no motion the text is empty.
        """
        name = name or ("label" if "label" in self._ds else "kind")
        if name not in self._ds:
            raise QuestionError(f"this Dataset has no variable `{name}`")
        array = self._ds[name]
        codes, places = np.unique(array.values, return_inverse=True)
        if name == "label":
            words = _core.labels_of(codes.tolist())
        elif "flag_meanings" in array.attrs:
            values = np.asarray(array.attrs["flag_values"]).tolist()
            meanings = dict(zip(values, str(array.attrs["flag_meanings"]).split()))
            words = [meanings.get(code, "") for code in codes.tolist()]
        else:
            raise QuestionError(f"`{name}` has no codes: it lacks the attribute flag_meanings")
        text = np.array(words, dtype=np.str_)[places].reshape(array.shape)
        return xr.DataArray(text, array.coords, array.dims, attrs={"long_name": array.attrs.get("long_name", name)})

    def plot(self, ax: "Axes | None" = None, *, which: str | None = None) -> "Axes":
        """The figure of what the Dataset holds: the motions over two axes, or the points of an orbit diagram.

        Parameters
        ----------
        ax : matplotlib Axes
            Where to draw; a new figure unless given.
        which : str
            Of an orbit diagram, the variable on the ordinate: "velocity" or "x" unless given.
        """
        from vibroimpact import _cells, _clouds

        if "point" in self._ds.dims:
            return _clouds.plot(self._ds, ax, which)
        if "label" in self._ds:
            return _cells.plot(self._ds, ax)
        raise QuestionError(
            "this Dataset is none that vibroimpact draws\nhint: those of basin, region_map and orbit_diagram have a figure"
        )
