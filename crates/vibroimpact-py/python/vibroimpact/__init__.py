"""Vibro-impact dynamics: oscillators that hit rigid stops.

A mass on a spring, driven by a harmonic force, hits a rigid stop:

    x'' + 2 zeta x' + x = sin(beta t + phase),   x <= gap,   u+ = -eps u-

Lengths are in units of the static deflection F/k, times in units of 1/omega_n, phases in radians;
`Oscillator.from_units` takes kg, N/m, N, Hz and m, and its attribute `units` converts results back.

>>> import vibroimpact as vi
>>> osc = vi.Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
>>> vi.settle(osc).label                    # the motion after the transient
'4/1'
>>> other = osc.replace(inverse_beta=1.3, gap=0.75)
>>> [(m.label, m.share) for m in vi.attractors(other, starts=200)]     # all attractors, and their shares of the starts
[('2/1', 0.64), ('1/1', 0.36)]

| result | function |
|---|---|
| every impact of a motion, of many motions | `simulate`, `simulate_many` |
| the motion after its transient, from one start or from many, of one system or of many | `settle`, `settle_many` |
| the attractors, and their shares of the starts | `attractors` |
| points drawn from a box of parameters and starts | `sample` |
| periodic orbits, stable or not | `orbits` |
| a branch of periodic orbits in one parameter, through its events | `branch` |
| a curve of folds, flips or grazing impacts in two parameters | `curve` |
| the regions where a motion exists and where it is stable | `region` |
| a quantity of all motions over one parameter: branches, and sweeps up and down | `response` |
| how far a motion is from the events that end or change it | `margins` |
| restitution, stiffness, damping and times of the contact with a spring and a damper | `contact` |
| the border between the starts of two motions, and the saddle on it | `edge` |
| Lyapunov exponents and the dimension of the attractor | `lyapunov` |
| the motion after its transient at each value of a parameter | `orbit_diagram` |
| the motion to which each start leads; the motions at each point of a parameter plane | `basin`, `region_map` |
| a machine of several coordinates, and its motions | `Machine` |
| a study of any size: a plan in a store | `Plan`, `run`, `resume`, `status`, `verify`, `open`, `vibroimpact.dask` |

Results contain arrays. `plot()` draws a figure, `to_dict()` returns the fields of the JSON of the command, and
`to_dataframe()` returns a table of pandas. Results are equal if all their values are.
"""

from typing import TYPE_CHECKING

from vibroimpact import _grids, dask
from vibroimpact._arguments import Span, set_threads, span
from vibroimpact._branch import Branch, BranchEvent, Curve, CurveEvent, Origin
from vibroimpact._contact import Contact, contact
from vibroimpact._continuation import branch, curve, margins, region, response
from vibroimpact._core import QuestionError, StoppedError, StoreError, __version__
from vibroimpact._events import Events, Measured
from vibroimpact._grids import basin, orbit_diagram, region_map
from vibroimpact._lyapunov import Closings, Lyapunov, Strobes
from vibroimpact._machine import Machine
from vibroimpact._margins import MarginEnd, Margins, MotionBox, Nearest, ParameterMargin
from vibroimpact._motion import Motion, Settled
from vibroimpact._motions import Attractor, Attractors, EarlierContact, Edge, Orbit, Orbits, Settlement
from vibroimpact._oscillator import Oscillator, Questions, Units
from vibroimpact._plan import Estimate, Plan
from vibroimpact._questions import attractors, edge, lyapunov, orbits, settle, simulate
from vibroimpact._refine import refine
from vibroimpact._region import Part, Polygon, Region
from vibroimpact._register import register as _register
from vibroimpact._response import Response, ResponseCurve
from vibroimpact._sample import Sample, sample
from vibroimpact._settle_many import settle_many
from vibroimpact._simulate_many import simulate_many
from vibroimpact._simulation import Simulation, Waveform
from vibroimpact._store import Ran, Status, Verified, open, resume, run, status, verify

if TYPE_CHECKING:
    from vibroimpact._accessor import VibroAccessor

_register()
# of a question that is refused for another reason than its range
for _name in ("name", "given", "least", "most"):
    setattr(QuestionError, _name, None)
setattr(QuestionError, "hint", property(lambda error: str(error).partition("\nhint: ")[2] or None))
# the questions are methods of both systems
_QUESTIONS = (
    simulate, simulate_many, settle, settle_many, attractors, lyapunov, orbits, branch, curve, region, margins, response, basin,
    edge,
)
for _name, _question in {**{of.__name__: of for of in _QUESTIONS}, "map": region_map, "diagram": orbit_diagram}.items():
    setattr(Questions, _name, _question)
# the plans of grids are made by functions of Plan
for _name in ("map", "basin", "diagram", "lyapunov", "attractors"):
    setattr(Plan, _name, staticmethod(getattr(_grids, f"plan_{_name}")))


def __getattr__(name: str) -> object:
    # its module imports xarray
    if name == "VibroAccessor":
        from vibroimpact._accessor import VibroAccessor

        return VibroAccessor
    raise AttributeError(f"module `vibroimpact` has no attribute `{name}`")


__all__ = [
    "Attractor",
    "Attractors",
    "Branch",
    "BranchEvent",
    "Closings",
    "Contact",
    "Curve",
    "CurveEvent",
    "EarlierContact",
    "Edge",
    "Estimate",
    "Events",
    "Lyapunov",
    "Machine",
    "MarginEnd",
    "Margins",
    "Measured",
    "Motion",
    "MotionBox",
    "Nearest",
    "Orbit",
    "Orbits",
    "Origin",
    "Oscillator",
    "ParameterMargin",
    "Part",
    "Plan",
    "Polygon",
    "QuestionError",
    "Ran",
    "Region",
    "Response",
    "ResponseCurve",
    "Sample",
    "Settled",
    "Settlement",
    "Simulation",
    "Span",
    "Status",
    "StoppedError",
    "StoreError",
    "Strobes",
    "Units",
    "Verified",
    "VibroAccessor",
    "Waveform",
    "__version__",
    "attractors",
    "basin",
    "branch",
    "contact",
    "curve",
    "dask",
    "edge",
    "lyapunov",
    "margins",
    "open",
    "orbit_diagram",
    "orbits",
    "refine",
    "region",
    "region_map",
    "response",
    "resume",
    "run",
    "sample",
    "set_threads",
    "settle",
    "settle_many",
    "simulate",
    "simulate_many",
    "span",
    "status",
    "verify",
]
