/* Sample and hold. */
#include "pcl2_hold.h"

PCL2_KERNEL void pcl2_hold_init(struct pcl2_hold *self)
{
    self->started = 0;
}

PCL2_KERNEL void pcl2_hold(struct pcl2_hold *self, pcl2_real x, int32_t trig)
{
    if (pcl2_is_bad(x)) {
        return;
    }
    if (self->started == 0 || (trig != 0 && self->trig1 == 0)) {
        self->y = x;
    }
    self->started = 1;
    self->trig1 = trig != 0;
}
