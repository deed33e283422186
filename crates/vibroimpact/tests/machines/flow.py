"""The flow of a linear system z' = A z in high precision, and the first root of linear guards along it.

A step is a Taylor polynomial of degree ORDER over a time h with |A| h <= 4, where |A| is a row-sum norm after diagonal
scaling; the remainder is below 4^(ORDER+1)/(ORDER+1)! e^4 < 1e-74 of the scaled state. Roots are isolated by Descartes'
rule of signs on subintervals, with the remainder as an interval around the constant coefficient: a subinterval without
a change of sign has no root, one with a single change has exactly one, which is simple. Nothing modal is computed.
"""

import math

from flint import arb, arb_mat, arb_poly, ctx

ctx.prec = 300  # bits, 90 digits
ORDER = 84
ZERO = 1e-60  # relative to its scale, a value below is zero,
SURE = 1e-55  # one above is not; in between nothing is decided
BALL = arb("1e-66")
DEPTH = 240  # of subdivision
SPLIT = arb(0.48583984375)  # not 1/2: a root on the boundary of two parts is found in neither


class Undecided(Exception):
    """High precision does not decide what comes next, or the semantics do not say it."""


def balanced_norm(rows):
    """Row-sum norm of a matrix of floats after scaling with powers of two (a similarity)."""
    n = len(rows)
    a = [[abs(x) for x in row] for row in rows]
    scale = [1.0] * n
    for _ in range(60):
        changed = False
        for i in range(n):
            row = sum(a[i][j] * scale[j] / scale[i] for j in range(n) if j != i)
            column = sum(a[j][i] * scale[i] / scale[j] for j in range(n) if j != i)
            if row == 0 or column == 0:
                continue
            factor = 2.0 ** round(math.log2(row / column) / 2)
            if factor != 1 and 1e-12 < scale[i] * factor < 1e12:
                scale[i] *= factor
                changed = True
        if not changed:
            break
    return max(sum(a[i][j] * scale[j] / scale[i] for j in range(n)) for i in range(n)) * 1.000001


class Flow:
    """The flow of z' = A z, with `rows` of A as lists of arb."""

    def __init__(self, rows):
        self.size = len(rows)
        norm = balanced_norm([[float(x) for x in row] for row in rows])
        power = math.floor(math.log2(3.8 / max(norm, 0.1)))
        self.h = arb(2) ** power * arb(0.9619140625)
        flat = [(x * self.h).mid() for row in rows for x in row]
        self.scaled = arb_mat(self.size, self.size, flat)

    def terms(self, z, order=ORDER):
        """Coefficients of z(x h) in powers of x, as columns."""
        terms = [z]
        for k in range(1, order + 1):
            terms.append(((self.scaled * terms[-1]) / k).mid())
        return terms


def value(terms, x):
    """The state at x of the polynomial with coefficients `terms`."""
    total = terms[-1]
    for term in reversed(terms[:-1]):
        total = (total * x + term).mid()
    return total


def guard_coefficients(rows, terms):
    """For each row (list of arb) the coefficients of row . z(x h) in powers of x."""
    if not rows:
        return []
    matrix = arb_mat(len(rows), len(rows[0]), [x for row in rows for x in row])
    columns = [(matrix * term).mid().entries() for term in terms]
    return [[column[i] for column in columns] for i in range(len(rows))]


def dot(row, z):
    total = arb(0)
    for a, b in zip(row, z.entries()):
        total += a * b
    return total.mid()


def sign(x, scale):
    """-1, 0 or 1, where 0 means zero within ZERO of the scale."""
    size = abs(x)
    if size <= scale * ZERO:
        return 0
    if size < scale * SURE:
        raise Undecided(f"a value of {float(size / scale):.1e} of its scale")
    return 1 if x > 0 else -1


def leading(coefficients, scale):
    """Number of leading zeros of a power series, and the sign of the first coefficient that is not zero (0: none)."""
    scale = max([abs(c) for c in coefficients] + [scale])
    if scale == 0:
        return len(coefficients), 0
    for k, c in enumerate(coefficients):
        s = sign(c, scale)
        if s != 0:
            return k, s
    return len(coefficients), 0


def changes(poly, ball):
    """Changes of sign of the coefficients that decide on roots in (0, 1), at most 2; None: not decided."""
    c = poly.coeffs()
    c[0] += ball
    c.reverse()
    count, last = 0, 0
    for b in arb_poly(c)(arb_poly([1, 1])).coeffs():
        if b > 0:
            s = 1
        elif b < 0:
            s = -1
        else:
            return None
        count += last * s < 0
        last = s
        if count > 1:
            return 2
    return count


def first_root(coefficients, zeros):
    """First root in (0, 1) of the polynomial after its first `zeros` coefficients, which are zero; None: no root.

    The polynomial is positive at once after 0."""
    c = coefficients[zeros:]
    size = sum((abs(x) for x in c), arb(0))
    if abs(c[0]) > size - abs(c[0]):
        return None
    ball = arb(0, size * BALL)
    whole = arb_poly(c)
    parts = [(arb(0), arb(1), 0)]
    while parts:
        a, b, depth = parts.pop()
        count = changes(whole(arb_poly([a, b - a])), ball)
        if count == 0:
            continue
        if count == 1:
            return refine(whole, a, b)
        if depth >= DEPTH:
            raise Undecided("a tangency")
        middle = (a + (b - a) * SPLIT).mid()
        parts.append((middle, b, depth + 1))
        parts.append((a, middle, depth + 1))
    return None


def refine(poly, a, b):
    """The single root of `poly` in (a, b), where it falls: Newton's method kept inside the bracket by bisection."""
    a, b = arb(a).mid(), arb(b).mid()
    slope = poly.derivative()
    tiny = arb(2) ** (12 - ctx.prec)
    x = ((a + b) / 2).mid()
    for _ in range(3000):
        y = poly(x).mid()
        if y == 0:
            return x
        if y > 0:
            a = x
        else:
            b = x
        if b - a < tiny * b:
            return ((a + b) / 2).mid()
        d = slope(x).mid()
        new = (x - y / d).mid() if d != 0 else a
        if abs(new - x) < tiny * abs(x):
            return new if a <= new <= b else x
        x = new if a < new < b else ((a + b) / 2).mid()
    raise Undecided("no convergence to a root")
