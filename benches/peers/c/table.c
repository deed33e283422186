/* The paper's search with its sines from a table: the steps of 0.1 are always the same, so their sines and cosines are
 * computed once for each beta. Eight steps are taken at a time, which the compiler turns into vector instructions.
 * It misses what scan.c misses. */
#include "flight.h"
#include "newton.h"

#define STEP 0.1

enum { BLOCK = 8, STEPS = 4096 };

static double free_cos[STEPS], free_sin[STEPS];      /* of s */
static double forced_cos[STEPS], forced_sin[STEPS];  /* of beta s */
static double table_beta = NAN;

static void fill(double beta)
{
    for (int k = 0; k < STEPS; k++) {
        const double s = (k + 1) * STEP;
        free_cos[k] = cos(s);
        free_sin[k] = sin(s);
        forced_cos[k] = cos(beta * s);
        forced_sin[k] = sin(beta * s);
    }
    table_beta = beta;
}

double first_contact(const struct flight *flight, double horizon)
{
    if (flight->beta != table_beta)
        fill(flight->beta);
    const double a = flight->a, b = flight->b, gap = flight->gap;
    const double c = flight->f * sin(flight->phase), d = flight->f * cos(flight->phase);
    for (int block = 0; block < STEPS && block * STEP < horizon; block += BLOCK) {
        const double *fc = free_cos + block, *fs = free_sin + block;
        const double *gc = forced_cos + block, *gs = forced_sin + block;
        double x[BLOCK];
        int beyond = 0;
        for (int i = 0; i < BLOCK; i++) {
            x[i] = a * fc[i] + b * fs[i] + c * gc[i] + d * gs[i];
            beyond |= x[i] > gap;
        }
        if (!beyond)
            continue;
        int i = 0;
        while (!(x[i] > gap))
            i++;
        const double s = (block + i + 1) * STEP;
        return block + i == 0 ? contact_before(flight, s) : contact_between(flight, s - STEP, s);
    }
    /* flights longer than the table are rare */
    for (long k = STEPS + 1; (double)k * STEP < horizon; k++) {
        const double s = (double)k * STEP;
        if (position(flight, s) > gap)
            return contact_between(flight, s - STEP, s);
    }
    return INFINITY;
}
