/* Whether a station lies in zone 4. */
#include "pcl2_stops_4.h"

PCL2_KERNEL void pcl2_stops_4(struct pcl2_stops_4 *self, int32_t goal)
{
    self->here = goal > 12 && goal <= 16;
}
