/* How long an answer from zone 3 may take, in seconds. */
#include "pcl2_limit_3.h"

PCL2_KERNEL void pcl2_limit_3(struct pcl2_limit_3 *self, int32_t loaded)
{
    self->limit = PCL2_R(2.3) + PCL2_R(1.0)*(pcl2_real)loaded;
}
