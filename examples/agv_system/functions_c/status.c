/* What the display shows of a vehicle: 1000 vehicle + its last request. */
#include "pcl2_status.h"

PCL2_KERNEL void pcl2_status(struct pcl2_status *self, int32_t id, int32_t number)
{
    self->shown = 1000*id + number;
}
