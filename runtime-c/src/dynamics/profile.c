/* Set-point program with guaranteed soak. */
#include "pcl2_profile.h"
#include "pcl2_between.h"
#include "pcl2_timing.h"

PCL2_KERNEL void pcl2_profile_init(
    struct pcl2_profile *self, int32_t n, const pcl2_real *t, const pcl2_real *v, pcl2_real k, pcl2_real *at,
    pcl2_real *level)
{
    (void)k;
    (void)at;
    (void)level;
    self->y = v[0];
    self->tleft = t[n - 1];
}

PCL2_KERNEL void pcl2_profile_tune(
    struct pcl2_profile *self, int32_t n, const pcl2_real *t, const pcl2_real *v, pcl2_real k, int64_t T, pcl2_real *at,
    pcl2_real *level)
{
    for (int32_t i = 0; i < n; i++) {
        at[i] = t[i];
        level[i] = v[i];
    }
    self->band = k;
    self->tick = T;
    self->span = pcl2_set_time(t[n - 1], T);
    self->until = -1;
}

PCL2_KERNEL int32_t pcl2_profile_check(
    int32_t n, const pcl2_real *t, const pcl2_real *v, pcl2_real k, int64_t T, pcl2_real *left)
{
    (void)v;
    (void)k;
    (void)T;
    for (int32_t i = 1; i < n; i++) {
        if (!(t[i] > t[i - 1])) {
            left[0] = t[i - 1];
            left[1] = t[i];
            return 1;
        }
    }
    return 0;
}

/* Finds the segment of now: seg, and the times begin and until that enclose now. */
static void pcl2_profile_find(struct pcl2_profile *self, int32_t n, const pcl2_real *at)
{
    self->seg = 0;
    self->begin = 0;
    self->until = pcl2_set_time(at[0], self->tick);
    while (self->now >= self->until) {
        self->seg++;
        self->begin = self->until;
        self->until = self->seg < n ? pcl2_set_time(at[self->seg], self->tick) : INT64_MAX;
    }
}

static pcl2_real pcl2_profile_value(const struct pcl2_profile *self, int32_t n, const pcl2_real *level)
{
    const int32_t seg = self->seg;
    if (seg == 0 || seg == n) {
        return level[seg == 0 ? 0 : n - 1];
    }
    const pcl2_real passed = (pcl2_real)(self->now - self->begin);
    return pcl2_between(level[seg - 1], level[seg], passed / (pcl2_real)(self->until - self->begin));
}

PCL2_KERNEL void pcl2_profile(
    struct pcl2_profile *self, int32_t run, int32_t hold, int32_t rst, int32_t n, pcl2_real fb, const pcl2_real *at,
    const pcl2_real *level)
{
    self->status = 0;
    self->now = rst != 0 ? 0 : self->now;
    if (self->now >= self->until || self->now < self->begin) {
        pcl2_profile_find(self, n, at);
    }
    self->y = pcl2_profile_value(self, n, level);
    self->done = self->now >= self->span;
    self->tleft = self->done != 0 ? PCL2_R(0.0) : pcl2_seconds(self->span - self->now);
    const pcl2_real gap = self->y - fb;
    const int32_t soaked = self->band <= PCL2_R(0.0) || (gap <= self->band && gap >= -self->band);
    if (run != 0 && hold == 0 && rst == 0 && self->done == 0 && soaked) {
        self->now += self->tick;
    }
}
