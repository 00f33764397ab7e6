/* Whether a station lies in zone 8. */
#include "pcl2_stops_8.h"

PCL2_KERNEL void pcl2_stops_8(struct pcl2_stops_8 *self, int32_t goal)
{
    self->here = goal > 28 && goal <= 32;
}
