/* Whether a station lies in zone 2. */
#include "pcl2_stops_2.h"

PCL2_KERNEL void pcl2_stops_2(struct pcl2_stops_2 *self, int32_t goal)
{
    self->here = goal > 4 && goal <= 8;
}
