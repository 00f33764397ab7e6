/* How long an answer from zone 12 may take, in seconds. */
#include "pcl2_limit_12.h"

PCL2_KERNEL void pcl2_limit_12(struct pcl2_limit_12 *self, int32_t loaded)
{
    self->limit = PCL2_R(3.2) + PCL2_R(1.0)*(pcl2_real)loaded;
}
