"""Machines in SI units: the impacts of the command compared with those of the physical equations, integrated by SciPy.

The physical equations, in the coordinate x of a frame at rest, are

    m x'' + c (x' - y') + k (x - y) = F sin(w t) + me w^2 sin(w t) + F0,    -d2 <= x - r <= d,

with the base y = Y sin(w t + p), the stop's motion r = R sin(w t + q), and u+ = -e u- for the velocity u = x' - r'
relative to the stop. Nothing of the conversion to an equivalent machine is used here. The command states the frame of
its results: its phases are w t + `frame.phase`, and its positions are x - r(t) - `frame.offset_m`.

Tolerance. In the norm sqrt(z^2 + (u/w_n)^2) the difference of two motions does not grow during a flight. An impact of
speed U multiplies it at most by e + |e a- + a+| / (U w_n), where a- and a+ are the relative accelerations before and after
it: this bounds the norm of the derivative of the impact. So the error of SciPy's motion is at most the sum, over the
flights, of `ACCURACY` times the size of the motion and the factors of the impacts since. All tolerances follow from this
bound. (With a hundredth of `STEP_TOLERANCE` the differences are a hundredth too: they are errors of SciPy.)

The comparison of a machine ends early only where impacts of low speed have used up SciPy's digits: the bound exceeds `USEFUL`
times the size of the motion, or does not decide whether an impact happens, or an impact is so slow that its derivative does
not describe it. How many impacts must be compared is asserted.
"""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

MACHINES, IMPACTS, GRAVITY = 12, 8, 9.80665
# relative to the size of the motion: error of SciPy in one flight, its tolerance for one step, and where comparisons end
ACCURACY, STEP_TOLERANCE, USEFUL = 3e-10, 1e-11, 1e-5
KINDS = ("base", "base, stop in space", "unbalance", "moving stop", "weight", "weight, two stops", "all together")


@dataclass
class Machine:
    """A machine as the physical equations have it, and the flags of the command that describe it."""

    mass: float
    damping: float
    stiffness: float
    omega: float
    restitution: float
    force: float = 0.0
    base: tuple[float, float] = (0.0, 0.0)
    stop: tuple[float, float] = (0.0, 0.0)
    unbalance: float = 0.0
    constant: float = 0.0
    gap: float = 0.0
    second: tuple[float, float] | None = None
    flags: list[object] = field(default_factory=list)

    @property
    def natural(self) -> float:
        """Natural frequency in rad/s."""
        return math.sqrt(self.stiffness / self.mass)

    def stop_at(self, t: float) -> tuple[float, float, float]:
        """Displacement, velocity and acceleration of the stop."""
        size, phase = self.stop
        sin, cos = math.sin(self.omega * t + phase), math.cos(self.omega * t + phase)
        return size * sin, size * self.omega * cos, -size * self.omega**2 * sin

    def field(self, t: float, y: Any) -> list[float]:
        """Velocity and acceleration of the mass."""
        w, (size, phase) = self.omega, self.base
        base, base_velocity = size * math.sin(w * t + phase), size * w * math.cos(w * t + phase)
        force = (self.force + self.unbalance * w * w) * math.sin(w * t) + self.constant
        x, v = float(y[0]), float(y[1])
        return [v, (force - self.damping * (v - base_velocity) - self.stiffness * (x - base)) / self.mass]

    def stops(self) -> list[tuple[int, float, float]]:
        """Side, distance and restitution of each stop."""
        return [(1, self.gap, self.restitution)] + ([] if self.second is None else [(-1, *self.second)])


def drawn(kind: str, rng: np.random.Generator, number: int) -> tuple[Machine, tuple[float, float, float]]:
    """A random machine of this kind, and a start: position from the equilibrium and velocity, both to the stop, and phase."""

    def log(low: float, high: float) -> float:
        return float(math.exp(rng.uniform(math.log(low), math.log(high))))

    def angle() -> float:
        return float(rng.uniform(-math.pi, math.pi))

    mass, hertz, ratio = log(0.05, 50), log(2, 60), float(rng.uniform(0, 0.1))
    stiffness = mass * (2 * math.pi * hertz) ** 2
    omega = 2 * math.pi * hertz * log(0.4, 2.5)
    m = Machine(mass, 2 * ratio * math.sqrt(mass * stiffness), stiffness, omega, float(rng.uniform(0.3, 0.95)))
    w, size, everything = omega, log(1e-4, 5e-3), kind == "all together"
    m.flags = ["--mass-kg", mass, "--stiffness-n-per-m", stiffness, "--restitution", m.restitution, "--units", "si"]
    m.flags += ["--damping-ratio", ratio] if number % 2 else ["--damping-ns-per-m", m.damping]
    m.flags += ["--frequency-hz", omega / (2 * math.pi)] if number % 4 < 2 else ["--omega-rad-per-s", omega]
    # every second machine that needs no force has one too
    if kind.startswith("weight") or kind == "moving stop" or everything or number % 2:
        m.force = stiffness * size * float(rng.uniform(0.3, 1))
        m.flags += ["--force-n", m.force]
    # all together: the stop is on the base, fixed in space, or moves while the base is at rest
    which = number % 3
    if kind.startswith("base") or everything and which < 2:
        in_space = "space" in kind or everything and which == 1
        m.base = (size, angle())
        m.stop = (0.0, 0.0) if in_space else m.base
        order = number // 2 % 3
        name = ("displacement-m", "velocity-m-per-s", "acceleration-m-per-s2")[order]
        m.flags += [f"--base-{name}", size * w**order, "--base-phase", m.base[1]] + ["--stop-in-space"] * in_space
    if kind == "moving stop" or everything and which == 2:
        m.stop = (size, angle())
        m.flags += ["--stop-displacement-m", size, "--stop-phase", m.stop[1]]
    if kind == "unbalance" or everything:
        m.unbalance = mass * size
        m.flags += ["--unbalance-kg-m", m.unbalance]
    if kind.startswith("weight") or everything:
        slope = float(rng.uniform(-1, 1))
        m.constant = mass * GRAVITY * slope
        # a half of it is given as gravity, or all
        m.flags += ["--gravity-m-per-s2", GRAVITY * slope * (0.5 if number % 2 else 1.0)]
        m.flags += ["--constant-force-n", m.constant / 2] * (number % 2)

    # a gap within the amplitude of the motion without stops, which near resonance takes too long to build up
    impedance = complex(stiffness - mass * w * w, w * m.damping)
    turned = [amplitude * complex(math.cos(phase), math.sin(phase)) for amplitude, phase in (m.base, m.stop)]
    force = m.force + m.unbalance * w * w + complex(stiffness, w * m.damping) * turned[0]
    amplitude = min(abs(force / impedance - turned[1]), 3 * abs(force - impedance * turned[1]) / stiffness)
    free, equilibrium = amplitude * float(rng.uniform(0.1, 0.7)), m.constant / stiffness
    m.gap = equilibrium + free
    m.flags += ["--gap-m", m.gap]
    if "two" in kind or everything and number % 2:
        m.second = (free * float(rng.uniform(0.6, 1.5)) - equilibrium, float(rng.uniform(0.3, 0.95)))
        m.flags += ["--second-gap-m", m.second[0], "--second-restitution", m.second[1]]
    start = (free * float(rng.uniform(-0.5, 0.5)), free * m.natural * float(rng.uniform(-0.5, 0.5)), angle() + math.pi)
    return m, start


def flight(m: Machine, t: float, y: list[float], error: float) -> tuple[Any, int, float] | None:
    """The flight from (t, y) to the next impact, the number of the stop and the time; None if a contact is undecided.

    SciPy sees a contact only if the sign of the event function differs at the ends of a step. Where it misses one, the mass
    turns back (relative velocity 0) beyond the stop. If there is such a turn before the contact, the flight is integrated
    again with steps an eighth as long. If a turn is nearer to the stop than the error, an impact is undecided.
    """
    stops, scale, worst = m.stops(), max(abs(m.gap), error / ACCURACY), math.inf

    def beyond(number: int, t: float, y: Any) -> float:
        side, gap, _ = stops[number]
        return float(side * (y[0] - m.stop_at(t)[0]) - gap)

    def reaches(number: int) -> Callable[[float, Any], float]:
        def arrives(t: float, y: Any) -> float:
            # just after an impact the distance is 0 up to rounding, but the mass moves away
            return min(beyond(number, t, y), stops[number][0] * turns(t, y) / m.natural)

        arrives.terminal, arrives.direction = True, 1  # type: ignore[attr-defined]
        return arrives

    def turns(t: float, y: Any) -> float:
        return float(y[1] - m.stop_at(t)[1])

    count, step = len(stops), 8 / max(m.omega, m.natural)
    while worst > error:
        step /= 8
        assert step * m.omega > 1e-5, f"SciPy misses an impact however short its steps are: {m}"
        run = solve_ivp(
            m.field, (t, t + 60 * 2 * math.pi / m.omega), y, "DOP853", events=[*map(reaches, range(count)), turns],
            rtol=STEP_TOLERANCE, atol=[1e-14 * scale, 1e-14 * scale * m.natural], max_step=step, dense_output=True,
        )  # fmt: skip
        assert run.status == 1, f"no impact in 60 periods: {m}"
        excess = [beyond(n, at, z) for n in range(count) for at, z in zip(run.t_events[-1], run.y_events[-1])]
        worst = max(excess, default=-math.inf)
    if worst > -error:
        return None
    hit = next(n for n in range(count) if len(run.t_events[n]))
    return run, hit, float(run.t_events[hit][0])


def compared(m: Machine, start: tuple[float, float, float], told: dict[str, Any], rows: np.ndarray) -> int:
    """Compares the impacts of the command, and its waveform between them, with SciPy; the number of impacts compared."""
    frame = told["system"]["scales"]["frame"]
    z, u, phase = start
    begin = (phase - frame["phase"]) / m.omega
    r, dr, _ = m.stop_at(begin)
    t, y = begin, [z + frame["offset_m"] + r, u + dr]
    error, size = 0.0, max(abs(y[0]), abs(y[1]) / m.natural, abs(m.gap))
    for number, event in enumerate(told["events"]):
        error += ACCURACY * size
        found = flight(m, t, y, error)
        if found is None or error > USEFUL * size:
            return number
        run, hit, at = found
        side, gap, restitution = m.stops()[hit]
        x, v = run.y[:, -1]
        r, dr, ddr = m.stop_at(at)
        speed, before = side * (v - dr), m.field(at, (x, v))[1] - ddr
        after = m.field(at, (x, dr - restitution * (v - dr)))[1] - ddr
        where = f"impact {number} at {at - begin} s, bound {error / size:.1e}: {m}"
        if error * abs(before) > 0.1 * speed**2:
            return number
        # an impact moves by the error over its speed, and its speed changes by the acceleration times that
        late, faster = error / speed, error * m.natural + error * abs(before) / speed
        assert event["kind"] == "impact" and event["stop"] == ("upper" if side > 0 else "lower"), where
        assert abs(event["time"] - (at - begin)) <= late, where
        assert abs(math.remainder(event["phase"] - m.omega * at - frame["phase"], 2 * math.pi)) <= m.omega * late, where
        assert abs(event["speed"] - speed) <= faster, where
        assert abs(side * event["qdot"][0] + restitution * speed) <= faster, where
        # the waveform of this flight, without its ends
        inside = rows[(rows[:, 0] > t - begin + late) & (rows[:, 0] < at - begin - late)]
        if len(inside):
            own = run.sol(inside[:, 0] + begin)
            moved = np.array([m.stop_at(s + begin)[:2] for s in inside[:, 0]]).T
            assert np.max(np.abs(own[0] - moved[0] - frame["offset_m"] - inside[:, 1])) <= error, where
            assert np.max(np.abs(own[1] - moved[1] - inside[:, 2])) <= error * m.natural, where
        error *= max(1.0, restitution + abs(restitution * before + after) / (speed * m.natural))
        size = max(np.max(np.abs(run.y[0])), np.max(np.abs(run.y[1])) / m.natural, abs(m.gap))
        t, y = at, [side * gap + r, dr - restitution * (v - dr)]
    return len(told["events"])


@pytest.mark.parametrize("kind", KINDS)
def test_impacts_are_those_of_the_physical_equations(kind: str, vibro: Callable[..., Any], tmp_path: Path) -> None:
    rng = np.random.default_rng([1971, KINDS.index(kind)])
    counts = []
    for number in range(MACHINES):
        m, start = drawn(kind, rng, number)
        wave = tmp_path / f"{number}.csv"
        given = [word for name, value in zip(("--x", "--v", "--phase"), start) for word in (name, value)]
        step = 2 * math.pi / m.omega / 8
        done = vibro("simulate", *m.flags, *given, "--impacts", IMPACTS, "--json", "--csv", wave, "--step", step)
        assert done.returncode == 0, done.stderr
        told = json.loads(done.stdout)
        assert told["units"] == "si" and len(told["events"]) == IMPACTS, f"{told['end']}: {m}"
        counts.append(compared(m, start, told, np.loadtxt(wave, delimiter=",", skiprows=1)))
    # every machine counts, and few end early
    assert min(counts) >= 4 and sum(counts) >= 0.9 * MACHINES * IMPACTS, counts


def test_an_impact_that_scipy_misses_is_recognised() -> None:
    """The mass turns a little beyond the stop, within one step of SciPy; shorter steps find the impact."""
    m = Machine(2.0, 0.0, 800.0, 13.0, 0.5, force=4.0, gap=1.0)
    y = [0.0, 0.0]
    free = solve_ivp(m.field, (0, 2), y, "DOP853", events=[lambda t, y: y[1]], rtol=STEP_TOLERANCE, atol=1e-14)
    top = float(np.max(free.y_events[0][:, 0]))
    for excess in (1e-3, 1e-4, 1e-5):
        m.gap = top * (1 - excess)
        found = flight(m, 0.0, y, ACCURACY * top)
        assert found is not None
        x, v = found[0].y[:, -1]
        assert abs(x - m.gap) < 1e-12 and 0 < v < 2 * m.natural * top * math.sqrt(excess) and found[2] < 2
    m.gap = top * (1 - 1e-10)
    assert flight(m, 0.0, y, ACCURACY * top) is None
