/* The zone behind zone 6 on the way to a station. */
#include "pcl2_next_6.h"

PCL2_KERNEL void pcl2_next_6(struct pcl2_next_6 *self, int32_t goal)
{
    (void)goal;
    self->next = 7;
}
