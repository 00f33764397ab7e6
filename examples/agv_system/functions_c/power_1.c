/* The battery's charge behind zone 1, in percent. */
#include "pcl2_power_1.h"

PCL2_KERNEL void pcl2_power_1(struct pcl2_power_1 *self, pcl2_real power, int32_t loaded)
{
    self->left = power - PCL2_R(0.32) - PCL2_R(0.2)*(pcl2_real)loaded;
}
