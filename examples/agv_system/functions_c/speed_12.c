/* The speed in zone 12, in mm/s. */
#include "pcl2_speed_12.h"

PCL2_KERNEL void pcl2_speed_12(struct pcl2_speed_12 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
