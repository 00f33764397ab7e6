/* The speed in zone 5, in mm/s. */
#include "pcl2_speed_5.h"

PCL2_KERNEL void pcl2_speed_5(struct pcl2_speed_5 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
