"""Moreau's impacts of rigid stops."""

from itertools import product

from flint import arb, arb_mat

from flow import Undecided, sign


def impact_velocities(machine, closed, rates, restitution):
    """Moreau's impulses L on the closed stops, by trying each set of stops that push."""
    w = arb_mat(len(closed), machine.n, [x for i in closed for x in machine.stops[i].w])
    g = w * machine.inverse_mass * w.transpose()
    solutions = []
    for pushing in product((False, True), repeat=len(closed)):
        on = [a for a, p in enumerate(pushing) if p]
        load = [arb(0)] * len(closed)
        if on:
            left = arb_mat(len(on), len(on), [g[a, b] for a in on for b in on])
            right = arb_mat(len(on), 1, [-(1 + restitution[a]) * rates[a] for a in on])
            try:
                found = left.solve(right).mid()
            except ZeroDivisionError:
                continue
            for a, x in zip(on, found.entries()):
                load[a] = x
        after = [rates[a] + sum((g[a, b] * load[b] for b in on), arb(0)) for a in range(len(closed))]
        size = sum((abs(x) for x in rates), arb(0)) + max(after, key=abs)
        size = size if size > 0 else arb(1)
        if all(load[a] > 0 for a in on) and all(
            sign((after[a] + restitution[a] * rates[a]).mid(), size) >= 0 for a in range(len(closed)) if a not in on
        ):
            solutions.append(load)
    if not solutions:
        raise Undecided("no solution of an impact")
    change = [-1 * machine.inverse_mass * w.transpose() * arb_mat(len(closed), 1, load) for load in solutions]
    size = sum((abs(x) for x in change[0].entries()), arb(0))
    for other in change[1:]:
        for x, y in zip(change[0].entries(), other.entries()):
            if abs(x - y) > 1e-50 * size:
                raise Undecided("several solutions of an impact")
    return change[0]
