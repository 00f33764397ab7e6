/* Edges of truth values (IEC 61131-3, R_TRIG and F_TRIG). The first scan only takes the value in. */
#include "pcl2_edges.h"

PCL2_KERNEL void pcl2_rtrig_init(struct pcl2_rtrig *self, int32_t first)
{
    (void)self;
    (void)first;
}

PCL2_KERNEL void pcl2_rtrig(struct pcl2_rtrig *self, int32_t x, int32_t first)
{
    const int32_t comparable = self->started | (first != 0);
    self->q = (x != 0) & (self->last == 0) & comparable;
    self->last = x;
    self->started = 1;
}

PCL2_KERNEL void pcl2_ftrig_init(struct pcl2_ftrig *self, int32_t first)
{
    (void)first;
    self->last = 1;
}

PCL2_KERNEL void pcl2_ftrig(struct pcl2_ftrig *self, int32_t x, int32_t first)
{
    const int32_t comparable = self->started | (first != 0);
    self->q = (x == 0) & (self->last != 0) & comparable;
    self->last = x;
    self->started = 1;
}
