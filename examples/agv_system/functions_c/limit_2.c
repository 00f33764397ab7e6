/* How long an answer from zone 2 may take, in seconds. */
#include "pcl2_limit_2.h"

PCL2_KERNEL void pcl2_limit_2(struct pcl2_limit_2 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.2) + PCL2_R(1.0)*(pcl2_real)loaded;
}
