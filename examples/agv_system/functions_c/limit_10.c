/* How long an answer from zone 10 may take, in seconds. */
#include "pcl2_limit_10.h"

PCL2_KERNEL void pcl2_limit_10(struct pcl2_limit_10 *self, int32_t loaded)
{
    self->limit = PCL2_R(3.0) + PCL2_R(1.0)*(pcl2_real)loaded;
}
