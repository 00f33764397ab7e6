/* The battery's charge behind zone 11, in percent. */
#include "pcl2_power_11.h"

PCL2_KERNEL void pcl2_power_11(struct pcl2_power_11 *self, pcl2_real power, int32_t loaded)
{
    self->left = power - PCL2_R(0.52) - PCL2_R(0.2)*(pcl2_real)loaded;
}
