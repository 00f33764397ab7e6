/* The zone behind zone 3 on the way to a station. */
#include "pcl2_next_3.h"

PCL2_KERNEL void pcl2_next_3(struct pcl2_next_3 *self, int32_t goal)
{
    const int32_t zone = (goal + 3)/4;
    self->next = 4 + 6*(zone == 1 || zone == 2 || zone == 3 || zone == 10 || zone == 11 || zone == 12);
}
