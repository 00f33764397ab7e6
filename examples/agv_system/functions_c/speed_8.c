/* The speed in zone 8, in mm/s. */
#include "pcl2_speed_8.h"

PCL2_KERNEL void pcl2_speed_8(struct pcl2_speed_8 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
