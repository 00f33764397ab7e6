/* Whether a station lies in zone 11. */
#include "pcl2_stops_11.h"

PCL2_KERNEL void pcl2_stops_11(struct pcl2_stops_11 *self, int32_t goal)
{
    self->here = goal > 40 && goal <= 44;
}
