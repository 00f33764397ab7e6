/* Whether a battery must be charged before the next transport. */
#include "pcl2_weak.h"

PCL2_KERNEL void pcl2_weak(struct pcl2_weak *self, pcl2_real power)
{
    self->low = power < 30.0;
}
