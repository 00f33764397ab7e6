/* Whether a station lies in zone 12. */
#include "pcl2_stops_12.h"

PCL2_KERNEL void pcl2_stops_12(struct pcl2_stops_12 *self, int32_t goal)
{
    self->here = goal > 44 && goal <= 48;
}
