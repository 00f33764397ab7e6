/* How long an answer from zone 4 may take, in seconds. */
#include "pcl2_limit_4.h"

PCL2_KERNEL void pcl2_limit_4(struct pcl2_limit_4 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.4) + PCL2_R(1.0)*(pcl2_real)loaded;
}
