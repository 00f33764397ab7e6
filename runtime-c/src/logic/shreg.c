/* Shift register of truth values. */
#include "pcl2_shreg.h"

PCL2_KERNEL void pcl2_shreg_init(struct pcl2_shreg *self, int32_t n, int32_t *y)
{
    (void)self;
    (void)n;
    (void)y;
}

PCL2_KERNEL void pcl2_shreg(struct pcl2_shreg *self, int32_t in, int32_t clk, int32_t n, int32_t r, int32_t *y)
{
    if ((clk != 0) & (self->last == 0) & self->started) {
        for (int32_t i = n - 1; i > 0; i--) {
            y[i] = y[i - 1];
        }
        y[0] = in != 0;
    }
    if (r != 0) {
        memset(y, 0, (size_t)n * sizeof *y);
    }
    self->q = y[n - 1];
    self->last = clk;
    self->started = 1;
}
