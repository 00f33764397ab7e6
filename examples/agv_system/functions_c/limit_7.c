/* How long an answer from zone 7 may take, in seconds. */
#include "pcl2_limit_7.h"

PCL2_KERNEL void pcl2_limit_7(struct pcl2_limit_7 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.7) + PCL2_R(1.0)*(pcl2_real)loaded;
}
