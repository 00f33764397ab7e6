/* Whether a station lies in zone 6. */
#include "pcl2_stops_6.h"

PCL2_KERNEL void pcl2_stops_6(struct pcl2_stops_6 *self, int32_t goal)
{
    self->here = goal > 20 && goal <= 24;
}
