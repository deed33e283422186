"""`ds.vibro`: figures and labels of the Datasets of vibroimpact. The import of this module registers it with xarray."""

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._datasets import codes_of, figure_of
from vibroimpact._json import read
from vibroimpact._stated import here, restored
from vibroimpact._oscillator import Units
from vibroimpact._paint import paint

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: A code that stands for no motion.
_NOTHING = np.iinfo(np.int32).min


@xr.register_dataset_accessor("vibro")  # type: ignore[no-untyped-call]
class VibroAccessor:
    """Additional methods for Datasets of vibroimpact."""

    def __init__(self, ds: xr.Dataset) -> None:
        self._ds = ds

    def labels(self, name: str | None = None) -> xr.DataArray:
        """The texts of the codes of a variable, in the same shape.

        Parameters
        ----------
        name : str
            Name of the variable; by default "label", or "kind" for an orbit diagram. Motions have their labels m/n,
            other codes their meanings. Where there is no motion the text is empty.
        """
        name = name or ("label" if here(self._ds, "label") in self._ds else "kind")
        now = here(self._ds, name)
        if now not in self._ds:
            raise QuestionError(f"this Dataset has no variable `{name}`")
        array = self._ds[now]
        if now == here(self._ds, "label"):
            name = "label"
        if name != "label" and "flag_meanings" not in array.attrs:
            raise QuestionError(f"`{name}` has no codes: it lacks the attribute flag_meanings")
        values = codes_of(array, name, _NOTHING)
        codes, places = np.unique(values, return_inverse=True)
        if name == "label":
            words = _core.labels_of(codes.tolist())
        else:
            flags = np.asarray(array.attrs["flag_values"]).tolist()
            meanings = dict(zip(flags, str(array.attrs["flag_meanings"]).split()))
            words = [meanings.get(code, "") for code in codes.tolist()]
        text = np.array(words, dtype=np.str_)[places].reshape(array.shape)
        return xr.DataArray(text, array.coords, array.dims, attrs={"long_name": array.attrs.get("long_name", name)})

    def measures(self) -> dict[str, Any]:
        """Measures of a basin in a plane: entropies of its boxes of 5 x 5 starts, and the uncertainty exponent.

        Returns
        -------
        dict
            "entropy" and "boundary_entropy" (Daza et al. 2016, https://doi.org/10.1038/srep31416; None without a boundary),
            the side "box_side" of their boxes, and "uncertainty_exponent" as value and standard error: 1 for a smooth
            boundary, less for a fractal one; None for planes that are too small. "merging" compares the boundaries of at
            least three basins (Daza et al. 2018, https://doi.org/10.1038/s41598-018-28119-0), else it is None: they differ
            by up to "radius" starts, "common" is the share of their starts within "limit" of all, and "wada" is whether
            the radius is at most the limit, so that all basins have one boundary at this resolution.

        Examples
        --------
        >>> from vibroimpact import Oscillator, basin
        >>> ds = basin(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), x="-4:0.75:100", v="-4:4:100")
        >>> of = ds.vibro.measures()
        >>> of["box_side"], 0 < of["entropy"] < of["boundary_entropy"] < 0.7
        (5, True)
        """
        ds = restored(self._ds)
        label = ds.get("label")
        if label is None or label.ndim != 2:
            raise QuestionError("measures are those of a basin over two axes, with the variable `label`")
        codes = np.unique(label.values, return_inverse=True)[1].reshape(-1)
        if "cycle" in ds:
            # two cycles may have one label
            pairs = np.stack([codes, ds["cycle"].values.reshape(-1)])
            codes = np.unique(pairs, axis=1, return_inverse=True)[1].reshape(-1)
        found = read(_core.basin_measures(codes.astype(np.int64), label.shape[1]))
        exponent = found["uncertainty_exponent"]
        return {"merging": None, **found, "uncertainty_exponent": exponent and (exponent["value"], exponent["error"])}

    def si(self, units: Units | None = None) -> xr.Dataset:
        """The same Dataset with all lengths and times, in values and coordinates, converted to metres and seconds.

        The plan in its attributes remains nondimensional. Figures are drawn from the Dataset before conversion.

        Parameters
        ----------
        units : Units
            The units of length and time, `osc.units`. By default those of the oscillator from which the Dataset was
            computed; the Dataset of a plan without units has none, so they must be given.

        Examples
        --------
        >>> from vibroimpact import Oscillator, basin
        >>> osc = Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.005, restitution=0.5)
        >>> ds = basin(osc, x=[-1, 0, 1]).vibro.si()
        >>> ds["x"].values.tolist(), ds["x"].attrs["units"]
        ([-0.005, 0.0, 0.005], 'm')
        """
        from vibroimpact import _si

        return _si.converted(restored(self._ds), units)

    def plot(
        self, ax: "Axes | None" = None, *, which: str | None = None, colour: str | None = None, of: str = "largest",
        legend: bool = True, title: str | None = None, **line: Any,
    ) -> "Axes":
        """Draw the Dataset: the motions over two axes or at points, their shares over one axis, or the points of an orbit diagram.

        With `colour`, the values of a quantity of the motions are drawn: over two axes in colours with a colour bar, over
        one axis as dots in the colours of the labels. Cells without a value (not defined, infinite, undecided, not
        computed) have looks of their own.

        The title states the coordinates of the Dataset, so it is still correct after `isel`, `sel`, `concat` and similar
        operations. A parameter that varied and whose coordinate was dropped is stated as not known. Values of an axis that
        neither rise nor fall are sorted.

        Parameters
        ----------
        ax : matplotlib Axes
            The axes to draw on; by default those of a new figure.
        which : str
            For an orbit diagram, the variable on the ordinate; by default "velocity" or, if absent, "x".
        colour : str
            For a basin or map, the variable whose values are drawn: one of the `fields` it was computed with, or another
            number of each motion, such as "share". The Dataset of `ds.vibro.si()` gives values in SI units.
        of : str
            Which of several motions at a point has the colour: the one with the "largest" value (or "worst"), with the
            "smallest" (or "least"), or the "likeliest", to which most starts lead.
        legend, title, line
            As for the figures of results: whether there is a legend, another title, and properties of lines and dots.

        Examples
        --------
        >>> from vibroimpact import Oscillator, region_map
        >>> osc = Oscillator(inverse_beta=1, gap=0, restitution=0.5)
        >>> over = {"inverse_beta": "1:1.3:4", "gap": "0.5:1:3"}
        >>> ds = region_map(osc, over, starts=4, fields=["impact_speed_max"])
        >>> ax = ds.vibro.plot(colour="impact_speed_max")
        >>> ax.figure.axes[1].get_ylabel()
        'largest impact speed ($ω_{n} F/k$)'
        """
        figure = figure_of(restored(self._ds), which, colour, of)
        drawn: Axes = paint(figure, ax, legend, title, line)
        return drawn
