"""Random machines aimed at difficult numbers: exact resonance, defective modes, stiff contacts, touches.

Modes appear here only to choose numbers; the simulator does not know them. All matrices are exact in binary."""

from flint import arb, arb_poly

from flow import guard_coefficients, refine
from kinds import KINDS
from model import exactly
from parts import (
    NAMES,
    basis,
    compliant,
    decimal,
    direction,
    dyadic,
    joint,
    moving,
    place,
    pushes,
    restitution,
    start,
    structure,
)
from simulation import Simulation


def from_modes(n, values):
    """Q diag(values) Q with an exact reflection Q: n = 1, 2, 4, or 3 (two coupled, one apart)."""
    if n == 1:
        return [[values[0]]]
    if n == 4:
        q = [[(1.0 if i == j else 0.0) - 0.5 for j in range(4)] for i in range(4)]
        return [[sum(q[i][k] * values[k] * q[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
    a, b = (values[0] + values[1]) / 2, (values[0] - values[1]) / 2
    if n == 2:
        return [[a, b], [b, a]]
    return [[a, b, 0.0], [b, a, 0.0], [0.0, 0.0, values[2]]]


def stops_and_joints(r, machine, begin):
    n = len(machine["coordinates"])
    choice = r.random()
    if choice < 0.45:
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    elif choice < 0.9:
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r)})
    else:
        joint(r, machine)
    if r.random() < 0.25:
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r)})
    return machine, begin


def resonant(r):
    """Undamped; one harmonic of the forcing has the frequency of a mode, to the last bit."""
    n = r.choice([1, 1, 2, 2, 3, 4])
    modes = [dyadic(r, 0.5, 2.75, 8) for _ in range(n)]
    mass = r.choice([1.0, 1.0, 0.5, 2.0, 3.0])
    stiffness = [[mass * x for x in row] for row in from_modes(n, [w * w for w in modes])]
    machine = {"coordinates": NAMES[:n], "mass": [mass] * n, "stiffness": stiffness}
    pushes(r, machine, forced=True)
    order = r.choice([1, 1, 1, 2])
    machine["frequency"] = r.choice(modes) / order
    machine["force"] = [
        {
            "order": h,
            "cos": [decimal(r, -0.6, 0.6, 2) for _ in range(n)],
            "sin": [decimal(r, -0.6, 0.6, 2) if r.random() < 0.4 else 0.0 for _ in range(n)],
        }
        for h in ([1] if order == 1 else r.choice([[2], [1, 2]]))
    ]
    return stops_and_joints(r, machine, start(r, n, 0.5))


NEAR = [0.0, 0.0, 0.0, 1e-8, -1e-8, 1e-12, -1e-12, 2.0**-52, -(2.0**-53)]


def defective(r):
    """A mode that is damped critically, or two modes that coincide without a second eigenvector, or nearly so."""
    near = 1 + r.choice(NEAR)
    if r.random() < 0.5:
        n = r.choice([1, 1, 2, 3, 4])
        modes = [dyadic(r, 0.5, 2.5, 8) for _ in range(n)]
        ratios = [r.choice([1.0, dyadic(r, 0.05, 1.5)]) for _ in range(n)]
        ratios[0] = near
        machine = {
            "coordinates": NAMES[:n],
            "mass": [1.0] * n,
            "stiffness": from_modes(n, [w * w for w in modes]),
            "damping": from_modes(n, [2 * z * w for z, w in zip(ratios, modes)]),
        }
    else:  # (x^2 + alpha x + beta)^2 is the characteristic polynomial, and the matrix has one eigenvector for each root
        n = 2
        d = r.choice([0.0625, 0.125, 0.25, 0.5])
        alpha, s = d + dyadic(r, 0, 0.5), dyadic(r, 0.5, 2, 8)
        k, e = s * s + (d * d + alpha * alpha) / 4, alpha * d / 2
        kappa = d * s * near
        machine = {
            "coordinates": NAMES[:2],
            "mass": [1.0, 1.0],
            "stiffness": [[k + e, -kappa], [-kappa, k - e]],
            "damping": [alpha + d, alpha - d],
        }
    pushes(r, machine, forced=True)
    for f in machine["force"]:
        f["cos"], f["sin"] = [round(2 * x, 2) for x in f["cos"]], [round(2 * x, 2) for x in f["sin"]]
    return stops_and_joints(r, machine, start(r, n, 1.0))


def stiff(r):
    """Contact stiffness from 1e4 to 1e8."""
    machine, begin, n = basis(r, free=False)
    for _ in range(r.choice([1, 1, 2])):
        place(
            r, machine, begin, {"direction": direction(r, n), **compliant(r, k=float(f"{10 ** r.uniform(4, 8):.2g}"))}, 0.02
        )
    if r.random() < 0.2:
        joint(r, machine)
    return machine, begin


def records(machine, begin, limit=30, parts=32):
    """Largest reaches so far of the only stop along the motion without it, up to time `limit`."""
    found = []

    def trace(s, regime, terms, _):
        rows = [s.machine.gap_rates[0], s.machine.gaps[0]]
        rate, gap = (arb_poly(c) for c in guard_coefficients(rows, terms))
        for i in range(parts):
            a, b = arb(i) / parts, arb(i + 1) / parts
            if rate(a) < 0 and rate(b) > 0:
                found.append(gap(refine(-1 * rate, a, b)).mid())

    s = Simulation(machine, exactly, begin, trace)
    s.run(1, arb(limit))
    reach = [s.machine.stops[0].gap - g for g in found]
    best, out = s.machine.stops[0].gap - gap_at(machine, begin), []
    for x in reach:
        if x > best:
            best = x
            out.append(x.mid())
    return out


def gap_at(machine, begin):
    """Gap of the only stop at the start."""
    s = Simulation(machine, exactly, begin)
    return sum((a * b for a, b in zip(s.machine.gaps[0], s.z.entries())), arb(0))


def grazing(r):
    """The gap is chosen so that a maximum of the free motion just reaches the stop, or just does not."""
    while True:
        machine = pushes(r, structure(r))
        n = len(machine["coordinates"])
        begin = start(r, n)
        stop = {"name": "s0", "direction": direction(r, n), "restitution": restitution(r), "gap": 1000.0}
        if r.random() < 0.5:
            stop = {"name": "s0", "direction": stop["direction"], **compliant(r), "gap": 1000.0}
        if r.random() < 0.2:
            stop["motion"] = moving(r, machine)
        machine["stop"] = [stop]
        reaches = [x for x in records(machine, begin) if abs(x) > 0.01]
        if reaches:
            chosen = r.choice(reaches[:4])
            stop["gap"] = float(chosen * (1 + r.choice([1, -1]) * arb(r.choice(["1e-6", "1e-9", "1e-12"]))))
            return machine, begin


def free(r):
    """Bodies that nothing ties to the ground but a stop or a joint; constant forces push them."""
    n = r.choice([1, 1, 2, 2, 3, 4])
    machine = pushes(r, structure(r, n=n, free=True), forced=r.random() < 0.4, constant=False)
    side = r.choice([1.0, -1.0])
    machine["constant"] = [side * decimal(r, 0.1, 1, 2) for _ in range(n)]
    begin, at = start(r, n, 0.5), r.randrange(n)
    w = [side if i == at else 0.0 for i in range(n)]
    choice = r.random()
    if choice < 0.5:
        place(r, machine, begin, {"direction": w, "restitution": restitution(r)})
    else:
        place(r, machine, begin, {"direction": w, **compliant(r)})
    if choice > 0.75 or n > 1 and r.random() < 0.3:
        joint(r, machine)
    if n > 1 and r.random() < 0.3:
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    return machine, begin


def stack(r):
    """Bodies one above the other on the ground: those below rest while those above strike, chatter and rest."""
    n = r.choice([2, 2, 3])
    machine = {"coordinates": NAMES[:n], "mass": [dyadic(r, 0.25, 3) for _ in range(n)]}
    pushes(r, machine, forced=r.random() < 0.5, constant=False)
    for f in machine.get("force", []):
        f["cos"], f["sin"] = [round(x / 2, 3) for x in f["cos"]], [round(x / 2, 3) for x in f["sin"]]
    if r.random() < 0.3:
        machine["damping"] = [dyadic(r, 0, 0.25, 64) for _ in range(n)]
    machine["constant"] = [-m for m in machine["mass"]]
    low = r.choice([0, 1, 1])  # bodies that rest at the start
    begin = {"q": [0.0] * n, "qdot": [0.0] * n, "phase": decimal(r, 0, 6.28)}
    for i in range(low, n):
        begin["q"][i] = dyadic(r, 0.0625, 0.5) + (begin["q"][i - 1] if i else 0.0)
        begin["qdot"][i] = decimal(r, -0.5, 0.5)
    machine["stop"] = []
    for i in range(n):
        w = [0.0] * n
        w[i] = -1.0
        if i:
            w[i - 1] = 1.0
        s = {"name": f"s{i}", "direction": w, "gap": 0.0, "restitution": decimal(r, 0.0, 0.75, 2)}
        machine["stop"].append(s)
    return machine, begin


for kind in (resonant, defective, stiff, grazing, free, stack):
    KINDS[kind.__name__] = kind
