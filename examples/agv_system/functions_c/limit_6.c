/* How long an answer from zone 6 may take, in seconds. */
#include "pcl2_limit_6.h"

PCL2_KERNEL void pcl2_limit_6(struct pcl2_limit_6 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.6) + PCL2_R(1.0)*(pcl2_real)loaded;
}
