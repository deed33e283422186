"""Parts of random machines: structures, forces, starts, stops, joints. `r` is a `random.Random`."""

import math

NAMES = ["a", "b", "c", "d"]


def dyadic(r, low, high, parts=16):
    """A multiple of 1/parts, so that sums of such numbers are exact."""
    return round(r.uniform(low, high) * parts) / parts


def decimal(r, low, high, digits=3):
    return round(r.uniform(low, high), digits)


def unit(n, i, x=1.0):
    return [x if j == i else 0.0 for j in range(n)]


def structure(r, n=None, free=None, damping=None):
    """Masses in a chain with springs and dashpots. `free`: nothing ties it to the ground."""
    n = n or r.choice([1, 1, 2, 2, 2, 3, 3, 4])
    free = r.random() < 0.2 if free is None else free
    damping = damping or r.choice(["zero", "proportional", "proportional", "general", "general"])

    def chain(draw, ground):
        a = [[0.0] * n for _ in range(n)]
        for i in range(n):
            a[i][i] += ground(i)
            if i:
                x = draw()
                a[i][i] += x
                a[i - 1][i - 1] += x
                a[i][i - 1] -= x
                a[i - 1][i] -= x
        return a

    mass = [dyadic(r, 0.25, 3) for _ in range(n)]
    if n > 1 and r.random() < 0.25:
        full = [[mass[i] if i == j else 0.0 for j in range(n)] for i in range(n)]
        for i in range(1, n):
            full[i][i - 1] = full[i - 1][i] = dyadic(r, -0.1, 0.1, 64)
        mass = full
    soft = (lambda: 0.0) if free and r.random() < 0.4 else lambda: dyadic(r, 0.2, 4)
    stiffness = chain(soft, lambda i: 0.0 if free or (i and r.random() < 0.5) else dyadic(r, 0.2, 3))
    machine = {"coordinates": NAMES[:n], "mass": mass, "stiffness": stiffness}
    if damping == "proportional":
        alpha, beta = (0.0 if free else dyadic(r, 0, 0.2)), dyadic(r, 0, 0.15)
        m = mass if isinstance(mass[0], list) else [[mass[i] if i == j else 0.0 for j in range(n)] for i in range(n)]
        machine["damping"] = [[alpha * m[i][j] + beta * stiffness[i][j] for j in range(n)] for i in range(n)]
    elif damping == "general":
        machine["damping"] = chain(
            lambda: dyadic(r, 0, 0.25, 64), lambda i: 0.0 if free or r.random() < 0.4 else dyadic(r, 0, 0.3, 64)
        )
    return machine


def pushes(r, machine, forced=None, constant=None):
    """Forcing and constant forces."""
    n = len(machine["coordinates"])
    if r.random() < 0.4 if constant is None else constant:
        machine["constant"] = [decimal(r, -0.8, 0.8, 2) for _ in range(n)]
    if r.random() < 0.8 if forced is None else forced:
        machine["frequency"] = decimal(r, 0.4, 2.5)
        orders = r.choice([[1], [1], [1], [1, 2], [1, 3], [2], [1, 2, 3]])
        machine["force"] = [
            {
                "order": h,
                "cos": [round(r.uniform(-1, 1) / h, 2) if r.random() < 0.7 else 0.0 for _ in range(n)],
                "sin": [round(r.uniform(-1, 1) / h, 2) if r.random() < 0.4 else 0.0 for _ in range(n)],
            }
            for h in orders
        ]
    return machine


def direction(r, n):
    choice = r.random()
    if n > 1 and choice < 0.35:
        i, j = r.sample(range(n), 2)
        w = unit(n, i)
        w[j] = -1.0
        return w
    if n > 1 and choice < 0.5:
        return [dyadic(r, -1, 1, 8) or 0.5 for _ in range(n)]
    return unit(n, r.randrange(n), r.choice([1.0, 1.0, -1.0]))


def start(r, n, size=1.0):
    return {
        "q": [decimal(r, -size, size) for _ in range(n)],
        "qdot": [decimal(r, -1, 1) for _ in range(n)],
        "phase": decimal(r, 0, 6.28) if r.random() < 0.7 else 0.0,
    }


def motion_at(machine, stop, begin):
    """Motion of a stop at the start (roughly: for gaps only)."""
    return sum(
        m["cos"] * math.cos(m["order"] * begin["phase"]) + m["sin"] * math.sin(m["order"] * begin["phase"])
        for m in stop.get("motion", [])
    )


def place(r, machine, begin, stop, low=0.05, high=0.8):
    """Adds a stop at a distance between low and high from the start."""
    reach = sum(w * q for w, q in zip(stop["direction"], begin["q"])) + motion_at(machine, stop, begin)
    stop = {"name": f"s{len(machine.setdefault('stop', []))}", **stop, "gap": round(reach + r.uniform(low, high), 3)}
    machine["stop"].append(stop)
    return stop


def restitution(r):
    return r.choice([0.0, 1.0, 1.0, decimal(r, 0.02, 0.98, 2), decimal(r, 0.3, 0.98, 2), decimal(r, 0.5, 0.95, 2)])


def moving(r, machine):
    machine.setdefault("frequency", decimal(r, 0.4, 2.5))
    return [
        {"order": h, "cos": decimal(r, -0.3, 0.3, 2), "sin": decimal(r, -0.3, 0.3, 2)}
        for h in r.choice([[1], [1], [2], [1, 2]])
    ]


def compliant(r, opening=None, damped=None, preload=None, k=None):
    s = {"stiffness": k or float(f"{10 ** r.uniform(0.3, 3.3):.2g}")}
    if r.random() < 0.6 if damped is None else damped:
        s["damping"] = float(f"{2 * r.uniform(0.02, 0.6) * s['stiffness'] ** 0.5:.2g}")
    if r.random() < 0.3 if preload is None else preload:
        s["preload"] = decimal(r, 0.05, 1.5, 2)
    if (s.get("damping") or s.get("preload")) and (opening or r.random() < 0.5):
        s["opening"] = opening or "position"
    return s


def basis(r, **options):
    machine = pushes(r, structure(r, **options))
    return machine, start(r, len(machine["coordinates"])), len(machine["coordinates"])


def pressed(r, low=0.2, high=1.0):
    """A machine whose first coordinate is pressed along +1 or -1 by a constant force; (machine, direction, force)."""
    machine = pushes(r, structure(r), constant=False)
    n = len(machine["coordinates"])
    side, i, force = r.choice([1.0, -1.0]), r.randrange(n), decimal(r, low, high, 2)
    machine["constant"] = unit(n, i, side * force)
    return machine, unit(n, i, side), force


def joint(r, machine, w=None):
    n = len(machine["coordinates"])
    joints = machine.setdefault("friction", [])
    f = {"name": f"f{len(joints)}", "direction": w or direction(r, n), "sliding": decimal(r, 0.05, 0.6, 2)}
    if r.random() < 0.5:
        f["static"] = round(f["sliding"] * r.uniform(1.02, 2), 2)
        f["static"] = max(f["static"], f["sliding"])
    if r.random() < 0.4:
        f["belt"] = decimal(r, -0.5, 0.5, 2)
    joints.append(f)
