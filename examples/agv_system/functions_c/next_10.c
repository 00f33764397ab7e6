/* The zone behind zone 10 on the way to a station. */
#include "pcl2_next_10.h"

PCL2_KERNEL void pcl2_next_10(struct pcl2_next_10 *self, int32_t goal)
{
    (void)goal;
    self->next = 11;
}
