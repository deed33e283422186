"""High-precision simulation of machines: piecewise-linear structures with stops and friction joints.

Each regime is a linear autonomous system z' = A z with z = (q, q', cos and sin of each harmonic, 1, surfaces); all
gaps, forces of contact and holding forces are linear in z. An event is the first zero of one of them (see flow.py).
At an event, the regimes that could follow are tried one by one: a regime can follow if every condition that it needs
holds at once afterwards, that is, if the first coefficient of its power series in time that is not zero is positive.
"""

from itertools import product

from flint import arb, arb_mat

from flow import Flow, Undecided, dot, first_root, guard_coefficients, leading, sign, value

CHATTER = arb("1e-30")  # relative to the largest speed so far: impacts slower than this end a chatter
STEPS = 1500  # of one simulation at most
NOTHING = arb(0)
FLOOR = arb("1e-20")  # of the scale of coordinates and velocities
DIGIT = arb("1e-60")  # roots closer than this, in steps, are one time


class Stop:
    """`kind`: rigid, undamped, force or position (how a damped compliant stop opens)."""

    def __init__(self, data, number, path):
        self.name, self.w = data["name"], [number(path + ("w", i), x) for i, x in enumerate(data["direction"])]
        self.gap = number(path + ("gap",), data["gap"])
        self.motion = {
            m["order"]: [number(path + ("motion", m["order"], key), m.get(key, 0)) for key in ("cos", "sin")]
            for m in data.get("motion", [])
        }
        if "restitution" in data:
            self.kind, self.e = "rigid", number(path + ("e",), data["restitution"])
        else:
            self.k = number(path + ("k",), data["stiffness"])
            self.c = number(path + ("c",), data.get("damping", 0))
            self.p = number(path + ("p",), data.get("preload", 0))
            opening = data.get("opening", "force")
            self.kind = opening if opening == "position" or self.c > 0 else "undamped"


class Joint:
    kind = "friction"

    def __init__(self, data, number, path):
        self.name, self.w = data["name"], [number(path + ("w", i), x) for i, x in enumerate(data["direction"])]
        self.sliding = number(path + ("sliding",), data["sliding"])
        same = data.get("static", data["sliding"]) == data["sliding"]
        self.static = self.sliding if same else number(path + ("static",), data["static"])
        self.belt = number(path + ("belt",), data.get("belt", 0))


class Machine:
    """A machine from its data; `number(path, x)` gives each of its numbers (and can disturb it)."""

    def __init__(self, data, number):
        n = self.n = len(data["coordinates"])

        def matrix(key):
            rows = data.get(key, [0] * n)
            if not isinstance(rows[0], list):
                rows = [[rows[i] if i == j else 0 for j in range(n)] for i in range(n)]
            flat = [number((key, min(i, j), max(i, j)), rows[i][j]) for i in range(n) for j in range(n)]
            return arb_mat(n, n, flat)

        self.inverse_mass = matrix("mass").inv().mid()
        self.damping, self.stiffness = matrix("damping"), matrix("stiffness")
        self.constant = [number(("constant", i), x) for i, x in enumerate(data.get("constant", [0] * n))]
        self.frequency = number(("frequency",), data["frequency"]) if "frequency" in data else arb(0)
        self.force = {}
        for f in data.get("force", []):
            self.force[f["order"]] = [
                [number(("force", f["order"], key, i), x) for i, x in enumerate(f[key])] for key in ("cos", "sin")
            ]
        self.stops = [Stop(s, number, ("stop", i)) for i, s in enumerate(data.get("stop", []))]
        self.joints = [Joint(f, number, ("friction", i)) for i, f in enumerate(data.get("friction", []))]
        self.elements = self.stops + self.joints
        orders = set(self.force)
        for s in self.stops:
            orders |= set(s.motion)
        self.orders = sorted(orders)
        # places in z
        self.wave = {h: 2 * n + 2 * i for i, h in enumerate(self.orders)}
        self.one = 2 * n + 2 * len(self.orders)
        self.surface = {}
        for i, s in enumerate(self.stops):
            if s.kind == "force":
                self.surface[i] = self.one + 1 + len(self.surface)
        self.size = self.one + 1 + len(self.surface)
        self.gaps = [self.gap_row(s) for s in self.stops]
        self.gap_rates = [self.gap_rate_row(s) for s in self.stops]
        self.slips = [self.slip_row(j) for j in self.joints]

    def row(self):
        return [arb(0)] * self.size

    def gap_row(self, stop):
        row = self.row()
        for i, w in enumerate(stop.w):
            row[i] = -w
        row[self.one] = stop.gap
        for h, (a, b) in stop.motion.items():
            row[self.wave[h]], row[self.wave[h] + 1] = -a, -b
        return row

    def wave_rate(self, row):
        """Rate of the part of `row` on the harmonics."""
        rate = self.row()
        for h, at in self.wave.items():
            rate[at + 1] = -row[at] * h * self.frequency
            rate[at] = row[at + 1] * h * self.frequency
        return rate

    def gap_rate_row(self, stop):
        row = self.wave_rate(self.gap_row(stop))
        for i, w in enumerate(stop.w):
            row[self.n + i] = -w
        return row

    def slip_row(self, joint):
        row = self.row()
        for i, w in enumerate(joint.w):
            row[self.n + i] = w
        row[self.one] = -joint.belt
        return row

    def contact_force(self, i):
        """Row of k (-g) + c (-g') + p of stop i."""
        s = self.stops[i]
        row = [-s.k * g - s.c * r for g, r in zip(self.gaps[i], self.gap_rates[i])]
        row[self.one] += s.p
        return row

    def initial(self, q, v, phase):
        z = list(q) + list(v)
        for h in self.orders:
            z += [(phase * h).cos().mid(), (phase * h).sin().mid()]
        z += [arb(1)] + [arb(0)] * len(self.surface)
        return arb_mat(self.size, 1, z)


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


class Simulation:
    """Events from a start. `events`: dicts of kind, stop, time, speed, q, v (arb); `chatter` in a stick that ends one."""

    def __init__(self, data, number, start, trace=None):
        self.machine = m = Machine(data, number)
        q = [number(("q", i), x) for i, x in enumerate(start["q"])]
        v = [number(("v", i), x) for i, x in enumerate(start["qdot"])]
        self.z = m.initial(q, v, number(("phase",), start.get("phase", 0)))
        self.time = arb(0)
        self.events, self.steps, self.trace = [], 0, trace
        self.largest = [arb(0)] * m.size
        self.note()
        self.regimes, self.modes, self.ended = {}, None, set()

    def scale(self, row):
        return sum((abs(a) * b for a, b in zip(row, self.sizes)), arb(0))

    def sign(self, row):
        return sign(dot(row, self.z), self.scale(row))

    def regime(self, modes):
        if modes not in self.regimes:
            self.regimes[modes] = Regime(self.machine, modes)
        return self.regimes[modes]

    def emit(self, kind, element, speed=NOTHING):
        n, z = self.machine.n, self.z.entries()
        name = self.machine.elements[element].name
        self.events.append({"kind": kind, "stop": name, "time": self.time, "speed": speed, "q": z[:n], "v": z[n : 2 * n]})

    def set(self, place, x):
        z = self.z.entries()
        z[place] = x
        self.z = arb_mat(self.machine.size, 1, z)

    def run(self, limit, horizon, stop=None):
        """Simulates until `limit` events, the time `horizon`, or `stop(self)`. Returns why it ended."""
        try:
            if self.modes is None:
                self.settle(set(), True)
            while len(self.events) < limit and not (stop and stop(self)):
                if self.time > horizon:
                    return "horizon"
                if self.steps >= STEPS:
                    return "steps"
                self.step()
            return "limit"
        except Undecided as reason:
            return str(reason)

    def step(self):
        self.steps += 1
        m = self.machine
        for e, s in enumerate(m.stops):  # a surface that has recovered to rounding
            if self.modes[e] == "back" and s.p == 0 and self.z[m.surface[e], 0] < 1e-45 * self.scale(m.gaps[e]):
                if self.sign(m.gaps[e]) <= 0:
                    raise Undecided("a contact with a surface that has recovered")
                self.set(m.surface[e], arb(0))
                self.modes = self.modes[:e] + ("open",) + self.modes[e + 1 :]
        regime = self.regime(self.modes)
        terms = regime.flow.terms(self.z)
        found = []
        rows = [row for row, _, _ in regime.guards]
        for (row, e, meaning), c in zip(regime.guards, guard_coefficients(rows, terms)):
            zeros = 0
            if e in self.fresh:
                zeros, lead = leading(c, self.scale(row))
                if lead == 0:
                    continue
                if lead < 0:
                    raise Undecided("a condition is lost at once")
            elif not c[0] > 0:
                raise Undecided("a condition is lost")
            x = first_root(c, zeros)
            if x is not None:
                found.append((x, e, meaning))
        if self.trace:
            self.trace(self, regime, terms, min([x for x, _, _ in found], default=arb(1)))
        if not found:
            self.advance(regime, terms, arb(1))
            self.fresh = set()
            return
        first = min(x for x, _, _ in found)
        fired = {(e, meaning) for x, e, meaning in found if x - first < DIGIT}
        self.advance(regime, terms, first)
        if fired == {(e, "recovered") for e, _ in fired}:
            self.fresh = set()
            for e, _ in fired:
                self.set(m.surface[e], arb(0))
                self.modes = self.modes[:e] + ("open",) + self.modes[e + 1 :]
            return
        self.settle(fired, False)

    def advance(self, regime, terms, x):
        self.z = value(terms, x)
        self.time = (self.time + x * regime.flow.h).mid()
        self.note()

    def note(self):
        """Notes how large each part of the state has been; coordinates share a size, and so do velocities."""
        n = self.machine.n
        self.largest = [max(a, abs(b)) for a, b in zip(self.largest, self.z.entries())]
        q, v = max(self.largest[:n] + [FLOOR]), max(self.largest[n : 2 * n] + [FLOOR])
        self.sizes = [q] * n + [v] * n + self.largest[2 * n :]

    def settle(self, fired, start):
        """What follows an event: impacts, then the regime; announces them."""
        m = self.machine
        old = self.modes
        hit = {e for e, _ in fired}
        if start:
            closed = [e for e, s in enumerate(m.stops) if s.kind == "rigid" and self.start_gap(e) == 0]
        else:
            struck = [e for e in hit if m.elements[e].kind == "rigid" and old[e] == "open"]
            if struck and len(hit) > len(struck):
                raise Undecided("an impact and another event at one time")
            resting = [e for e, s in enumerate(m.stops) if s.kind == "rigid" and old[e] == "rest"]
            closed = sorted(struck + resting) if struck else []
        touching = set(closed)
        self.ended = set()
        impact = self.impacts(closed)
        choices = [self.choices(e, old, fired, touching, impact, start) for e in range(len(m.elements))]
        self.modes = self.select(choices, old)
        self.fresh = {
            e
            for e in range(len(choices))
            if start or impact or e in hit or old[e] != self.modes[e] or self.modes[e] in ("rest", "hold")
        }
        if any(self.modes[e] != "rest" for e in self.ended):
            raise Undecided("a chatter that does not end at rest")
        self.announce(old, start)

    def start_gap(self, e):
        s = self.sign(self.machine.gaps[e])
        if s < 0 and self.machine.stops[e].kind == "rigid":
            raise ValueError("the start lies inside a rigid stop")
        return s

    def impacts(self, closed):
        """Resolves impacts on the closed rigid stops; whether there were any."""
        m, any_impact = self.machine, False
        for _ in range(100):
            rates = [dot(m.gap_rates[e], self.z) for e in closed]
            signs = [self.sign(m.gap_rates[e]) for e in closed]
            approaching = [a for a, s in enumerate(signs) if s < 0]
            if not approaching:
                return any_impact
            any_impact = True
            restitution = [m.stops[e].e for e in closed]
            counted = []
            for a in approaching:
                if -rates[a] < CHATTER * self.scale(m.gap_rates[closed[a]]):
                    restitution[a] = arb(0)
                    self.ended.add(closed[a])
                else:
                    counted.append(a)
            change = impact_velocities(m, closed, rates, restitution)
            z = self.z.entries()
            for i in range(m.n):
                z[m.n + i] = (z[m.n + i] + change[i, 0]).mid()
            self.z = arb_mat(m.size, 1, z)
            self.note()
            for a in counted:
                self.emit("impact", closed[a], -rates[a])
        raise Undecided("many impacts at one time")

    def choices(self, e, old, fired, touching, impact, start):
        """Modes that element e can have next."""
        m, element = self.machine, self.machine.elements[e]
        mode = old[e] if old else None
        hit = {meaning for f, meaning in fired if f == e}
        if element.kind == "friction":
            if start or impact:
                s = self.sign(m.slips[e - len(m.stops)])
                return ["hold", "plus", "minus"] if s == 0 else ["plus" if s > 0 else "minus"]
            return ["hold", "plus", "minus"] if hit or mode == "hold" else [mode]
        if element.kind == "rigid":
            if mode == "rest" and not impact:
                return ["rest", "open"]
            if e in touching:
                return ["open"] if self.sign(m.gap_rates[e]) > 0 else ["rest", "open"]
            return ["open"]
        at_zero = [x for x in ("rest", "open", "closed") if x != "rest" or element.p > 0]
        if start:
            s = self.start_gap(e)
            if s > 0:
                return ["open"]
            if s < 0 and element.kind != "force":
                return ["closed"]
        elif mode == "rest" and not impact:
            return at_zero
        elif mode == "rest" or (mode == "closed" and "zero" in hit) or (mode == "open" and hit):
            s = 0
        elif mode == "closed" and "force" in hit:
            self.set(m.surface[e], -dot(m.gaps[e], self.z))
            return ["back"]
        elif mode == "back" and hit:
            row = list(m.gap_rates[e])
            row[m.surface[e]] -= element.k / element.c
            row[m.one] -= element.p / element.c
            if self.sign(row) == 0:
                raise Undecided("a touch of a surface that recovers")
            self.set(m.surface[e], arb(0))
            return ["closed"]
        elif mode == "closed" and impact and element.kind == "force":
            s = -1
        else:
            return [mode]
        if s == 0:
            rate = self.sign(m.gap_rates[e])
            return at_zero if rate == 0 else ["open" if rate > 0 else "closed"]
        push = self.sign(m.contact_force(e))  # inside, opening by force: at the start, or after an impact elsewhere
        if push == 0:
            raise Undecided("no force at a closed stop")
        if push > 0:
            return ["closed"]
        self.set(m.surface[e], -dot(m.gaps[e], self.z))
        return ["back"]

    def select(self, choices, old):
        """The one regime among the choices that can follow."""
        open_question = {e for e, c in enumerate(choices) if len(c) > 1}
        if not open_question:
            return tuple(c[0] for c in choices)
        possible, singular = [], False
        for modes in product(*choices):
            try:
                regime = self.regime(modes)
            except Undecided:
                singular = True
                continue
            guards = [(row, e) for row, e, _ in regime.guards if e in open_question]
            series = guard_coefficients([row for row, _ in guards], regime.flow.terms(self.z, 16))
            leads = [leading(c, self.scale(row))[1] for c, (row, _) in zip(series, guards)]
            if all(lead > 0 for lead in leads):
                possible.append(modes)
            elif all(lead >= 0 for lead in leads):
                raise Undecided("a condition that neither holds nor fails")
        if singular:
            raise Undecided("two contacts hold one direction")
        if not possible:
            raise Undecided("no regime can follow")
        if len(possible) > 1:  # a joint that can hold does
            most = max(possible, key=lambda p: p.count("hold"))
            for other in possible:
                if any(a != b and a != "hold" for a, b in zip(most, other)):
                    raise Undecided("several regimes can follow")
            return most
        return possible[0]

    def announce(self, old, start):
        m = self.machine
        for e, (element, new) in enumerate(zip(m.elements, self.modes)):
            was = old[e] if old else None
            if element.kind == "friction":
                if new == "hold" and was != "hold":
                    self.emit("hold", e)
                elif was and new != "hold" and was != new:
                    self.emit("slip", e)
            elif new == "rest" and was != "rest":
                self.emit("stick", e)
                self.events[-1]["chatter"] = e in self.ended
            elif was == "rest" and new == "open":
                self.emit("release", e)
            elif new == "closed" and was != "closed" and not (start and self.start_gap(e) < 0):
                rate = dot(m.gap_rates[e], self.z)
                self.emit("close", e, -rate if rate < 0 else arb(0))
            elif was == "closed" and new in ("open", "back"):
                self.emit("open", e)


def exactly(path, x):
    """Each number as it is."""
    return arb(x)
