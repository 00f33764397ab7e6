/* How long an answer from zone 11 may take, in seconds. */
#include "pcl2_limit_11.h"

PCL2_KERNEL void pcl2_limit_11(struct pcl2_limit_11 *self, int32_t loaded)
{
    self->limit = PCL2_R(3.1) + PCL2_R(1.0)*(pcl2_real)loaded;
}
