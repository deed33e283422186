/* A motion from impact to impact. */
#ifndef MOTION_H
#define MOTION_H

#include "flight.h"

#define TAU 6.283185307179586476925

struct motion {
    double beta, gap, restitution;
    double x, v, phase; /* after the last impact, or at the start */
    double time;        /* since the start */
};

enum arrival { IMPACT, NO_CONTACT, ON_THE_STOP };

/* Goes on to the next impact, unless there is none in `horizon` or the mass rests on the stop. */
static inline enum arrival next_impact(struct motion *m, double horizon)
{
    const struct flight flight = flight_from(m->beta, m->gap, m->x, m->v, m->phase);
    const double s = first_contact(&flight, horizon);
    if (s == STUCK)
        return ON_THE_STOP;
    if (!(s < horizon))
        return NO_CONTACT;
    m->x = m->gap;
    m->v = -m->restitution * velocity(&flight, s);
    m->phase = fmod(m->phase + m->beta * s, TAU);
    m->time += s;
    return IMPACT;
}

#endif
