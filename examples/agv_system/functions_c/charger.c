/* The station where a vehicle is charged. */
#include "pcl2_charger.h"

PCL2_KERNEL void pcl2_charger(struct pcl2_charger *self, int32_t id)
{
    self->station = 48 - id + 1;
}
