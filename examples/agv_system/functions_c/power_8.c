/* The battery's charge behind zone 8, in percent. */
#include "pcl2_power_8.h"

PCL2_KERNEL void pcl2_power_8(struct pcl2_power_8 *self, pcl2_real power, int32_t loaded)
{
    self->left = power - PCL2_R(0.46) - PCL2_R(0.2)*(pcl2_real)loaded;
}
