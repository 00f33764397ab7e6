/* Finds the way on a ring. */
#include "pcl2_route.h"

enum { ROUTE_STATIONS = 8, ROUTE_SIDE = 2, ROUTE_PASS = 1, ROUTE_LEFT = 2, ROUTE_STOP = 3, ROUTE_BASE = 4 };

static int32_t pcl2_route_knows(int32_t number)
{
    return number >= 1 && number <= ROUTE_STATIONS;
}

PCL2_KERNEL void pcl2_route(struct pcl2_route *self, int32_t here, int32_t there)
{
    self->word = 0;
    if (!pcl2_route_knows(here) || !pcl2_route_knows(there)) {
        return;
    }
    int32_t at = here;
    while (at != there) {
        if (at % ROUTE_SIDE == 0) {
            self->word = ROUTE_BASE * self->word + ROUTE_LEFT;
        }
        at = at % ROUTE_STATIONS + 1;
        if (at != there) {
            self->word = ROUTE_BASE * self->word + ROUTE_PASS;
        }
    }
    self->word = ROUTE_BASE * self->word + ROUTE_STOP;
}
