/* Moving average by a running sum. */
#include "pcl2_mavg.h"

PCL2_KERNEL void pcl2_mavg_init(struct pcl2_mavg *self, int32_t n, pcl2_real *ring)
{
    (void)n;
    (void)ring;
    self->started = 0;
}

/* 1 when the sum has a place among the reals. */
static int32_t pcl2_mavg_start(struct pcl2_mavg *self, pcl2_real x, int32_t n, pcl2_real *ring)
{
    for (int32_t i = 0; i < n; i++) {
        ring[i] = x;
    }
    const pcl2_real sum = x * (pcl2_real)n;
    self->started = !pcl2_is_bad(sum);
    self->sum = self->started != 0 ? sum : PCL2_R(0.0);
    return self->started;
}

/* fresh is the sum of what the ring got since slot 0: with the last slot it is the whole sum. */
PCL2_KERNEL void pcl2_mavg(struct pcl2_mavg *self, pcl2_real x, int32_t n, pcl2_real *ring)
{
    if (pcl2_is_bad(x) || (self->started == 0 && !pcl2_mavg_start(self, x, n, ring))) {
        return;
    }
    const int32_t last = self->at + 1 == n;
    const pcl2_real fresh = self->fresh + x;
    const pcl2_real sum = last ? fresh : self->sum + (x - ring[self->at]);
    if (pcl2_is_bad(sum) || pcl2_is_bad(fresh)) {
        return;
    }
    ring[self->at] = x;
    self->sum = sum;
    self->fresh = last ? PCL2_R(0.0) : fresh;
    self->at = last ? 0 : self->at + 1;
    self->y = sum / (pcl2_real)n;
}
