/* Adds up the times of a route's moves. */
#include "pcl2_duration.h"

enum { DURATION_BASE = 4 };

PCL2_KERNEL void pcl2_duration(struct pcl2_duration *self, int32_t word)
{
    self->t = PCL2_R(0.0);
    for (int32_t rest = word; rest > 0; rest /= DURATION_BASE) {
        self->t += PCL2_R(1.0);
    }
}
