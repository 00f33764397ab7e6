/* Interlock with first-out and bypass. */
#include "pcl2_ilock.h"
#include "pcl2_timing.h"

/* The statuses. */
enum { ILOCK_BYPASSED = 1, ILOCK_REFUSED = 2, ILOCK_TOO_LONG = 3 };

/* The delay in periods, rounded up. */
static int64_t pcl2_ilock_periods(pcl2_real delay, int64_t T)
{
    const int64_t time = pcl2_set_time(delay, T);
    return time / T + (time % T != 0);
}

PCL2_KERNEL int32_t pcl2_ilock_check(int32_t n, pcl2_real delay, const int32_t *bypass, int64_t T, pcl2_real *left)
{
    (void)n;
    (void)bypass;
    const int64_t periods = pcl2_ilock_periods(delay, T);
    left[0] = (pcl2_real)periods;
    return periods < INT32_MAX ? 0 : ILOCK_TOO_LONG;
}

PCL2_KERNEL void pcl2_ilock_tune(
    struct pcl2_ilock *self, int32_t n, pcl2_real delay, const int32_t *bypass, int64_t T, int32_t *allowed)
{
    self->scans = (int32_t)pcl2_ilock_periods(delay, T);
    memcpy(allowed, bypass, (size_t)n * sizeof *allowed);
}

PCL2_KERNEL void pcl2_ilock_init(
    struct pcl2_ilock *self, int32_t n, pcl2_real delay, const int32_t *bypass, int32_t *since, int32_t *allowed,
    int32_t *bypassed)
{
    (void)self;
    (void)n;
    (void)delay;
    (void)bypass;
    (void)since;
    (void)allowed;
    (void)bypassed;
}

/* Judges the bypasses that are asked for. */
static void pcl2_ilock_bypass(
    struct pcl2_ilock *self, int32_t n, const int32_t *by, const int32_t *allowed, int32_t *bypassed)
{
    self->status = 0;
    for (int32_t i = 0; i < n; i++) {
        const int32_t asked = by[i] != 0;
        bypassed[i] = asked & (allowed[i] != 0);
        if (asked != bypassed[i]) {
            self->status = ILOCK_REFUSED;
        } else if (asked && self->status == 0) {
            self->status = ILOCK_BYPASSED;
        }
    }
}

/* The number of the first condition that is lost and not bypassed, from 1; 0: none. since counts the scans in which a
 * condition has been 0, the one in which it went included. */
static int32_t pcl2_ilock_lost(
    const struct pcl2_ilock *self, const int32_t *c, int32_t n, int32_t *since, const int32_t *bypassed)
{
    int32_t lost = 0;
    for (int32_t i = n; i > 0; i--) {
        const int32_t before = since[i - 1] <= self->scans ? since[i - 1] : self->scans;
        since[i - 1] = c[i - 1] != 0 ? 0 : before + 1;
        if (since[i - 1] > self->scans && bypassed[i - 1] == 0) {
            lost = i;
        }
    }
    return lost;
}

PCL2_KERNEL void pcl2_ilock(
    struct pcl2_ilock *self, const int32_t *c, int32_t n, const int32_t *by, int32_t rst, int32_t *since,
    const int32_t *allowed, int32_t *bypassed)
{
    const int32_t was = self->started == 0 || self->ok != 0;
    pcl2_ilock_bypass(self, n, by, allowed, bypassed);
    const int32_t lost = pcl2_ilock_lost(self, c, n, since, bypassed);
    self->ok = lost == 0;
    if (was && lost != 0) {
        self->first = lost;
    } else if (rst != 0 && lost == 0) {
        self->first = 0;
    }
    self->started = 1;
}
