/* Whether a station lies in zone 10. */
#include "pcl2_stops_10.h"

PCL2_KERNEL void pcl2_stops_10(struct pcl2_stops_10 *self, int32_t goal)
{
    self->here = goal > 36 && goal <= 40;
}
