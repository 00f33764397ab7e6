/* The speed in zone 3, in mm/s. */
#include "pcl2_speed_3.h"

PCL2_KERNEL void pcl2_speed_3(struct pcl2_speed_3 *self, int32_t loaded)
{
    self->speed = 800 - 300*loaded;
}
