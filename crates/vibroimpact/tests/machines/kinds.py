"""Random machines with starts, from a fixed seed. `KINDS` names the functions; each returns (machine, start)."""

import random

from parts import basis, compliant, decimal, direction, joint, moving, place, pressed, restitution, start, unit


def rigid_ground(r):
    machine, begin, n = basis(r)
    place(r, machine, begin, {"direction": unit(n, r.randrange(n), r.choice([1.0, -1.0])), "restitution": restitution(r)})
    return machine, begin


def rigid_between(r):
    machine, begin, n = basis(r, n=r.choice([2, 2, 3, 4]))
    i, j = r.sample(range(n), 2)
    w = unit(n, i)
    w[j] = -1.0
    place(r, machine, begin, {"direction": w, "restitution": restitution(r)})
    return machine, begin


def rigid_moving(r):
    machine, begin, n = basis(r)
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r), "motion": moving(r, machine)})
    return machine, begin


def rigid_many(r):
    machine, begin, n = basis(r)
    for _ in range(r.choice([2, 2, 3])):
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    return machine, begin


def rigid_rest(r):
    """Chatter, rest and release."""
    machine, w, _ = pressed(r)
    n = len(w)
    resting = r.random() < 0.3
    begin = {"q": [0.0] * n, "qdot": [0.0] * n, "phase": decimal(r, 0, 6.28)} if resting else start(r, n, 0.3)
    s = {"direction": w, "restitution": decimal(r, 0.0, 0.8, 2)}
    if r.random() < 0.3 and not resting:
        s["motion"] = moving(r, machine)
    s = place(r, machine, begin, s, 0.0 if resting else 0.01, 0.0 if resting else 0.2)
    if n > 1 and r.random() < 0.4:
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    return machine, begin


def compliant_undamped(r):
    machine, begin, n = basis(r)
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r, damped=False, preload=False)}, -0.05)
    return machine, begin


def compliant_force(r):
    machine, begin, n = basis(r)
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r, "force", True, False)}, -0.05)
    return machine, begin


def compliant_position(r):
    machine, begin, n = basis(r)
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r, "position", True, False)}, -0.05)
    return machine, begin


def compliant_preload(r):
    machine, begin, n = basis(r)
    for _ in range(r.choice([1, 1, 2])):
        opening = r.choice(["force", "position"])
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r, opening, None, True)}, -0.05)
    return machine, begin


def compliant_staged(r):
    machine, begin, n = basis(r)
    w = direction(r, n)
    first = place(r, machine, begin, {"direction": w, **compliant(r)})
    for i in range(r.choice([1, 2])):
        s = place(r, machine, begin, {"direction": w, **compliant(r)})
        s["gap"] = round(first["gap"] + (i + 1) * decimal(r, 0.01, 0.1), 3)
    if r.random() < 0.3:
        for s in machine["stop"]:
            s["motion"] = machine["stop"][0].get("motion") or moving(r, machine)
    return machine, begin


def compliant_rest(r):
    """A preloaded stop that is pressed with less than its preload: rests at the start."""
    machine, w, force = pressed(r)
    n = len(w)
    begin = {"q": [0.0] * n, "qdot": [0.0] * n, "phase": decimal(r, 0, 6.28)}
    s = compliant(r, None, None, True)
    s["preload"] = round(force * r.uniform(1.1, 3), 2)
    place(r, machine, begin, {"direction": w, **s}, 0, 0)
    if n > 1 and r.random() < 0.3:
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    return machine, begin


def mixture(r):
    machine, begin, n = basis(r)
    place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r)}, -0.02)
    if r.random() < 0.3:
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r), "motion": moving(r, machine)})
    return machine, begin


def friction(r):
    machine, begin, n = basis(r)
    if r.random() < 0.2:
        begin["qdot"] = [0.0] * n
    joint(r, machine)
    return machine, begin


def friction_two(r):
    machine, begin, n = basis(r, n=r.choice([2, 2, 3, 4]))
    if r.random() < 0.2:
        begin["qdot"] = [0.0] * n
    for i in r.sample(range(n), 2):
        joint(r, machine, unit(n, i))
    if r.random() < 0.3:
        machine["friction"][1]["direction"] = direction(r, n)
    return machine, begin


def friction_rigid(r):
    machine, begin, n = basis(r, n=r.choice([1, 2, 2, 3, 4]))
    joint(r, machine)
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), "restitution": restitution(r)})
    return machine, begin


def friction_compliant(r):
    machine, begin, n = basis(r)
    joint(r, machine)
    for _ in range(r.choice([1, 1, 2])):
        place(r, machine, begin, {"direction": direction(r, n), **compliant(r)}, -0.02)
    return machine, begin


KINDS = {
    f.__name__: f
    for f in (
        rigid_ground,
        rigid_between,
        rigid_moving,
        rigid_many,
        rigid_rest,
        compliant_undamped,
        compliant_force,
        compliant_position,
        compliant_preload,
        compliant_staged,
        compliant_rest,
        mixture,
        friction,
        friction_two,
        friction_rigid,
        friction_compliant,
    )
}


def draw(kind, seed, index):
    """The machine and start number `index` of a kind."""
    r = random.Random(f"{seed}/{kind}/{index}")
    return KINDS[kind](r)
