/* Newton's method for the contact once a scan or a search has found where it is. */
#ifndef NEWTON_H
#define NEWTON_H

#include "flight.h"

enum { MOST_ITERATIONS = 60 };
/* A step this small ends the iteration. */
#define CONVERGED 1e-13

/* The contact between `low`, where the mass is short of the stop, and `high`, where it is beyond. A step that leaves
 * the bracket is replaced by its middle. */
static inline double contact_between(const struct flight *q, double low, double high)
{
    double s = high;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        const double y = position(q, s) - q->gap;
        if (y > 0.0)
            high = s;
        else
            low = s;
        double next = s - y / velocity(q, s);
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        if (fabs(next - s) <= CONVERGED * (1.0 + s))
            return next;
        s = next;
    }
    return s;
}

/* The contact before `s` of a flight that began on the stop and is beyond it at `s`. The start is a zero too, so there
 * is no bracket; Newton's method from the right finds the last zero, and STUCK says that it was the start. */
static inline double contact_before(const struct flight *q, double s)
{
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        const double step = (position(q, s) - q->gap) / velocity(q, s);
        s -= step;
        if (!(s > 1e-10))
            return STUCK;
        if (fabs(step) <= CONVERGED)
            break;
    }
    return s;
}

#endif
