"""A ball on a vibrating table is the limit of the oscillator for a high frequency ratio, with errors of order beta^-2.

A ball under gravity g bounces with restitution e on a table at A sin(w t). Its height h above the table, in units of A,
over the phase T = w t, with Gamma = A w^2 / g, obeys

    h'' = sin T - 1/Gamma,   h >= 0.

The oscillator obeys xi'' + xi = sin(beta tau), xi <= delta. With delta = -1/Gamma and xi = delta - h / beta^2, its time
beta tau as the phase, and T = beta tau + pi,

    h'' = sin T - 1/Gamma - h / beta^2,   h >= 0.

So the phase of the table is the phase of the force less pi, velocities in units of A w are beta times those of the
oscillator, and events differ by O(beta^-2).

From h = 0 and h' = W at the phase T, the ball flies as (a flight s later)

    h = -s^2/(2 Gamma) + s (W + cos T) - sin(T + s) + sin T,   h' = W - s/Gamma + cos T - cos(T + s).            (1)

All closed forms below follow from (1). Those of the bouncing ball with one impact in n periods are known since Holmes (J.
Sound Vib. 84 (1982) 173), those of the wholly inelastic ball are in Luck and Mehta (Phys. Rev. E 48 (1993) 3988).
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi

# the frequency ratio per period of the table in a flight; the order is measured between neighbours
RATIOS = (20, 40, 80, 160)


def table(phase: float) -> float:
    """The phase of the table, -pi to pi, from that of the force."""
    return math.remainder(phase - math.pi, 2 * math.pi)


def oscillator(beta: float, gamma: float, restitution: float) -> vi.Oscillator:
    """The oscillator that is a ball in the limit of an infinite `beta`."""
    return vi.Oscillator(beta=beta, gap=-1 / gamma, restitution=restitution)


def has_order_two(errors_at: Callable[[float], Sequence[float]], periods: float = 1) -> None:
    """The errors are of order 2 in 1 / beta: from beta to 2 beta each falls by 2^2, nearly, and nearer as beta grows."""
    errors = np.abs([errors_at(ratio * periods) for ratio in RATIOS])
    # far above rounding errors, so that the orders mean something
    assert errors.min() > 1e-8, errors
    orders = np.log2(errors[:-1] / errors[1:])
    for order, margin in zip(orders, (0.3, 0.1, 0.02)):
        assert np.all(np.abs(order - 2) < margin), (errors, orders)


def fly(gamma: float, phase: float, speed: float) -> tuple[float, float]:
    """The flight of a ball that leaves with this speed, by (1): its duration, and its speed at the impact."""

    def height(s: float) -> float:
        return -(s**2) / (2 * gamma) + s * (speed + math.cos(phase)) - math.sin(phase + s) + math.sin(phase)

    # beyond the last time, gravity has won: the sines change h by at most 2
    last = gamma * (speed + 1) + math.hypot(gamma * (speed + 1), 2 * math.sqrt(gamma))
    times = np.linspace(0, last, 20_001)[20:]
    down = times[np.argmax(np.vectorize(height)(times) < 0)]
    s = float(brentq(height, down - last / 20_000, down, xtol=1e-15, rtol=1e-15))
    return s, -(speed - s / gamma + math.cos(phase) - math.cos(phase + s))


def first_flight(beta: float, gamma: float) -> tuple[float, float, float]:
    """Take-off phase of a ball at rest on the table, duration of its flight and speed at the impact."""
    osc = oscillator(beta, gamma, 0.0)
    sim = vi.simulate(osc, x=osc.gap, v=0.0, phase=0.0, impacts=1)
    assert sim.kind.tolist() == ["stick", "release", "impact"]
    return table(sim.phase[1]), beta * float(sim.time[2] - sim.time[1]), beta * float(sim.speed[2])


@pytest.mark.parametrize("beta", [0.7, 10.0, 160.0])
def test_the_ball_leaves_the_table_where_its_acceleration_is_that_of_gravity(beta: float) -> None:
    """At sin T = 1/Gamma, for any beta, because h = 0 there; and never for Gamma < 1."""
    for gamma in (1.001, 1.5, 3.0, 12.0):
        assert abs(first_flight(beta, gamma)[0] - math.asin(1 / gamma)) < 1e-12
    osc = oscillator(beta, 0.999, 0.0)
    assert vi.simulate(osc, x=osc.gap).end == "stuck"


@pytest.mark.parametrize("gamma", [1.2, 2.0, 4.0, 7.0])
def test_flight_of_the_inelastic_ball(gamma: float) -> None:
    """The duration and the impact speed of the flight from rest, W = 0 and sin T = 1/Gamma."""
    duration, speed = fly(gamma, math.asin(1 / gamma), 0.0)

    def errors(beta: float) -> list[float]:
        _, own_duration, own_speed = first_flight(beta, gamma)
        return [own_duration - duration, own_speed - speed]

    has_order_two(errors, max(1.0, duration / (2 * math.pi)))


@pytest.mark.parametrize("n", [1, 2, 3])
def test_flights_of_whole_periods_of_the_inelastic_ball(n: int) -> None:
    """For s = 2 pi n and W = 0, (1) gives cos T = pi n / Gamma, with sin T = 1/Gamma: Gamma^2 = 1 + (n pi)^2."""
    gamma, duration = math.hypot(1, n * math.pi), 2 * math.pi * n

    def errors(beta: float) -> list[float]:
        _, own_duration, own_speed = first_flight(beta, gamma)
        return [own_duration - duration, own_speed - duration / gamma]

    has_order_two(errors, n)


@pytest.mark.parametrize(("restitution", "start"), [(0.2, (0.3, 0.2)), (0.5, (0.6, 0.9)), (0.8, (-0.5, 1.4))])
def test_impacts_one_after_another(restitution: float, start: tuple[float, float]) -> None:
    """Phases and speeds of impacts from a start on the table, flight by flight."""
    gamma, impacts = 3.0, 3
    phase, leaves, expected = *start, []
    for _ in range(impacts):
        duration, speed = fly(gamma, phase, leaves)
        phase, leaves = phase + duration, restitution * speed
        expected += [phase, speed]

    def errors(beta: float) -> list[float]:
        osc = oscillator(beta, gamma, restitution)
        sim = vi.simulate(osc, x=osc.gap, v=-start[1] / beta, phase=start[0] + math.pi, impacts=impacts)
        assert sim.kind.tolist() == ["impact"] * impacts
        own = np.stack([start[0] + beta * sim.time, beta * sim.speed], axis=1)
        return list(own.ravel() - expected)

    # impacts multiply the errors, so that the order shows at greater beta
    has_order_two(errors, 10)


BOUNCES = [(0.0, 1), (0.3, 2), (0.5, 1), (0.5, 2), (0.5, 3), (0.8, 1)]


def window(restitution: float, n: int) -> tuple[float, float]:
    """Gamma at which one impact in n periods begins to exist, and at which it doubles its period.

    With s = 2 pi n and W = e V, (1) gives V = 2 pi n / (Gamma (1 + e)) and cos T = Gamma_0 / Gamma with
    Gamma_0 = n pi (1 - e)/(1 + e). The derivative of one bounce has the determinant e^2 and the trace
    1 + e^2 - (1 + e)^2 Gamma sin T. An eigenvalue is 1 at sin T = 0, so Gamma = Gamma_0, and -1 at
    Gamma sin T = 2 (1 + e^2)/(1 + e)^2.

    The wholly inelastic ball must leave the table at once, sin T > 1/Gamma, so its flights begin at sqrt(1 + (n pi)^2).
    """
    onset = n * math.pi * (1 - restitution) / (1 + restitution)
    return onset, math.hypot(onset, 2 * (1 + restitution**2) / (1 + restitution) ** 2)


def first_gamma(restitution: float, n: int) -> float:
    """The least Gamma of stable flights of n periods."""
    return window(restitution, n)[0] if restitution > 0 else math.hypot(1, n * math.pi)


@pytest.mark.parametrize(("restitution", "n"), BOUNCES)
def test_one_impact_in_n_periods(restitution: float, n: int) -> None:
    """Phase and speed of the impact, and the multipliers, in the middle of the window of stable bouncing."""
    onset, doubles = window(restitution, n)
    gamma = (first_gamma(restitution, n) + doubles) / 2
    phase, speed = math.acos(onset / gamma), 2 * math.pi * n / (gamma * (1 + restitution))
    trace = 1 + restitution**2 - (1 + restitution) ** 2 * gamma * math.sin(phase)

    def errors(beta: float) -> list[float]:
        stable = [orbit for orbit in vi.orbits(oscillator(beta, gamma, restitution), f"1/{n}") if orbit.stable]
        assert len(stable) == 1, stable
        (orbit,) = stable
        a, b = (complex(*pair) for pair in orbit.to_dict()["multipliers"])
        # the determinant is e^2 for any beta, because there is no damper
        assert abs(a * b - restitution**2) < 1e-9
        return [table(orbit.cycle.phase[0]) - phase, beta * orbit.cycle.speed[0] - speed, (a + b).real - trace]

    has_order_two(errors, n)


@pytest.mark.parametrize(("restitution", "n"), BOUNCES)
def test_where_bouncing_begins_and_doubles_its_period(restitution: float, n: int) -> None:
    """The ends of the window, as events of the branch over the gap."""
    doubles, begins = window(restitution, n)[1], first_gamma(restitution, n)
    gamma = (begins + doubles) / 2

    def errors(beta: float) -> list[float]:
        found = []
        for kind, expected, beyond in (("fold" if restitution > 0 else "sticking begins", begins, 0.9), ("flip", doubles, 1.1)):
            branch = vi.branch(oscillator(beta, gamma, restitution), "gap", -1 / (expected * beyond), label=f"1/{n}")
            events = [event for event in branch.events if event.kind == kind]
            assert len(events) == 1, branch.events
            found.append(-1 / events[0].parameter - expected)
        return found

    has_order_two(errors, n)
