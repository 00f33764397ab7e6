/* Whether a station lies in zone 3. */
#include "pcl2_stops_3.h"

PCL2_KERNEL void pcl2_stops_3(struct pcl2_stops_3 *self, int32_t goal)
{
    self->here = goal > 8 && goal <= 12;
}
