"""The questions about motions of one system, each a function of the package and a method of systems; the other questions are in
`_continuation.py` and `_grids.py`. Their arguments are the fields of their tasks in plans.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, SupportsIndex

from numpy.typing import ArrayLike

from vibroimpact._arguments import Progress
from vibroimpact._lyapunov import Lyapunov
from vibroimpact._motion import Settled
from vibroimpact._motions import Attractors, Edge, Orbits
from vibroimpact._oscillator import Oscillator
from vibroimpact._question import ask, document
from vibroimpact._simulation import Simulation
from vibroimpact._system import Start, System


def _events(fields: Mapping[str, Any]) -> int:
    return fields.get("impacts") or (1 if {"periods", "time"} & fields.keys() else 100)


def simulate(
    system: System, *, impacts: SupportsIndex | None = None, periods: float | None = None, time: float | None = None,
    x: float | None = None, v: float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None,
    phase: float | None = None, progress: Progress = None,
) -> Simulation:
    """Follow a motion event by event: impacts, grazing contacts, sticking and release, contact and slip.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> sim = vi.simulate(vi.Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5), impacts=20)
    >>> sim.kind[:3].tolist(), sim.time[:3].round(4).tolist()
    (['impact', 'impact', 'impact'], [1.4598, 2.2409, 2.6025])
    >>> wave = sim.waveform()
    >>> bool(wave.q.max() <= 0.25 + 1e-12)
    True
    >>> motion = vi.Machine.named("sdnd101").simulate(impacts=2)
    >>> motion.kind.tolist(), motion.time.round(6).tolist()
    (['close', 'open'], [0.0, 0.03126])
    >>> wave = motion.waveform(1e-4)
    >>> float(wave.force[:, 0].max().round())          # 9950.37 N in closed form
    9950.0
    """
    place = Start(system, x, v, q, qdot, phase)
    task = place.within({"impacts": impacts, "periods": periods, "time": time})
    return ask(Simulation, place, "simulate", task, "events", progress, _events)


def settle(
    system: System, *, impacts: SupportsIndex | None = None, x: float | None = None, v: float | None = None,
    q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Settled:
    """Follow the motion from a start until it has settled, and confirm the result: a cycle, chaos, no further impact, or rest on
    a stop.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> osc = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> vi.settle(osc), vi.settle(osc, x=-2)
    (<Settled 2/1, stable>, <Settled 1/1, stable>)
    >>> found = vi.Machine.named("two-mass-hammer").settle()
    >>> found, found.counts, len(found.multipliers)
    (<Settled 1/1, stable>, {'anvil': 1}, 4)
    """
    place = Start(system, x, v, q, qdot, phase)
    return ask(Settled, place, "settle", place.within({"impacts": impacts}), "motions", progress)


def attractors(
    system: System, starts: SupportsIndex = 200, *, seed: SupportsIndex = 1, impacts: SupportsIndex | None = None,
    threads: SupportsIndex = 0, progress: Progress = None,
) -> Attractors:
    """Find the steady motions to which many scattered starts lead, and their shares of the starts.

    The starts are spread evenly over a box of positions, velocities and phases that contains the motion. They are the
    same on every computer. Motions with the same label are distinguished if their events differ.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> list(vi.attractors(vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)))
    [<Attractor 2/1, stable, 64 %>, <Attractor 1/1, stable, 36 %>]
    >>> vi.Machine.named("two-mass-hammer").attractors(20)
    <Attractors of 20 starts: 1/1, stable, 100 %>
    """
    task = {"starts": starts, "seed": seed, "impacts": impacts}
    return ask(Attractors, Start(system), "attractors", task, "starts", progress, lambda fields: int(fields["starts"]), threads)


def orbits(system: System, label: str, *, progress: Progress = None) -> Orbits:
    """Find the periodic orbits with m closings of stops in n forcing periods, stable or not. The fastest one comes last.

    Orbits are searched by Newton's method from many seeds; orbits 1/n of an oscillator are also computed in closed form. An orbit
    to which no seed leads is not found. Solutions that pass through a stop are inadmissible and marked as such; only some of
    them are found, and none of a machine.

    Parameters
    ----------
    label : str
        "m/n", "inf/n", "m/T" without forcing, or "0" for the motion of an oscillator without impacts.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> osc = vi.Oscillator(inverse_beta=1.11, gap=2, restitution=0.5)
    >>> vi.orbits(osc, "1/1")
    <Orbits: <Orbit 1/1, unstable>>
    >>> [orbit for orbit in vi.orbits(osc, "1/2") if orbit.admissible and orbit.stable]
    [<Orbit 1/2, stable>]
    >>> vi.Machine.named("two-mass-hammer").orbits("1/1")[-1].stable
    True
    """
    return ask(Orbits, Start(system), "orbit", {"label": label}, "searches", progress)


def edge(
    system: System, other: Mapping[str, float], *, laps: SupportsIndex | None = None, impacts: SupportsIndex | None = None,
    x: float | None = None, v: float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None,
    phase: float | None = None, progress: Progress = None,
) -> Edge:
    """Find the border between the starts of two motions, follow the motion on it, and find the saddle to which that leads.

    The way from the start to another one is halved until the border is known to rounding. Two states close to each other, one on
    each side, are then followed until they part, and their way is halved again. Where the motion on the border comes back to itself,
    Newton's method finds the cycle.

    Parameters
    ----------
    other : dict
        In what the second start differs from the first: values of "x" and "v" of an oscillator, of "q.NAME" and "qdot.NAME" of a
        machine.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.edge(vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), {"x": -2})
    >>> found, found.saddle.stability
    (<Edge of 2/1 and 1/1, saddle 2/1>, 'unstable')
    >>> vi.Machine.named("fukaya-irie-1971").edge({"q.mass": -2})
    <Edge of 2/1 and 1/1, saddle 2/1>
    """
    places = [{"coordinate": name, "value": float(value)} for name, value in dict(other).items()]
    place = Start(system, x, v, q, qdot, phase)
    return ask(Edge, place, "edge", place.within({"other": places, "laps": laps, "impacts": impacts}), "searches", progress)


def lyapunov(
    system: System, *, impacts: SupportsIndex | None = None, transient: SupportsIndex | None = None,
    points: SupportsIndex | None = None, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Lyapunov:
    """Measure the Lyapunov exponents of a motion, with error bars, and the dimension of its attractor.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.lyapunov(vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5), impacts=10_000)
    >>> found.motion.label, found.exponents[0].value > found.exponents[0].error
    ('chaotic', True)
    >>> abs(found.sum.value - found.identity) < 1e-9
    True
    >>> len(vi.Machine.named("two-mass-hammer").lyapunov(impacts=2000).exponents)
    4
    """
    place = Start(system, x, v, q, qdot, phase)

    def total(fields: Mapping[str, Any]) -> int:
        before, shown = fields.get("transient", 1000), fields.get("points")
        measured = fields.get("impacts", 100_000 if isinstance(system, Oscillator) else 20_000)
        return int(before + measured + (0 if shown is None else before + shown))

    task = place.within({"impacts": impacts, "transient": transient, "points": points})
    return ask(Lyapunov, place, "lyapunov", task, "impacts", progress, total)


document(simulate=[simulate], settle=[settle], attractors=[attractors], orbit=[orbits], edge=[edge], lyapunov=[lyapunov])
