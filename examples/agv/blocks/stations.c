/* Reads an order of the production computer. */
#include "pcl2_stations.h"

enum { STATIONS_MOST = 8 };

static int32_t pcl2_stations_know(int32_t number)
{
    return number >= 1 && number <= STATIONS_MOST;
}

PCL2_KERNEL void pcl2_stations(struct pcl2_stations *self, int32_t order)
{
    const int32_t pick = order / 100;
    const int32_t drop = order % 100;
    const int32_t legal = pcl2_stations_know(pick) && pcl2_stations_know(drop) && pick != drop;
    self->pick = legal ? pick : 0;
    self->drop = legal ? drop : 0;
}
