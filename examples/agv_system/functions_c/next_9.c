/* The zone behind zone 9 on the way to a station. */
#include "pcl2_next_9.h"

PCL2_KERNEL void pcl2_next_9(struct pcl2_next_9 *self, int32_t goal)
{
    const int32_t zone = (goal + 3)/4;
    self->next = 10 + -6*(zone == 4 || zone == 5 || zone == 6 || zone == 7 || zone == 8 || zone == 9);
}
