/* How long an answer from zone 5 may take, in seconds. */
#include "pcl2_limit_5.h"

PCL2_KERNEL void pcl2_limit_5(struct pcl2_limit_5 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.5) + PCL2_R(1.0)*(pcl2_real)loaded;
}
