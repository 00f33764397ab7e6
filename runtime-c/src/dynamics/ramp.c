/* Linear ramp to a target. */
#include "pcl2_ramp.h"
#include "pcl2_sum.h"

PCL2_KERNEL void pcl2_ramp_init(struct pcl2_ramp *self, pcl2_real rate, pcl2_real y0)
{
    (void)rate;
    self->y = y0;
}

PCL2_KERNEL void pcl2_ramp_tune(struct pcl2_ramp *self, pcl2_real rate, pcl2_real y0, int64_t T)
{
    self->step = rate * pcl2_seconds(T);
    self->base = y0;
}

static void pcl2_ramp_move(struct pcl2_ramp *self, pcl2_real tgt)
{
    const pcl2_real gap = tgt - self->y;
    if (gap <= self->step && gap >= -self->step) {
        self->y = tgt;
        self->carry = PCL2_R(0.0);
    } else {
        self->y = pcl2_sum(self->y, gap > PCL2_R(0.0) ? self->step : -self->step, &self->carry);
    }
}

PCL2_KERNEL void pcl2_ramp(struct pcl2_ramp *self, pcl2_real tgt, int32_t run, int32_t rst)
{
    if (rst != 0) {
        self->y = self->base;
        self->carry = PCL2_R(0.0);
    } else if (run != 0 && !pcl2_is_bad(tgt)) {
        pcl2_ramp_move(self, tgt);
    }
    self->done = pcl2_is_bad(tgt) ? self->done : self->y == tgt;
}
