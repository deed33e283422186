/* The flight between two impacts in closed form, and the interface of a search for the next contact.
 *
 * Undamped and away from resonance the 1971 paper's equation (3) reads
 *
 *     x(s) = A cos s + B sin s + f sin(beta s + phase),   f = 1 / (1 - beta^2),
 *
 * with A and B from the state at s = 0. The sines are those of the platform's mathematics library. */
#ifndef FLIGHT_H
#define FLIGHT_H

#include <math.h>

struct flight {
    double beta, gap;    /* the oscillator */
    double x, v, phase;  /* the state at s = 0 */
    double a, b, f;      /* the closed form */
};

/* The mass stays on the stop: there is no flight. */
#define STUCK (-1.0)

/* Time of the first contact in (0, horizon), INFINITY where none was found, STUCK where the mass does not leave the
 * stop. Each peer has its own: scan.c, table.c, safe.c. */
double first_contact(const struct flight *flight, double horizon);

static inline struct flight flight_from(double beta, double gap, double x, double v, double phase)
{
    const double f = 1.0 / ((1.0 - beta) * (1.0 + beta));
    struct flight flight = {beta, gap, x, v, phase, 0.0, 0.0, f};
    flight.a = x - f * sin(phase);
    flight.b = v - f * beta * cos(phase);
    return flight;
}

static inline double position(const struct flight *q, double s)
{
    return q->a * cos(s) + q->b * sin(s) + q->f * sin(q->beta * s + q->phase);
}

static inline double velocity(const struct flight *q, double s)
{
    return q->b * cos(s) - q->a * sin(s) + q->f * q->beta * cos(q->beta * s + q->phase);
}

#endif
