"""A quantity of all motions over one parameter: branches, stable or not, and the motions of sweeps up and down."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._result import Rows, View

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class ResponseCurve(Rows):
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

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        columns = Rows._table(self)
        quantities = columns.pop("quantities")
        return {**columns, **quantities}

    def __repr__(self) -> str:
        return f"<ResponseCurve with {len(self)} points: {', '.join(dict.fromkeys(self.label.tolist()))}>"


class Response(View):
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
        The unit of each quantity; those of SI over a number of a body.
    plan : str
        The plan as JSON.
    """

    vary: str
    quantity: str
    up: ResponseCurve
    down: ResponseCurve
    branches: list[ResponseCurve]
    units: dict[str, str]

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        found, all_ = super()._read(answer), answer.columns() or {}
        lists = [of["points"] for of in (*found["sweeps"], *found["branches"])]
        up, down, *branches = [_curve(points, all_["names"], values) for points, values in zip(lists, all_["curves"])]
        units = dict(zip(all_["names"], all_["units"]))
        return {**found, "up": up, "down": down, "branches": branches, "units": units}

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
        self, ax: Any = None, *, quantity: str | None = None, si: bool = False, legend: bool = True, title: str | None = None, **line: Any
    ) -> "Axes":
        """Draw a quantity over the parameter: stable branches solid, neutral ones dashed and dotted, unstable ones dashed, the motions of the sweeps as dots.

        Parameters
        ----------
        ax : Axes
            The axes to draw in; new ones by default.
        quantity : str
            Another quantity than that of the response.
        si : bool
            Whether to draw in metres and seconds, for an oscillator with units; over a number in SI units this is always so.
        """
        if quantity is not None and quantity not in self.up.quantities:
            known = ", ".join(self.up.quantities)
            raise _core.QuestionError(f"`{quantity}` is no quantity; there are {known}")
        figure = self._figure(si=si or any(self.units.values()), quantity=quantity)
        drawn: Axes = self._painted(figure, ax, legend, title, line)
        return drawn

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json."""
        found: dict[str, Any] = json.loads(self._whole.json(False))
        return found


def _curve(points: list[dict[str, Any]], names: list[str], values: NDArray[np.float64]) -> ResponseCurve:
    def column(name: str, kind: Any) -> NDArray[Any]:
        return np.array([point[name] or "" if kind is np.str_ else point[name] for point in points], dtype=kind)

    return ResponseCurve(
        column("parameter", np.float64), column("label", np.str_), column("stable", np.bool_), column("stability", np.str_),
        column("admissible", np.bool_), {name: values[:, k] for k, name in enumerate(names)},
    )
