/* How long an answer from zone 1 may take, in seconds. */
#include "pcl2_limit_1.h"

PCL2_KERNEL void pcl2_limit_1(struct pcl2_limit_1 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.1) + PCL2_R(1.0)*(pcl2_real)loaded;
}
