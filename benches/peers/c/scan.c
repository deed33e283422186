/* The 1971 paper's own search: time goes on in steps of 0.1 until the mass is beyond the stop, then Newton's method.
 * An excursion that begins and ends between two steps is not seen. This is the baseline of the comparison. */
#include "flight.h"
#include "newton.h"

#define STEP 0.1

double first_contact(const struct flight *flight, double horizon)
{
    for (long k = 1; (double)k * STEP < horizon; k++) {
        const double s = (double)k * STEP;
        if (position(flight, s) > flight->gap)
            return k == 1 ? contact_before(flight, s) : contact_between(flight, s - STEP, s);
    }
    return INFINITY;
}
