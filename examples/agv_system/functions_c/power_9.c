/* The battery's charge behind zone 9, in percent. */
#include "pcl2_power_9.h"

PCL2_KERNEL void pcl2_power_9(struct pcl2_power_9 *self, pcl2_real power, int32_t loaded)
{
    self->left = power - PCL2_R(0.48) - PCL2_R(0.2)*(pcl2_real)loaded;
}
