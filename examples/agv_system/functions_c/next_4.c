/* The zone behind zone 4 on the way to a station. */
#include "pcl2_next_4.h"

PCL2_KERNEL void pcl2_next_4(struct pcl2_next_4 *self, int32_t goal)
{
    (void)goal;
    self->next = 5;
}
