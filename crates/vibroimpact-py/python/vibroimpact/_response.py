"""The response of a system: a quantity of all motions over one number."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact import _core
from vibroimpact._result import Answer, Floats, View, column


class ResponseCurve(View, schema="response PointObject"):
    """The motions of a sweep, or the points of a branch from one end to the other.

    Attributes
    ----------
    quantities : dict of ndarray
        All quantities by name; nan where one is not defined.
    """

    parameter, label, stability = column(np.float64), column(np.str_), column(np.str_)
    stable, admissible = column(np.bool_), column(np.bool_)
    quantities: dict[str, Floats]

    def __len__(self) -> int:
        return len(self._rows)

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        names = ("parameter", "label", "stable", "stability", "admissible")
        return {name: getattr(self, name) for name in names} | self.quantities

    def __repr__(self) -> str:
        return f"<ResponseCurve with {len(self)} points: {', '.join(dict.fromkeys(self.label.tolist()))}>"


class Response(Answer, schema="response"):
    """A quantity of all motions over one parameter.

    Attributes
    ----------
    up, down : ResponseCurve
        The motions of the sweeps with rising and with falling values.
    units : dict of str
        The unit of each quantity; those of SI over a number of a body.
    """

    _brief = True
    vary: str
    quantity: str
    up: ResponseCurve
    down: ResponseCurve
    branches: list[ResponseCurve]
    units: dict[str, str]

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        found, all_ = super()._read(answer), answer.columns() or {}
        columns = [dict(zip(all_["names"], values.T)) for values in all_["curves"]]
        curves = [{**of, "quantities": own} for of, own in zip((*found["sweeps"], *found["branches"]), columns)]
        up, down, *branches = [ResponseCurve(of, self.system) for of in curves]
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
    ) -> Any:
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
        return self._painted(self._figure(si=si or any(self.units.values()), quantity=quantity), ax, legend, title, line)
