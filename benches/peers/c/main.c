/* A peer as a program: `PEER chaos|regular|basin SECONDS` prints {"rate": ...}, `PEER impacts FILE` the first impact
 * times of the starts in the file. The README of the folder above says what the workloads are; python/peer.py is the
 * same in Python. */
#define _POSIX_C_SOURCE 199309L /* clock_gettime */

#include "motion.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    DROPPED = 200,      /* impacts before a rate is taken */
    FOLLOWED = 120,     /* impacts before a start gets its label */
    MOST_M = 8,         /* labels m/n up to this m */
    FIRST = 5,          /* impact times that `impacts` prints */
    SIDE = 100,         /* starts along each side of the grid */
    STRIDE = 7919,      /* order in which the grid is visited */
    OUTLOOK = 1000,     /* longest flight of a workload */
    OUTLOOK_PERIODS = 20 /* of `impacts`: time to follow a start for, in forcing periods */
};

static const struct motion CHAOS = {1.0 / 1.11, 3.0, 0.5, 0.0, 0.0, 0.0, 0.0};
static const struct motion TWO_ONE = {1.0 / 1.3, 0.75, 0.5, 0.0, 0.0, 0.0, 0.0};
static const struct motion ONE_ONE = {1.0 / 1.3, 0.75, 0.5, -2.0, 0.0, 0.0, 0.0};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Impacts per second of the motion that `m` settles into. */
static double follow(struct motion m, double seconds)
{
    for (int i = 0; i < DROPPED; i++)
        if (next_impact(&m, OUTLOOK) != IMPACT)
            return 0.0;
    const double begin = now();
    long impacts = 0;
    double elapsed = 0.0;
    while (elapsed < seconds) {
        for (int i = 0; i < 100; i++)
            if (next_impact(&m, OUTLOOK) != IMPACT)
                return 0.0;
        impacts += 100;
        elapsed = now() - begin;
    }
    return (double)impacts / elapsed;
}

/* Start k of the basin: the centres of the cells of the grid, in an order that covers it evenly from the beginning. */
static struct motion basin_start(long k)
{
    const long cell = k * STRIDE % (SIDE * SIDE);
    struct motion m = TWO_ONE;
    m.x = -4.0 + 4.75 * ((double)(cell % SIDE) + 0.5) / SIDE;
    m.v = -4.0 + 8.0 * ((double)(cell / SIDE) + 0.5) / SIDE;
    return m;
}

/* The label m/n of the last impacts, by the paper's rule, or what kept the start from one. */
static void label(struct motion m, char *text, size_t size)
{
    double v[FOLLOWED], phase[FOLLOWED], time[FOLLOWED];
    for (int i = 0; i < FOLLOWED; i++) {
        const enum arrival arrival = next_impact(&m, OUTLOOK);
        if (arrival != IMPACT) {
            snprintf(text, size, "%s", arrival == NO_CONTACT ? "none" : "stuck");
            return;
        }
        v[i] = m.v;
        phase[i] = m.phase;
        time[i] = m.time;
    }
    const int last = FOLLOWED - 1;
    for (int k = 1; k <= MOST_M; k++) {
        const double turn = remainder(phase[last] - phase[last - k], TAU);
        if (fabs(v[last] - v[last - k]) < 1e-6 * fabs(v[last]) && fabs(turn) < 1e-6 * TAU) {
            snprintf(text, size, "%d/%.0f", k, m.beta * (time[last] - time[last - k]) / TAU);
            return;
        }
    }
    snprintf(text, size, "open");
}

enum { MOST_LABELS = 64, LABEL_SIZE = 16 };

static void basin(double seconds)
{
    static char names[MOST_LABELS][LABEL_SIZE];
    static long counts[MOST_LABELS];
    int used = 0;
    long starts = 0;
    const double begin = now();
    double elapsed = 0.0;
    for (; elapsed < seconds; elapsed = now() - begin) {
        char text[LABEL_SIZE];
        label(basin_start(starts++), text, sizeof text);
        int k = 0;
        while (k < used && strcmp(names[k], text) != 0)
            k++;
        if (k == used && used < MOST_LABELS)
            strcpy(names[used++], text);
        if (k < MOST_LABELS)
            counts[k]++;
    }
    printf("{\"rate\": %.17g, \"labels\": {", (double)starts / elapsed);
    for (int k = 0; k < used; k++)
        printf("%s\"%s\": %ld", k ? ", " : "", names[k], counts[k]);
    printf("}}\n");
}

/* One line of times for each line `inverse_beta gap restitution x v phase` of the file. */
static int impacts(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) {
        perror(path);
        return 1;
    }
    double inverse_beta;
    struct motion m = {0};
    while (fscanf(file, "%lf %lf %lf %lf %lf %lf", &inverse_beta, &m.gap, &m.restitution, &m.x, &m.v, &m.phase) == 6) {
        m.beta = 1.0 / inverse_beta;
        m.time = 0.0;
        const double horizon = OUTLOOK_PERIODS * TAU / m.beta;
        for (int i = 0; i < FIRST && next_impact(&m, horizon - m.time) == IMPACT; i++)
            printf("%s%.17g", i ? " " : "", m.time);
        printf("\n");
    }
    fclose(file);
    return 0;
}

int main(int count, char **words)
{
    if (count != 3) {
        fprintf(stderr, "usage: %s chaos|regular|basin SECONDS, or %s impacts FILE\n", words[0], words[0]);
        return 2;
    }
    if (strcmp(words[1], "impacts") == 0)
        return impacts(words[2]);
    const double seconds = atof(words[2]);
    if (strcmp(words[1], "chaos") == 0) {
        printf("{\"rate\": %.17g}\n", follow(CHAOS, seconds));
    } else if (strcmp(words[1], "regular") == 0) {
        /* equally many impacts of either motion */
        const double one = follow(ONE_ONE, 0.5 * seconds), two = follow(TWO_ONE, 0.5 * seconds);
        printf("{\"rate\": %.17g}\n", 2.0 / (1.0 / one + 1.0 / two));
    } else if (strcmp(words[1], "basin") == 0) {
        basin(seconds);
    } else {
        fprintf(stderr, "`%s` is not a workload\n", words[1]);
        return 2;
    }
    return 0;
}
