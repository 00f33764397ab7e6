/* The zone behind zone 12 on the way to a station. */
#include "pcl2_next_12.h"

PCL2_KERNEL void pcl2_next_12(struct pcl2_next_12 *self, int32_t goal)
{
    (void)goal;
    self->next = 1;
}
