/* Whether a station lies in zone 1. */
#include "pcl2_stops_1.h"

PCL2_KERNEL void pcl2_stops_1(struct pcl2_stops_1 *self, int32_t goal)
{
    self->here = goal > 0 && goal <= 4;
}
