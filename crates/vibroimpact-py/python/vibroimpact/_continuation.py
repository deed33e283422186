"""The questions in which numbers of the system vary, as those of `_questions.py`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, SupportsIndex

from numpy.typing import ArrayLike

from vibroimpact import _core
from vibroimpact._arguments import Axis, Interval, Progress, beside, plane, sweep
from vibroimpact._branch import Branch, Curve
from vibroimpact._core import QuestionError
from vibroimpact._margins import Margins
from vibroimpact._oscillator import Oscillator
from vibroimpact._question import ask, document
from vibroimpact._region import Region
from vibroimpact._response import Response
from vibroimpact._system import Start, System, numbered


def branch(
    system: System, vary: str, to: float | tuple[float, float], *, label: str | None = None, also: Mapping[str, float] | None = None,
    orbit: SupportsIndex | None = None, follow: SupportsIndex = 0, points: SupportsIndex = 5000, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Branch:
    """Follow a periodic orbit, stable or not, in one number and through its events.

    The orbit is searched at `system` and followed by pseudo-arclength continuation to the value `to`. Events are located to
    rounding. At a grazing event the branch continues with the orbit on the other side of the event.

    Parameters
    ----------
    system : Oscillator or Machine
        The system at which the branch begins.
    to : float or (float, float)
        The other end of its range; or both ends, for a branch that is followed both ways from `system`.
    also : dict
        A second number that varies in proportion to the first, and its value where the first is `to`: {"inverse_beta": 1.05}. Its
        value at the beginning is that of `system`. So a branch can follow any line in two numbers.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.branch(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), "gap", 2.5, label="1/1", follow=1)
    >>> [(event.kind, round(event.parameter, 9)) for event in found.events]
    [('flip', 1.82900619), ('end of range', 2.5)]
    >>> [event.kind for event in found.followed[0].events]
    ['fold', 'grazing', 'end of range']
    >>> found = vi.branch(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), "gap", (0.2, 2.5), label="1/1")
    >>> found.parameter[[0, found.start, -1]].tolist(), [event.kind for event in found.events]
    ([0.2, 1.5, 2.5], ['end of range', 'fold', 'grazing', 'flip', 'end of range'])
    >>> [(of.kind, of.stop) for of in vi.Machine.named("two-mass-hammer").branch("frequency", 1.05).events]
    [('grazing', 'anvil'), ('fold', None), ('end of range', None)]
    """
    back, end = map(float, to) if isinstance(to, Sequence) else (None, float(to))
    second = beside(also)
    line = second and {numbered(system): second[0], "to": float(second[1])}
    task = {"label": label, "orbit": orbit, "vary": vary, "to": end, "back": back, "also": line, "follow": follow, "points": points}
    return ask(Branch, Start(system, q=q, qdot=qdot, phase=phase), "branch", task, "branches", progress)


def curve(
    system: System, kind: str, over: Mapping[str, Interval], *, label: str | None = None, orbit: SupportsIndex | None = None,
    event: SupportsIndex | None = None, points: SupportsIndex | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Curve:
    """Follow an event of an orbit in a plane of two numbers.

    The orbit is searched at `system` and followed in the first number to both ends of its range, as long as it keeps its
    label. From an event of the given kind the curve is followed in both directions to the edge of the plane.

    Parameters
    ----------
    system : Oscillator or Machine
        The system at which the orbit is searched; it must lie in the plane.
    kind : str
        "fold", "flip" or "grazing"; of a machine also "torus", "corner", and "sticking" and "holding", the begin and the end of sticking
        on a stop and of holding of a friction joint.
    over : mapping
        Two numbers and their ranges; the orbit is followed in the first one:
        {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}. With physical units also {"gap_m": (0.001, 0.01), "force_n": (20, 60)}; the
        velocities of the impacts are in the units at each point, which depend on the mass, the stiffness and what drives it. Of a
        machine paths.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> osc = vi.Oscillator(inverse_beta=0.7, gap=2, restitution=0.5)
    >>> fold = vi.curve(osc, "fold", {"gap": (0, 5), "inverse_beta": (0.45, 0.9)}, label="1/1")
    >>> [(event.kind, round(event.values[0], 6)) for event in fold.events]
    [('resonant grazing', 0.333333), ('end of box', 5.0)]
    >>> found = vi.Machine.named("two-mass-hammer").curve("grazing", {"frequency": (0.9, 1.3), "b": (0.4, 0.6)})
    >>> found.kind, [event.kind for event in found.events]
    ('grazing', ['end of box', 'end of box'])
    """
    vary, other = ({numbered(system): path, "from": first, "to": last} for path, first, last in plane(over))
    task = {"label": label, "kind": kind, "vary": vary, "and": other, "orbit": orbit, "event": event, "points": points}
    return ask(Curve, Start(system, q=q, qdot=qdot, phase=phase), "curve", task, "curves", progress)


def region(
    system: System, label: str, over: Mapping[str, Interval], *, grid: SupportsIndex = 24, threads: SupportsIndex = 0,
    progress: Progress = None,
) -> Region:
    """Find the regions of a plane of two parameters in which the motion m/n exists and is stable, as closed polygons.

    Orbits are searched on a grid. From each orbit the boundary of its part of the region is followed along the curves of
    events that form it.

    Parameters
    ----------
    system : Oscillator or Machine
        The system; its values of the two parameters are ignored. A machine must have one coordinate on a spring, forcing of
        order 1, no friction, and one rigid stop or two on opposite sides.
    over : mapping
        Two parameters and their ranges, the abscissa first: {"inverse_beta": (0.4, 2), "gap": (-1, 5)}. With
        physical units also two of them: {"mass_kg": (0.7, 0.95), "force_n": (10, 60)}. Of a machine paths:
        {"frequency": (0.5, 1.5), "stop.wall.gap": (0, 2)}.

    Examples
    --------
    >>> from vibroimpact import Oscillator, region
    >>> osc = Oscillator(inverse_beta=1, gap=0, restitution=0.5)
    >>> found = region(osc, "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=6)
    >>> bool(found.stability.contains(0.8, 1.5))
    True
    """
    across, up = ({numbered(system): name, "from": low, "to": high} for name, low, high in plane(over))
    task = {"label": label, "across": across, "up": up, "grid": grid}
    return ask(Region, Start(system), "region", task, "regions", progress, lambda fields: 2, threads)


def _motions(fields: Mapping[str, Any]) -> int:
    over = fields["over"]
    return 2 * len(_core.span_values(over) if isinstance(over, str) else over)


def response(
    system: System, vary: str, over: Axis, *, quantity: str | None = None, impacts: SupportsIndex | None = None,
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
    quantity : str
        The quantity that is drawn; all are computed. `Motion.quantities` has the names. Default: "displacement_amplitude", of a
        machine that of its first coordinate.

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
    task = {"vary": vary, "over": sweep(over), "quantity": quantity and quantity.replace("-", "_"), "impacts": impacts}
    return ask(Response, Start(system), "response", task, "motions", progress, _motions)


def margins(
    system: System, *, label: str | None = None, vary: Sequence[str] | None = None, scale: Mapping[str, float] | None = None,
    within: float = 2.0, lines: SupportsIndex | None = None, x: float | None = None, v: float | None = None,
    q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Margins:
    """Find how far a periodic motion is from the events that end or change it.

    The motion is followed in each number alone, up and down, to the nearest event: a fold, a flip, a grazing impact, the end of a
    rest. Of an oscillator the largest box of all parameters together is looked for in which the motion is stable. It is found by
    trying points along lines from its centre, so events between the lines may be missed.

    Parameters
    ----------
    vary : sequence of str
        The numbers that vary; by default all of an oscillator, whose frequency is "beta" or "inverse_beta", and of a machine the
        parameters of the file, and the numbers that are written as such and are not 0, without directions.
    scale : dict
        The change of a parameter of an oscillator that counts as 1 in the box; by default its value.
    within : float
        Events are looked for from each value divided by this number to the value times this number, above 1 and up to 100;
        a restitution from 0 to 1.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.margins(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), vary=["gap"])
    >>> found
    <Margins of 1/1, nearest flip at gap 1.82901>
    >>> found.parameters["gap"].up.distance
    0.32900618968...
    >>> vi.Machine.named("two-mass-hammer").margins(vary=["omega"])
    <Margins of 1/1, nearest grazing at omega 1.055>
    """
    if isinstance(vary, str):
        raise TypeError(f'vary = {vary!r} is not a list of numbers, such as ["gap"]')
    scales, varied = dict(scale or {}), list[Any](vary or [])
    if isinstance(system, Oscillator):
        if vary is None and scales:
            varied = _core.varied_parameters(system._file)
        for name in scales:
            if name not in varied:
                raise QuestionError(f"the scale of {name} has no effect: it does not vary\nhint: vary has its name")
        varied = [{"parameter": name} | ({"scale": scales[name]} if name in scales else {}) for name in varied]
    elif scales or lines is not None:
        raise QuestionError("scale and lines belong to the box, which is not looked for in numbers of a machine")
    place = Start(system, x, v, q, qdot, phase)
    task = place.within({"label": label, "vary": varied, "within": float(within), "lines": lines})
    return ask(Margins, place, "margins", task, "margins", progress)


document(branch=[branch], curve=[curve], region=[region], response=[response], margins=[margins])
