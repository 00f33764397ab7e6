/* Whether a station lies in zone 5. */
#include "pcl2_stops_5.h"

PCL2_KERNEL void pcl2_stops_5(struct pcl2_stops_5 *self, int32_t goal)
{
    self->here = goal > 16 && goal <= 20;
}
