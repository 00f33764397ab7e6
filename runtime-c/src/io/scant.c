/* Scan times: the executive's measurement against the period. */
#include "pcl2_scant.h"

PCL2_KERNEL void pcl2_scant_tune(struct pcl2_scant *self, int64_t T)
{
    self->period = pcl2_seconds(T);
    self->limit = pcl2_saturate_i(T / 1000);
}

PCL2_KERNEL void pcl2_scant_init(struct pcl2_scant *self)
{
    self->longest = 0;
    self->late = 0;
}

PCL2_KERNEL void pcl2_scant(struct pcl2_scant *self, int32_t reset, int32_t word)
{
    const int32_t duration = word > 0 ? word : 0;
    const int32_t longest = reset != 0 ? 0 : self->longest;
    const int32_t late = reset != 0 ? 0 : self->late;
    self->longest = duration > longest ? duration : longest;
    self->late = pcl2_add_i(late, duration > self->limit);
    self->T = self->period;
    self->last = duration;
    self->max = self->longest;
    self->overruns = self->late;
}
