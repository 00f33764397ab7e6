/* The speed in zone 9, in mm/s. */
#include "pcl2_speed_9.h"

PCL2_KERNEL void pcl2_speed_9(struct pcl2_speed_9 *self, int32_t loaded)
{
    self->speed = 800 - 300*loaded;
}
