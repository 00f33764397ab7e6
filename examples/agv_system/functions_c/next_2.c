/* The zone behind zone 2 on the way to a station. */
#include "pcl2_next_2.h"

PCL2_KERNEL void pcl2_next_2(struct pcl2_next_2 *self, int32_t goal)
{
    (void)goal;
    self->next = 3;
}
