/* The speed in zone 7, in mm/s. */
#include "pcl2_speed_7.h"

PCL2_KERNEL void pcl2_speed_7(struct pcl2_speed_7 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
