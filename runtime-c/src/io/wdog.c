/* Supervision of a heart beat. */
#include "pcl2_timing.h"
#include "pcl2_wdog.h"

PCL2_KERNEL void pcl2_wdog_tune(struct pcl2_wdog *self, pcl2_real t, int64_t T)
{
    self->limit = pcl2_set_time(t, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_wdog_init(struct pcl2_wdog *self, pcl2_real t)
{
    (void)self;
    (void)t;
}

PCL2_KERNEL void pcl2_wdog(struct pcl2_wdog *self, int32_t in)
{
    const int32_t beats = in != self->last || self->started == 0;
    self->since = beats ? 0 : pcl2_elapse(self->since, self->tick, self->limit);
    self->q = !beats && self->since >= self->limit;
    self->last = in;
    self->started = 1;
}
