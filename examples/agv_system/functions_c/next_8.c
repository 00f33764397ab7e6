/* The zone behind zone 8 on the way to a station. */
#include "pcl2_next_8.h"

PCL2_KERNEL void pcl2_next_8(struct pcl2_next_8 *self, int32_t goal)
{
    (void)goal;
    self->next = 9;
}
