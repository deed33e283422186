"""The numbers of a machine, and the rows that give its gaps, their rates and its contact forces.

The state is z = (q, q', cos and sin of each harmonic, 1, surfaces that stand back). Rows are linear in z.
"""

from flint import arb, arb_mat


def exactly(path, x):
    """Each number as it is."""
    return arb(x)


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
