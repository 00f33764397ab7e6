/* How urgent an order is, 0 to 9. */
#include "pcl2_urgency.h"

PCL2_KERNEL void pcl2_urgency(struct pcl2_urgency *self, int32_t order)
{
    self->urgent = order/10000 - order/100000*10;
}
