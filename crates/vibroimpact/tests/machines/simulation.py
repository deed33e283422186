"""High-precision simulation of machines: piecewise-linear structures with stops and friction joints.

An event is the first zero of a guard of the regime (see regime.py, flow.py). At an event, the regimes that could follow
are tried one by one: a regime can follow if every condition that it needs holds at once afterwards, that is, if the
first coefficient of its power series in time that is not zero is positive.
"""

from itertools import product

from flint import arb, arb_mat

from flow import Undecided, dot, first_root, guard_coefficients, leading, sign, value
from impacts import impact_velocities
from model import Machine
from regime import Regime

CHATTER = arb("1e-30")  # relative to the largest speed so far: impacts slower than this end a chatter
STEPS = 1500  # of one simulation at most
NOTHING = arb(0)
FLOOR = arb("1e-20")  # of the scale of coordinates and velocities
DIGIT = arb("1e-60")  # roots closer than this, in steps, are one time


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
