/* How long an answer from zone 8 may take, in seconds. */
#include "pcl2_limit_8.h"

PCL2_KERNEL void pcl2_limit_8(struct pcl2_limit_8 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.8) + PCL2_R(1.0)*(pcl2_real)loaded;
}
