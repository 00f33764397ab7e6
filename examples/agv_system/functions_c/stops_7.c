/* Whether a station lies in zone 7. */
#include "pcl2_stops_7.h"

PCL2_KERNEL void pcl2_stops_7(struct pcl2_stops_7 *self, int32_t goal)
{
    self->here = goal > 24 && goal <= 28;
}
