"""A quantity of all motions over one parameter: branches, stable or not, and the motions of sweeps up and down."""

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core, _figure
from vibroimpact._ask import System, answered, given
from vibroimpact._axis import Axis, sweep
from vibroimpact._core import Oscillator
from vibroimpact._figure import axis_of, heading, named, new_axes
from vibroimpact._progress import Progress
from vibroimpact._result import Result
from vibroimpact._styled import styled
from vibroimpact._tracks import LOOKS, curve
from vibroimpact._whole import BUDGET, maybe

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class ResponseCurve(Result):
    """The motions of a sweep, or the points of a branch from one end to the other.

    Attributes
    ----------
    parameter : ndarray
        The value of the parameter.
    label : ndarray of str
        The label of each motion.
    stable, admissible : ndarray of bool
        Whether it is stable; whether it is admissible. Motions of a sweep are both.
    stability : ndarray of str
        "stable", "neutral" or "unstable".
    quantities : dict of ndarray
        All quantities by name; nan where one is not defined.
    """

    parameter: NDArray[np.float64]
    label: NDArray[np.str_]
    stable: NDArray[np.bool_]
    stability: NDArray[np.str_]
    admissible: NDArray[np.bool_]
    quantities: dict[str, NDArray[np.float64]]

    def __len__(self) -> int:
        return len(self.parameter)

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        names = ("parameter", "label", "stable", "stability", "admissible")
        return {**{name: getattr(self, name) for name in names}, **self.quantities}

    def __repr__(self) -> str:
        return f"<ResponseCurve with {len(self)} points: {', '.join(dict.fromkeys(self.label.tolist()))}>"


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Response(Result):
    """A quantity of all motions over one parameter.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    vary, quantity : str
        The parameter, and the quantity that is drawn.
    up, down : ResponseCurve
        The motions of the sweeps with rising and with falling values.
    branches : list of ResponseCurve
        The branches on which their cycles lie.
    units : dict of str
        The unit of each quantity; those of SI over a number of a machine.
    plan : str
        The plan as JSON.
    """

    system: Any
    vary: str
    quantity: str
    up: ResponseCurve
    down: ResponseCurve
    branches: list[ResponseCurve]
    units: dict[str, str]
    plan: str

    def __repr__(self) -> str:
        count = len(self.branches)
        return f"<Response of {self.quantity} over {self.vary}: {len(self.up)} values, {count} branch{'' if count == 1 else 'es'}>"

    def _table(self) -> dict[str, Any]:
        """One row for each motion of the sweeps and each point of the branches."""
        curves = [("up", self.up), ("down", self.down), *((f"branch {k + 1}", of) for k, of in enumerate(self.branches))]
        tables = [(name, of._table()) for name, of in curves]
        joined = {name: np.concatenate([table[name] for _, table in tables]) for name in tables[0][1]}
        of = np.repeat([name for name, _ in tables], [len(curve) for _, curve in curves])
        return {"curve": of, self.vary: joined.pop("parameter"), **joined}

    def plot(
        self, ax: "Axes | None" = None, *, quantity: str | None = None, legend: bool = True, title: str | None = None, **line: Any
    ) -> "Axes":
        """Draw a quantity over the parameter: stable branches solid, neutral ones dashed and dotted, unstable ones dashed, the motions of the sweeps as dots.

        Parameters
        ----------
        ax : Axes
            The axes to draw in; new ones by default.
        quantity : str
            Another quantity than that of the response.
        """
        quantity = quantity or self.quantity
        if quantity not in self.up.quantities:
            known = ", ".join(self.up.quantities)
            raise _core.QuestionError(f"`{quantity}` is no quantity; there are {known}")
        return styled(lambda ax: self._drawn(ax, quantity), ax, legend, title, line)

    def _drawn(self, ax: "Axes | None", quantity: str) -> "Axes":
        ax = new_axes(ax, (7.2, 4.8))
        for name, of, size, colour in (("sweep up", self.up, 6.0, "0.77"), ("sweep down", self.down, 3.0, "0.38")):
            ax.plot(of.parameter, of.quantities[quantity], "o", color=colour, markersize=size, markeredgewidth=0, label=name)
        labels, looks = list[str](), set[str]()
        for branch in self.branches:
            for begin, end in _runs(branch):
                label, stability = str(branch.label[end]), str(branch.stability[end])
                looks.add(stability)
                xs, ys = branch.parameter[begin : end + 1], branch.quantities[quantity][begin : end + 1]
                curve(ax, xs, ys, LOOKS[stability], label)
                if label not in labels:
                    labels.append(label)
                    curve(ax, [], [], "-", label, label=named(label))
        for word in ("neutral", "unstable"):
            if word in looks:
                ax.plot([], [], LOOKS[word], color="black", linewidth=1.8, label=word)
        ax.set_xlabel(axis_of(self.system, self.vary))
        unit = self.units[quantity]
        words = quantity.replace("_", " ") if isinstance(self.system, Oscillator) else quantity
        ax.set_ylabel(words + (f" ({unit})" if unit else ""))
        ax.set_title(heading(self.system, (self.vary,)))
        _figure.legend(ax)
        return ax


def _runs(branch: ResponseCurve) -> list[tuple[int, int]]:
    """The first and last point of each part with one label and stability; parts share a point. Inadmissible ones are left out."""
    runs: list[tuple[int, int]] = []
    for k in range(1, len(branch)):
        if not branch.admissible[k]:
            continue
        last = runs[-1] if runs else None
        same = last is not None and last[1] == k - 1 and branch.label[k] == branch.label[k - 1]
        if same and branch.stability[k] == branch.stability[k - 1] and last is not None:
            runs[-1] = (last[0], k)
        else:
            runs.append((k - 1, k))
    return runs


def response(
    system: System,
    vary: str,
    over: Axis,
    *,
    quantity: str | None = None,
    impacts: int | None = None,
    progress: Progress = None,
) -> Response:
    """Compute the response over a number, such as the frequency.

    A sweep with rising values and one with falling values settle the motion at each value from the state of the motion at
    the value before. The branch of each cycle that they find is followed through its folds and grazing impacts. Orbits on
    branches that no sweep meets are not found.

    Parameters
    ----------
    system : Oscillator or Machine
        The system; its value of the number that varies is ignored.
    vary : str
        "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution"; for an oscillator
        from `Oscillator.from_units` also a number of the body, such as "frequency_hz", "force_n", "mass_kg" or "gap_m", over which
        the quantities are in SI units; of a machine the path of a number.
    over : str or array
        Its values: a range ("0.5:1.5:201" has 201 values) or an array.
    quantity : str
        The quantity that is drawn; all are computed. `Motion.quantities` has the names. Default: "displacement_amplitude", of a
        machine that of its first coordinate.
    impacts : int
        Budget of impacts for the motion at each value, of a machine of events. Motions that have not settled by then are undecided.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> osc = vi.Oscillator(inverse_beta=1.3, gap=0.5, restitution=0.5)
    >>> found = vi.response(osc, "gap", "0.5:1.5:11", quantity="impact_speed_max")
    >>> found.up.label.tolist()[-1], found.down.label.tolist()[-1], len(found.branches)
    ('1/1', '2/1', 1)
    >>> vi.Machine.named("two-mass-hammer").response("frequency", "1.1:1.3:3")
    <Response of q.frame.displacement_amplitude over frequency: 3 values, 1 branch>
    """
    values = sweep(over)
    count = len(_core.span_values(values)) if isinstance(values, str) else len(values)
    shown = quantity.replace("-", "_") if quantity is not None else None
    task = given(vary=vary, over=values, quantity=shown, impacts=maybe("impacts", impacts, BUDGET))
    answer = answered(system, "response", task, total=2 * count, progress=progress, what="motions")
    found, all_ = answer["object"], answer["response"]
    lists = [*(of["points"] for of in found["sweeps"]), *(of["points"] for of in found["branches"])]
    up, down, *branches = [_curve(points, all_["names"], values) for points, values in zip(lists, all_["curves"])]
    units = dict(zip(all_["names"], all_["units"]))
    return Response(system, vary, found["quantity"], up, down, branches, units, json.dumps(found["plan"]))


def _curve(points: list[dict[str, Any]], names: list[str], values: NDArray[np.float64]) -> ResponseCurve:
    def column(name: str, kind: Any) -> NDArray[Any]:
        return np.array([point[name] or "" if kind is np.str_ else point[name] for point in points], dtype=kind)

    return ResponseCurve(
        column("parameter", np.float64), column("label", np.str_), column("stable", np.bool_), column("stability", np.str_),
        column("admissible", np.bool_), {name: values[:, k] for k, name in enumerate(names)},
    )
