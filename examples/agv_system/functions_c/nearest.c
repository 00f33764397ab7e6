/* The free vehicle with the least cost, the first of equal ones; 0 if none is free. */
#include "pcl2_nearest.h"

PCL2_KERNEL void pcl2_nearest(struct pcl2_nearest *self, int32_t free1, int32_t free2, int32_t free3, int32_t free4, int32_t free5, int32_t cost1, int32_t cost2, int32_t cost3, int32_t cost4, int32_t cost5)
{
    const int32_t bid1 = cost1 + 1000*(1 - free1);
    const int32_t bid2 = cost2 + 1000*(1 - free2);
    const int32_t bid3 = cost3 + 1000*(1 - free3);
    const int32_t bid4 = cost4 + 1000*(1 - free4);
    const int32_t bid5 = cost5 + 1000*(1 - free5);
    self->vehicle = 1*(bid1 < 1000 && bid1 <= bid2 && bid1 <= bid3 && bid1 <= bid4 && bid1 <= bid5) + 2*(bid2 < 1000 && bid2 < bid1 && bid2 <= bid3 && bid2 <= bid4 && bid2 <= bid5) + 3*(bid3 < 1000 && bid3 < bid1 && bid3 < bid2 && bid3 <= bid4 && bid3 <= bid5) + 4*(bid4 < 1000 && bid4 < bid1 && bid4 < bid2 && bid4 < bid3 && bid4 <= bid5) + 5*(bid5 < 1000 && bid5 < bid1 && bid5 < bid2 && bid5 < bid3 && bid5 < bid4);
}
