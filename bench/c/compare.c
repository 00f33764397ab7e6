#define _POSIX_C_SOURCE 199309L
#include "compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* One measurement takes about this long: short beside a time slice of the system, so that most are undisturbed. */
#define SLICE_NS 2e5

void compare_nothing(void *self)
{
    (void)self;
}

static double now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static double once(const struct contender *one, long n)
{
    const double start = now_ns();
    one->run(n);
    return (now_ns() - start) / (double)n;
}

/* How many turns fill a slice. */
static long turns(const struct contender *one)
{
    long n = 1;
    while (once(one, n) * (double)n < SLICE_NS) {
        n *= 2;
    }
    return n;
}

void compare(const struct contender *all, int count, int rounds)
{
    double *const seen = malloc(sizeof *seen * (size_t)count * (size_t)rounds);
    long *const n = malloc(sizeof *n * (size_t)count);
    if (seen == NULL || n == NULL) {
        abort();
    }
    for (int i = 0; i < count; i++) {
        n[i] = turns(&all[i]);
    }
    for (int r = 0; r < rounds; r++) {
        for (int i = 0; i < count; i++) {
            seen[i * rounds + r] = once(&all[i], n[i]);
        }
    }
    for (int i = 0; i < count; i++) {
        printf("%s", all[i].name);
        for (int r = 0; r < rounds; r++) {
            printf(" %.4f", seen[i * rounds + r]);
        }
        printf("\n");
    }
    free(seen);
    free(n);
}
