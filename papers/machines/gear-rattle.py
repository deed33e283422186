"""The motion of the rattling gear pair from its release to its next rest, with as many digits as are asked for.

    python gear-rattle.py DIGITS [double]

prints the number of impacts and of revolutions; DIGITS is 60 or more. The numbers of the machine are exact, or with `double` those of its
description rounded to double precision, as `vibro` uses them. Needs mpmath.
"""

import math
import sys

from mpmath import acos, atan2, cos, exp, mp, mpf, pi, sin, sqrt

digits, rounded = int(sys.argv[1]), "double" in sys.argv
mp.dps = digits
if rounded:
    drag, gap, restitution = mpf(0.6), mpf(0.6), mpf(0.9)
    constant, in_cos, in_sin = mpf(7.5398223686155035), mpf(-11.84352528130723), mpf(-1.1309733552923256)
    w = mpf(2 * math.pi)
else:
    drag, gap, restitution, eps, w = mpf(6) / 10, mpf(6) / 10, mpf(9) / 10, mpf(3) / 10, 2 * pi
    constant, in_cos, in_sin = 4 * pi * drag, -(w**2) * eps, -w * drag * eps

# the steady part constant / drag s + p cos wt + q sin wt of a flight
size = w**4 + (drag * w) ** 2
p = (-w * w * in_cos - drag * w * in_sin) / size
q = (-w * w * in_sin + drag * w * in_cos) / size


def force(phase):
    return constant + in_cos * cos(phase) + in_sin * sin(phase)


def flight(x, v, t, mode=(cos, sin, exp), real=mpf):
    """Position and velocity a time after a state."""
    own_cos, own_sin, own_exp = mode
    d, rate, c, a, b = (real(value) for value in (drag, w, constant, p, q))
    turned = cos(w * t), sin(w * t)
    by = -(v - constant / drag + w * p * turned[1] - w * q * turned[0]) / drag
    at = x - by - p * turned[0] - q * turned[1]
    at, by, start = real(at), real(by), real(w * t)

    def after(s):
        fade, phase = by * own_exp(-d * s), start + rate * s
        one, two = own_cos(phase), own_sin(phase)
        return at + fade + c / d * s + a * one + b * two, -d * fade + c / d - rate * a * two + rate * b * one

    return after


def begin(x, v, t):
    """A time close to the next contact, from samples in double precision and the extremes between them."""
    coarse, step, s = flight(x, v, t % (2 * pi / w), (math.cos, math.sin, math.exp), float), 1e-3, 1e-3
    before = coarse(s)
    while True:
        after = coarse(s + step)
        low, high = s, s + step
        if before[1] * after[1] < 0:
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if coarse(middle)[1] * before[1] > 0 else (low, middle)
            if abs(coarse(high)[0]) <= float(gap):
                high = s + step
        if abs(coarse(high)[0]) > float(gap):
            side = math.copysign(1, coarse(high)[0])
            low = s
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (low, middle) if side * coarse(middle)[0] > float(gap) else (middle, high)
            return mpf(high), side
        before, s = after, s + step


middle, half = atan2(in_sin, in_cos), acos(-constant / sqrt(in_cos**2 + in_sin**2))
release = next(th for th in (middle + half, middle - half) if in_sin * cos(th) < in_cos * sin(th)) % (2 * pi)
x, v, t, impacts = gap, mpf(0), release / w, 0
while True:
    side = 1 if x > 0 else -1
    push = side * force(w * t) - side * drag * v
    if impacts and push > 0 and abs(v) < mpf(10) ** -25:
        break
    if impacts and push > 0 and 2 * abs(v) < 5e-3 * push:
        s = 2 * abs(v) / push
    else:
        s, side = begin(x, v, t)
    after = flight(x, v, t)
    for _ in range(60):
        x, v = after(s)
        change = (x - side * gap) / v
        s -= change
        if abs(change) < mpf(10) ** (20 - digits):
            break
    t, x, v, impacts = t + s, side * gap, -restitution * after(s)[1], impacts + 1
rest = (w * t) % (2 * pi)
turns = (w * t - rest) / (2 * pi) + (1 if rest > release else 0)
print(f"{digits} digits: {impacts} impacts, at rest at {float(t - release / w):.6f}, again released after {float(turns):.0f} revolutions")
