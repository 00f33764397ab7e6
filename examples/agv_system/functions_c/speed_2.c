/* The speed in zone 2, in mm/s. */
#include "pcl2_speed_2.h"

PCL2_KERNEL void pcl2_speed_2(struct pcl2_speed_2 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
