/* Times one mechanism's C on closed configurations from the standard input, behind their number;
 * `kin_` stands for the mechanism. Writes nanoseconds for all postures, all assemblies, the assembly
 * nearby and the forward Jacobian, the medians of all rounds, and how many of each there are. */
#define _POSIX_C_SOURCE 199309L
#include "kin_.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 512, ROUNDS = 41, TASKS = 4 };

static double q[MOST][KIN_JOINTS], poses[MOST][12 * KIN_CHAINS], driven[MOST][KIN_ACTUATED];
static double moved[MOST][KIN_ACTUATED];

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

/* How many answers there are for a configuration. */
static int answers(int task, int i)
{
    double found[KIN_JOINTS], jacobian[6 * KIN_ACTUATED];
    if (task == 0) {
#ifdef KIN_MOST
        kin_postures postures;
        return kin_ik(poses[i], &postures);
#endif
    } else if (task == 1) {
#ifdef KIN_ASSEMBLY_MODES
        kin_assembly assemblies[KIN_ASSEMBLY_MODES];
        return kin_fk(driven[i], assemblies);
#endif
    } else if (task == 2) {
        return kin_fk_near(moved[i], q[i], found);
    } else {
        return kin_forward_jacobian(q[i], jacobian);
    }
    return 0;
}

int main(void)
{
    int count;
    if (scanf("%d", &count) != 1 || count > MOST) {
        return 1;
    }
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < KIN_JOINTS; ++j) {
            if (scanf("%lf", &q[i][j]) != 1) {
                return 1;
            }
        }
        kin_chain_poses(q[i], poses[i]);
        for (int a = 0; a < KIN_ACTUATED; ++a) {
            driven[i][a] = q[i][kin_actuated[a]];
            moved[i][a] = driven[i][a] + 0.01 * (a % 3) - 0.01;
        }
    }
    for (int task = 0; task < TASKS; ++task) {
        double times[ROUNDS];
        volatile long found = 0;
        for (int round = 0; round < ROUNDS; ++round) {
            const double start = now();
            found = 0;
            for (int i = 0; i < count; ++i) {
                found += answers(task, i);
            }
            times[round] = (now() - start) / count;
        }
        qsort(times, ROUNDS, sizeof *times, ascending);
        printf("%g %ld\n", times[ROUNDS / 2], found);
    }
    return 0;
}
