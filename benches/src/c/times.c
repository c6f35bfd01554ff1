/* Times one robot's C on configurations from the standard input; `kin_` stands for the robot.
 * Writes nanoseconds for a pose and for all solutions, the medians of all rounds, and how many
 * solutions there are. */
#define _POSIX_C_SOURCE 199309L
#include "kin_.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { COUNT = 4096, ROUNDS = 41 };

static double q[COUNT][KIN_JOINTS], poses[COUNT][12];

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e9 + (double)time.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void)
{
    double forward[ROUNDS], inverse[ROUNDS];
    volatile double sink = 0.0;
    long found = 0;
    for (int i = 0; i < COUNT; ++i) {
        for (int j = 0; j < KIN_JOINTS; ++j) {
            if (scanf("%lf", &q[i][j]) != 1) {
                return 1;
            }
        }
        kin_fk(q[i], poses[i]);
    }
    for (int round = 0; round < ROUNDS; ++round) {
        double start = now();
        for (int i = 0; i < COUNT; ++i) {
            double pose[12];
            kin_fk(q[i], pose);
            sink += pose[3];
        }
        forward[round] = (now() - start) / COUNT;
        start = now();
        found = 0;
        for (int i = 0; i < COUNT; ++i) {
            kin_solution solutions[KIN_MAX_SOLUTIONS];
            const int count = kin_ik(poses[i], solutions);
            sink += count > 0 ? solutions[0].q[0] : 0.0;
            found += count > 0 ? count : 0;
        }
        inverse[round] = (now() - start) / COUNT;
    }
    qsort(forward, ROUNDS, sizeof *forward, ascending);
    qsort(inverse, ROUNDS, sizeof *inverse, ascending);
    printf("%g %g %ld\n", forward[ROUNDS / 2], inverse[ROUNDS / 2], found);
    return 0;
}
