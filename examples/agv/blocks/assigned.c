/* Assigns a request to a vehicle. */
#include "pcl2_assigned.h"

PCL2_KERNEL void pcl2_assigned(struct pcl2_assigned *self, int32_t waiting, int32_t id, int32_t requests)
{
    self->vehicle = waiting > 0 && requests > 0 ? id : 0;
}
