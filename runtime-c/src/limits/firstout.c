/* The order in which alarms came. */
#include "pcl2_firstout.h"

PCL2_KERNEL void pcl2_firstout_init(struct pcl2_firstout *self, int32_t n, int32_t *order)
{
    (void)self;
    (void)n;
    (void)order;
}

PCL2_KERNEL void pcl2_firstout(struct pcl2_firstout *self, const int32_t *x, int32_t n, int32_t rst, int32_t *order)
{
    if (rst != 0) {
        self->came = 0;
        self->idx = 0;
    }
    for (int32_t i = 0; i < n; i++) {
        const int32_t known = rst != 0 ? 0 : order[i];
        const int32_t comes = (x[i] != 0) & (known == 0) & (rst == 0);
        self->came += comes;
        order[i] = comes ? self->came : known;
        self->idx = order[i] == 1 ? i + 1 : self->idx;
    }
}
