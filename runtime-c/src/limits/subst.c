/* Substitution of a bad signal, for a time. */
#include "pcl2_subst.h"
#include "pcl2_timing.h"

enum { SUBST_SUBSTITUTED = 1, SUBST_LATE = 2 };

PCL2_KERNEL void pcl2_subst_tune(struct pcl2_subst *self, pcl2_real tlim, int64_t T)
{
    self->limit = pcl2_set_time(tlim, T);
    self->tick = T;
}

PCL2_KERNEL void pcl2_subst_init(struct pcl2_subst *self, pcl2_real tlim)
{
    (void)self;
    (void)tlim;
}

PCL2_KERNEL void pcl2_subst(struct pcl2_subst *self, pcl2_real x, pcl2_real sub)
{
    const int32_t bad = pcl2_is_bad(x);
    const int32_t late = bad && self->limit > 0 && self->since >= self->limit;
    self->used = bad && !late;
    self->y = self->used ? sub : x;
    self->status = late ? SUBST_LATE : bad ? SUBST_SUBSTITUTED : 0;
    self->since = bad ? pcl2_elapse(self->since, self->tick, self->limit) : 0;
}
