/* Counters (IEC 61131-3, CTU, CTD and CTUD). The first scan only takes the inputs in. */
#include "pcl2_counters.h"

PCL2_KERNEL void pcl2_ctu_init(struct pcl2_ctu *self)
{
    (void)self;
}

PCL2_KERNEL void pcl2_ctu(struct pcl2_ctu *self, int32_t cu, int32_t r, int32_t pv)
{
    const int32_t edge = (cu != 0) & (self->last == 0) & self->started;
    self->cv = r != 0 ? 0 : pcl2_add_i(self->cv, edge);
    self->q = self->cv >= pv;
    self->last = cu;
    self->started = 1;
}

PCL2_KERNEL void pcl2_ctd_init(struct pcl2_ctd *self)
{
    (void)self;
}

PCL2_KERNEL void pcl2_ctd(struct pcl2_ctd *self, int32_t cd, int32_t ld, int32_t pv)
{
    const int32_t edge = (cd != 0) & (self->last == 0) & self->started;
    self->cv = ld != 0 ? pv : pcl2_sub_i(self->cv, edge);
    self->q = self->cv <= 0;
    self->last = cd;
    self->started = 1;
}

PCL2_KERNEL void pcl2_ctud_init(struct pcl2_ctud *self)
{
    (void)self;
}

PCL2_KERNEL void pcl2_ctud(struct pcl2_ctud *self, int32_t cu, int32_t cd, int32_t r, int32_t ld, int32_t pv)
{
    const int32_t up = (cu != 0) & (self->lastu == 0) & self->started;
    const int32_t down = (cd != 0) & (self->lastd == 0) & self->started;
    self->cv = r != 0 ? 0 : ld != 0 ? pv : pcl2_add_i(self->cv, up - down);
    self->qu = self->cv >= pv;
    self->qd = self->cv <= 0;
    self->lastu = cu;
    self->lastd = cd;
    self->started = 1;
}
