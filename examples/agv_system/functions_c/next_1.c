/* The zone behind zone 1 on the way to a station. */
#include "pcl2_next_1.h"

PCL2_KERNEL void pcl2_next_1(struct pcl2_next_1 *self, int32_t goal)
{
    (void)goal;
    self->next = 2;
}
