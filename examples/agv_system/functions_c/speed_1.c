/* The speed in zone 1, in mm/s. */
#include "pcl2_speed_1.h"

PCL2_KERNEL void pcl2_speed_1(struct pcl2_speed_1 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
