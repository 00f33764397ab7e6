/* Read-back: the return wire of a measured position. */
#include "pcl2_rback.h"
#include "pcl2_return.h"

PCL2_KERNEL void pcl2_rback_init(struct pcl2_rback *self, pcl2_real *bk)
{
    (void)self;
    (void)bk;
}

PCL2_KERNEL void pcl2_rback(struct pcl2_rback *self, pcl2_real pos, int32_t local, pcl2_real *bk)
{
    const int32_t bad = pcl2_is_bad(pos);
    const int32_t waiting = !bad && (local != 0 || self->started == 0);
    pcl2_hand_back(bk, bad ? bk[0] : pos, waiting ? PCL2_WAITING : PCL2_FOLLOWING);
    self->started = 1;
}
