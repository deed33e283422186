/* A safe search: time goes on only as far as bounds on the derivatives prove the stop out of reach.
 *
 * With r = sqrt(x^2 + v^2), which grows by at most 1 per unit of time, a window H has
 *
 *     |x'''| <= beta + r + H,   |x''''| <= beta^2 + 1 + r + H,
 *
 * so that x'' <= a + max(0, j H + (beta^2 + 1 + r + H) H^2 / 2) = c in it, and the stop at distance g cannot be
 * reached before the first zero of -g + v h + c h^2 / 2. */
#include "flight.h"
#include "newton.h"

struct point {
    double x, v, a, j; /* position and its derivatives */
};

static struct point at(const struct flight *q, double s)
{
    const double cs = cos(s), sn = sin(s);
    const double angle = q->beta * s + q->phase;
    const double cb = cos(angle), sb = sin(angle);
    struct point p;
    p.x = q->a * cs + q->b * sn + q->f * sb;
    p.v = q->b * cs - q->a * sn + q->f * q->beta * cb;
    p.a = sb - p.x;
    p.j = q->beta * cb - p.v;
    return p;
}

static double first_zero(double g, double v, double c)
{
    const double disc = v * v + 2.0 * c * g;
    if (disc < 0.0)
        return INFINITY;
    const double root = sqrt(disc);
    if (v > 0.0)
        return 2.0 * g / (v + root);
    return c > 0.0 ? (root - v) / c : INFINITY;
}

/* The time over which a flight from the stop stays off it: x - gap divided by h is at most
 * v + a h / 2 + (j + B4 H) h^2 / 6. Zero where the mass does not leave. */
static double leave_time(const struct flight *q)
{
    const double angle_sin = sin(q->phase), angle_cos = cos(q->phase);
    const double a = angle_sin - q->x, j = q->beta * angle_cos - q->v;
    if (q->v > 0.0 || (q->v == 0.0 && a >= 0.0))
        return 0.0;
    const double r = sqrt(q->x * q->x + q->v * q->v);
    double window = 0.3;
    if (a > 0.0)
        window = fmin(window, -8.0 * q->v / a);
    const double b = 0.5 * a, c = (j + (q->beta * q->beta + 1.0 + r + window) * window) / 6.0;
    const double disc = b * b - 4.0 * q->v * c;
    if (disc < 0.0 || b + sqrt(disc) <= 0.0)
        return window;
    const double zero = q->v < 0.0 ? -2.0 * q->v / (b + sqrt(disc)) : -b / c;
    return fmin(zero, window);
}

double first_contact(const struct flight *flight, double horizon)
{
    const double beta = flight->beta;
    double s = 0.0, window = 0.3;
    if (flight->x >= flight->gap) {
        s = leave_time(flight);
        if (s == 0.0)
            return STUCK;
    }
    while (s < horizon) {
        const struct point p = at(flight, s);
        const double g = flight->gap - p.x, r = sqrt(p.x * p.x + p.v * p.v);
        if (g <= 1e-14 * (1.0 + r)) {
            /* down to rounding: a contact if it is transversal, else a touch without effect */
            if (p.v * fabs(p.v) > 1e-13 * (1.0 + r))
                return s;
            s += 1e-7;
            continue;
        }
        const double span = 2.0 * g / p.v;
        if (span > 0.0 && span < 1.0) {
            /* the velocity stays positive and the mass ends beyond the stop: one contact, and a simple one */
            const double lowest = p.a - (beta + r + span) * span;
            if (p.v + lowest * span > 0.0 && g + 0.5 * lowest * span * span > 0.0)
                return contact_between(flight, s, s + span);
        }
        const double b4 = beta * beta + 1.0 + r + window;
        const double rise = fmin(window * (p.j + 0.5 * b4 * window), (beta + r + window) * window);
        const double zero = first_zero(g, p.v, p.a + fmax(rise, 0.0));
        if (zero >= window) {
            s += window;
            window *= 2.0;
        } else {
            s += fmax(zero, 1e-12);
            window = 1.25 * zero;
        }
    }
    return INFINITY;
}
