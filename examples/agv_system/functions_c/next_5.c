/* The zone behind zone 5 on the way to a station. */
#include "pcl2_next_5.h"

PCL2_KERNEL void pcl2_next_5(struct pcl2_next_5 *self, int32_t goal)
{
    (void)goal;
    self->next = 6;
}
