/* The speed in zone 10, in mm/s. */
#include "pcl2_speed_10.h"

PCL2_KERNEL void pcl2_speed_10(struct pcl2_speed_10 *self, int32_t loaded)
{
    self->speed = 800 - 300*loaded;
}
