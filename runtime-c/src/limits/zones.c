/* Characteristics that remember where they stand. */
#include "pcl2_zones.h"

PCL2_KERNEL void pcl2_dband_init(struct pcl2_dband *self, pcl2_real w)
{
    (void)self;
    (void)w;
}

PCL2_KERNEL void pcl2_dband(struct pcl2_dband *self, pcl2_real x, pcl2_real w)
{
    if (PCL2_RARELY(pcl2_is_bad(x))) {
        return;
    }
    const pcl2_real distance = x < self->y ? self->y - x : x - self->y;
    if (self->started == 0 || distance > w) {
        self->y = x;
    }
    self->started = 1;
}

PCL2_KERNEL void pcl2_backl_init(struct pcl2_backl *self, pcl2_real w)
{
    (void)self;
    (void)w;
}

PCL2_KERNEL void pcl2_backl(struct pcl2_backl *self, pcl2_real x, pcl2_real w)
{
    if (PCL2_RARELY(pcl2_is_bad(x))) {
        return;
    }
    const pcl2_real half = self->started != 0 ? w * PCL2_R(0.5) : PCL2_R(0.0);
    if (self->y < x - half) {
        self->y = x - half;
    } else if (self->y > x + half) {
        self->y = x + half;
    }
    self->started = 1;
}
