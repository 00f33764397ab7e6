/* The speed in zone 6, in mm/s. */
#include "pcl2_speed_6.h"

PCL2_KERNEL void pcl2_speed_6(struct pcl2_speed_6 *self, int32_t loaded)
{
    self->speed = 1000 - 200*loaded;
}
