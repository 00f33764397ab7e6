/* The zone in which a station lies. */
#include "pcl2_zone_of.h"

PCL2_KERNEL void pcl2_zone_of(struct pcl2_zone_of *self, int32_t station)
{
    self->zone = (station + 3)/4;
}
