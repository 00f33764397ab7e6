/* The speed in zone 11, in mm/s. */
#include "pcl2_speed_11.h"

PCL2_KERNEL void pcl2_speed_11(struct pcl2_speed_11 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
