/* The zone behind zone 7 on the way to a station. */
#include "pcl2_next_7.h"

PCL2_KERNEL void pcl2_next_7(struct pcl2_next_7 *self, int32_t goal)
{
    (void)goal;
    self->next = 8;
}
