/* The stations of an order, 10000 urgency + 100 pick + drop; 0 where one is not there. */
#include "pcl2_stations.h"

PCL2_KERNEL void pcl2_stations(struct pcl2_stations *self, int32_t order)
{
    const int32_t pick = order/100 - order/10000*100;
    const int32_t drop = order - order/100*100;
    const int32_t legal = (pick >= 1 && pick <= 48 && drop >= 1 && drop <= 48 && pick != drop);
    self->load_at = legal*pick;
    self->bring_to = legal*drop;
}
