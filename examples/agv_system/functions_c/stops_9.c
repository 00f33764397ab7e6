/* Whether a station lies in zone 9. */
#include "pcl2_stops_9.h"

PCL2_KERNEL void pcl2_stops_9(struct pcl2_stops_9 *self, int32_t goal)
{
    self->here = goal > 32 && goal <= 36;
}
