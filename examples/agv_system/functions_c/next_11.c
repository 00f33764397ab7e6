/* The zone behind zone 11 on the way to a station. */
#include "pcl2_next_11.h"

PCL2_KERNEL void pcl2_next_11(struct pcl2_next_11 *self, int32_t goal)
{
    (void)goal;
    self->next = 12;
}
