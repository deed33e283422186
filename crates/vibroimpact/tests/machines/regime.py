"""The linear system that holds while no contact and no joint changes, and its guards.

Each regime is a linear autonomous system z' = A z; all gaps, forces of contact and holding forces are linear in z.
"""

from flint import arb, arb_mat

from flow import Flow, Undecided


class Regime:
    """The linear system for given modes of all elements, and its guards: (row, element, meaning), all positive."""

    def __init__(self, machine, modes):
        m, n = machine, machine.n
        force = [m.row() for _ in range(n)]
        for i in range(n):
            for j in range(n):
                force[i][j] -= m.stiffness[i, j]
                force[i][n + j] -= m.damping[i, j]
            force[i][m.one] += m.constant[i]
            for h, (a, b) in m.force.items():
                force[i][m.wave[h]] += a[i]
                force[i][m.wave[h] + 1] += b[i]
        guards, held, surfaces = [], [], {}
        for e, (element, mode) in enumerate(zip(m.elements, modes)):
            push = None
            if element.kind == "friction":
                row = m.slips[e - len(m.stops)]
                if mode == "hold":
                    held.append((e, element.w, m.row()))
                else:
                    side = 1 if mode == "plus" else -1
                    guards.append(([side * x for x in row], e, "zero"))
                    push = m.row()
                    push[m.one] = side * element.sliding
            elif mode == "rest":
                held.append((e, element.w, m.wave_rate(m.gap_rates[e])))
            elif mode == "closed":
                push = m.contact_force(e)
                guards.append(([-x for x in m.gaps[e]], e, "zero"))
                if element.kind == "force":
                    guards.append((push, e, "force"))
            elif mode == "back":
                row = list(m.gaps[e])
                row[m.surface[e]] += 1
                guards.append((row, e, "zero"))
                surfaces[e] = element
                if element.p > 0:
                    row = m.row()
                    row[m.surface[e]] = arb(1)
                    guards.append((row, e, "recovered"))
            else:
                guards.append((m.gaps[e], e, "zero"))
            if push:
                for i in range(n):
                    for j in range(m.size):
                        force[i][j] -= element.w[i] * push[j]
        free = m.inverse_mass * arb_mat(n, m.size, [x for row in force for x in row])
        if held:  # w . a = b for each: a = M^-1 (F - W' L)
            w = arb_mat(len(held), n, [x for _, w, _ in held for x in w])
            b = arb_mat(len(held), m.size, [x for _, _, row in held for x in row])
            try:
                load = (w * m.inverse_mass * w.transpose()).solve(w * free - b).mid()
            except ZeroDivisionError:
                raise Undecided("two contacts hold one direction") from None
            free = free - m.inverse_mass * w.transpose() * load
            for i, (e, _, _) in enumerate(held):
                row, element = [load[i, j] for j in range(m.size)], m.elements[e]
                if element.kind == "friction":
                    low, high = list(row), [-x for x in row]
                    low[m.one] += element.static
                    high[m.one] += element.static
                    guards += [(low, e, "minus"), (high, e, "plus")]
                else:
                    guards.append((row, e, "release"))
                    if element.kind != "rigid":
                        row = [-x for x in row]
                        row[m.one] += element.p
                        guards.append((row, e, "press"))
        rows = [m.row() for _ in range(m.size)]
        for i in range(n):
            rows[i][n + i] = arb(1)
            rows[n + i] = [free[i, j] for j in range(m.size)]
        for h, at in m.wave.items():
            rows[at][at + 1], rows[at + 1][at] = -h * m.frequency, h * m.frequency
        for e, s in surfaces.items():
            rows[m.surface[e]][m.surface[e]], rows[m.surface[e]][m.one] = -s.k / s.c, -s.p / s.c
        self.guards = guards
        self.flow = Flow(rows)
