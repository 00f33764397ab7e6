/* Delays in rings: whole scans, and a dead time between samples (Laakso and others, IEEE Signal Processing
 * Magazine 13, 1996). */
#include "pcl2_delay.h"
#include "pcl2_between.h"

PCL2_KERNEL void pcl2_delay_init(struct pcl2_delay *self, int32_t n, pcl2_real x0, pcl2_real *ring)
{
    for (int32_t i = 0; i < n; i++) {
        ring[i] = x0;
    }
    self->at = 0;
    self->y = x0;
}

PCL2_KERNEL void pcl2_delay(struct pcl2_delay *self, pcl2_real x, int32_t n, pcl2_real *ring)
{
    if (pcl2_is_bad(x)) {
        return;
    }
    self->y = ring[self->at];
    ring[self->at] = x;
    self->at = self->at + 1 < n ? self->at + 1 : 0;
}

PCL2_KERNEL void pcl2_dead_init(struct pcl2_dead *self, int32_t nmax, pcl2_real *ring)
{
    (void)nmax;
    (void)ring;
    self->started = 0;
}

PCL2_KERNEL void pcl2_dead_tune(struct pcl2_dead *self, int32_t nmax, int64_t T)
{
    (void)nmax;
    self->h = pcl2_seconds(T);
}

/* x(k - i); at is where the oldest sample, x(k - n), stands. */
static pcl2_real pcl2_dead_past(int32_t n, int32_t at, const pcl2_real *ring, pcl2_real x, int32_t i)
{
    const int32_t slot = at - i;
    return i == 0 ? x : ring[slot < 0 ? slot + n : slot];
}

/* 1 when the dead time, in periods, had to be clamped. */
static int32_t pcl2_dead_clamp(pcl2_real *periods, int32_t nmax)
{
    const pcl2_real most = (pcl2_real)nmax;
    const pcl2_real asked = *periods;
    *periods = asked >= most ? most : asked > PCL2_R(0.0) ? asked : PCL2_R(0.0);
    return asked > most || asked < PCL2_R(0.0);
}

PCL2_KERNEL void pcl2_dead(struct pcl2_dead *self, pcl2_real x, pcl2_real td, int32_t nmax, pcl2_real *ring)
{
    self->status = 0;
    if (pcl2_is_bad(x) || pcl2_is_bad(td)) {
        return;
    }
    for (; self->started < nmax; self->started++) {
        ring[self->started] = x;
    }
    pcl2_real periods = td / self->h;
    self->status = pcl2_dead_clamp(&periods, nmax);
    const int32_t i = (int32_t)periods;
    const pcl2_real f = periods - (pcl2_real)i;
    const pcl2_real late = pcl2_dead_past(nmax, self->at, ring, x, i);
    const pcl2_real later = i < nmax ? pcl2_dead_past(nmax, self->at, ring, x, i + 1) : late;
    self->y = pcl2_between(late, later, f);
    ring[self->at] = x;
    self->at = self->at + 1 < nmax ? self->at + 1 : 0;
}
