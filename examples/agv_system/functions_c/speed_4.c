/* The speed in zone 4, in mm/s. */
#include "pcl2_speed_4.h"

PCL2_KERNEL void pcl2_speed_4(struct pcl2_speed_4 *self, int32_t loaded)
{
    self->speed = 800 - 300*loaded;
}
