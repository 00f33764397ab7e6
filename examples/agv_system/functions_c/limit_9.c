/* How long an answer from zone 9 may take, in seconds. */
#include "pcl2_limit_9.h"

PCL2_KERNEL void pcl2_limit_9(struct pcl2_limit_9 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.9) + PCL2_R(1.0)*(pcl2_real)loaded;
}
